//! White noise: one random number per cell.

use crate::{
    contract::kernel::{Kernel, Sealed},
    contract::noise::{kind, noise},
    lanes::lanes::{LaneSample, Lanes},
    lattice::integer_hash::IntegerHash,
    lattice::lattice::{Lattice, cell},
    lattice::variates::uniform,
    statistics::statistics::Statistics,
    statistics::tables,
};

/// A number per cell of the lattice, uniform in (−1, 1) and independent of all other cells'; leaps at the borders.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/white.md"))]
///
/// ```text
/// n(p) = 2 word(⌊p⌋)/2³² − 1
/// ```
///
/// In 1 to 4 dimensions. The gradient is 0, as it is inside every cell.
///
/// - **Range:** (−1, 1), multiples of 2⁻²³ off by half a step; variance 1/3 at every point.
///
/// Ebert (ed.) 1994, "Texturing and Modeling".
///
/// ```
/// use asperity_noise::{Field, White, glam::Vec2};
///
/// let noise = White::new(3);
/// assert_eq!(noise.sample(Vec2::new(0.1, -0.1)), noise.sample(Vec2::new(0.9, -0.9)));
/// assert_ne!(noise.value(Vec2::new(0.1, 0.1)), noise.value(Vec2::new(0.1, -0.1)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct White<L = IntegerHash> {
    seed: u32,
    lattice: L,
}

kind!(White);
noise!(White);

impl<L: Lattice, const N: usize> Sealed<N> for White<L> {}

impl<L: Lattice, const N: usize> Kernel<N> for White<L> {
    type RowScratch = ();

    #[inline(always)]
    fn seed(&self) -> u32 {
        self.seed
    }

    #[inline(always)]
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N], seed: u32) -> S::F {
        let mut terms = [s.word(0); N];
        for axis in 0..N {
            let (cell, _) = cell(s, p[axis]);
            terms[axis] = self.lattice.term(s, axis, cell);
        }
        uniform(s, self.lattice.words(s, terms, seed))
    }

    #[inline(always)]
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        (self.lane_values(s, p, seed), [s.float(0.0); N])
    }

    fn statistics(&self) -> &'static Statistics {
        &tables::WHITE[N - 1]
    }

    /// Moments of the uniform distribution, 1/(k + 1).
    fn absolute_moments(&self) -> [f32; 4] {
        [0.5, 1.0 / 3.0, 0.25, 0.2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::field::Field;
    use approx::assert_abs_diff_eq;
    use glam::{Vec3, Vec4};

    #[test]
    fn a_cell_has_one_value() {
        let noise = White::default();
        for i in 0..50_i16 {
            let corner = Vec3::new(f32::from(i) - 25.0, 3.0 - f32::from(i), f32::from(i % 7));
            let value = noise.with_seed(1).value(corner);
            assert_abs_diff_eq!(value, 0.0, epsilon = 1.0);
            assert_eq!(value, noise.with_seed(1).value(corner + Vec3::new(0.99, 0.01, 0.5)));
            assert_ne!(value, noise.with_seed(1).value(corner + Vec3::X));
            assert_ne!(value, noise.with_seed(2).value(corner));
            assert_eq!(noise.with_seed(1).sample(corner).gradient, Vec3::ZERO);
        }
    }

    #[test]
    fn values_are_uniform() {
        let noise = White::default();
        let mut bins = [0_u16; 16];
        for i in 0..4096_u16 {
            let p = Vec4::new(f32::from(i & 15), f32::from(i >> 4 & 15), f32::from(i >> 8), -3.0);
            bins[((noise.with_seed(5).value(p) + 1.0) * 8.0) as usize] += 1;
        }
        let chi_square: f32 =
            bins.iter().map(|&n| (f32::from(n) - 256.0) * (f32::from(n) - 256.0) / 256.0).sum();
        // The quantile 0.999 of χ² with 15 degrees of freedom.
        assert!(chi_square < 37.7, "{bins:?}: {chi_square}");
    }

    #[test]
    fn far_points_and_points_that_are_none_are_defined() {
        let noise = White::default();
        assert_eq!(noise.with_seed(1).value(Vec3::new(f32::NAN, 0.0, 0.0)), 0.0);
        assert_eq!(noise.with_seed(1).value(f32::NEG_INFINITY), 0.0);
        assert_eq!(
            noise.with_seed(1).value(4_294_967_296.0_f32 + 1024.0),
            noise.with_seed(1).value(1024.0_f32)
        );
    }
}
