//! The lanes of a SIMD register, at every level that `fearless_simd` knows.

use fearless_simd::{Bytes, Select, Simd, SimdBase, SimdFloat, SimdInt, SimdMask};

use crate::{
    lanes::lanes::{LANES, Lanes, sealed::Sealed},
    lanes::look_up::looked_up,
};

/// The lanes of a register of the SIMD level, and the keys that they draw words with.
#[derive(Clone, Copy)]
pub(crate) struct Wide<S, K = Common>(pub(crate) S, pub(crate) K);

/// The keys of a register's lanes.
pub(crate) trait Keys<S: Simd>: Copy {
    fn keys(self, simd: S, common: impl FnOnce() -> u32) -> S::u32s;
}

/// One key for all lanes, that of a seed.
#[derive(Clone, Copy)]
pub(crate) struct Common;

/// A key for each lane.
#[derive(Clone, Copy)]
pub(crate) struct Own<U>(U);

impl<S: Simd> Keys<S> for Common {
    #[inline(always)]
    fn keys(self, simd: S, common: impl FnOnce() -> u32) -> S::u32s {
        S::u32s::splat(simd, common())
    }
}

impl<S: Simd> Keys<S> for Own<S::u32s> {
    #[inline(always)]
    fn keys(self, _: S, _: impl FnOnce() -> u32) -> S::u32s {
        self.0
    }
}

impl<S: Simd, K: Keys<S>> Sealed for Wide<S, K> {}

impl<S: Simd, Y: Keys<S>> Lanes for Wide<S, Y> {
    const LEN: usize = S::f32s::LEN;
    const TABLES: bool = false;
    type F = S::f32s;
    type U = S::u32s;
    type M = S::mask32s;
    type Keyed = Wide<S, Own<S::u32s>>;

