//! The lanes of SIMD registers, at every level that `fearless_simd` knows.

use fearless_simd::{
    Bytes, Select, Simd, SimdBase, SimdCombine, SimdFloat, SimdMask, f32x4, f32x8, mask32x8, u32x8,
};

use crate::simd::gather::{Gather, four};
use crate::simd::lanes::{Lanes, MOST};

/// The lanes of one register of the SIMD level.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Registers<S>(pub(crate) S);

/// Eight lanes, in as many registers as they need.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EightLanes<S>(pub(crate) S);

macro_rules! lanes {
    ($lanes:ident, $floats:ty, $words:ty, $mask:ty) => {
        impl<S: Simd> Lanes for $lanes<S> {
            const LEN: usize = <$floats>::LEN;
            type F = $floats;
            type U = $words;
            type M = $mask;

            #[inline(always)]
            fn float(self, x: f32) -> Self::F {
                <$floats>::splat(self.0, x)
            }
            #[inline(always)]
            fn word(self, x: u32) -> Self::U {
                <$words>::splat(self.0, x)
            }
            #[inline(always)]
            fn load(self, slice: &[f32]) -> Self::F {
                if let Some(whole) = slice.get(..Self::LEN) {
                    return <$floats>::from_slice(self.0, whole);
                }
                let mut padded = [0.0; MOST];
                for (to, from) in padded.iter_mut().zip(slice) {
                    *to = *from;
                }
                match padded.get(..Self::LEN) {
                    Some(whole) => <$floats>::from_slice(self.0, whole),
                    None => self.float(0.0),
                }
            }
            #[inline(always)]
            fn store(self, x: Self::F, slice: &mut [f32]) {
                if let Some(whole) = slice.get_mut(..Self::LEN) {
                    x.store_slice(whole);
                } else {
                    for (to, from) in slice.iter_mut().zip(x.as_slice()) {
                        *to = *from;
                    }
                }
            }
            #[inline(always)]
            fn shl<const N: u32>(self, x: Self::U) -> Self::U {
                x << N
            }
            #[inline(always)]
            fn shr<const N: u32>(self, x: Self::U) -> Self::U {
                x >> N
            }
            #[inline(always)]
            fn bits(self, x: Self::F) -> Self::U {
                x.bitcast()
            }
            #[inline(always)]
            fn float_of_bits(self, x: Self::U) -> Self::F {
                x.bitcast()
            }
            #[inline(always)]
            fn sqrt(self, x: Self::F) -> Self::F {
                x.sqrt()
            }
            #[inline(always)]
            fn less(self, a: Self::F, b: Self::F) -> Self::M {
                a.simd_lt(b)
            }
            #[inline(always)]
            fn select(self, mask: Self::M, yes: Self::F, no: Self::F) -> Self::F {
                mask.select(yes, no)
            }
        }
    };
}
lanes!(Registers, S::f32s, S::u32s, S::mask32s);
lanes!(EightLanes, f32x8<S>, u32x8<S>, mask32x8<S>);

impl<S: Simd> Gather<8> for EightLanes<S> {
    #[inline(always)]
    fn words(self, x: Self::U) -> [u32; 8] {
        x.into()
    }
    #[inline(always)]
    fn of_words(self, x: &[u32; 8]) -> Self::U {
        u32x8::from_slice(self.0, x)
    }
    #[inline(always)]
    fn transposed(self, rows: &[&[f32; 4]; 8]) -> [Self::F; 4] {
        let mut quads = [f32x4::splat(self.0, 0.0); 8];
        for k in 0..8 {
            quads[k] = f32x4::from_slice(self.0, rows[k]);
        }
        transposed(quads)
    }
    #[inline(always)]
    fn mixed(self, rows: &[&[[f32; 4]; 4]; 8], factors: &[[f32; 8]; 4]) -> [Self::F; 4] {
        let quad = |row: &[f32; 4]| f32x4::from_slice(self.0, row);
        let mut quads = [f32x4::splat(self.0, 0.0); 8];
        for k in 0..8 {
            let (rows, [a, b, c, d]) =
                (rows[k], [factors[0][k], factors[1][k], factors[2][k], factors[3][k]]);
            let first = f32x4::from_slice(self.0, &[a, a, a, 1.0]);
            quads[k] =
                (quad(&rows[0]) * first + quad(&rows[1]) * b) + (quad(&rows[2]) * c + quad(&rows[3]) * d);
        }
        transposed(quads)
    }
    #[inline(always)]
    fn any(self, mask: Self::M) -> bool {
        mask.any_true()
    }
    #[inline(always)]
    fn blended(self, [left, right]: [&[&[f32; 4]; 8]; 2], [r, t]: [Self::F; 2]) -> [Self::F; 4] {
        let (r, t) = (self.floats(r), self.floats(t));
        let mut quads = [f32x4::splat(self.0, 0.0); 8];
        for k in 0..8 {
            let (left, right) = (f32x4::from_slice(self.0, left[k]), f32x4::from_slice(self.0, right[k]));
            quads[k] = left * r[k] + right * t[k];
        }
        transposed(quads)
    }
    #[inline(always)]
    fn reached<const SIDES: usize>(
        self,
        [left, right]: [&[f32; 16]; 2],
        [r, t]: [f32; 2],
        limit: f32,
    ) -> (u32, [f32; 4]) {
        let limit = self.float(limit);
        let (mut low, mut high) = halves(self, left);
        if SIDES == 2 {
            let (other_low, other_high) = halves(self, right);
            (low, high) = (low * r + other_low * t, high * r + other_high * t);
        }
        let passed = low.simd_le(limit).to_bitmask() | (high.simd_le(limit).to_bitmask() << 8);
        let count = (passed & 0x5555).count_ones();
        let [left, right] = [four(left, count), four(right, count)];
        if SIDES == 1 {
            return (count, left);
        }
        let (left, right) = (f32x4::from_slice(self.0, &left), f32x4::from_slice(self.0, &right));
        (count, (left * r + right * t).into())
    }
}

#[inline(always)]
fn halves<S: Simd>(lanes: EightLanes<S>, numbers: &[f32; 16]) -> (f32x8<S>, f32x8<S>) {
    let (low, high) = numbers.split_at(8);
    (f32x8::from_slice(lanes.0, low), f32x8::from_slice(lanes.0, high))
}

/// The columns of eight rows.
#[inline(always)]
fn transposed<S: Simd>([a, b, c, d, e, f, g, h]: [f32x4<S>; 8]) -> [f32x8<S>; 4] {
    let (low, high) = (columns([a, b, c, d]), columns([e, f, g, h]));
    [low[0].combine(high[0]), low[1].combine(high[1]), low[2].combine(high[2]), low[3].combine(high[3])]
}

/// The columns of four rows.
#[inline(always)]
fn columns<S: Simd>([a, b, c, d]: [f32x4<S>; 4]) -> [f32x4<S>; 4] {
    let (even, odd) = (a.interleave(c), b.interleave(d));
    let (first, last) = (even.0.interleave(odd.0), even.1.interleave(odd.1));
    [first.0, first.1, last.0, last.1]
}
