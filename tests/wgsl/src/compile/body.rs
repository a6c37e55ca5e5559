//! A function while it is compiled. A value is the list of its words' places, so that whatever only takes values apart
//! or puts them together costs nothing when it runs.

use std::collections::HashMap;

use naga::valid::FunctionInfo;
use naga::{Expression, Handle, LocalVariable, Module, TypeInner};

use super::super::layout::{self, Kind};
use super::super::operators::{Binary, Ternary, Unary};
use super::super::program::{Function, Operation, Slot, Step};
use super::memory::{self, Memory};
use super::place::{Base, Place};

/// Result of compiling an expression.
#[derive(Clone, Debug)]
pub(super) enum Compiled {
    Words(Vec<Slot>),
    Place(Place),
    /// Place of its index of naga.
    Texture(Slot),
}

/// A function while it is compiled.
pub(super) struct Body<'a> {
    pub(super) module: &'a Module,
    pub(super) info: &'a FunctionInfo,
    pub(super) function: &'a naga::Function,
    pub(super) globals: &'a [Result<Compiled, String>],
    pub(super) callees: &'a [Result<Function, String>],
    pub(super) memory: &'a mut Memory,
    /// By the index of naga.
    pub(super) values: Vec<Option<Compiled>>,
    pub(super) arguments: Vec<Compiled>,
    locals: Vec<Slot>,
    compiled: Function,
    pub(super) steps: Vec<Step>,
    /// The value of words of variables, as far as the statements of this block tell it: what is read again costs nothing.
    pub(super) known: HashMap<Slot, Slot>,
}

impl<'a> Body<'a> {
    /// Gives arguments, variables and result their places.
    pub(super) fn new(
        module: &'a Module,
        info: &'a FunctionInfo,
        function: &'a naga::Function,
        globals: &'a [Result<Compiled, String>],
        callees: &'a [Result<Function, String>],
        memory: &'a mut Memory,
    ) -> Result<Self, String> {
        let counts = function.arguments.iter().map(|argument| layout::words_of(module, argument.ty));
        let counts = counts.collect::<Result<Vec<u32>, String>>()?;
        let first_argument = memory.fresh(counts.iter().sum());
        let mut next = first_argument;
        let mut arguments = Vec::new();
        for (argument, count) in function.arguments.iter().zip(&counts) {
            arguments.push(match module.types[argument.ty].inner {
                TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => {
                    Compiled::Place(Place::pointed(next))
                }
                TypeInner::Image { .. } => Compiled::Texture(next),
                _ => Compiled::Words((next..next + count).collect()),
            });
            next += count;
        }
        let mut locals = Vec::new();
        for (_, local) in function.local_variables.iter() {
            locals.push(memory.fresh(layout::words_of(module, local.ty)?));
        }
        let result_words = match &function.result {
            Some(result) => layout::words_of(module, result.ty)?,
            None => 0,
        };
        let compiled = Function {
            name: function.name.clone().unwrap_or_default(),
            arguments: counts.iter().map(|count| *count as usize).collect(),
            first_argument,
            result: memory.fresh(result_words),
            result_words,
            steps: Vec::new(),
        };
        let values = vec![None; function.expressions.len()];
        let (steps, known) = (Vec::new(), HashMap::new());
        Ok(Self {
            module,
            info,
            function,
            globals,
            callees,
            memory,
            values,
            arguments,
            locals,
            compiled,
            steps,
            known,
        })
    }

    /// Compiles all statements.
    pub(super) fn compile(mut self) -> Result<Function, String> {
        for (handle, local) in self.function.local_variables.iter() {
            let words = match local.init {
                Some(init) => memory::constant_words(self.module, &self.function.expressions, init)?,
                None => vec![0; layout::words_of(self.module, local.ty)? as usize],
            };
            for (to, word) in (self.local(handle)..).zip(words) {
                let from = self.memory.constant(word);
                self.set(to, from);
            }
        }
        let function = self.function;
        self.block(&function.body)?;
        Ok(Function { steps: self.steps, ..self.compiled })
    }

    /// Beginning of a variable.
    pub(super) fn local(&self, handle: Handle<LocalVariable>) -> Slot {
        self.locals[handle.index()]
    }

    /// Beginning of the result.
    pub(super) const fn result(&self) -> Slot {
        self.compiled.result
    }

