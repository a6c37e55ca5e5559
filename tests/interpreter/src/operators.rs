//! Operators and built-in functions on words, each a Rust operation. Built-ins follow the formulas
//! of the WGSL specification.

use std::rc::Rc;

use naga::{BinaryOperator, MathFunction, TypeInner, UnaryOperator};

use super::arithmetic::{Arithmetic, Rounding};
use super::layout::Kind;

/// Number of points that run together: values of a typical function fit the first-level cache.
pub(super) const LANES: usize = 64;

/// A word at all points.
pub(super) type Lanes = [u32; LANES];

/// The words of a value.
pub(super) type Words = Rc<[Lanes]>;

/// An operand of a sum.
#[derive(Clone, Copy)]
pub(super) enum Term<'a> {
    /// A product without other uses.
    Product(&'a [Lanes], &'a [Lanes]),
    Value(&'a [Lanes]),
}

/// Applies a function word by word; scalars are broadcast.
#[inline(always)]
fn zip<const K: usize>(operands: [&[Lanes]; K], f: impl Fn([u32; K]) -> u32) -> Words {
    let count = operands.iter().map(|operand| operand.len()).max().unwrap_or(0);
    let mut result: Words = std::iter::repeat_n([0; LANES], count).collect();
    // In place, because nothing else refers to it yet.
    for (at, to) in Rc::get_mut(&mut result).into_iter().flatten().enumerate() {
        let from = operands.map(|operand| &operand[if operand.len() == 1 { 0 } else { at }]);
        // Loops instead of `map`, because closures over arrays are not inlined here.
        for (lane, to) in to.iter_mut().enumerate() {
            let mut words = [0; K];
            for (k, word) in words.iter_mut().enumerate() {
                *word = from[k][lane];
            }
            *to = f(words);
        }
    }
    result
}

/// Applies a function of two signed numbers, word by word.
fn signed(operands: [&[Lanes]; 2], f: impl Fn(i32, i32) -> i32) -> Words {
    zip(operands, |[a, b]| f(a.cast_signed(), b.cast_signed()).cast_unsigned())
}

/// Flushes denormals to zero of the same sign.
fn flushed(word: u32) -> u32 {
    if f32::from_bits(word).is_subnormal() { word & 0x8000_0000 } else { word }
}

/// Returns `accept` where the condition is true, otherwise `reject`.
pub(super) fn select(condition: &[Lanes], accept: &[Lanes], reject: &[Lanes]) -> Words {
    zip([condition, accept, reject], |[condition, a, b]| if condition != 0 { a } else { b })
}

/// Converts scalars between types.
pub(super) fn converted(words: &[Lanes], from: Kind, to: Kind) -> Words {
    use Kind::{Bool, Float, Signed, Unsigned};
    let words = [words];
    match (from, to) {
        (Signed, Float) => zip(words, |[x]| (x.cast_signed() as f32).to_bits()),
        (Unsigned | Bool, Float) => zip(words, |[x]| (x as f32).to_bits()),
        (Float, Signed) => zip(words, |[x]| (f32::from_bits(x) as i32).cast_unsigned()),
        (Float, Unsigned) => zip(words, |[x]| f32::from_bits(x) as u32),
        (Float, Bool) => zip(words, |[x]| (f32::from_bits(x) != 0.0).into()),
        (Signed | Unsigned, Bool) => zip(words, |[x]| (x != 0).into()),
        (Float, Float) | (Signed | Unsigned | Bool, Signed | Unsigned) | (Bool, Bool) => words[0].into(),
    }
}

/// Returns the words of the columns of a matrix.
fn columns(matrix: &[Lanes], rows: usize) -> impl Iterator<Item = &[Lanes]> {
    matrix.chunks(rows.max(1))
}

impl Rounding {
    /// Applies a function of floats.
    #[inline(always)]
    fn float<const K: usize>(self, operands: [&[Lanes]; K], f: impl Fn([f32; K]) -> f32) -> Words {
        let floats = |words: [u32; K], bits: fn(u32) -> u32| {
            let mut floats = [0.0; K];
            for (float, word) in floats.iter_mut().zip(words) {
                *float = f32::from_bits(bits(word));
            }
            floats
        };
        if self.flush_denormals {
            zip(operands, |words| flushed(f(floats(words, flushed)).to_bits()))
        } else {
            zip(operands, |words| f(floats(words, |word| word)).to_bits())
        }
    }

