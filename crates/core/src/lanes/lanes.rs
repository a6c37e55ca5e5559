//! SIMD lanes: arithmetic that is written once, for one number or for a register of numbers.
//!
//! Every operation is exact or correctly rounded, so each lane has the bits of the scalar
//! computation.

use core::{
    num::Wrapping,
    ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Sub},
};

use crate::math;

/// Number of lanes of the longest register.
pub const MAX_LANES: usize = 16;

/// A trait of all types with these operators.
macro_rules! with_operators {
    ($(#[$doc:meta])* $name:ident: $($operator:ident)+) => {
        $(#[$doc])*
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

/// Float arithmetic in lanes, selected by a token: the operations that closed forms need.
pub trait Arithmetic: Copy {
    /// Number of lanes.
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
    /// The first floats of a slice, followed by zeros if the slice is shorter than `LEN`.
    fn load(self, slice: &[f32]) -> Self::F;
    /// Writes as many lanes as the slice can hold.
    fn store(self, x: Self::F, slice: &mut [f32]);
    /// x ≪ N.
    fn shl<const N: u32>(self, x: Self::U) -> Self::U;
    /// x ≫ N, filled with zeros.
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

    /// x clamped to ±`limit`; 0 where x is NaN.
    #[inline(always)]
    fn bounded(self, x: Self::F, limit: f32) -> Self::F {
        let (low, high) = (self.float(-limit), self.float(limit));
        let x = self.select(self.less(x, high), x, self.select(self.less(low, x), high, self.float(0.0)));
        self.select(self.less(low, x), x, low)
    }

    /// x with its sign flipped where the word's top bit is set; the other bits must be 0.
    #[inline(always)]
    fn flip(self, x: Self::F, sign: Self::U) -> Self::F {
        self.float_of_bits(self.bits(x) ^ sign)
    }
}

/// All operations of one register: integers, masks, gathers and records.
pub trait Lanes: Arithmetic {
    /// Whether a table lookup is faster than computing the entries.
    const TABLES: bool = false;
    /// These lanes with one word each, for instance the key for a hash.
    type Keyed: Lanes<F = Self::F, U = Self::U, M = Self::M>;

    /// These lanes, with a word each. [`Scalar`] carries none.
    fn keyed(self, keys: Self::U) -> Self::Keyed;
    /// The words that the lanes carry; `common` in every lane if they carry none.
    fn keys(self, common: impl FnOnce() -> u32) -> Self::U;

    /// One float per lane, by its number.
    fn floats(self, f: impl FnMut(usize) -> f32) -> Self::F;
    /// Two floats per lane, which are adjacent in memory.
    fn pairs(self, f: impl FnMut(usize) -> [f32; 2]) -> [Self::F; 2];
    /// One word per lane, by its number.
    fn words(self, f: impl FnMut(usize) -> u32) -> Self::U;
    /// The number of each lane.
    fn iota(self) -> Self::U;
    /// The first words of a slice; zeros if the slice is shorter than `LEN`.
    fn load_words(self, slice: &[u32]) -> Self::U;
    /// Writes all words to a slice of at least `LEN`.
    fn store_words(self, x: Self::U, slice: &mut [u32]);
    /// The float of one lane; lane 0 if the number is out of range.
    fn lane(self, x: Self::F, lane: usize) -> f32;
    /// The word of one lane; lane 0 if the number is out of range.
    fn lane_word(self, x: Self::U, lane: usize) -> u32;

    /// ⌊x⌋ for |x| < 2³¹.
    fn floor(self, x: Self::F) -> Self::F;
    /// An integral |x| < 2³¹ as the bits of an `i32`.
    fn integer(self, x: Self::F) -> Self::U;
    /// The integer part of 0 ≤ x < 2³¹.
    fn truncated(self, x: Self::F) -> Self::U;
    /// The bits of an `i32` as a float.
    fn real(self, x: Self::U) -> Self::F;
    /// |x|.
    fn abs(self, x: Self::F) -> Self::F;
    /// The smaller of two numbers, neither of which is NaN.
    fn min(self, a: Self::F, b: Self::F) -> Self::F;
    /// The larger of two numbers, neither of which is NaN.
    fn max(self, a: Self::F, b: Self::F) -> Self::F;

    /// a ≤ b; false if either is NaN.
    fn at_or_below(self, a: Self::F, b: Self::F) -> Self::M;
    /// a < b as the bits of `i32`s.
    fn signed_less(self, a: Self::U, b: Self::U) -> Self::M;
    /// a = b.
    fn equal(self, a: Self::U, b: Self::U) -> Self::M;
    /// `yes` where the mask holds, else `no`.
    fn select_word(self, mask: Self::M, yes: Self::U, no: Self::U) -> Self::U;
    /// x where the mask holds, else 0.
    fn keep(self, mask: Self::M, x: Self::F) -> Self::F;
    /// 0 where the mask holds, else x.
    fn drop(self, mask: Self::M, x: Self::F) -> Self::F;
    /// a ∧ b.
    fn both(self, a: Self::M, b: Self::M) -> Self::M;
    /// a ∨ b.
    fn either(self, a: Self::M, b: Self::M) -> Self::M;
    /// ¬a.
    fn not(self, a: Self::M) -> Self::M;
    /// Whether the mask holds in every lane.
    fn all(self, mask: Self::M) -> bool;
    /// Whether the mask holds in at least one lane.
    fn any(self, mask: Self::M) -> bool;
    /// One bit per lane in which the mask holds, lane 0 lowest.
    fn bitmask(self, mask: Self::M) -> u32;
    /// Each block of four lanes rotated by K.
    fn turned<const K: usize>(self, x: Self::F) -> Self::F;

    /// The fields of one record per lane.
    fn fields2(self, records: &[[f32; 2]]) -> [Self::F; 2];
    /// The fields of one record per lane.
    fn fields4(self, records: &[[f32; 4]]) -> [Self::F; 4];
    /// The fields of one record per lane.
    fn fields8(self, records: &[[f32; 8]]) -> [Self::F; 8];
    /// `r left + t right`, field by field.
    fn blended4(self, sides: [&[f32; 4]; 2], factors: [f32; 2]) -> [f32; 4];
    /// `r left + t right`, field by field.
    fn blended8(self, sides: [&[f32; 8]; 2], factors: [f32; 2]) -> [f32; 8];

    /// ⌊x⌋ as the bits of an `i32`, and x − ⌊x⌋, for |x| < 2³¹; +0 for −0.
    #[inline(always)]
    fn cell(self, x: Self::F) -> (Self::U, Self::F) {
        let floor = self.floor(x);
        (self.integer(floor), x - floor)
    }

    /// The entries of a table of eight, stored twice, at indices below 8; `None` at a level without
    /// a lookup instruction.
    #[inline(always)]
    fn looked_up(self, _table: &[f32; MAX_LANES], _index: Self::U) -> Option<Self::F> {
        None
    }

    /// x clamped to [−1, 1].
    #[inline(always)]
    fn within_one(self, x: Self::F) -> Self::F {
        self.min(self.max(x, self.float(-1.0)), self.float(1.0))
    }

    /// x clamped to [0, 1].
    #[inline(always)]
    fn unit(self, x: Self::F) -> Self::F {
        self.min(self.max(x, self.float(0.0)), self.float(1.0))
    }

    /// x where it is above `limit`, else 0.
    #[inline(always)]
    fn above(self, x: Self::F, limit: f32) -> Self::F {
        self.select(self.less(self.float(limit), x), x, self.float(0.0))
    }

    /// Two floats, swapped where the mask holds.
    #[inline(always)]
    fn exchanged(self, mask: Self::M, a: Self::F, b: Self::F) -> [Self::F; 2] {
        [self.select(mask, b, a), self.select(mask, a, b)]
    }
}

/// One lane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Scalar;

/// ⌊x⌋ for |x| ≤ 2³¹.
#[inline(always)]
fn floor(x: f32) -> i32 {
    // 1.5·2²³: adding it rounds to an integer, which the lower bits hold. This is faster than a
    // saturating cast.
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

impl Arithmetic for Scalar {
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

impl Lanes for Scalar {
    const TABLES: bool = true;
    type Keyed = Self;

    #[inline(always)]
    fn keyed(self, _: Wrapping<u32>) -> Self {
        self
    }
    #[inline(always)]
    fn keys(self, common: impl FnOnce() -> u32) -> Wrapping<u32> {
        Wrapping(common())
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
    fn load_words(self, slice: &[u32]) -> Wrapping<u32> {
        Wrapping(slice.first().copied().unwrap_or(0))
    }
    #[inline(always)]
    fn store_words(self, x: Wrapping<u32>, slice: &mut [u32]) {
        if let Some(first) = slice.first_mut() {
            *first = x.0;
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
    fn floor(self, x: f32) -> f32 {
        floor(x) as f32
    }
    #[inline(always)]
    fn integer(self, x: f32) -> Wrapping<u32> {
        Wrapping(floor(x) as u32)
    }
    #[inline(always)]
    fn truncated(self, x: f32) -> Wrapping<u32> {
        Wrapping(x as i32 as u32)
    }
    #[inline(always)]
    fn real(self, x: Wrapping<u32>) -> f32 {
        x.0 as i32 as f32
    }
    #[inline(always)]
    fn abs(self, x: f32) -> f32 {
        x.abs()
    }
    #[inline(always)]
    fn min(self, a: f32, b: f32) -> f32 {
        if a < b { a } else { b }
    }
    #[inline(always)]
    fn max(self, a: f32, b: f32) -> f32 {
        if a > b { a } else { b }
    }
    #[inline(always)]
    fn at_or_below(self, a: f32, b: f32) -> bool {
        a <= b
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
    fn select_word(self, mask: bool, yes: Wrapping<u32>, no: Wrapping<u32>) -> Wrapping<u32> {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn keep(self, mask: bool, x: f32) -> f32 {
        // A conditional would be a branch on random data.
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
    fn bitmask(self, mask: bool) -> u32 {
        u32::from(mask)
    }
    #[inline(always)]
    fn turned<const K: usize>(self, x: f32) -> f32 {
        x
    }
    #[inline(always)]
    fn fields2(self, records: &[[f32; 2]]) -> [f32; 2] {
        records.first().copied().unwrap_or_default()
    }
    #[inline(always)]
    fn fields4(self, records: &[[f32; 4]]) -> [f32; 4] {
        records.first().copied().unwrap_or_default()
    }
    #[inline(always)]
    fn fields8(self, records: &[[f32; 8]]) -> [f32; 8] {
        records.first().copied().unwrap_or_default()
    }
    #[inline(always)]
    fn blended4(self, sides: [&[f32; 4]; 2], factors: [f32; 2]) -> [f32; 4] {
        blended(sides, factors)
    }
    #[inline(always)]
    fn blended8(self, sides: [&[f32; 8]; 2], factors: [f32; 2]) -> [f32; 8] {
        blended(sides, factors)
    }
    #[inline(always)]
    fn cell(self, x: f32) -> (Wrapping<u32>, f32) {
        let floor = floor(x);
        // −0 + 0 = 0.
        (Wrapping(floor as u32), x - floor as f32 + 0.0)
    }
}

#[inline(always)]
fn blended<const N: usize>([left, right]: [&[f32; N]; 2], [r, t]: [f32; 2]) -> [f32; N] {
    let mut blended = [0.0; N];
    for k in 0..N {
        blended[k] = r * left[k] + t * right[k];
    }
    blended
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(p: impl Lanes) {
        let records: [[f32; 8]; 64] =
            core::array::from_fn(|k| core::array::from_fn(|field| (8 * k + field) as f32));
        let lanes = |x| -> [f32; 64] {
            let mut lanes = [0.0; 64];
            p.store(x, &mut lanes);
            lanes
        };
        let len = lanes(p.float(1.0)).iter().filter(|&&x| x == 1.0).count();
        let (quads, pairs) = (records.map(|r| [r[0], r[1], r[2], r[3]]), records.map(|r| [r[0], r[1]]));
        for (field, x) in p.fields8(&records[..len]).into_iter().enumerate() {
            assert!(lanes(x)[..len].iter().enumerate().all(|(k, &x)| x == records[k][field]), "{field}");
        }
        for (field, x) in p.fields4(&quads[..len]).into_iter().enumerate() {
            assert!(lanes(x)[..len].iter().enumerate().all(|(k, &x)| x == records[k][field]), "{field}");
        }
        for (field, x) in p.fields2(&pairs[..len]).into_iter().enumerate() {
            assert!(lanes(x)[..len].iter().enumerate().all(|(k, &x)| x == records[k][field]), "{field}");
        }
        let (sides, factors) = ([&records[1], &records[3]], [0.25, 0.75]);
        assert_eq!(p.blended8(sides, factors), blended(sides, factors));
        let sides = [&quads[1], &quads[3]];
        assert_eq!(p.blended4(sides, factors), blended(sides, factors));
        assert_eq!(lanes(p.real(p.truncated(p.float(7.9))))[..len], [7.0; 64][..len]);
    }

    #[test]
    fn fields_become_lanes() {
        check(Scalar);
        #[cfg(feature = "simd")]
        crate::lanes::dispatch::each_level(|level| {
            fearless_simd::dispatch!(level, simd => check(crate::lanes::registers::Registers::new(simd)));
        });
    }

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
