//! Runs compiled functions, at several points at once: lanes that took another way wait behind a mask.

use super::binding::{Bindings, Texture};
use super::operators::nudged;
use super::program::{Function, Operation, Program, Slot, Step};
use super::value::Value;

/// Number of points that run together.
pub(super) const LANES: usize = 64;

/// A word of memory at all points.
type Lanes = [u32; LANES];

/// Rounds of loops that one call may take.
const MOST_ROUNDS: u64 = 1_000_000;

/// Every bit of a lane that goes on is set.
#[derive(Clone, Copy)]
struct Mask(Lanes);

impl Mask {
    const NONE: Self = Self([0; LANES]);

    fn first(count: usize) -> Self {
        Self(std::array::from_fn(|lane| if lane < count { u32::MAX } else { 0 }))
    }

    fn is_empty(self) -> bool {
        self.0.iter().fold(0, |any, lane| any | lane) == 0
    }

    fn zip(self, other: Lanes, f: impl Fn(u32, u32) -> u32) -> Self {
        let mut mask = self;
        for (word, other) in mask.0.iter_mut().zip(other) {
            *word = f(*word, other);
        }
        mask
    }

    /// Those where a truth is 1.
    fn and(self, truth: Lanes) -> Self {
        self.zip(truth, |a, b| a & b.wrapping_neg())
    }

    /// Those where a truth is 0.
    fn and_not(self, truth: Lanes) -> Self {
        self.zip(truth, |a, b| a & !b.wrapping_neg())
    }

    fn or(self, other: Self) -> Self {
        self.zip(other.0, |a, b| a | b)
    }

    fn without(self, other: Self) -> Self {
        self.zip(other.0, |a, b| a & !b)
    }

    /// The lanes that go on.
    fn lanes(self) -> impl Iterator<Item = usize> {
        (0..LANES).filter(move |lane| self.0[*lane] != 0)
    }
}

/// A program with memory to run in.
pub(super) struct Machine<'p> {
    program: &'p Program,
    bindings: &'p Bindings,
    memory: Vec<Lanes>,
    /// Lanes that left the innermost loop or switch.
    broken: Mask,
    /// Lanes that wait for the end of the innermost loop's body.
    continued: Mask,
    rounds: u64,
}

impl<'p> Machine<'p> {
    /// Memory with the constants.
    pub(super) fn new(program: &'p Program, bindings: &'p Bindings) -> Self {
        let mut memory = vec![[0; LANES]; program.memory as usize];
        for (slot, word) in &program.constants {
            memory[*slot as usize] = [*word; LANES];
        }
        Self { program, bindings, memory, broken: Mask::NONE, continued: Mask::NONE, rounds: 0 }
    }

    /// Calls a function at up to [`LANES`] points.
    pub(super) fn call(&mut self, function: &Function, points: &[&[u32]]) -> Result<Vec<Value>, String> {
        self.rounds = 0;
        for (slot, word) in &self.program.variables {
            self.memory[*slot as usize] = [*word; LANES];
        }
        for (lane, point) in points.iter().enumerate() {
            for (slot, word) in (function.first_argument..).zip(*point) {
                self.memory[slot as usize][lane] = *word;
            }
        }
        self.enter(function, Mask::first(points.len()))?;
        let result = function.result as usize..(function.result + function.result_words) as usize;
        let words = &self.memory[result];
        Ok((0..points.len())
            .map(|lane| Value::from(words.iter().map(|word| word[lane]).collect::<Vec<_>>()))
            .collect())
    }

    fn enter(&mut self, function: &Function, mask: Mask) -> Result<(), String> {
        match self.run(&function.steps, mask) {
            Ok(_) => Ok(()),
            Err(error) => Err(format!("{error}, in `{}`", function.name)),
        }
    }