    fn compare(self, operands: [&[Lanes]; 2], f: impl Fn(f32, f32) -> bool) -> Words {
        let operand = |word| f32::from_bits(if self.flush_denormals { flushed(word) } else { word });
        zip(operands, |[a, b]| f(operand(a), operand(b)).into())
    }

    /// Moves a quotient or root away from zero by the configured units. Zero, infinities and NaN
    /// are unchanged.
    fn nudged(self, x: f32) -> f32 {
        if self.division_ulps == 0 || x == 0.0 || !x.is_finite() {
            return x;
        }
        f32::from_bits(x.to_bits().wrapping_add_signed(self.division_ulps))
    }

    pub(super) fn unary(self, operator: UnaryOperator, kind: Kind, a: &[Lanes]) -> Words {
        match (operator, kind) {
            (UnaryOperator::Negate, Kind::Float) => self.float([a], |[x]| -x),
            (UnaryOperator::Negate, _) => zip([a], |[x]| x.wrapping_neg()),
            (UnaryOperator::LogicalNot, _) => zip([a], |[x]| x ^ 1),
            (UnaryOperator::BitwiseNot, _) => zip([a], |[x]| !x),
        }
    }

    pub(super) fn binary(self, operator: BinaryOperator, kind: Kind, a: &[Lanes], b: &[Lanes]) -> Words {
        use BinaryOperator as Op;
        let ab = [a, b];
        match (operator, kind) {
            (Op::Greater, _) => self.binary(Op::Less, kind, b, a),
            (Op::GreaterEqual, _) => self.binary(Op::LessEqual, kind, b, a),
            (Op::Add, Kind::Float) => self.float(ab, |[a, b]| a + b),
            (Op::Subtract, Kind::Float) => self.float(ab, |[a, b]| a - b),
            (Op::Multiply, Kind::Float) => self.float(ab, |[a, b]| a * b),
            (Op::Divide, Kind::Float) => self.float(ab, |[a, b]| self.nudged(a / b)),
            (Op::Modulo, Kind::Float) => self.float(ab, |[a, b]| a % b),
            (Op::Equal, Kind::Float) => self.compare(ab, |a, b| a == b),
            (Op::NotEqual, Kind::Float) => self.compare(ab, |a, b| a != b),
            (Op::Less, Kind::Float) => self.compare(ab, |a, b| a < b),
            (Op::LessEqual, Kind::Float) => self.compare(ab, |a, b| a <= b),
            (Op::Add, _) => zip(ab, |[a, b]| a.wrapping_add(b)),
            (Op::Subtract, _) => zip(ab, |[a, b]| a.wrapping_sub(b)),
            (Op::Multiply, _) => zip(ab, |[a, b]| a.wrapping_mul(b)),
            // As in WGSL: `x / 0 = x` and `x % 0 = 0`.
            (Op::Divide, Kind::Signed) => signed(ab, |a, b| if b == 0 { a } else { a.wrapping_div(b) }),
            (Op::Divide, _) => zip(ab, |[a, b]| a.checked_div(b).unwrap_or(a)),
            (Op::Modulo, Kind::Signed) => signed(ab, |a, b| if b == 0 { 0 } else { a.wrapping_rem(b) }),
            (Op::Modulo, _) => zip(ab, |[a, b]| a.checked_rem(b).unwrap_or(0)),
            (Op::Equal, _) => zip(ab, |[a, b]| (a == b).into()),
            (Op::NotEqual, _) => zip(ab, |[a, b]| (a != b).into()),
            (Op::Less, Kind::Signed) => signed(ab, |a, b| (a < b).into()),
            (Op::Less, _) => zip(ab, |[a, b]| (a < b).into()),
            (Op::LessEqual, Kind::Signed) => signed(ab, |a, b| (a <= b).into()),
            (Op::LessEqual, _) => zip(ab, |[a, b]| (a <= b).into()),
            (Op::And | Op::LogicalAnd, _) => zip(ab, |[a, b]| a & b),
            (Op::InclusiveOr | Op::LogicalOr, _) => zip(ab, |[a, b]| a | b),
            (Op::ExclusiveOr, _) => zip(ab, |[a, b]| a ^ b),
            (Op::ShiftLeft, _) => zip(ab, |[a, b]| a.wrapping_shl(b)),
            (Op::ShiftRight, Kind::Signed) => signed(ab, |a, b| a.wrapping_shr(b.cast_unsigned())),
            (Op::ShiftRight, _) => zip(ab, |[a, b]| a.wrapping_shr(b)),
        }
    }

