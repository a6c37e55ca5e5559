//! Builtin functions, by their formulas in the specification of WGSL; those of analysis are the standard library's.

use naga::{Expression, Handle, MathFunction};

use super::super::layout::Kind;
use super::super::operators::{Binary, Ternary, Unary};
use super::super::program::Slot;
use super::body::{Body, spread};

impl Body<'_> {
    /// Compiles a builtin function.
    pub(super) fn math(
        &mut self,
        function: MathFunction,
        argument: Handle<Expression>,
        further: [Option<Handle<Expression>>; 3],
    ) -> Result<Vec<Slot>, String> {
        use MathFunction as Fn;
        let a = &self.words(argument)?[..];
        let mut others = [vec![], vec![], vec![]];
        for (other, handle) in others.iter_mut().zip(further) {
            if let Some(handle) = handle {
                *other = self.words(handle)?;
            }
        }
        let [b, c, _] = &others;
        let kind = self.kind(argument)?;
        let is_float = kind == Kind::Float;
        if let Some(unary) = unary(function, kind) {
            return Ok(self.each(unary, a));
        }
        if let Some(binary) = binary(function, kind) {
            return Ok(self.pairs(binary, a, b));
        }
        let (least, greatest) = min_max(kind);
        Ok(match function {
            Fn::Clamp => {
                let above = self.pairs(greatest, a, b);
                self.pairs(least, &above, c)
            }
            Fn::Dot => vec![self.dot(a, b, is_float)],
            Fn::Cross => self.cross(a, b),
            Fn::Length => vec![self.length(a)],
            Fn::Normalize => {
                let length = self.length(a);
                self.pairs(Binary::Divide, a, &[length])
            }
            // e1 − 2 dot(e2, e1) e2.
            Fn::Reflect => {
                let two = self.float(2.0);
                let dot = self.dot(b, a, true);
                let twice = self.binary(Binary::Multiply, two, dot);
                let normal = self.pairs(Binary::Multiply, &[twice], b);
                self.pairs(Binary::Subtract, a, &normal)
            }
            Fn::Fma => self.triples(Ternary::MultiplyAdd, a, b, c),
            // t² (3 − 2 t) with t = clamp((x − low) / (high − low), 0, 1).
            Fn::SmoothStep => {
                let [two, three] = [self.float(2.0), self.float(3.0)];
                let place = self.pairs(Binary::Subtract, c, a);
                let width = self.pairs(Binary::Subtract, b, a);
                let share = self.pairs(Binary::Divide, &place, &width);
                let t = self.saturate(&share);
                let twice = self.pairs(Binary::Multiply, &[two], &t);
                let rest = self.pairs(Binary::Subtract, &[three], &twice);
                let squared = self.pairs(Binary::Multiply, &t, &t);
                self.pairs(Binary::Multiply, &squared, &rest)
            }
            other => return Err(format!("the builtin {other:?} of {kind:?} numbers is not known")),
        })
    }

    fn saturate(&mut self, a: &[Slot]) -> Vec<Slot> {
        let [zero, one] = [self.float(0.0), self.float(1.0)];
        let above = self.pairs(Binary::Max, a, &[zero]);
        self.pairs(Binary::Min, &above, &[one])
    }

    fn triples(&mut self, ternary: Ternary, a: &[Slot], b: &[Slot], c: &[Slot]) -> Vec<Slot> {
        let word = |words: &[Slot], at| spread(words, at);
        (0..a.len()).map(|at| self.ternary(ternary, a[at], word(b, at), word(c, at))).collect()
    }
}

fn min_max(kind: Kind) -> (Binary, Binary) {
    match kind {
        Kind::Float => (Binary::Min, Binary::Max),
        Kind::Signed => (Binary::MinSigned, Binary::MaxSigned),
        Kind::Unsigned | Kind::Bool => (Binary::MinUnsigned, Binary::MaxUnsigned),
    }
}

/// The operation of a builtin that takes every word for itself.
fn unary(function: MathFunction, kind: Kind) -> Option<Unary> {
    use MathFunction as Fn;
    Some(match (function, kind) {
        (Fn::Abs, Kind::Signed) => Unary::AbsInteger,
        (Fn::Abs, Kind::Unsigned) => Unary::Copy,
        (Fn::Sign, Kind::Signed) => Unary::SignInteger,
        (_, Kind::Signed | Kind::Unsigned | Kind::Bool) => return None,
        (Fn::Abs, _) => Unary::Abs,
        (Fn::Sign, _) => Unary::Sign,
        (Fn::Cos, _) => Unary::Cos,
        (Fn::Sin, _) => Unary::Sin,
        (Fn::Tan, _) => Unary::Tan,
        (Fn::Floor, _) => Unary::Floor,
        (Fn::Round, _) => Unary::Round,
        (Fn::Exp, _) => Unary::Exp,
        (Fn::Exp2, _) => Unary::Exp2,
        (Fn::Log, _) => Unary::Log,
        (Fn::Log2, _) => Unary::Log2,
        (Fn::Sqrt, _) => Unary::Sqrt,
        _ => return None,
    })
}

/// The operation of a builtin that takes every pair of words for itself.
fn binary(function: MathFunction, kind: Kind) -> Option<Binary> {
    use MathFunction as Fn;
    Some(match (function, kind) {
        (Fn::Min, _) => min_max(kind).0,
        (Fn::Max, _) => min_max(kind).1,
        (Fn::Atan2, Kind::Float) => Binary::Atan2,
        _ => return None,
    })
}