    /// Runs statements; the lanes that come to their end.
    fn run(&mut self, steps: &[Step], mask: Mask) -> Result<Mask, String> {
        let mut active = mask;
        for step in steps {
            if active.is_empty() {
                break;
            }
            active = match step {
                Step::Compute(operations) => {
                    for operation in operations {
                        self.compute(operation, active)?;
                    }
                    active
                }
                Step::If { condition, accept, reject } => {
                    let condition = self.memory[*condition as usize];
                    let accepted = self.run(accept, active.and(condition))?;
                    accepted.or(self.run(reject, active.and_not(condition))?)
                }
                Step::Switch { selector, cases } => {
                    let selector = self.memory[*selector as usize];
                    let outer = std::mem::replace(&mut self.broken, Mask::NONE);
                    let chosen = |value: u32| active.and(selector.map(|of| (of == value).into()));
                    let default = cases
                        .iter()
                        .filter_map(|case| case.value)
                        .fold(active, |rest, value| rest.without(chosen(value)));
                    let (mut through, mut left) = (Mask::NONE, Mask::NONE);
                    for case in cases {
                        let own = case.value.map_or(default, chosen);
                        let end = self.run(&case.body, own.or(through))?;
                        through = if case.fall_through { end } else { Mask::NONE };
                        left = left.or(if case.fall_through { Mask::NONE } else { end });
                    }
                    left.or(through).or(std::mem::replace(&mut self.broken, outer))
                }
                Step::Loop { body, continuing, break_if } => {
                    self.repeat(body, continuing, *break_if, active)?
                }
                Step::Block(steps) => self.run(steps, active)?,
                Step::Break => {
                    self.broken = self.broken.or(active);
                    Mask::NONE
                }
                Step::Continue => {
                    self.continued = self.continued.or(active);
                    Mask::NONE
                }
                Step::Return => Mask::NONE,
                Step::Call(function) => {
                    let program = self.program;
                    let function = program.functions[*function].as_ref().map_err(Clone::clone)?;
                    self.enter(function, active)?;
                    active
                }
            };
        }
        Ok(active)
    }

    /// Runs a loop; the lanes that left it otherwise than by a return.
    fn repeat(
        &mut self,
        body: &[Step],
        continuing: &[Step],
        break_if: Option<Slot>,
        mask: Mask,
    ) -> Result<Mask, String> {
        let outer = (self.broken, self.continued);
        (self.broken, self.continued) = (Mask::NONE, Mask::NONE);
        let mut active = mask;
        while !active.is_empty() {
            self.rounds += 1;
            if self.rounds > MOST_ROUNDS {
                return Err(format!("loops take more than {MOST_ROUNDS} rounds"));
            }
            let end = self.run(body, active)?;
            active = end.or(std::mem::replace(&mut self.continued, Mask::NONE));
            active = self.run(continuing, active)?;
            if let Some(condition) = break_if {
                let condition = self.memory[condition as usize];
                self.broken = self.broken.or(active.and(condition));
                active = active.and_not(condition);
            }
        }
        let left = self.broken;
        (self.broken, self.continued) = outer;
        Ok(left)
    }

    fn at(&self, slot: Slot) -> &Lanes {
        &self.memory[slot as usize]
    }

    /// Computes a word from others. What is computed lies behind what it is computed from, but where operands are flushed.
    #[inline(always)]
    fn apply<const K: usize>(
        &mut self,
        to: Slot,
        from: [Slot; K],
        lanes: impl FnOnce([&Lanes; K], &mut Lanes),
    ) {
        let copies: [Lanes; K];
        let (from, to) = if from.iter().all(|slot| *slot < to) {
            let (before, rest) = self.memory.split_at_mut(to as usize);
            (from.map(|slot| &before[slot as usize]), &mut rest[0])
        } else {
            copies = from.map(|slot| self.memory[slot as usize]);
            (copies.each_ref(), &mut self.memory[to as usize])
        };
        lanes(from, to);
    }

