//! The lanes of SIMD registers, at every level that `fearless_simd` knows.

use fearless_simd::{Bytes, Select, Simd, SimdBase, SimdFloat, SimdInt, SimdMask, f32x4, f32x8};

use crate::simd::lanes::{Lanes, MOST};
use crate::simd::records::Records;

/// The lanes of one register of the SIMD level.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Registers<S>(pub(crate) S);

impl<S: Simd> Lanes for Registers<S> {
    const LEN: usize = S::f32s::LEN;
    type F = S::f32s;
    type U = S::u32s;
    type M = S::mask32s;

    #[inline(always)]
    fn float(self, x: f32) -> Self::F {
        S::f32s::splat(self.0, x)
    }
    #[inline(always)]
    fn word(self, x: u32) -> Self::U {
        S::u32s::splat(self.0, x)
    }
    #[inline(always)]
    fn load(self, slice: &[f32]) -> Self::F {
        if let Some(whole) = slice.get(..Self::LEN) {
            return S::f32s::from_slice(self.0, whole);
        }
        let mut padded = [0.0; MOST];
        for (to, from) in padded.iter_mut().zip(slice) {
            *to = *from;
        }
        match padded.get(..Self::LEN) {
            Some(whole) => S::f32s::from_slice(self.0, whole),
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

impl<S: Simd> Records for Registers<S> {
    #[inline(always)]
    fn load_words(self, slice: &[u32]) -> Self::U {
        match slice.get(..Self::LEN) {
            Some(whole) => S::u32s::from_slice(self.0, whole),
            None => self.word(0),
        }
    }
    #[inline(always)]
    fn store_words(self, x: Self::U, slice: &mut [u32]) {
        if let Some(whole) = slice.get_mut(..Self::LEN) {
            x.store_slice(whole);
        }
    }
    #[inline(always)]
    fn truncated(self, x: Self::F) -> Self::U {
        x.to_int::<S::i32s>().bitcast()
    }
    #[inline(always)]
    fn float_of_word(self, x: Self::U) -> Self::F {
        let x: S::i32s = x.bitcast();
        x.to_float()
    }
    #[inline(always)]
    fn max(self, a: Self::F, b: Self::F) -> Self::F {
        a.max(b)
    }
    #[inline(always)]
    fn min(self, a: Self::F, b: Self::F) -> Self::F {
        a.min(b)
    }
    #[inline(always)]
    fn at_or_below(self, a: Self::F, b: Self::F) -> Self::M {
        a.simd_le(b)
    }
    #[inline(always)]
    fn either(self, a: Self::M, b: Self::M) -> Self::M {
        a | b
    }
    #[inline(always)]
    fn any(self, mask: Self::M) -> bool {
        mask.any_true()
    }
    #[inline(always)]
    fn fields2(self, records: &[[f32; 2]]) -> [Self::F; 2] {
        let [a, b] = loaded(self, records.as_flattened());
        let (even, odd) = a.deinterleave(b);
        [even, odd]
    }
    #[inline(always)]
    fn fields4(self, records: &[[f32; 4]]) -> [Self::F; 4] {
        fields_of_four::<S>(loaded(self, records.as_flattened()))
    }
    #[inline(always)]
    fn fields8(self, records: &[[f32; 8]]) -> [Self::F; 8] {
        let [a, b, c, d, e, f, g, h] = loaded(self, records.as_flattened());
        let ((a, b), (c, d)) = (a.deinterleave(b), c.deinterleave(d));
        let ((e, f), (g, h)) = (e.deinterleave(f), g.deinterleave(h));
        let [x0, x2, x4, x6] = fields_of_four::<S>([a, c, e, g]);
        let [x1, x3, x5, x7] = fields_of_four::<S>([b, d, f, h]);
        [x0, x1, x2, x3, x4, x5, x6, x7]
    }
    #[inline(always)]
    fn blended4(self, [left, right]: [&[f32; 4]; 2], [r, t]: [f32; 2]) -> [f32; 4] {
        (f32x4::from_slice(self.0, left) * r + f32x4::from_slice(self.0, right) * t).into()
    }
    #[inline(always)]
    fn blended8(self, [left, right]: [&[f32; 8]; 2], [r, t]: [f32; 2]) -> [f32; 8] {
        (f32x8::from_slice(self.0, left) * r + f32x8::from_slice(self.0, right) * t).into()
    }
}

/// Registers one after another.
#[inline(always)]
fn loaded<S: Simd, const N: usize>(lanes: Registers<S>, floats: &[f32]) -> [S::f32s; N] {
    let mut registers = [lanes.float(0.0); N];
    for (register, floats) in registers.iter_mut().zip(floats.chunks_exact(S::f32s::LEN)) {
        *register = S::f32s::from_slice(lanes.0, floats);
    }
    registers
}

/// The fields of records of four, given as they lie one after another.
#[inline(always)]
fn fields_of_four<S: Simd>([a, b, c, d]: [S::f32s; 4]) -> [S::f32s; 4] {
    let ((even, odd), (next_even, next_odd)) = (a.deinterleave(b), c.deinterleave(d));
    let ((x0, x2), (x1, x3)) = (even.deinterleave(next_even), odd.deinterleave(next_odd));
    [x0, x1, x2, x3]
}
