//! The lanes of one SIMD register, at every level of `fearless_simd`.

use fearless_simd::{Bytes, Select, Simd, SimdBase, SimdFloat, SimdInt, SimdMask, f32x4, f32x8};

use crate::lanes::lanes::{Arithmetic, Lanes, MAX_LANES};
use crate::lanes::look_up::looked_up;

/// The lanes of one register of a SIMD level, and the words `K` that they carry; no words by
/// default.
#[derive(Clone, Copy, Debug)]
pub struct Registers<S, K = ()> {
    /// Token of the level.
    pub(crate) simd: S,
    keys: K,
}

impl<S> Registers<S> {
    /// Registers of the level.
    #[inline(always)]
    pub const fn new(simd: S) -> Self {
        Self { simd, keys: () }
    }
}

/// The words that lanes carry.
pub trait Keys<U>: Copy {
    /// The words, or none.
    fn keys(self) -> Option<U>;
}

impl<U> Keys<U> for () {
    #[inline(always)]
    fn keys(self) -> Option<U> {
        None
    }
}

/// A word per lane.
#[derive(Clone, Copy, Debug)]
pub struct OwnKeys<U>(U);

impl<U: Copy> Keys<U> for OwnKeys<U> {
    #[inline(always)]
    fn keys(self) -> Option<U> {
        Some(self.0)
    }
}

impl<S: Simd, K: Copy> Arithmetic for Registers<S, K> {
    const LEN: usize = S::f32s::LEN;
    type F = S::f32s;
    type U = S::u32s;
    type M = S::mask32s;

