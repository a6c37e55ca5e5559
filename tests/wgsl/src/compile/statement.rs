//! Statements.

use naga::{Block, Expression, Function, Handle, Statement, SwitchValue};

use super::super::operators::Binary;
use super::super::program::{Case, Operation, Slot, Step};
use super::body::{Body, Compiled};
use super::place::{Base, Place};

impl Body<'_> {
    /// Appends the statements of a block.
    pub(super) fn block(&mut self, block: &Block) -> Result<(), String> {
        block.iter().try_for_each(|statement| self.statement(statement))
    }

    /// The statements of a block that only some come to.
    fn inner_block(&mut self, block: &Block) -> Result<Vec<Step>, String> {
        let outer = std::mem::take(&mut self.steps);
        self.known.clear();
        let result = self.block(block);
        self.known.clear();
        let steps = std::mem::replace(&mut self.steps, outer);
        result.map(|()| steps)
    }

    fn statement(&mut self, statement: &Statement) -> Result<(), String> {
        let step = match statement {
            Statement::Emit(range) => {
                return range.clone().try_for_each(|handle| self.compiled(handle).map(|_| ()));
            }
            Statement::Block(block) => Step::Block(self.inner_block(block)?),
            Statement::If { condition, accept, reject } => {
                let condition = self.word(*condition)?;
                Step::If { condition, accept: self.inner_block(accept)?, reject: self.inner_block(reject)? }
            }
            Statement::Switch { selector, cases } => {
                let selector = self.word(*selector)?;
                let mut compiled = Vec::new();
                for case in cases {
                    let value = match case.value {
                        SwitchValue::I32(value) => Some(value.cast_unsigned()),
                        SwitchValue::U32(value) => Some(value),
                        SwitchValue::Default => None,
                    };
                    let body = self.inner_block(&case.body)?;
                    compiled.push(Case { value, body, fall_through: case.fall_through });
                }
                Step::Switch { selector, cases: compiled }
            }
            Statement::Loop { body, continuing, break_if } => {
                let body = self.inner_block(body)?;
                let continuing = self.inner_block(continuing)?;
                let break_if = break_if.map(|condition| self.word(condition)).transpose()?;
                Step::Loop { body, continuing, break_if }
            }
            Statement::Break => Step::Break,
            Statement::Continue => Step::Continue,
            Statement::Return { value } => {
                if let Some(value) = value {
                    let words = self.words(*value)?;
                    self.store(Place::memory(self.result()), &words);
                }
                Step::Return
            }
            Statement::Store { pointer, value } => {
                let (place, words) = (self.place(*pointer)?, self.words(*value)?);
                if place.base != Base::Memory {
                    return Err("only variables can be written".into());
                }
                self.store(place, &words);
                return Ok(());
            }
            Statement::Call { function, arguments, result } => {
                return self.call(*function, arguments, *result);
            }
            other => {
                let name = format!("{other:?}");
                let name: String = name.chars().take_while(|letter| letter.is_alphanumeric()).collect();
                return Err(format!("statements of kind `{name}` are not known"));
            }
        };
        self.steps.push(step);
        Ok(())
    }

    /// Writes a variable of memory.
    fn store(&mut self, place: Place, words: &[Slot]) {
        for (offset, from) in (place.offset..).zip(words) {
            if let Some(address) = place.address {
                self.emit(Operation::StoreAt { address, offset, from: *from });
                self.known.clear();
            } else {
                self.set(offset, *from);
            }
        }
    }

    fn call(
        &mut self,
        function: Handle<Function>,
        arguments: &[Handle<Expression>],
        result: Option<Handle<Expression>>,
    ) -> Result<(), String> {
        let callees = self.callees;
        let callee = callees.get(function.index()).ok_or("a function is called before it is there")?;
        let callee = callee.as_ref().map_err(Clone::clone)?;
        let mut words = Vec::new();
        for argument in arguments {
            match self.compiled(*argument)? {
                Compiled::Words(mut argument) => words.append(&mut argument),
                Compiled::Texture(slot) => words.push(slot),
                Compiled::Place(place) => words.push(self.address(place)?),
            }
        }
        for (to, from) in (callee.first_argument..).zip(words) {
            self.emit(Operation::Store { to, from });
        }
        self.steps.push(Step::Call(function.index()));
        // It may have written to what a pointer points to, and to private variables.
        self.known.clear();
        if let Some(result) = result {
            // The next call overwrites what this one left.
            let words = self.load(Place::memory(callee.result), callee.result_words);
            self.values[result.index()] = Some(Compiled::Words(words));
        }
        Ok(())
    }

    /// A pointer as a word.
    fn address(&mut self, place: Place) -> Result<Slot, String> {
        if place.base != Base::Memory {
            return Err("only pointers to variables can be handed over".into());
        }
        let offset = self.constant(place.offset);
        Ok(match place.address {
            None => offset,
            Some(address) if place.offset == 0 => address,
            Some(address) => self.binary(Binary::AddInteger, address, offset),
        })
    }
}
