//! Hands out words of memory.

use std::collections::HashMap;

use naga::{Arena, Expression, Handle, Literal, Module};

use super::super::layout;
use super::super::program::{Function, Program, Slot};

/// Constants lie together, so that a machine touches few pages of memory before it runs.
const BLOCK: u32 = 64;

/// Memory that is handed out, and what is in it from the beginning.
#[derive(Default)]
pub(super) struct Memory {
    next: Slot,
    constants: Vec<(Slot, u32)>,
    slots: HashMap<u32, Slot>,
    words: HashMap<Slot, u32>,
    variables: Vec<(Slot, u32)>,
    tables: Vec<Vec<u32>>,
    table_indices: HashMap<Vec<u32>, u32>,
}

impl Memory {
    /// The first of so many new words, one after the other.
    pub(super) fn fresh(&mut self, words: u32) -> Slot {
        let first = self.next;
        self.next += words;
        first
    }

    /// Place of a constant.
    pub(super) fn constant(&mut self, word: u32) -> Slot {
        if let Some(slot) = self.slots.get(&word) {
            return *slot;
        }
        let slot = match self.constants.last() {
            Some((last, _)) if !(last + 1).is_multiple_of(BLOCK) => last + 1,
            _ => {
                let first = self.next.next_multiple_of(BLOCK);
                self.next = first + BLOCK;
                first
            }
        };
        self.constants.push((slot, word));
        self.slots.insert(word, slot);
        self.words.insert(slot, word);
        slot
    }

    /// The constant that is at a place.
    pub(super) fn word(&self, slot: Slot) -> Option<u32> {
        self.words.get(&slot).copied()
    }

    /// Beginning of a private variable that starts with these words.
    pub(super) fn variable(&mut self, words: &[u32]) -> Slot {
        let first = self.fresh(words.len() as u32);
        self.variables.extend((first..).zip(words.iter().copied()));
        first
    }

    /// The number of a table of these words.
    pub(super) fn table(&mut self, words: Vec<u32>) -> u32 {
        let next = self.tables.len() as u32;
        *self.table_indices.entry(words).or_insert_with_key(|words| {
            self.tables.push(words.clone());
            next
        })
    }

    /// The program of these functions.
    pub(super) fn program(self, functions: Vec<Result<Function, String>>) -> Program {
        Program {
            functions,
            memory: self.next,
            constants: self.constants,
            variables: self.variables,
            tables: self.tables,
        }
    }
}

/// The word of a literal.
pub(super) fn literal(literal: Literal) -> Result<u32, String> {
    match literal {
        Literal::F32(value) => Ok(value.to_bits()),
        Literal::U32(value) => Ok(value),
        Literal::I32(value) => Ok(value.cast_unsigned()),
        Literal::Bool(value) => Ok(value.into()),
        other => Err(format!("literals such as {other:?} are not known")),
    }
}

/// The words of an expression that does not depend on anything.
pub(super) fn constant_words(
    module: &Module,
    expressions: &Arena<Expression>,
    handle: Handle<Expression>,
) -> Result<Vec<u32>, String> {
    match expressions[handle] {
        Expression::Literal(value) => Ok(vec![literal(value)?]),
        Expression::Constant(constant) => {
            constant_words(module, &module.global_expressions, module.constants[constant].init)
        }
        Expression::ZeroValue(of) => Ok(vec![0; layout::words_of(module, of)? as usize]),
        Expression::Compose { ref components, .. } => {
            let mut words = Vec::new();
            for component in components {
                words.append(&mut constant_words(module, expressions, *component)?);
            }
            Ok(words)
        }
        Expression::Splat { size, value } => {
            Ok(constant_words(module, expressions, value)?.repeat(size as usize))
        }
        ref other => Err(format!("constants such as {other:?} are not known")),
    }
}