    /// The type of an expression.
    pub(super) fn inner(&self, handle: Handle<Expression>) -> &'a TypeInner {
        self.info[handle].ty.inner_with(&self.module.types)
    }

    /// The type of an expression, or of what it points to.
    pub(super) fn pointee(&self, handle: Handle<Expression>) -> &'a TypeInner {
        match *self.inner(handle) {
            TypeInner::Pointer { base, .. } => &self.module.types[base].inner,
            ref other => other,
        }
    }

    /// The kind of the scalars of an expression.
    pub(super) fn kind(&self, handle: Handle<Expression>) -> Result<Kind, String> {
        match *self.inner(handle) {
            TypeInner::Scalar(scalar)
            | TypeInner::Vector { scalar, .. }
            | TypeInner::Matrix { scalar, .. } => layout::kind(scalar),
            ref other => Err(format!("{other:?} has no scalars of one kind")),
        }
    }

    /// The words of an expression.
    pub(super) fn words(&mut self, handle: Handle<Expression>) -> Result<Vec<Slot>, String> {
        match self.compiled(handle)? {
            Compiled::Words(words) => Ok(words),
            other => Err(format!("{other:?} where a value is wanted")),
        }
    }

    /// The word of an expression that is a scalar.
    pub(super) fn word(&mut self, handle: Handle<Expression>) -> Result<Slot, String> {
        let words = self.words(handle)?;
        words.first().copied().ok_or_else(|| "no words where a scalar is wanted".into())
    }

    /// Target of an expression that is a pointer.
    pub(super) fn place(&mut self, handle: Handle<Expression>) -> Result<Place, String> {
        match self.compiled(handle)? {
            Compiled::Place(place) => Ok(place),
            other => Err(format!("{other:?} where a pointer is wanted")),
        }
    }

    /// Place of a texture's index.
    pub(super) fn texture(&mut self, handle: Handle<Expression>) -> Result<Slot, String> {
        match self.compiled(handle)? {
            Compiled::Texture(slot) => Ok(slot),
            other => Err(format!("{other:?} where a texture is wanted")),
        }
    }

    /// Result of compiling an expression; what naga never emits is compiled where it is used first.
    pub(super) fn compiled(&mut self, handle: Handle<Expression>) -> Result<Compiled, String> {
        if let Some(compiled) = &self.values[handle.index()] {
            return Ok(compiled.clone());
        }
        let compiled = self.expression(handle)?;
        self.values[handle.index()] = Some(compiled.clone());
        Ok(compiled)
    }

    /// Appends an operation.
    pub(super) fn emit(&mut self, operation: Operation) {
        if let Some(Step::Compute(operations)) = self.steps.last_mut() {
            operations.push(operation);
        } else {
            self.steps.push(Step::Compute(vec![operation]));
        }
    }

    /// Place of a constant.
    pub(super) fn constant(&mut self, word: u32) -> Slot {
        self.memory.constant(word)
    }

    /// Place of a constant float.
    pub(super) fn float(&mut self, value: f32) -> Slot {
        self.memory.constant(value.to_bits())
    }

    /// Appends an operation on one word.
    pub(super) fn unary(&mut self, unary: Unary, a: Slot) -> Slot {
        let to = self.memory.fresh(1);
        self.emit(Operation::Unary(unary, to, [a]));
        to
    }

    /// Appends an operation on two words.
    pub(super) fn binary(&mut self, binary: Binary, a: Slot, b: Slot) -> Slot {
        let to = self.memory.fresh(1);
        self.emit(Operation::Binary(binary, to, [a, b]));
        to
    }

    /// Appends an operation on three words.
    pub(super) fn ternary(&mut self, ternary: Ternary, a: Slot, b: Slot, c: Slot) -> Slot {
        let to = self.memory.fresh(1);
        self.emit(Operation::Ternary(ternary, to, [a, b, c]));
        to
    }

    /// An operation on every word.
    pub(super) fn each(&mut self, unary: Unary, words: &[Slot]) -> Vec<Slot> {
        words.iter().map(|a| self.unary(unary, *a)).collect()
    }

    /// An operation word by word; a scalar goes with every word.
    pub(super) fn pairs(&mut self, binary: Binary, a: &[Slot], b: &[Slot]) -> Vec<Slot> {
        let count = a.len().max(b.len());
        (0..count).map(|at| self.binary(binary, spread(a, at), spread(b, at))).collect()
    }

    /// Writes a word of a variable.
    pub(super) fn set(&mut self, to: Slot, from: Slot) {
        self.emit(Operation::Store { to, from });
        self.known.insert(to, from);
    }

    /// Reads so many words into places of their own.
    pub(super) fn load(&mut self, place: Place, count: u32) -> Vec<Slot> {
        let mut words = Vec::new();
        for offset in place.offset..place.offset + count {
            let is_variable = place.base == Base::Memory && place.address.is_none();
            if let Some(known) = self.known.get(&offset).filter(|_| is_variable) {
                words.push(*known);
                continue;
            }
            let to = self.memory.fresh(1);
            words.push(to);
            self.emit(match (place.base, place.address) {
                (Base::Memory, None) => Operation::Unary(Unary::Copy, to, [offset]),
                (Base::Memory, Some(address)) => Operation::Load { to, address, offset },
                (Base::Buffer(buffer), address) => Operation::LoadBuffer { to, buffer, address, offset },
            });
            if is_variable {
                self.known.insert(offset, to);
            }
        }
        words
    }
}

/// A word of a vector, or the scalar that stands for all of them.
pub(super) fn spread(words: &[Slot], at: usize) -> Slot {
    if words.len() == 1 { words[0] } else { words[at] }
}
