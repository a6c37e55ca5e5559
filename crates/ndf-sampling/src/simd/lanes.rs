//! Lanes: the arithmetic that batches of normals are written in once, for one normal or for a register of them.
//!
//! Every operation is exact or correctly rounded, so each lane of each register has the bits of the single lane.

use core::num::Wrapping;
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Sub};

use crate::math;

/// The most lanes there are.
#[cfg(feature = "simd")]
pub(crate) const MOST: usize = 16;

/// A trait of all types with these operators.
macro_rules! with_operators {
    ($(#[$about:meta])* $name:ident: $($operator:ident)+) => {
        $(#[$about])*
        pub trait $name: Copy $(+ $operator<Output = Self>)+ {}

        impl<T: Copy $(+ $operator<Output = T>)+> $name for T {}
    };
}
with_operators!(
    /// Floats in lanes.
    Floats: Add Sub Mul Div Neg
);
with_operators!(
    /// Words of 32 bits in lanes; sums and products wrap.
    Words: Add Sub Mul BitAnd BitOr BitXor
);

/// A number of lanes and their operations, chosen by a token that costs nothing.
pub trait Lanes: Copy {
    /// The number of lanes.
    const LEN: usize;
    /// One `f32` per lane.
    type F: Floats;
    /// One `u32` per lane.
    type U: Words;
    /// One truth value per lane.
    type M: Copy;

    /// One float in every lane.
    fn float(self, x: f32) -> Self::F;
    /// One word in every lane.
    fn word(self, x: u32) -> Self::U;
    /// The first floats of a slice, zeros if it has fewer than `LEN`.
    fn load(self, slice: &[f32]) -> Self::F;
    /// Writes as many lanes as the slice can hold.
    fn store(self, x: Self::F, slice: &mut [f32]);
    /// x ≪ N.
    fn shl<const N: u32>(self, x: Self::U) -> Self::U;
    /// x ≫ N, zeros from the left.
    fn shr<const N: u32>(self, x: Self::U) -> Self::U;
    /// The bits of a float.
    fn bits(self, x: Self::F) -> Self::U;
    /// The float of the bits.
    fn float_of_bits(self, x: Self::U) -> Self::F;
    /// √x, correctly rounded.
    fn sqrt(self, x: Self::F) -> Self::F;
    /// a < b; false if either is NaN.
    fn less(self, a: Self::F, b: Self::F) -> Self::M;
    /// `yes` where the mask holds, else `no`.
    fn select(self, mask: Self::M, yes: Self::F, no: Self::F) -> Self::F;

    /// The smaller of x and `limit`; `limit` where x is NaN.
    #[inline(always)]
    fn at_most(self, x: Self::F, limit: f32) -> Self::F {
        let limit = self.float(limit);
        self.select(self.less(x, limit), x, limit)
    }

    /// The larger of x and `limit`; `limit` where x is NaN.
    #[inline(always)]
    fn at_least(self, x: Self::F, limit: f32) -> Self::F {
        let limit = self.float(limit);
        self.select(self.less(limit, x), x, limit)
    }

    /// x in ±`limit`; 0 where x is NaN.
    #[inline(always)]
    fn bounded(self, x: Self::F, limit: f32) -> Self::F {
        let (low, high) = (self.float(-limit), self.float(limit));
        let x = self.select(self.less(x, high), x, self.select(self.less(low, x), high, self.float(0.0)));
        self.select(self.less(low, x), x, low)
    }
}

/// One lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scalar;

impl Lanes for Scalar {
    const LEN: usize = 1;
    type F = f32;
    type U = Wrapping<u32>;
    type M = bool;

    #[inline(always)]
    fn float(self, x: f32) -> f32 {
        x
    }
    #[inline(always)]
    fn word(self, x: u32) -> Wrapping<u32> {
        Wrapping(x)
    }
    #[inline(always)]
    fn load(self, slice: &[f32]) -> f32 {
        slice.first().copied().unwrap_or(0.0)
    }
    #[inline(always)]
    fn store(self, x: f32, slice: &mut [f32]) {
        if let Some(first) = slice.first_mut() {
            *first = x;
        }
    }
    #[inline(always)]
    fn shl<const N: u32>(self, x: Wrapping<u32>) -> Wrapping<u32> {
        x << N as usize
    }
    #[inline(always)]
    fn shr<const N: u32>(self, x: Wrapping<u32>) -> Wrapping<u32> {
        x >> N as usize
    }
    #[inline(always)]
    fn bits(self, x: f32) -> Wrapping<u32> {
        Wrapping(x.to_bits())
    }
    #[inline(always)]
    fn float_of_bits(self, x: Wrapping<u32>) -> f32 {
        f32::from_bits(x.0)
    }
    #[inline(always)]
    fn sqrt(self, x: f32) -> f32 {
        math::sqrt(x)
    }
    #[inline(always)]
    fn less(self, a: f32, b: f32) -> bool {
        a < b
    }
    #[inline(always)]
    fn select(self, mask: bool, yes: f32, no: f32) -> f32 {
        if mask { yes } else { no }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_of_every_input() {
        for (x, bounded) in
            [(f32::NAN, 0.0), (f32::INFINITY, 2.0), (f32::NEG_INFINITY, -2.0), (1.5, 1.5), (-2.5, -2.0)]
        {
            assert_eq!(Scalar.bounded(x, 2.0), bounded, "{x}");
        }
        assert_eq!((Scalar.at_most(f32::NAN, 1.0), Scalar.at_least(f32::NAN, 1.0)), (1.0, 1.0));
        assert_eq!((Scalar.at_most(0.5, 1.0), Scalar.at_least(0.5, 1.0)), (0.5, 1.0));
    }
}
