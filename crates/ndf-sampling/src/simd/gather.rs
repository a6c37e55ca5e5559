//! Gathers: lanes that read their numbers from arrays, each at its own index.

use core::num::Wrapping;

use crate::simd::lanes::{Lanes, Scalar};

/// Lanes that are taken apart and put together; `N` is their number.
pub(crate) trait Gather<const N: usize>: Lanes {
    /// The word of every lane.
    fn words(self, x: Self::U) -> [u32; N];
    /// The lanes of an array.
    fn of_words(self, x: &[u32; N]) -> Self::U;
    /// Four numbers of every lane.
    fn transposed(self, rows: &[&[f32; 4]; N]) -> [Self::F; 4];
    /// The rows of every lane, each times its factor, added up; the last number is the first row's.
    fn mixed(self, rows: &[&[[f32; 4]; 4]; N], factors: &[[f32; N]; 4]) -> [Self::F; 4];
    /// Whether the mask holds in a lane.
    fn any(self, mask: Self::M) -> bool;
    /// The rows of every lane of two, each times its factor, added up.
    fn blended(self, rows: [&[&[f32; 4]; N]; 2], factors: [Self::F; 2]) -> [Self::F; 4];
    /// Number of the even numbers of `r left + t right` are at most `limit`, and the four numbers that begin with the last of
    /// these; with one side `left`.
    fn reached<const SIDES: usize>(
        self,
        sides: [&[f32; 16]; 2],
        factors: [f32; 2],
        limit: f32,
    ) -> (u32, [f32; 4]);

    /// The float of every lane.
    #[inline(always)]
    fn floats(self, x: Self::F) -> [f32; N] {
        let mut floats = [0.0; N];
        self.store(x, &mut floats);
        floats
    }

    /// The lanes of an array.
    #[inline(always)]
    fn of_floats(self, x: &[f32; N]) -> Self::F {
        self.load(x)
    }

    /// The integer below `x` (or `x`, or the one below, if it is one) for x < 2²², as a float and as a word; 0 for less.
    #[inline(always)]
    fn below(self, x: Self::F) -> (Self::F, Self::U) {
        let shifted = self.at_least(x - self.float(0.5), 0.0) + self.float(SHIFT);
        (shifted - self.float(SHIFT), self.bits(shifted) & self.word(0x7f_ffff))
    }

    /// The float of a word below 2²³.
    #[inline(always)]
    fn float_of_word(self, x: Self::U) -> Self::F {
        self.float_of_bits(x | self.word(SHIFT.to_bits())) - self.float(SHIFT)
    }
}

/// 2²³: a float from here on counts whole numbers.
const SHIFT: f32 = 8_388_608.0;

impl Gather<1> for Scalar {
    #[inline(always)]
    fn words(self, x: Wrapping<u32>) -> [u32; 1] {
        [x.0]
    }
    #[inline(always)]
    fn of_words(self, &[x]: &[u32; 1]) -> Wrapping<u32> {
        Wrapping(x)
    }
    #[inline(always)]
    fn transposed(self, &[&row]: &[&[f32; 4]; 1]) -> [f32; 4] {
        row
    }
    #[inline(always)]
    fn mixed(self, &[rows]: &[&[[f32; 4]; 4]; 1], &[[a], [b], [c], [d]]: &[[f32; 1]; 4]) -> [f32; 4] {
        let mut mixed = [0.0; 4];
        for k in 0..4 {
            let first = if k < 3 { a } else { 1.0 };
            mixed[k] = (rows[0][k] * first + rows[1][k] * b) + (rows[2][k] * c + rows[3][k] * d);
        }
        mixed
    }
    #[inline(always)]
    fn any(self, mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn blended(self, [[left], [right]]: [&[&[f32; 4]; 1]; 2], [r, t]: [f32; 2]) -> [f32; 4] {
        let mut blended = [0.0; 4];
        for k in 0..4 {
            blended[k] = r * left[k] + t * right[k];
        }
        blended
    }
    #[inline(always)]
    fn reached<const SIDES: usize>(
        self,
        [left, right]: [&[f32; 16]; 2],
        [r, t]: [f32; 2],
        limit: f32,
    ) -> (u32, [f32; 4]) {
        // All numbers, for the compiler to take four at once.
        let mut mixed = *left;
        if SIDES == 2 {
            for k in 0..16 {
                mixed[k] = r * left[k] + t * right[k];
            }
        }
        let mut count = 0;
        for k in 0..8 {
            count += u32::from(mixed[2 * k] <= limit);
        }
        (count, four(&mixed, count))
    }
}

/// The four numbers from the last of `count` even ones on; from the last that has four if there are more.
#[inline(always)]
pub(crate) fn four(numbers: &[f32; 16], count: u32) -> [f32; 4] {
    let at = 2 * (count.wrapping_sub(1) as usize).min(6);
    numbers.get(at..at + 4).and_then(|four| four.as_array()).copied().unwrap_or_default()
}
