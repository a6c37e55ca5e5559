//! Runs naga functions at several points at once. Lanes in another branch wait behind a mask.

use std::rc::Rc;

use naga::valid::FunctionInfo;
use naga::{
    Arena, BinaryOperator, Block, Expression, Function, Handle, Literal, Module, Statement, SwitchCase,
    SwitchValue, TypeInner,
};

use super::arithmetic::Arithmetic;
use super::layout::{self, Kind};
use super::operators::{LANES, Lanes, Words};
use super::shader::Shader;
use super::value::Value;

/// A bit for each active lane.
pub(super) type Mask = u64;

/// Maximum loop iterations of one call.
const MOST_ROUNDS: u64 = 1_000_000;

/// The lanes of a mask, from the lowest bit.
#[derive(Clone)]
pub(super) struct LanesOf(Mask);

impl Iterator for LanesOf {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        let lane = self.0.trailing_zeros() as usize;
        self.0 &= self.0.wrapping_sub(1);
        (lane < LANES).then_some(lane)
    }
}

/// Returns the lanes of a mask.
pub(super) const fn lanes(mask: Mask) -> LanesOf {
    LanesOf(mask)
}

/// Returns the lanes where a boolean is 1.
fn truth(word: &Lanes) -> Mask {
    word.iter().enumerate().fold(0, |mask, (lane, word)| mask | Mask::from(word & 1) << lane)
}

fn write(to: &mut Lanes, from: &Lanes, mask: Mask) {
    if mask == Mask::MAX {
        *to = *from;
    } else {
        lanes(mask).for_each(|lane| to[lane] = from[lane]);
    }
}

/// Result of an expression.
#[derive(Clone, Debug)]
pub(super) enum Operand {
    Words(Words),
    Place(Place),
    /// naga's index.
    Texture(usize),
}

/// Target of a pointer, `base + index` in words.
#[derive(Clone, Debug)]
pub(super) struct Place {
    /// naga's index of a uniform or storage buffer, or `None` in memory.
    pub(super) buffer: Option<usize>,
    pub(super) base: u32,
    pub(super) index: Option<Rc<Lanes>>,
}

impl Place {
    /// Returns the position shifted by words.
    pub(super) fn plus(self, words: u32) -> Self {
        Self { base: self.base.saturating_add(words), ..self }
    }
}

/// A function call in progress.
pub(super) struct Frame<'m> {
    pub(super) handle: Handle<Function>,
    pub(super) function: &'m Function,
    pub(super) info: &'m FunctionInfo,
    pub(super) mask: Mask,
    pub(super) arguments: Vec<Operand>,
    /// Addresses of variables.
    pub(super) locals: Vec<u32>,
    /// Results of evaluated expressions, by naga's index.
    pub(super) values: Vec<Option<Operand>>,
    result: Vec<Lanes>,
    /// Lanes that left the innermost loop or switch.
    broken: Mask,
    /// Lanes that wait for the end of the innermost loop's body.
    continued: Mask,
}

/// A shader with memory for execution.
pub(super) struct Machine<'m> {
    pub(super) shader: &'m Shader,
    pub(super) memory: Vec<Lanes>,
    /// Addresses of private variables, by naga's index.
    pub(super) privates: Vec<u32>,
    /// Evaluated constant expressions, by naga's indices of function and expression.
    pub(super) constants: Vec<Vec<Option<Words>>>,
    rounds: u64,
}

impl<'m> Machine<'m> {
    pub(super) fn new(shader: &'m Shader) -> Self {
        let functions = shader.module.functions.iter();
        let constants = functions.map(|(_, function)| vec![None; function.expressions.len()]).collect();
        Self { shader, memory: vec![], privates: vec![], constants, rounds: 0 }
    }