    /// Returns `left + right` or, with `minus`, `left − right`, of floats. Fused arithmetic rounds
    /// the sum and one of its products once; of two products, the left one.
    pub(super) fn sum(self, left: Term<'_>, minus: bool, right: Term<'_>) -> Words {
        let value = |term| match term {
            Term::Product(a, b) => self.binary(BinaryOperator::Multiply, Kind::Float, a, b),
            Term::Value(words) => words.into(),
        };
        let sign = if minus { -1.0 } else { 1.0 };
        match (left, right) {
            (Term::Product(a, b), _) if self.arithmetic == Arithmetic::Fused => {
                self.float([a, b, &value(right)], |[a, b, c]| a.mul_add(b, sign * c))
            }
            (_, Term::Product(a, b)) if self.arithmetic == Arithmetic::Fused => {
                self.float([a, b, &value(left)], |[a, b, c]| (sign * a).mul_add(b, c))
            }
            _ if minus => self.float([&value(left), &value(right)], |[a, b]| a - b),
            _ => self.float([&value(left), &value(right)], |[a, b]| a + b),
        }
    }

    /// Returns the sum of products, from the first component to the last.
    fn dot(self, kind: Kind, a: &[Lanes], b: &[Lanes]) -> Words {
        let product = |k: usize| self.binary(BinaryOperator::Multiply, kind, &a[k..=k], &b[k..=k]);
        if kind != Kind::Float {
            let sum = |sum: Words, k| self.binary(BinaryOperator::Add, kind, &sum, &product(k));
            return (1..a.len()).fold(product(0), sum);
        }
        let term = |k: usize| Term::Product(&a[k..=k], &b[k..=k]);
        match a.len() {
            1 => product(0),
            count => (2..count).fold(self.sum(term(0), false, term(1)), |sum, k| {
                self.sum(Term::Value(&sum), false, term(k))
            }),
        }
    }

    /// Returns a linear algebra product, or `None` for component-wise multiplication.
    pub(super) fn matrix_product(
        self,
        [left, right]: [&TypeInner; 2],
        a: &[Lanes],
        b: &[Lanes],
    ) -> Option<Words> {
        // The sum of a matrix's columns, each times a component of the vector.
        let times = |rows: usize, vector: &[Lanes]| {
            let row = |row: usize| a.iter().skip(row).step_by(rows).copied().collect::<Vec<Lanes>>();
            (0..rows).map(|at| self.dot(Kind::Float, &row(at), vector)[0]).collect::<Vec<Lanes>>()
        };
        match (left, right) {
            (TypeInner::Matrix { rows, .. }, TypeInner::Vector { .. }) => {
                Some(times(*rows as usize, b).into())
            }
            (TypeInner::Vector { .. }, TypeInner::Matrix { rows, .. }) => {
                Some(columns(b, *rows as usize).map(|column| self.dot(Kind::Float, a, column)[0]).collect())
            }
            (TypeInner::Matrix { rows, .. }, TypeInner::Matrix { rows: inner, .. }) => {
                Some(columns(b, *inner as usize).flat_map(|column| times(*rows as usize, column)).collect())
            }
            _ => None,
        }
    }

    fn length(self, a: &[Lanes]) -> Words {
        match a.len() {
            1 => self.float([a], |[x]| x.abs()),
            _ => self.float([&self.dot(Kind::Float, a, a)], |[x]| self.nudged(x.sqrt())),
        }
    }

    fn least(self, kind: Kind, a: &[Lanes], b: &[Lanes]) -> Words {
        match kind {
            Kind::Float => self.float([a, b], |[a, b]| a.min(b)),
            Kind::Signed => signed([a, b], i32::min),
            Kind::Unsigned | Kind::Bool => zip([a, b], |[a, b]| a.min(b)),
        }
    }

    fn largest(self, kind: Kind, a: &[Lanes], b: &[Lanes]) -> Words {
        match kind {
            Kind::Float => self.float([a, b], |[a, b]| a.max(b)),
            Kind::Signed => signed([a, b], i32::max),
            Kind::Unsigned | Kind::Bool => zip([a, b], |[a, b]| a.max(b)),
        }
    }