    #[inline(always)]
    fn float(self, x: f32) -> Self::F {
        S::f32s::splat(self.0, x)
    }
    #[inline(always)]
    fn word(self, x: u32) -> Self::U {
        S::u32s::splat(self.0, x)
    }
    #[inline(always)]
    fn floats(self, f: impl FnMut(usize) -> f32) -> Self::F {
        S::f32s::from_fn(self.0, f)
    }
    #[inline(always)]
    fn pairs(self, mut f: impl FnMut(usize) -> [f32; 2]) -> [Self::F; 2] {
        // As one number of 64 bits two neighbours are loaded at once.
        let mut pair = |lane| {
            let [first, second] = f(lane).map(|x| u64::from(x.to_bits()));
            f64::from_bits(first | second << 32)
        };
        let low: Self::F = S::f64s::from_fn(self.0, &mut pair).bitcast();
        let high: Self::F = S::f64s::from_fn(self.0, |lane| pair(Self::LEN / 2 + lane)).bitcast();
        [low.unzip_low(high), low.unzip_high(high)]
    }
    #[inline(always)]
    fn words(self, f: impl FnMut(usize) -> u32) -> Self::U {
        S::u32s::from_fn(self.0, f)
    }
    #[inline(always)]
    fn iota(self) -> Self::U {
        let numbers = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
        S::u32s::from_slice(self.0, &numbers[..Self::LEN])
    }
    #[inline(always)]
    fn load(self, slice: &[f32]) -> Self::F {
        match slice.get(..Self::LEN) {
            Some(slice) => S::f32s::from_slice(self.0, slice),
            None => self.float(0.0),
        }
    }
    #[inline(always)]
    fn keyed(self, keys: Self::U) -> Self::Keyed {
        Wide(self.0, Own(keys))
    }
    #[inline(always)]
    fn keys(self, common: impl FnOnce() -> u32) -> Self::U {
        self.1.keys(self.0, common)
    }
    #[inline(always)]
    fn load_words(self, slice: &[u32]) -> Self::U {
        match slice.get(..Self::LEN) {
            Some(slice) => S::u32s::from_slice(self.0, slice),
            None => self.word(0),
        }
    }
    #[inline(always)]
    fn store(self, x: Self::F, slice: &mut [f32]) {
        if let Some(slice) = slice.get_mut(..Self::LEN) {
            x.store_slice(slice);
        } else {
            for (to, from) in slice.iter_mut().zip(x.as_slice()) {
                *to = *from;
            }
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
    fn shl<const N: u32>(self, x: Self::U) -> Self::U {
        x << N
    }
    #[inline(always)]
    fn shr<const N: u32>(self, x: Self::U) -> Self::U {
        x >> N
    }
    #[inline(always)]
    fn floor(self, x: Self::F) -> Self::F {
        if self.rounds() {
            x.floor()
        } else {
            let (_, nearest, above) = self.truncated(x);
            nearest - self.select(above, self.float(1.0), self.float(0.0))
        }
    }
    #[inline(always)]
    fn cell(self, x: Self::F) -> (Self::U, Self::F) {
        if self.rounds() {
            let floor = x.floor();
            return (self.integer(floor), x - floor);
        }
        // Both differences are exact but where the second is near 1, and the sum with 0 has no sign of its own.
        let (truncated, nearest, above) = self.truncated(x);
        let cell = truncated + self.select_word(above, self.word(u32::MAX), self.word(0));
        (cell, (x - nearest) + self.select(above, self.float(1.0), self.float(0.0)))
    }
    #[inline(always)]
    fn even_products(self, a: Self::U, b: Self::U) -> Self::U {
        if self.rounds() {
            return a * b;
        }
        // What has no instruction that multiplies words has one that multiplies the lower half of numbers of 64 bits.
        let low = |x: Self::U| x.bitcast::<S::u64s>() & S::u64s::splat(self.0, 0xffff_ffff);
        (low(a) * low(b)).bitcast()
    }
    #[inline(always)]
    fn integer(self, x: Self::F) -> Self::U {
        x.to_int::<S::i32s>().bitcast()
    }
    #[inline(always)]
    fn real(self, x: Self::U) -> Self::F {
        x.bitcast::<S::i32s>().to_float()
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
    fn abs(self, x: Self::F) -> Self::F {
        x.abs()
    }
    #[inline(always)]
    fn sqrt(self, x: Self::F) -> Self::F {
        x.sqrt()
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
    fn less(self, a: Self::F, b: Self::F) -> Self::M {
        a.simd_lt(b)
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
    fn select(self, mask: Self::M, yes: Self::F, no: Self::F) -> Self::F {
        mask.select(yes, no)
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
    fn lanes(self, mask: Self::M) -> u32 {
        mask.to_bitmask() as u32
    }
    #[inline(always)]
    fn exchanged(self, mask: Self::M, a: Self::F, b: Self::F) -> [Self::F; 2] {
        if self.rounds() {
            return [self.select(mask, b, a), self.select(mask, a, b)];
        }
        // What rounds has an instruction that selects too. Without one the bits that differ change places.
        let (first, second) = (self.bits(a), self.bits(b));
        let differing = self.select_word(mask, first ^ second, self.word(0));
        [first, second].map(|bits| self.float_of_bits(bits ^ differing))
    }
    #[inline(always)]
    fn looked_up(self, table: &[f32; LANES], index: Self::U) -> Option<Self::F> {
        looked_up(self.0, table, index)
    }
    #[inline(always)]
    fn turned<const K: usize>(self, x: Self::F) -> Self::F {
        x.slide_within_blocks::<K>(x)
    }
}

impl<S: Simd, K: Keys<S>> Wide<S, K> {
    /// Whether the level has an instruction that rounds; without one a library would be called for every lane.
    #[inline(always)]
    fn rounds(self) -> bool {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        return !matches!(self.0.level(), fearless_simd::Level::Sse2(_));
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        true
    }

    /// x truncated, as the bits of an `i32` and as a float, and whether that is above x, for |x| < 2³¹.
    #[inline(always)]
    fn truncated(
        self,
        x: <Self as Lanes>::F,
    ) -> (<Self as Lanes>::U, <Self as Lanes>::F, <Self as Lanes>::M) {
        let truncated = self.integer(x);
        let nearest = self.real(truncated);
        (truncated, nearest, self.less(x, nearest))
    }
}

/// Four lanes of the level that the program is built for, which a single call may use.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
#[inline(always)]
pub(crate) fn four() -> Option<Wide<fearless_simd::x86::Sse2>> {
    fearless_simd::Level::baseline().as_sse2().map(|simd| Wide(simd, Common))
}

/// Four lanes of the level that the program is built for, which a single call may use.
#[cfg(target_arch = "aarch64")]
#[inline(always)]
pub(crate) fn four() -> Option<Wide<fearless_simd::aarch64::Neon>> {
    fearless_simd::Level::baseline().as_neon().map(|simd| Wide(simd, Common))
}

/// Four lanes of the level that the program is built for, which a single call may use.
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
#[inline(always)]
pub(crate) fn four() -> Option<Wide<fearless_simd::wasm32::WasmSimd128>> {
    fearless_simd::Level::baseline().as_wasm_simd128().map(|simd| Wide(simd, Common))
}

/// Four lanes of the level that the program is built for; there are none.
#[cfg(not(any(
    target_arch = "x86",
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
)))]
#[inline(always)]
pub(crate) fn four() -> Option<crate::lanes::lanes::Scalar> {
    None
}
