//! Value noise: random numbers at lattice points, interpolated in two ways.

use crate::{
    contract::kernel::{Kernel, Sealed},
    contract::noise::{kind, noise},
    kinds::catmull_rom::{SplineNoise, spline_rows, spline_samples, spline_values},
    kinds::cell::corner::{CellNoise, Corner},
    lanes::lanes::{LaneSample, Lanes},
    lattice::fade::Fade,
    lattice::integer_hash::IntegerHash,
    lattice::lattice::Lattice,
    lattice::variates::uniform,
    row::row::Row,
    statistics::absolute_moments,
    statistics::statistics::Statistics,
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
/// - **Range:** [−1, 1], since the weights are positive and sum to 1. v is short of 1 by 2e-6, which keeps rounding inside.
/// - **Flat** at every lattice point: there the gradient is 0 and |n| most spread, with variance 1/3.
///
/// Ebert (ed.) 1994, "Texturing and Modeling"; weights of Perlin 2002.
///
/// ```
/// use asperity_noise::{Field, Value, glam::Vec3};
///
/// let sample = Value::new(2).sample(Vec3::new(4.0, -1.0, 7.0));
/// assert!(sample.value.abs() <= 1.0);
/// assert_eq!(sample.gradient, Vec3::ZERO);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Value<L = IntegerHash> {
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
/// - **Range:** [−1, 1]. The spline overshoots: Σ |s| = 1 + t − t² ≤ 5/4, so max |Σ| = (5/4)ⁿ, attained in cell centres;
///   the noise is divided by it.
///
/// Ebert (ed.) 1994, "Texturing and Modeling", `vnoise`, which does not divide; [`Vnoise`](crate::printed::Vnoise) is that.
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

kind!(Value);
noise!(Value, curved);

kind!(ValueCatmullRom);
noise!(ValueCatmullRom);

/// Keeps rounding from crossing 1.
const MARGIN: f32 = 1.0 - 2e-6;
/// (4/5)ⁿ.
const SCALE_CATMULL_ROM: [f32; 4] = [MARGIN * 0.8, MARGIN * 0.64, MARGIN * 0.512, MARGIN * 0.4096];

impl<L: Lattice, const N: usize> CellNoise<N> for Value<L> {
    type Lattice = L;
    const HAS_VALUE: bool = true;
    const HAS_GRADIENT: bool = false;
    const FADE: Fade = Fade::Quintic;

    #[inline(always)]
    fn lattice(&self) -> &L {
        &self.lattice
    }

    #[inline(always)]
    fn seed(&self) -> u32 {
        self.seed
    }

    #[inline(always)]
    fn corner<S: Lanes>(&self, s: S, word: S::U) -> Corner<S, N> {
        Corner { value: uniform(s, word) * s.float(MARGIN), gradient: [s.float(0.0); N] }
    }

    fn statistics(&self) -> &'static Statistics {
        &tables::VALUE[N - 1]
    }

    fn absolute_moments(&self) -> [f32; 4] {
        absolute_moments::VALUE[N - 1]
    }
}

impl<L: Lattice, const N: usize> SplineNoise<N> for ValueCatmullRom<L> {
    type Lattice = L;

    #[inline(always)]
    fn lattice(&self) -> &L {
        &self.lattice
    }

    #[inline(always)]
    fn number<S: Lanes>(&self, s: S, word: S::U) -> S::F {
        uniform(s, word) * s.float(SCALE_CATMULL_ROM[N - 1])
    }
}

impl<L: Lattice, const N: usize> Sealed<N> for ValueCatmullRom<L> {}

impl<L: Lattice, const N: usize> Kernel<N> for ValueCatmullRom<L> {
    type RowScratch = ();

    #[inline(always)]
    fn seed(&self) -> u32 {
        self.seed
    }

    #[inline(always)]
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N], seed: u32) -> S::F {
        spline_values(s, self, p, seed)
    }

    #[inline(always)]
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        spline_samples(s, self, p, seed)
    }

    #[inline(always)]
    fn rows<S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        row: &Row<N>,
        seed: u32,
        _scratch: &mut (),
        values: &mut [f32],
        gradients: Option<&mut [&mut [f32]; N]>,
    ) {
        spline_rows::<Self, S, N, GRADIENTS>(s, self, row, seed, values, gradients);
    }

    fn statistics(&self) -> &'static Statistics {
        &tables::VALUE_CATMULL_ROM[N - 1]
    }

    fn absolute_moments(&self) -> [f32; 4] {
        absolute_moments::VALUE_CATMULL_ROM[N - 1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{contract::field::Field, lanes::lanes::Scalar};
    use approx::{abs_diff_eq, assert_abs_diff_eq};
    use glam::{Vec2, Vec3, Vec4};

    #[test]
    fn both_meet_the_numbers_at_lattice_points() {
        let number = |cell: [i32; 3]| uniform(Scalar, Scalar.word(IntegerHash.word(cell, 7)));
        for i in -20..20_i16 {
            let (x, y, z) = (i, 3 * i - 5, -i);
            let p = Vec3::new(f32::from(x), f32::from(y), f32::from(z));
            let expected = number([x.into(), y.into(), z.into()]);
            assert_eq!(Value::new(7).value(p), expected * MARGIN);
            assert_abs_diff_eq!(ValueCatmullRom::new(7).value(p), 0.512 * expected, epsilon = 2e-6);
        }
    }

    /// A lattice whose words alternate as the spline's weights do, so that all parts of the sum have one sign.
    struct Alternating;

    impl Lattice for Alternating {
        fn word<const N: usize>(&self, cell: [i32; N], _: u32) -> u32 {
            let outer = cell.iter().filter(|c| **c < 0 || **c > 1).count();
            if outer % 2 == 0 { u32::MAX } else { 0 }
        }
    }

    #[test]
    fn the_bound_is_attained_in_the_centre() {
        let noise = ValueCatmullRom::default().with_lattice(Alternating);
        let values = [
            noise.value(0.5),
            noise.value(Vec2::splat(0.5)),
            noise.value(Vec3::splat(0.5)),
            noise.value(Vec4::splat(0.5)),
        ];
        assert!(values.iter().all(|&value| value <= 1.0 && value > 1.0 - 4e-6), "{values:?}");
        for i in 0..=100_u8 {
            let p = Vec2::new(f32::from(i) / 100.0, f32::from(i % 11) / 11.0);
            assert!(noise.value(p) <= values[1]);
        }
    }

    #[test]
    fn gradients_are_differences() {
        let h = 1.0 / 256.0;
        for i in 0..200_i16 {
            let p = Vec4::new(0.37 * f32::from(i), 11.3 - 0.61 * f32::from(i), 0.23, -0.83 * f32::from(i));
            let close = |noise: &dyn Fn(Vec4) -> (f32, Vec4)| {
                let (_, gradient) = noise(p);
                for axis in 0..4 {
                    let step = h * Vec4::AXES[axis];
                    let difference = (noise(p + step).0 - noise(p - step).0) / (2.0 * h);
                    // The error is h² max |n‴|/6 and 2⁻²⁴/h; the spline's second derivative leaps at borders, by h/2 of which it errs.
                    assert!(
                        abs_diff_eq!(gradient[axis], difference, epsilon = 0.012),
                        "{p}, axis {axis}: {difference}"
                    );
                }
            };
            let pair = |sample: crate::Sample<Vec4>| (sample.value, sample.gradient);
            close(&|p| pair(Value::new(1).sample(p)));
            close(&|p| pair(ValueCatmullRom::new(1).sample(p)));
        }
    }
}