    pub(super) fn module(&self) -> &'m Module {
        &self.shader.module
    }

    /// Calls a function at up to [`LANES`] points.
    pub(super) fn call(
        &mut self,
        function: Handle<Function>,
        points: &[&[u32]],
    ) -> Result<Vec<Value>, String> {
        let module = self.module();
        self.rounds = 0;
        self.memory.clear();
        self.privates.clear();
        for (_, variable) in module.global_variables.iter() {
            self.privates.push(self.memory.len() as u32);
            if variable.space == naga::AddressSpace::Private {
                self.variable(variable.ty, variable.init.map(|init| (&module.global_expressions, init)))?;
            }
        }
        let mut arguments = vec![];
        let mut first = 0;
        for argument in &module.functions[function].arguments {
            let count = layout::words_of(module, argument.ty)? as usize;
            let word = |at: usize| {
                let mut word = [0; LANES];
                word.iter_mut().zip(points).for_each(|(word, point)| *word = point[at]);
                word
            };
            arguments.push(Operand::Words((first..first + count).map(word).collect()));
            first += count;
        }
        let result = self.enter(function, arguments, Mask::MAX >> (LANES - points.len()))?;
        let value =
            |lane: usize| Value::from(result.iter().map(|word: &Lanes| word[lane]).collect::<Vec<u32>>());
        Ok((0..points.len()).map(value).collect())
    }

    /// Appends a variable to memory.
    fn variable(
        &mut self,
        of: Handle<naga::Type>,
        init: Option<(&Arena<Expression>, Handle<Expression>)>,
    ) -> Result<(), String> {
        let words = match init {
            Some((expressions, init)) => constant_words(self.module(), expressions, init)?,
            None => vec![0; layout::words_of(self.module(), of)? as usize],
        };
        self.memory.extend(words.into_iter().map(|word| [word; LANES]));
        Ok(())
    }

    fn enter(
        &mut self,
        handle: Handle<Function>,
        arguments: Vec<Operand>,
        mask: Mask,
    ) -> Result<Vec<Lanes>, String> {
        let function = &self.module().functions[handle];
        let bottom = self.memory.len();
        let result = self.run_function(handle, arguments, mask);
        self.memory.truncate(bottom);
        result.map_err(|error| format!("{error}, in `{}`", function.name.as_deref().unwrap_or_default()))
    }

    fn run_function(
        &mut self,
        handle: Handle<Function>,
        arguments: Vec<Operand>,
        mask: Mask,
    ) -> Result<Vec<Lanes>, String> {
        let (function, info) = (&self.module().functions[handle], &self.shader.info[handle]);
        let mut locals = vec![];
        for (_, local) in function.local_variables.iter() {
            locals.push(self.memory.len() as u32);
            self.variable(local.ty, local.init.map(|init| (&function.expressions, init)))?;
        }
        let words = function.result.as_ref().map(|result| layout::words_of(self.module(), result.ty));
        let result = vec![[0; LANES]; words.transpose()?.unwrap_or(0) as usize];
        let values = vec![None; function.expressions.len()];
        let (broken, continued) = (0, 0);
        let mut frame =
            Frame { handle, function, info, mask, arguments, locals, values, result, broken, continued };
        self.block(&mut frame, &function.body, mask)?;
        Ok(frame.result)
    }

    /// Runs statements, and returns the lanes that reach their end.
    fn block(&mut self, frame: &mut Frame<'m>, block: &'m Block, mask: Mask) -> Result<Mask, String> {
        let mut active = mask;
        for statement in block {
            if active == 0 {
                break;
            }
            frame.mask = active;
            active = self.statement(frame, statement, active)?;
        }
        Ok(active)
    }

    fn statement(
        &mut self,
        frame: &mut Frame<'m>,
        statement: &'m Statement,
        active: Mask,
    ) -> Result<Mask, String> {
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    // Computed by a sum.
                    if !self.is_fused_product(frame, handle) {
                        frame.values[handle.index()] = Some(self.expression(frame, handle)?);
                    }
                }
            }
            Statement::Block(block) => return self.block(frame, block, active),
            Statement::If { condition, accept, reject } => {
                let condition = truth(&self.word(frame, *condition)?);
                let accepted = self.block(frame, accept, active & condition)?;
                return Ok(accepted | self.block(frame, reject, active & !condition)?);
            }
            Statement::Switch { selector, cases } => {
                let selector = self.word(frame, *selector)?;
                return self.switch(frame, &selector, cases, active);
            }
            Statement::Loop { body, continuing, break_if } => {
                return self.repeat(frame, [body, continuing], *break_if, active);
            }
            Statement::Break => {
                frame.broken |= active;
                return Ok(0);
            }
            Statement::Continue => {
                frame.continued |= active;
                return Ok(0);
            }
            Statement::Return { value } => {
                if let Some(value) = value {
                    let words = self.words(frame, *value)?;
                    frame.result.iter_mut().zip(&*words).for_each(|(to, from)| write(to, from, active));
                }
                return Ok(0);
            }
            Statement::Store { pointer, value } => {
                let (place, words) = (self.place(frame, *pointer)?, self.words(frame, *value)?);
                self.store(&place, &words, active)?;
            }
            Statement::Call { function, arguments, result } => {
                let arguments = arguments.iter().map(|argument| self.operand(frame, *argument));
                let arguments = arguments.collect::<Result<_, String>>()?;
                let words = self.enter(*function, arguments, active)?;
                if let Some(result) = result {
                    frame.values[result.index()] = Some(Operand::Words(words.into()));
                }
            }
            other => return Err(format!("unsupported statement `{}`", kind_name(other))),
        }
        Ok(active)
    }

    fn switch(
        &mut self,
        frame: &mut Frame<'m>,
        selector: &Lanes,
        cases: &'m [SwitchCase],
        active: Mask,
    ) -> Result<Mask, String> {
        let outer = std::mem::take(&mut frame.broken);
        let chosen = |value: SwitchValue| {
            let value = match value {
                SwitchValue::I32(value) => value.cast_unsigned(),
                SwitchValue::U32(value) => value,
                SwitchValue::Default => return None,
            };
            Some(active & truth(&selector.map(|of| (of == value).into())))
        };
        let default =
            active & !cases.iter().filter_map(|case| chosen(case.value)).fold(0, |all, own| all | own);
        let (mut through, mut left) = (0, 0);
        for case in cases {
            let end = self.block(frame, &case.body, chosen(case.value).unwrap_or(default) | through)?;
            through = if case.fall_through { end } else { 0 };
            left |= if case.fall_through { 0 } else { end };
        }
        Ok(left | through | std::mem::replace(&mut frame.broken, outer))
    }

    /// Runs a loop, and returns the lanes that left it without a return.
    fn repeat(
        &mut self,
        frame: &mut Frame<'m>,
        [body, continuing]: [&'m Block; 2],
        break_if: Option<Handle<Expression>>,
        mask: Mask,
    ) -> Result<Mask, String> {
        let outer = (frame.broken, frame.continued);
        (frame.broken, frame.continued) = (0, 0);
        let mut active = mask;
        while active != 0 {
            self.rounds += 1;
            if self.rounds > MOST_ROUNDS {
                return Err(format!("loops exceed {MOST_ROUNDS} iterations"));
            }
            active = self.block(frame, body, active)? | std::mem::take(&mut frame.continued);
            active = self.block(frame, continuing, active)?;
            if let Some(condition) = break_if.filter(|_| active != 0) {
                frame.mask = active;
                let left = active & truth(&self.word(frame, condition)?);
                frame.broken |= left;
                active &= !left;
            }
        }
        let left = frame.broken;
        (frame.broken, frame.continued) = outer;
        Ok(left)
    }

    fn store(&mut self, place: &Place, words: &[Lanes], mask: Mask) -> Result<(), String> {
        if place.buffer.is_some() {
            return Err("only variables are writable".into());
        }
        for (address, from) in (place.base as usize..).zip(words) {
            match &place.index {
                None => write(&mut self.memory[address], from, mask),
                Some(index) => {
                    lanes(mask)
                        .for_each(|lane| self.memory[address + index[lane] as usize][lane] = from[lane]);
                }
            }
        }
        Ok(())
    }

    /// Reads `count` words.
    pub(super) fn load(&self, place: &Place, count: u32, mask: Mask) -> Result<Words, String> {
        let bindings = &self.shader.bindings;
        let buffer = place.buffer.map(|buffer| Ok((buffer, bindings.buffer_words(buffer)?)));
        let buffer = buffer.transpose().map_err(|error: String| error)?;
        let word = |address: u32, lane: usize| match buffer {
            None => Ok(self.memory[address as usize][lane]),
            Some((buffer, words)) => words
                .get(address as usize)
                .copied()
                .ok_or_else(|| format!("word {address} is out of bounds of `{}`", bindings.name(buffer))),
        };
        let read = |address: u32| match (&place.index, buffer) {
            (None, None) => Ok(self.memory[address as usize]),
            (None, Some(_)) => Ok([word(address, 0)?; LANES]),
            (Some(index), _) => {
                let mut to = [0; LANES];
                for lane in lanes(mask) {
                    to[lane] = word(address.saturating_add(index[lane]), lane)?;
                }
                Ok(to)
            }
        };
        (0..count).map(|at| read(place.base.saturating_add(at))).collect()
    }

    /// Whether an expression is a product used by a single sum, with fusing arithmetic.
    pub(super) fn is_fused_product(&self, frame: &Frame<'m>, handle: Handle<Expression>) -> bool {
        if self.shader.rounding.arithmetic == Arithmetic::Written {
            return false;
        }
        let Expression::Binary { op: BinaryOperator::Multiply, left, right } =
            frame.function.expressions[handle]
        else {
            return false;
        };
        let is_matrix = |operand| matches!(self.inner(frame, operand), TypeInner::Matrix { .. });
        frame.info[handle].ref_count == 1
            && self.kind(frame, left) == Ok(Kind::Float)
            && !is_matrix(left)
            && !is_matrix(right)
    }
}

