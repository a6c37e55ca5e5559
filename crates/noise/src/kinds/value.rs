//! Value noise: random numbers at lattice points, interpolated by quintic weights or by splines.

use crate::{
    contract::compiled::on_lattice,
    contract::kernel::Kernel,
    contract::noise::{kind, measured, noise, tiles},
    kinds::catmull_rom::{LONG_STEP, SplineNoise, spline, spline_rows},
    kinds::cell::corner::{CellNoise, Corner},
    lanes::{LaneSample, Lanes},
    lattice::integer_hash::IntegerHash,
    lattice::lattice::Lattice,
    lattice::variates::{MARGIN, uniform},
    row::row::Strip,
    statistics::tables,
};

/// Value noise between the 2ⁿ corners of a cell, with quintic weights; C².
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/value.md"))]
///
/// ```text
/// n(p) = Σ_c W_c(p) v_c,   W = Π w or 1 − w,   w(t) = 6t⁵ − 15t⁴ + 10t³
/// ```
///
/// In 1 to 4 dimensions, v uniform in (−1, 1).
///
/// - **Range:** [−1, 1], since the weights are positive and sum to 1. Next to the upper border of a
///   cell a rounded weight exceeds 1 by up to 1.1e-6, so the value is clamped.
/// - **Lattice points:** the gradient is 0 at every lattice point, and the variance of n is
///   largest there, 1/3.
///
/// Ebert (ed.) 1994, "Texturing and Modeling"; weights of Perlin 2002.
///
/// ```
/// use asperity_noise::{Field, ValueNoise, glam::Vec3};
///
/// let sample = ValueNoise::new(2).sample(Vec3::new(4.0, -1.0, 7.0));
/// assert!(sample.value.abs() <= 1.0);
/// assert_eq!(sample.gradient, Vec3::ZERO);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ValueNoise<L = IntegerHash> {
    seed: u32,
    lattice: L,
}

/// Value noise through the 4ⁿ lattice points around a point, by Catmull–Rom splines; C¹.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/value_catmull_rom.md"))]
///
/// ```text
/// n(p) = (4/5)ⁿ Σ_k Π_i s_{kᵢ}(tᵢ) v_k,   k ∈ {−1, 0, 1, 2}ⁿ
/// s₋₁ = (−t + 2t² − t³)/2,   s₀ = (2 − 5t² + 3t³)/2,   s₁ = (t + 4t² − 3t³)/2,   s₂ = (t³ − t²)/2
/// ```
///
/// In 1 to 4 dimensions, v uniform in (−1, 1).
///
/// - **Range:** [−1, 1]. The spline overshoots: Σ |s| = 1 + t − t² ≤ 5/4, so max |Σ| = (5/4)ⁿ,
///   attained in cell centers. The noise is divided by it.
///
/// Ebert (ed.) 1994, "Texturing and Modeling", `vnoise`. The original does not divide, see
/// [`Vnoise`](crate::ebert_1994::Vnoise).
///
/// ```
/// use asperity_noise::{Field, ValueCatmullRom, glam::Vec2};
///
/// let noise = ValueCatmullRom::new(1);
/// let (before, after) = (noise.sample(Vec2::new(2.9999, 0.5)), noise.sample(Vec2::new(3.0001, 0.5)));
/// assert!((before.gradient - after.gradient).length() < 1e-2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ValueCatmullRom<L = IntegerHash> {
    seed: u32,
    lattice: L,
}

kind!(ValueNoise);
measured!(ValueNoise, |self| &tables::VALUE);
noise!(ValueNoise, curved);
tiles!(ValueNoise);

kind!(ValueCatmullRom);
measured!(ValueCatmullRom, |self| &tables::VALUE_CATMULL_ROM);
noise!(ValueCatmullRom);
tiles!(ValueCatmullRom);

/// (4/5)ⁿ.
const SCALE_CATMULL_ROM: [f32; 4] = [MARGIN * 0.8, MARGIN * 0.64, MARGIN * 0.512, MARGIN * 0.4096];

impl<L: Lattice, const N: usize> CellNoise<N> for ValueNoise<L> {
    type Standard = ValueNoise;

    #[inline(always)]
    fn standard(&self) -> ValueNoise {
        Self::standard(self)
    }

    const UPPER_BITS: bool = true;
    const CLAMPED: bool = true;
    const HAS_GRADIENT: bool = false;
    const UNIT: f32 = MARGIN / 2_147_483_648.0;

    #[inline(always)]
    fn corner<S: Lanes>(&self, s: S, word: S::U) -> Corner<S, N> {
        Corner { value: s.real(word), gradient: [s.float(0.0); N] }
    }
}

impl<L: Lattice, const N: usize> SplineNoise<N> for ValueCatmullRom<L> {
    #[inline(always)]
    fn number<S: Lanes>(&self, s: S, word: S::U) -> S::F {
        uniform(s, word) * s.float(SCALE_CATMULL_ROM[N - 1])
    }
}

impl<L: Lattice, const N: usize> Kernel<N> for ValueCatmullRom<L> {
    const LONG_STEP: f32 = LONG_STEP;

    type RowScratch = ();

    on_lattice!();

    #[inline(always)]
    fn evaluate<S: Lanes, const GRADIENTS: bool>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        spline::<Self, S, N, GRADIENTS>(s, self, p, seed)
    }

    #[inline(always)]
    fn rows<S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        _: &mut (),
        strip: Strip<'_, N, GRADIENTS>,
    ) -> usize {
        spline_rows(s, self, strip)
    }
}
