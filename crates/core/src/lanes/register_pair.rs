//! Pairs of registers whose instructions are interleaved, which hides latency.

use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Sub};

use crate::lanes::lanes::Arithmetic;

/// The lanes of two registers of `S`.
#[derive(Clone, Copy, Debug)]
pub struct RegisterPair<S>(pub S);

/// One value for each of the two registers.
#[derive(Clone, Copy, Debug)]
pub struct Pair<T>(T, T);

macro_rules! in_step {
    ($($operator:ident $function:ident),*) => {$(
        impl<T: $operator<Output = T>> $operator for Pair<T> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(self.0.$function(other.0), self.1.$function(other.1))
            }
        }
    )*};
}
in_step!(Add add, Sub sub, Mul mul, Div div, BitAnd bitand, BitOr bitor, BitXor bitxor);

impl<T: Neg<Output = T>> Neg for Pair<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl<S: Arithmetic> Arithmetic for RegisterPair<S> {
    const LEN: usize = 2 * S::LEN;
    type F = Pair<S::F>;
    type U = Pair<S::U>;
    type M = Pair<S::M>;

    #[inline(always)]
    fn float(self, x: f32) -> Self::F {
        Pair(self.0.float(x), self.0.float(x))
    }
    #[inline(always)]
    fn word(self, x: u32) -> Self::U {
        Pair(self.0.word(x), self.0.word(x))
    }
    #[inline(always)]
    fn load(self, slice: &[f32]) -> Self::F {
        let (first, second) = slice.split_at(S::LEN.min(slice.len()));
        Pair(self.0.load(first), self.0.load(second))
    }
    #[inline(always)]
    fn store(self, x: Self::F, slice: &mut [f32]) {
        let (first, second) = slice.split_at_mut(S::LEN.min(slice.len()));
        self.0.store(x.0, first);
        self.0.store(x.1, second);
    }
    #[inline(always)]
    fn shl<const N: u32>(self, x: Self::U) -> Self::U {
        Pair(self.0.shl::<N>(x.0), self.0.shl::<N>(x.1))
    }
    #[inline(always)]
    fn shr<const N: u32>(self, x: Self::U) -> Self::U {
        Pair(self.0.shr::<N>(x.0), self.0.shr::<N>(x.1))
    }
    #[inline(always)]
    fn bits(self, x: Self::F) -> Self::U {
        Pair(self.0.bits(x.0), self.0.bits(x.1))
    }
    #[inline(always)]
    fn float_of_bits(self, x: Self::U) -> Self::F {
        Pair(self.0.float_of_bits(x.0), self.0.float_of_bits(x.1))
    }
    #[inline(always)]
    fn sqrt(self, x: Self::F) -> Self::F {
        Pair(self.0.sqrt(x.0), self.0.sqrt(x.1))
    }
    #[inline(always)]
    fn less(self, a: Self::F, b: Self::F) -> Self::M {
        Pair(self.0.less(a.0, b.0), self.0.less(a.1, b.1))
    }
    #[inline(always)]
    fn select(self, mask: Self::M, yes: Self::F, no: Self::F) -> Self::F {
        Pair(self.0.select(mask.0, yes.0, no.0), self.0.select(mask.1, yes.1, no.1))
    }
}