/// Returns the name of the variant of an expression or a statement.
pub(super) fn kind_name(of: &impl std::fmt::Debug) -> String {
    format!("{of:?}").chars().take_while(|letter| letter.is_alphanumeric()).collect()
}

/// Returns the words of a constant expression.
pub(super) fn constant_words(
    module: &Module,
    expressions: &Arena<Expression>,
    handle: Handle<Expression>,
) -> Result<Vec<u32>, String> {
    match expressions[handle] {
        Expression::Literal(Literal::F32(value)) => Ok(vec![value.to_bits()]),
        Expression::Literal(Literal::U32(value)) => Ok(vec![value]),
        Expression::Literal(Literal::I32(value)) => Ok(vec![value.cast_unsigned()]),
        Expression::Literal(Literal::Bool(value)) => Ok(vec![value.into()]),
        Expression::Constant(constant) => {
            constant_words(module, &module.global_expressions, module.constants[constant].init)
        }
        Expression::ZeroValue(of) => Ok(vec![0; layout::words_of(module, of)? as usize]),
        Expression::Compose { ref components, .. } => {
            let words = components.iter().map(|component| constant_words(module, expressions, *component));
            Ok(words.collect::<Result<Vec<_>, String>>()?.concat())
        }
        Expression::Splat { size, value } => {
            Ok(constant_words(module, expressions, value)?.repeat(size as usize))
        }
        ref other => Err(format!("unsupported constant {other:?}")),
    }
}
