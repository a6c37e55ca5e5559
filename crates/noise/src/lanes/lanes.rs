//! Lanes: the arithmetic that every noise is written in once, for one point or for a vector of them.
//!
//! A noise is generic over [`Lanes`]. [`Scalar`] has one lane; each SIMD level has as many as its registers hold. All
//! operations are exact or correctly rounded, so a lane has the bits that the scalar function has.

use core::{
    num::Wrapping,
    ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Shl, Shr, Sub},
};

use crate::math;

/// The most lanes there are.
pub(crate) const LANES: usize = 16;

/// A trait of the numbers in lanes, by their operators.
macro_rules! numbers {
    ($(#[$doc:meta])* $name:ident: $($operator:ident)*) => {
        $(#[$doc])*
        pub trait $name: Copy $(+ $operator<Output = Self>)* {}

        impl<T: Copy $(+ $operator<Output = T>)*> $name for T {}
    };
}

numbers!(
    /// Floats in lanes.
    Floats: Add Sub Mul Div Neg
);
numbers!(
    /// Words of 32 bits in lanes; sums and products wrap.
    Words: Add Sub Mul BitXor BitAnd BitOr
);

/// A number of lanes and their operations, chosen by a token that costs nothing.
///
/// It is public because kinds of noise are generic over it, and sealed: batches pick it.
pub trait Lanes: Copy + sealed::Sealed {
    /// The number of lanes.
    const LEN: usize;
    /// Whether a table is looked up faster than its entries are computed.
    const TABLES: bool;
    /// One `f32` per lane.
    type F: Floats;
    /// One `u32` per lane.
    type U: Words;
    /// One truth value per lane.
    type M: Copy;
    /// Lanes of this number, each of which draws words with a key of its own.
    type Keyed: Lanes<F = Self::F, U = Self::U, M = Self::M>;

    /// One float in every lane.
    fn float(self, x: f32) -> Self::F;
    /// One word in every lane.
    fn word(self, x: u32) -> Self::U;
    /// The float of each lane.
    fn floats(self, f: impl FnMut(usize) -> f32) -> Self::F;
    /// Two floats of each lane that lie side by side where they come from.
    fn pairs(self, f: impl FnMut(usize) -> [f32; 2]) -> [Self::F; 2];
    /// The word of each lane.
    fn words(self, f: impl FnMut(usize) -> u32) -> Self::U;
    /// The number of each lane.
    fn iota(self) -> Self::U;
    /// Lanes with a key each, in place of the one that a seed gives them all. One lane alone keeps that of its seed.
    fn keyed(self, keys: Self::U) -> Self::Keyed;
    /// The key of each lane: the one given, unless they have their own.
    fn keys(self, common: impl FnOnce() -> u32) -> Self::U;

    /// The first floats of a slice, zeros if it has fewer than `LEN`.
    fn load(self, slice: &[f32]) -> Self::F;
    /// The first words of a slice, zeros if it has fewer than `LEN`.
    fn load_words(self, slice: &[u32]) -> Self::U;
    /// Writes as many lanes as the slice can hold.
    fn store(self, x: Self::F, slice: &mut [f32]);
    /// One lane; lane 0 where there is no such lane.
    fn lane(self, x: Self::F, lane: usize) -> f32;
    /// One lane; lane 0 where there is no such lane.
    fn lane_word(self, x: Self::U, lane: usize) -> u32;

    /// x ≪ N.
    fn shl<const N: u32>(self, x: Self::U) -> Self::U;
    /// x ≫ N, zeros from the left.
    fn shr<const N: u32>(self, x: Self::U) -> Self::U;
    /// The largest integer that is not above x, |x| < 2³¹.
    fn floor(self, x: Self::F) -> Self::F;
    /// An integral |x| < 2³¹ as the bits of an `i32`.
    fn integer(self, x: Self::F) -> Self::U;
    /// The bits of an `i32` as a float.
    fn real(self, x: Self::U) -> Self::F;
    /// The bits of a float.
    fn bits(self, x: Self::F) -> Self::U;
    /// The float of the bits.
    fn float_of_bits(self, x: Self::U) -> Self::F;
    /// |x|.
    fn abs(self, x: Self::F) -> Self::F;
    /// √x, correctly rounded.
    fn sqrt(self, x: Self::F) -> Self::F;
    /// The lesser of numbers that are neither NaN nor −0.
    fn min(self, a: Self::F, b: Self::F) -> Self::F;
    /// The greater of numbers that are neither NaN nor −0.
    fn max(self, a: Self::F, b: Self::F) -> Self::F;
    /// a < b; false if either is NaN.
    fn less(self, a: Self::F, b: Self::F) -> Self::M;
    /// a < b as the bits of `i32`s.
    fn signed_less(self, a: Self::U, b: Self::U) -> Self::M;
    /// a = b.
    fn equal(self, a: Self::U, b: Self::U) -> Self::M;
    /// `yes` where the mask holds, else `no`.
    fn select(self, mask: Self::M, yes: Self::F, no: Self::F) -> Self::F;
    /// `yes` where the mask holds, else `no`.
    fn select_word(self, mask: Self::M, yes: Self::U, no: Self::U) -> Self::U;
    /// x where the mask holds, else 0.
    fn keep(self, mask: Self::M, x: Self::F) -> Self::F;
    /// 0 where the mask holds, else x.
    fn drop(self, mask: Self::M, x: Self::F) -> Self::F;
    /// A mask that holds where both do.
    fn both(self, a: Self::M, b: Self::M) -> Self::M;
    /// A mask that holds where one of two does.
    fn either(self, a: Self::M, b: Self::M) -> Self::M;
    /// A mask that holds where another does not.
    fn not(self, a: Self::M) -> Self::M;
    /// Whether the mask holds in every lane.
    fn all(self, mask: Self::M) -> bool;
    /// Whether the mask holds in a lane.
    fn any(self, mask: Self::M) -> bool;
    /// The lanes that the mask holds in, a bit for each, that of lane 0 the lowest.
    fn lanes(self, mask: Self::M) -> u32;
    /// Of every four lanes those from the K-th on, followed by those before it.
    fn turned<const K: usize>(self, x: Self::F) -> Self::F;

    /// The first floats of a slice, followed by zeros if it has fewer than `LEN`.
    #[inline(always)]
    fn load_part(self, slice: &[f32]) -> Self::F {
        if slice.len() < Self::LEN {
            let mut padded = [0.0; LANES];
            for (to, from) in padded.iter_mut().zip(slice) {
                *to = *from;
            }
            self.load(&padded)
        } else {
            self.load(slice)
        }
    }

    /// ⌊x⌋ as the bits of an `i32`, and x − ⌊x⌋, for |x| < 2³¹; 0 for −0, not −0.
    #[inline(always)]
    fn cell(self, x: Self::F) -> (Self::U, Self::F) {
        let floor = self.floor(x);
        (self.integer(floor), x - floor)
    }

    /// The products of lanes 0, 2, …; the others are of no meaning.
    #[inline(always)]
    fn even_products(self, a: Self::U, b: Self::U) -> Self::U {
        a * b
    }

    /// x clamped to [−1, 1].
    #[inline(always)]
    fn within_one(self, x: Self::F) -> Self::F {
        self.min(self.max(x, self.float(-1.0)), self.float(1.0))
    }

    /// x where it is above `limit`, else 0.
    #[inline(always)]
    fn above(self, x: Self::F, limit: f32) -> Self::F {
        self.select(self.less(self.float(limit), x), x, self.float(0.0))
    }

    /// Two floats, in the other order where the mask holds.
    #[inline(always)]
    fn exchanged(self, mask: Self::M, a: Self::F, b: Self::F) -> [Self::F; 2] {
        [self.select(mask, b, a), self.select(mask, a, b)]
    }

    /// The entries of a table of eight, written twice, at indices below 8; nothing where no instruction finds them.
    #[inline(always)]
    fn looked_up(self, _table: &[f32; LANES], _index: Self::U) -> Option<Self::F> {
        None
    }

    /// x with its sign flipped where the word's top bit is set; the other bits must be 0.
    #[inline(always)]
    fn flip(self, x: Self::F, sign: Self::U) -> Self::F {
        self.float_of_bits(self.bits(x) ^ sign)
    }
}

/// A value in lanes, and its gradient.
pub type LaneSample<S, const N: usize> = (<S as Lanes>::F, [<S as Lanes>::F; N]);

pub(crate) mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Scalar {}
}

/// One lane: the noise of one point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Scalar;

/// ⌊x⌋ for |x| ≤ 2³¹.
#[inline(always)]
fn floor(x: f32) -> i32 {
    // 1.5·2²³: a sum with it is rounded to an integer, which its lower bits hold. A cast would also have to see to NaN
    // and to numbers that are too large, and a call of the library is slower still.
    const ROUND: f32 = 12_582_912.0;
    let (nearest, above) = if x.abs() < 4_194_304.0 {
        let sum = x + ROUND;
        (sum.to_bits().wrapping_sub(ROUND.to_bits()) as i32, x < sum - ROUND)
    } else {
        let truncated = x as i32;
        (truncated, x < truncated as f32)
    };
    nearest.wrapping_sub(i32::from(above))
}

impl Lanes for Scalar {
    const LEN: usize = 1;
    const TABLES: bool = true;
    type F = f32;
    type U = Wrapping<u32>;
    type M = bool;
    type Keyed = Self;

    #[inline(always)]
    fn float(self, x: f32) -> f32 {
        x
    }
    #[inline(always)]
    fn word(self, x: u32) -> Wrapping<u32> {
        Wrapping(x)
    }
    #[inline(always)]
    fn floats(self, mut f: impl FnMut(usize) -> f32) -> f32 {
        f(0)
    }
    #[inline(always)]
    fn pairs(self, mut f: impl FnMut(usize) -> [f32; 2]) -> [f32; 2] {
        f(0)
    }
    #[inline(always)]
    fn words(self, mut f: impl FnMut(usize) -> u32) -> Wrapping<u32> {
        Wrapping(f(0))
    }
    #[inline(always)]
    fn iota(self) -> Wrapping<u32> {
        Wrapping(0)
    }
    #[inline(always)]
    fn keyed(self, _: Wrapping<u32>) -> Self {
        self
    }
    #[inline(always)]
    fn keys(self, common: impl FnOnce() -> u32) -> Wrapping<u32> {
        Wrapping(common())
    }
    #[inline(always)]
    fn load(self, slice: &[f32]) -> f32 {
        slice.first().copied().unwrap_or(0.0)
    }
    #[inline(always)]
    fn load_words(self, slice: &[u32]) -> Wrapping<u32> {
        Wrapping(slice.first().copied().unwrap_or(0))
    }
    #[inline(always)]
    fn store(self, x: f32, slice: &mut [f32]) {
        if let Some(first) = slice.first_mut() {
            *first = x;
        }
    }
    #[inline(always)]
    fn lane(self, x: f32, _: usize) -> f32 {
        x
    }
    #[inline(always)]
    fn lane_word(self, x: Wrapping<u32>, _: usize) -> u32 {
        x.0
    }
    #[inline(always)]
    fn shl<const N: u32>(self, x: Wrapping<u32>) -> Wrapping<u32> {
        Shl::<usize>::shl(x, N as usize)
    }
    #[inline(always)]
    fn shr<const N: u32>(self, x: Wrapping<u32>) -> Wrapping<u32> {
        Shr::<usize>::shr(x, N as usize)
    }
    #[inline(always)]
    fn floor(self, x: f32) -> f32 {
        floor(x) as f32
    }
    #[inline(always)]
    fn integer(self, x: f32) -> Wrapping<u32> {
        Wrapping(floor(x) as u32)
    }
    #[inline(always)]
    fn cell(self, x: f32) -> (Wrapping<u32>, f32) {
        let floor = floor(x);
        // −0 + 0 = 0.
        (Wrapping(floor as u32), x - floor as f32 + 0.0)
    }
    #[inline(always)]
    fn real(self, x: Wrapping<u32>) -> f32 {
        x.0 as i32 as f32
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
    fn abs(self, x: f32) -> f32 {
        x.abs()
    }
    #[inline(always)]
    fn sqrt(self, x: f32) -> f32 {
        math::sqrt(x)
    }
    #[inline(always)]
    fn min(self, a: f32, b: f32) -> f32 {
        if a < b { a } else { b }
    }
    #[inline(always)]
    fn max(self, a: f32, b: f32) -> f32 {
        if a < b { b } else { a }
    }
    #[inline(always)]
    fn less(self, a: f32, b: f32) -> bool {
        a < b
    }
    #[inline(always)]
    fn signed_less(self, a: Wrapping<u32>, b: Wrapping<u32>) -> bool {
        (a.0 as i32) < b.0 as i32
    }
    #[inline(always)]
    fn equal(self, a: Wrapping<u32>, b: Wrapping<u32>) -> bool {
        a == b
    }
    #[inline(always)]
    fn select(self, mask: bool, yes: f32, no: f32) -> f32 {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn select_word(self, mask: bool, yes: Wrapping<u32>, no: Wrapping<u32>) -> Wrapping<u32> {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn keep(self, mask: bool, x: f32) -> f32 {
        // A choice would be a branch, on what is random.
        f32::from_bits(x.to_bits() & u32::from(mask).wrapping_neg())
    }
    #[inline(always)]
    fn drop(self, mask: bool, x: f32) -> f32 {
        self.keep(!mask, x)
    }
    #[inline(always)]
    fn both(self, a: bool, b: bool) -> bool {
        a & b
    }
    #[inline(always)]
    fn either(self, a: bool, b: bool) -> bool {
        a | b
    }
    #[inline(always)]
    fn not(self, a: bool) -> bool {
        !a
    }
    #[inline(always)]
    fn all(self, mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn any(self, mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn lanes(self, mask: bool) -> u32 {
        u32::from(mask)
    }
    #[inline(always)]
    fn turned<const K: usize>(self, x: f32) -> f32 {
        x
    }
}
