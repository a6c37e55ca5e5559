//! Records that lie in arrays, turned into lanes; and whole numbers in lanes.

use core::num::Wrapping;

use crate::simd::lanes::{Lanes, Scalar};

/// Lanes that read fields of records, one record for each lane.
pub(crate) trait Records: Lanes {
    /// The first words of a slice.
    fn load_words(self, slice: &[u32]) -> Self::U;
    /// Writes all words.
    fn store_words(self, x: Self::U, slice: &mut [u32]);
    /// The integer part, for 0 ≤ x < 2³¹.
    fn truncated(self, x: Self::F) -> Self::U;
    /// The float of an integer below 2³¹.
    fn float_of_word(self, x: Self::U) -> Self::F;
    /// The larger of two numbers, neither of which is NaN.
    fn max(self, a: Self::F, b: Self::F) -> Self::F;
    /// The smaller of two numbers, neither of which is NaN.
    fn min(self, a: Self::F, b: Self::F) -> Self::F;
    /// a ≤ b; false if either is NaN.
    fn at_or_below(self, a: Self::F, b: Self::F) -> Self::M;
    /// Lanes in which one mask holds or the other.
    fn either(self, a: Self::M, b: Self::M) -> Self::M;
    /// Whether the mask holds in a lane.
    fn any(self, mask: Self::M) -> bool;
    /// The fields of as many records as there are lanes.
    fn fields2(self, records: &[[f32; 2]]) -> [Self::F; 2];
    /// The fields of as many records as there are lanes.
    fn fields4(self, records: &[[f32; 4]]) -> [Self::F; 4];
    /// The fields of as many records as there are lanes.
    fn fields8(self, records: &[[f32; 8]]) -> [Self::F; 8];
    /// `r left + t right`, field by field.
    fn blended4(self, sides: [&[f32; 4]; 2], factors: [f32; 2]) -> [f32; 4];
    /// `r left + t right`, field by field.
    fn blended8(self, sides: [&[f32; 8]; 2], factors: [f32; 2]) -> [f32; 8];

    /// The nearest number from 0 to 1 of one that is not NaN.
    #[inline(always)]
    fn unit(self, x: Self::F) -> Self::F {
        self.min(self.max(x, self.float(0.0)), self.float(1.0))
    }
}

impl Records for Scalar {
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
    fn truncated(self, x: f32) -> Wrapping<u32> {
        Wrapping(x as i32 as u32)
    }
    #[inline(always)]
    fn float_of_word(self, x: Wrapping<u32>) -> f32 {
        x.0 as i32 as f32
    }
    #[inline(always)]
    fn max(self, a: f32, b: f32) -> f32 {
        if a > b { a } else { b }
    }
    #[inline(always)]
    fn min(self, a: f32, b: f32) -> f32 {
        if a < b { a } else { b }
    }
    #[inline(always)]
    fn at_or_below(self, a: f32, b: f32) -> bool {
        a <= b
    }
    #[inline(always)]
    fn either(self, a: bool, b: bool) -> bool {
        a | b
    }
    #[inline(always)]
    fn any(self, mask: bool) -> bool {
        mask
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

    fn check(p: impl Records) {
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
        assert_eq!(lanes(p.float_of_word(p.truncated(p.float(7.9))))[..len], [7.0; 64][..len]);
    }

    #[test]
    fn fields_become_lanes() {
        check(Scalar);
        #[cfg(feature = "simd")]
        crate::simd::dispatch::each_level(|level| {
            fearless_simd::dispatch!(level, simd => check(crate::simd::registers::Registers(simd)));
        });
    }
}
