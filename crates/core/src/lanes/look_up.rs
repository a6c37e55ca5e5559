//! Lookups in short tables, in all lanes at once if the level has an instruction for it.

use fearless_simd::Simd;

use crate::lanes::lanes::MAX_LANES;

#[cfg(target_arch = "x86")]
use core::arch::x86 as arch;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64 as arch;

/// The entries of a table of eight, stored twice, at indices below 8; `None` at a level without a
/// lookup instruction.
#[inline(always)]
pub(super) fn looked_up<S: Simd>(simd: S, table: &[f32; MAX_LANES], index: S::u32s) -> Option<S::f32s> {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        use fearless_simd::{Level, SimdBase, f32x8, f32x16, u32x8, u32x16};
        match simd.level() {
            Level::Avx2(avx2) => {
                let index = u32x8::from_slice(avx2, index.as_slice());
                let found = among_8(avx2, f32x8::from_slice(avx2, &table[..8]), index);
                Some(S::f32s::from_slice(simd, found.as_slice()))
            }
            Level::Avx512(avx512) => {
                let index = u32x16::from_slice(avx512, index.as_slice());
                let found = among_16(avx512, f32x16::from_slice(avx512, table), index);
                Some(S::f32s::from_slice(simd, found.as_slice()))
            }
            _ => None,
        }
    }
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    {
        let _ = (simd, table, index);
        None
    }
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
fearless_simd::kernel!(
    #[inline(always)]
    fn among_8(
        avx2: Avx2,
        table: fearless_simd::f32x8<fearless_simd::Avx2>,
        index: fearless_simd::u32x8<fearless_simd::Avx2>,
    ) -> fearless_simd::f32x8<fearless_simd::Avx2> {
        fearless_simd::SimdInto::simd_into(arch::_mm256_permutevar8x32_ps(table.into(), index.into()), avx2)
    }
);

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
fearless_simd::kernel!(
    #[inline(always)]
    fn among_16(
        avx512: Avx512,
        table: fearless_simd::f32x16<fearless_simd::Avx512>,
        index: fearless_simd::u32x16<fearless_simd::Avx512>,
    ) -> fearless_simd::f32x16<fearless_simd::Avx512> {
        fearless_simd::SimdInto::simd_into(arch::_mm512_permutexvar_ps(index.into(), table.into()), avx512)
    }
);