    /// An operation on all lanes. Only variables keep the words of lanes that wait: nothing else is read by a lane
    /// without being computed again before.
    #[inline]
    fn compute(&mut self, operation: &Operation, mask: Mask) -> Result<(), String> {
        match *operation {
            Operation::Unary(unary, to, from) => self.apply(to, from, |from, to| unary.lanes(from, to)),
            Operation::Binary(binary, to, from) => self.apply(to, from, |from, to| binary.lanes(from, to)),
            Operation::Ternary(ternary, to, from) => self.apply(to, from, |from, to| ternary.lanes(from, to)),
            Operation::Nudge { to, ulps } => {
                self.memory[to as usize] = self.at(to).map(|word| nudged(word, ulps));
            }
            Operation::Store { to, from } => {
                // A variable that is written to itself stays as it is.
                if let Ok([to, from]) = self.memory.get_disjoint_mut([to as usize, from as usize]) {
                    for lane in 0..LANES {
                        to[lane] = (to[lane] & !mask.0[lane]) | (from[lane] & mask.0[lane]);
                    }
                }
            }
            _ => self.address(operation, mask)?,
        }
        Ok(())
    }

    /// An operation whose addresses differ from lane to lane.
    fn address(&mut self, operation: &Operation, mask: Mask) -> Result<(), String> {
        match *operation {
            Operation::Index { to, base, index, stride, bound } => {
                for lane in mask.lanes() {
                    let index = self.at(index)[lane];
                    if index >= bound {
                        return Err(format!("index {} is outside {bound} elements", index.cast_signed()));
                    }
                    let base = base.map_or(0, |base| self.at(base)[lane]);
                    self.memory[to as usize][lane] = base.saturating_add(index.saturating_mul(stride));
                }
            }
            Operation::Load { to, address, offset } => {
                for lane in mask.lanes() {
                    let address = self.at(address)[lane] + offset;
                    self.memory[to as usize][lane] = self.at(address)[lane];
                }
            }
            Operation::StoreAt { address, offset, from } => {
                for lane in mask.lanes() {
                    let address = self.at(address)[lane] + offset;
                    self.memory[address as usize][lane] = self.at(from)[lane];
                }
            }
            Operation::LoadBuffer { to, buffer, address, offset } => {
                let words = self.bindings.buffer_words(buffer)?;
                let word = |address: u32| {
                    let word = words.get(address.saturating_add(offset) as usize).copied();
                    word.ok_or_else(|| {
                        format!("word {address} is behind the end of `{}`", self.bindings.name(buffer))
                    })
                };
                if let Some(address) = address {
                    for lane in mask.lanes() {
                        self.memory[to as usize][lane] = word(self.at(address)[lane])?;
                    }
                } else {
                    self.memory[to as usize] = [word(0)?; LANES];
                }
            }
            Operation::LoadTable { to, table, address } => {
                let table = &self.program.tables[table as usize];
                for lane in mask.lanes() {
                    let address = self.at(address)[lane];
                    self.memory[to as usize][lane] = table.get(address as usize).copied().unwrap_or_default();
                }
            }
            Operation::ArrayLength { to, buffer, offset, stride } => {
                let words = self.bindings.buffer_words(buffer)?.len() as u32;
                self.memory[to as usize] = [words.saturating_sub(offset) / stride.max(1); LANES];
            }
            Operation::LoadTexel { to, texture, x, y, level } => {
                for lane in mask.lanes() {
                    let [of, x, y, level] = [texture, x, y, level].map(|slot| self.at(slot)[lane]);
                    let texture = self.bindings.texture_at(of)?;
                    if x >= texture.width || y >= texture.height || level != 0 {
                        let [x, y, level] = [x, y, level].map(u32::cast_signed);
                        let Texture { width, height, .. } = texture;
                        return Err(format!(
                            "texel ({x}, {y}) of level {level} is outside the {width} × {height} of `{}`",
                            self.bindings.name(of)
                        ));
                    }
                    let word = texture.words[(y * texture.width + x) as usize];
                    self.memory[to as usize][lane] = word;
                }
            }
            Operation::TextureSize { to, texture } => {
                for lane in mask.lanes() {
                    let texture = self.bindings.texture_at(self.at(texture)[lane])?;
                    self.memory[to as usize][lane] = texture.width;
                    self.memory[to as usize + 1][lane] = texture.height;
                }
            }
            Operation::Unary(..)
            | Operation::Binary(..)
            | Operation::Ternary(..)
            | Operation::Nudge { .. }
            | Operation::Store { .. } => {}
        }
        Ok(())
    }
}