    #[inline(always)]
    fn float(self, x: f32) -> Self::F {
        S::f32s::splat(self.simd, x)
    }
    #[inline(always)]
    fn word(self, x: u32) -> Self::U {
        S::u32s::splat(self.simd, x)
    }
    #[inline(always)]
    fn load(self, slice: &[f32]) -> Self::F {
        if let Some(whole) = slice.get(..Self::LEN) {
            return S::f32s::from_slice(self.simd, whole);
        }
        let mut padded = [0.0; MAX_LANES];
        for (to, from) in padded.iter_mut().zip(slice) {
            *to = *from;
        }
        match padded.get(..Self::LEN) {
            Some(whole) => S::f32s::from_slice(self.simd, whole),
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

impl<S: Simd, K: Keys<S::u32s>> Lanes for Registers<S, K> {
    type Keyed = Registers<S, OwnKeys<S::u32s>>;

    #[inline(always)]
    fn keyed(self, keys: Self::U) -> Self::Keyed {
        Registers { simd: self.simd, keys: OwnKeys(keys) }
    }
    #[inline(always)]
    fn keys(self, common: impl FnOnce() -> u32) -> Self::U {
        match self.keys.keys() {
            Some(keys) => keys,
            None => self.word(common()),
        }
    }
    #[inline(always)]
    fn floats(self, f: impl FnMut(usize) -> f32) -> Self::F {
        S::f32s::from_fn(self.simd, f)
    }
    #[inline(always)]
    fn pairs(self, mut f: impl FnMut(usize) -> [f32; 2]) -> [Self::F; 2] {
        // Two neighbors are loaded at once as one number of 64 bits.
        let mut pair = |lane| {
            let [first, second] = f(lane).map(|x| u64::from(x.to_bits()));
            f64::from_bits(first | second << 32)
        };
        let low: Self::F = S::f64s::from_fn(self.simd, &mut pair).bitcast();
        let high: Self::F = S::f64s::from_fn(self.simd, |lane| pair(Self::LEN / 2 + lane)).bitcast();
        [low.unzip_low(high), low.unzip_high(high)]
    }
    #[inline(always)]
    fn words(self, f: impl FnMut(usize) -> u32) -> Self::U {
        S::u32s::from_fn(self.simd, f)
    }
    #[inline(always)]
    fn iota(self) -> Self::U {
        let numbers = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
        S::u32s::from_slice(self.simd, &numbers[..Self::LEN])
    }
    #[inline(always)]
    fn load_words(self, slice: &[u32]) -> Self::U {
        match slice.get(..Self::LEN) {
            Some(slice) => S::u32s::from_slice(self.simd, slice),
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
    fn lane(self, x: Self::F, lane: usize) -> f32 {
        x.as_slice().get(lane).copied().unwrap_or(x.as_slice()[0])
    }
    #[inline(always)]
    fn lane_word(self, x: Self::U, lane: usize) -> u32 {
        x.as_slice().get(lane).copied().unwrap_or(x.as_slice()[0])
    }
    #[inline(always)]
    fn floor(self, x: Self::F) -> Self::F {
        if self.rounds() {
            x.floor()
        } else {
            let (_, nearest, above) = self.truncated_above(x);
            nearest - self.select(above, self.float(1.0), self.float(0.0))
        }
    }
    #[inline(always)]
    fn integer(self, x: Self::F) -> Self::U {
        x.to_int::<S::i32s>().bitcast()
    }
    #[inline(always)]
    fn truncated(self, x: Self::F) -> Self::U {
        x.to_int::<S::i32s>().bitcast()
    }
    #[inline(always)]
    fn real(self, x: Self::U) -> Self::F {
        x.bitcast::<S::i32s>().to_float()
    }
    #[inline(always)]
    fn abs(self, x: Self::F) -> Self::F {
        x.abs()
    }
    #[inline(always)]
    fn min(self, a: Self::F, b: Self::F) -> Self::F {
        a.min(b)
    }
    #[inline(always)]
    fn max(self, a: Self::F, b: Self::F) -> Self::F {
        a.max(b)
    }
    #[inline(always)]
    fn at_or_below(self, a: Self::F, b: Self::F) -> Self::M {
        a.simd_le(b)
    }
    #[inline(always)]
    fn signed_less(self, a: Self::U, b: Self::U) -> Self::M {
        a.bitcast::<S::i32s>().simd_lt(b.bitcast::<S::i32s>())
    }
    #[inline(always)]
    fn equal(self, a: Self::U, b: Self::U) -> Self::M {
        a.simd_eq(b)
    }
    #[inline(always)]
    fn select_word(self, mask: Self::M, yes: Self::U, no: Self::U) -> Self::U {
        mask.select(yes, no)
    }
    #[inline(always)]
    fn keep(self, mask: Self::M, x: Self::F) -> Self::F {
        mask.select(x, self.float(0.0))
    }
    #[inline(always)]
    fn drop(self, mask: Self::M, x: Self::F) -> Self::F {
        mask.select(self.float(0.0), x)
    }
    #[inline(always)]
    fn both(self, a: Self::M, b: Self::M) -> Self::M {
        a & b
    }
    #[inline(always)]
    fn either(self, a: Self::M, b: Self::M) -> Self::M {
        a | b
    }
    #[inline(always)]
    fn not(self, a: Self::M) -> Self::M {
        !a
    }
    #[inline(always)]
    fn all(self, mask: Self::M) -> bool {
        mask.all_true()
    }
    #[inline(always)]
    fn any(self, mask: Self::M) -> bool {
        mask.any_true()
    }
    #[inline(always)]
    fn bitmask(self, mask: Self::M) -> u32 {
        mask.to_bitmask() as u32
    }
    #[inline(always)]
    fn turned<const BY: usize>(self, x: Self::F) -> Self::F {
        x.slide_within_blocks::<BY>(x)
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
        (f32x4::from_slice(self.simd, left) * r + f32x4::from_slice(self.simd, right) * t).into()
    }
    #[inline(always)]
    fn blended8(self, [left, right]: [&[f32; 8]; 2], [r, t]: [f32; 2]) -> [f32; 8] {
        (f32x8::from_slice(self.simd, left) * r + f32x8::from_slice(self.simd, right) * t).into()
    }
    #[inline(always)]
    fn cell(self, x: Self::F) -> (Self::U, Self::F) {
        if self.rounds() {
            let floor = x.floor();
            return (self.integer(floor), x - floor);
        }
        // Both differences are exact, except if the second is near 1. The sum with 0 removes the
        // sign of 0.
        let (truncated, nearest, above) = self.truncated_above(x);
        let cell = truncated + self.select_word(above, self.word(u32::MAX), self.word(0));
        (cell, (x - nearest) + self.select(above, self.float(1.0), self.float(0.0)))
    }
    #[inline(always)]
    fn looked_up(self, table: &[f32; MAX_LANES], index: Self::U) -> Option<Self::F> {
        looked_up(self.simd, table, index)
    }
    #[inline(always)]
    fn exchanged(self, mask: Self::M, a: Self::F, b: Self::F) -> [Self::F; 2] {
        if self.rounds() {
            return [self.select(mask, b, a), self.select(mask, a, b)];
        }
        // Levels with a rounding instruction also have a select instruction. Otherwise swap the
        // bits that differ.
        let (first, second) = (self.bits(a), self.bits(b));
        let differing = self.select_word(mask, first ^ second, self.word(0));
        [first, second].map(|bits| self.float_of_bits(bits ^ differing))
    }
}

impl<S: Simd, K: Keys<S::u32s>> Registers<S, K> {
    /// Whether the level has a rounding instruction; otherwise a library would be called for every
    /// lane.
    #[inline(always)]
    fn rounds(self) -> bool {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        return !matches!(self.simd.level(), fearless_simd::Level::Sse2(_));
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        true
    }

    /// x truncated, as the bits of an `i32` and as a float, and whether the truncated number is
    /// above x, for |x| < 2³¹.
    #[inline(always)]
    fn truncated_above(
        self,
        x: <Self as Arithmetic>::F,
    ) -> (<Self as Arithmetic>::U, <Self as Arithmetic>::F, <Self as Arithmetic>::M) {
        let truncated = self.integer(x);
        let nearest = self.real(truncated);
        (truncated, nearest, self.less(x, nearest))
    }
}

/// Registers one after another.
#[inline(always)]
fn loaded<S: Simd, K: Copy, const N: usize>(lanes: Registers<S, K>, floats: &[f32]) -> [S::f32s; N] {
    let mut registers = [lanes.float(0.0); N];
    for (register, floats) in registers.iter_mut().zip(floats.chunks_exact(S::f32s::LEN)) {
        *register = S::f32s::from_slice(lanes.simd, floats);
    }
    registers
}

/// The fields of records of four, given in memory order.
#[inline(always)]
fn fields_of_four<S: Simd>([a, b, c, d]: [S::f32s; 4]) -> [S::f32s; 4] {
    let ((even, odd), (next_even, next_odd)) = (a.deinterleave(b), c.deinterleave(d));
    let ((x0, x2), (x1, x3)) = (even.deinterleave(next_even), odd.deinterleave(next_odd));
    [x0, x1, x2, x3]
}