    /// Evaluates a built-in function. Transcendental functions are from the standard library.
    pub(super) fn math(
        self,
        function: MathFunction,
        kind: Kind,
        operands: &[Words],
    ) -> Result<Words, String> {
        use MathFunction as Fn;
        const ZERO: Lanes = [0; LANES];
        const ONE: Lanes = [0x3f80_0000; LANES];
        const TWO: Lanes = [0x4000_0000; LANES];
        const THREE: Lanes = [0x4040_0000; LANES];
        let operand = |k: usize| operands.get(k).map_or(&[][..], |words| words);
        let [a, b, c] = [0, 1, 2].map(operand);
        match (function, kind) {
            (Fn::Min, _) => return Ok(self.least(kind, a, b)),
            (Fn::Max, _) => return Ok(self.largest(kind, a, b)),
            (Fn::Clamp, _) => return Ok(self.least(kind, &self.largest(kind, a, b), c)),
            (Fn::Dot, _) => return Ok(self.dot(kind, a, b)),
            (Fn::Abs, Kind::Signed) => return Ok(signed([a, a], |x, _| x.wrapping_abs())),
            (Fn::Abs, Kind::Unsigned) => return Ok(a.into()),
            (Fn::Sign, Kind::Signed) => return Ok(signed([a, a], |x, _| x.signum())),
            (_, Kind::Float) => {}
            _ => return Err(format!("unsupported built-in {function:?} of {kind:?} numbers")),
        }
        let multiply = |a: &[Lanes], b: &[Lanes]| self.binary(BinaryOperator::Multiply, kind, a, b);
        let subtract = |a: &[Lanes], b: &[Lanes]| self.binary(BinaryOperator::Subtract, kind, a, b);
        let divide = |a: &[Lanes], b: &[Lanes]| self.binary(BinaryOperator::Divide, kind, a, b);
        Ok(match function {
            Fn::Abs => self.float([a], |[x]| x.abs()),
            Fn::Sign => self.float([a], |[x]| if x == 0.0 || x.is_nan() { 0.0 } else { x.signum() }),
            Fn::Cos => self.float([a], |[x]| x.cos()),
            Fn::Sin => self.float([a], |[x]| x.sin()),
            Fn::Tan => self.float([a], |[x]| x.tan()),
            Fn::Floor => self.float([a], |[x]| x.floor()),
            Fn::Round => self.float([a], |[x]| x.round_ties_even()),
            Fn::Exp => self.float([a], |[x]| x.exp()),
            Fn::Exp2 => self.float([a], |[x]| x.exp2()),
            Fn::Log => self.float([a], |[x]| x.ln()),
            Fn::Log2 => self.float([a], |[x]| x.log2()),
            Fn::Sqrt => self.float([a], |[x]| self.nudged(x.sqrt())),
            Fn::Atan2 => self.float([a, b], |[a, b]| a.atan2(b)),
            Fn::Fma => self.float([a, b, c], |[a, b, c]| a.mul_add(b, c)),
            Fn::Length => self.length(a),
            Fn::Normalize => divide(a, &self.length(a)),
            // a_i b_j − b_i a_j.
            Fn::Cross => [(1, 2), (2, 0), (0, 1)]
                .map(|(i, j)| {
                    let right = Term::Product(&b[i..=i], &a[j..=j]);
                    self.sum(Term::Product(&a[i..=i], &b[j..=j]), true, right)[0]
                })
                .into(),
            // e1 − 2 dot(e2, e1) e2.
            Fn::Reflect => {
                let twice = multiply(&[TWO], &self.dot(kind, b, a));
                self.sum(Term::Value(a), true, Term::Product(&twice, b))
            }
            // t² (3 − 2 t) with t = clamp((x − low) / (high − low), 0, 1).
            Fn::SmoothStep => {
                let place = divide(&subtract(c, a), &subtract(b, a));
                let t = self.least(kind, &self.largest(kind, &place, &[ZERO]), &[ONE]);
                let rest = self.sum(Term::Value(&[THREE]), true, Term::Product(&[TWO], &t));
                multiply(&multiply(&t, &t), &rest)
            }
            other => return Err(format!("unsupported built-in {other:?} of {kind:?} numbers")),
        })
    }
}
