//! The lanes of a SIMD register, at every level that `fearless_simd` knows.

use fearless_simd::{Bytes, Select, Simd, SimdBase, SimdFloat};

use crate::lanes::{Lanes, MOST};

/// As many lanes as a register of the SIMD level has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wide<S>(pub(crate) S);

impl<S: Simd> Lanes for Wide<S> {
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
