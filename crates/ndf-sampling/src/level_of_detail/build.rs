//! Construction of textures of half vectors from NDFs, and their accuracy.

use glam::{Vec2, Vec3};

use crate::coordinates::GaussianSplit;
use crate::error::{NdfError, square};
use crate::level_of_detail::table::ConditionalTable;
use crate::ndf::Ndf;
use crate::normal_table::chart::Chart;
use crate::numeric::normal_distribution::inverse_gaussian_cdf;
use asperity_core::math;

/// Accuracy of a [`ConditionalTable`], over 64 × 64 quantiles of the NDF.
///
/// At the fraction `s` an error of the coordinates shifts the lobe by `√s` times the error. The
/// width of the lobe is `√(1 − s)`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ConditionalAccuracy {
    /// `½ ∫ |D′ − D| cos θ dω` where the NDF has weight.
    pub variation: f32,
    /// The root mean square of `|T⁻¹′(h) − T⁻¹(h)|`, in standard deviations.
    pub coordinates: f32,
}

#[cfg(feature = "approx")]
asperity_core::impl_approx! { f32; ConditionalAccuracy: accuracy => accuracy.variation, accuracy.coordinates; }

/// Quantiles per side at which the accuracy is measured.
const QUANTILES: usize = 64;

/// Points per side at which `D` is averaged over a texel.
const POINTS: usize = 4;

/// `√(2 ln 2)`: half of the normals of an isotropic NDF are within this Gaussian coordinate.
const MEDIAN: f32 = 1.177_41;

/// The smallest stretch, the lower bound of the deviation of the narrowest NDFs.
const LEAST_STRETCH: f32 = 1e-6;

impl ConditionalTable {
    /// Creates the table of `ndf` with `size · size` entries.
    ///
    /// # Errors
    /// A `size` of 0 or above 4096.
    pub fn new<N: Ndf + ?Sized>(ndf: &N, size: usize) -> Result<Self, NdfError> {
        square(size, None)?;
        let stretch = deviation(ndf);
        let entry = |column: usize, row: usize| {
            let at = |x: f64, y: f64| entry_half_vector([column as f64 + x, row as f64 + y], size, stretch);
            let z = ndf.invert(at(0.5, 0.5));
            let mut sum = 0.0;
            for (k, l) in (0..POINTS).flat_map(|k| (0..POINTS).map(move |l| (k, l))) {
                let place = |k: usize| (k as f64 + 0.5) / POINTS as f64;
                sum += f64::from(ndf.d(at(place(k), place(l))));
            }
            let mean = sum / (POINTS * POINTS) as f64;
            [z.x, z.y, math::sqrt_f64(math::sqrt_f64(mean)) as f32]
        };
        let entries =
            (0..size).flat_map(|row| (0..size).map(move |column| (column, row))).map(|(c, r)| entry(c, r));
        Ok(Self { size, stretch, entries: entries.collect() })
    }

    /// Accuracy of the lookup compared with `ndf`; see [`ConditionalAccuracy`].
    #[must_use]
    pub fn accuracy<N: Ndf + ?Sized>(&self, ndf: &N) -> ConditionalAccuracy {
        let quantile = |k: usize| inverse_gaussian_cdf((k as f64 + 0.5) / QUANTILES as f64) as f32;
        let (mut ratios, mut squares, mut weight) = (0.0, 0.0, 0.0);
        for (k, l) in (0..QUANTILES).flat_map(|k| (0..QUANTILES).map(move |l| (k, l))) {
            let h = ndf.warp_gaussian(Vec2::new(quantile(k), quantile(l)));
            let exact = f64::from(ndf.d(h));
            // Rounding of a normal at a border may leave the support of the NDF.
            if exact > 0.0 {
                let got = f64::from(self.residual_ndf(h, GaussianSplit::new(Vec2::ZERO, 0.0)));
                let z = self.invert(h) - ndf.invert(h);
                ratios += 0.5 * (got / exact - 1.0).abs();
                squares += f64::from(z.x * z.x + z.y * z.y);
                weight += 1.0;
            }
        }
        let mean = |sum: f64| if weight > 0.0 { sum / weight } else { 0.0 };
        ConditionalAccuracy {
            variation: mean(ratios) as f32,
            coordinates: math::sqrt_f64(mean(squares)) as f32,
        }
    }
}

/// The slopes along x and y that half of the normals do not exceed.
///
/// At most 1, where the map needs no stretching.
fn deviation<N: Ndf + ?Sized>(ndf: &N) -> Vec2 {
    let slope = |z: Vec2| Chart::Slopes.to_point(ndf.warp_gaussian(z));
    let x = slope(Vec2::new(MEDIAN, 0.0)).x - slope(Vec2::new(-MEDIAN, 0.0)).x;
    let y = slope(Vec2::new(0.0, MEDIAN)).y - slope(Vec2::new(0.0, -MEDIAN)).y;
    let bounded = |c: f32| (0.5 * c.abs()).clamp(LEAST_STRETCH, 1.0);
    Vec2::new(bounded(x), bounded(y))
}

/// The half vector at a position in texels; beyond the rim the one on it, above the horizon.
fn entry_half_vector([column, row]: [f64; 2], size: usize, stretch: Vec2) -> Vec3 {
    let [x, y] = [column, row].map(|k| 2.0 * k / size as f64 - 1.0);
    let r = math::sqrt_f64(x * x + y * y);
    // A quarter of a texel inside the rim, because at the horizon densities may be 0 or infinite.
    let rim = 1.0 - 0.5 / size as f64;
    let inside = if r > rim { rim / r } else { 1.0 };
    let (x, y) = (x * inside, y * inside);
    let r2 = x * x + y * y;
    let (x, y) = (2.0 * x * f64::from(stretch.x), 2.0 * y * f64::from(stretch.y));
    let up = 1.0 - r2;
    let length = math::sqrt_f64(x * x + y * y + up * up);
    Vec3::new((x / length) as f32, (y / length) as f32, (up / length) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Beckmann, Ggx};
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn stretch_is_the_roughness_of_ggx() {
        let stretch = ConditionalTable::new(&Ggx::new(0.003, 0.5).unwrap(), 2).unwrap().stretch;
        assert_abs_diff_eq!(stretch.x / 0.003, 1.0, epsilon = 1e-5);
        assert_abs_diff_eq!(stretch.y / 0.5, 1.0, epsilon = 1e-5);
        // Slopes of Beckmann are closer together: √ln 2 of the roughness.
        let stretch = ConditionalTable::new(&Beckmann::isotropic(0.3).unwrap(), 2).unwrap().stretch;
        assert_abs_diff_eq!(stretch.x / 0.249_77, 1.0, epsilon = 1e-4);
    }

    #[test]
    fn table_of_one_entry_is_constant() {
        let ggx = Ggx::isotropic(0.5).unwrap();
        let table = ConditionalTable::new(&ggx, 1).unwrap();
        let split = GaussianSplit::new(Vec2::new(0.3, -0.4), 0.0);
        assert_eq!(table.residual_ndf(Vec3::Z, split), table.residual_ndf(Vec3::new(0.6, 0.0, 0.8), split));
    }

    #[test]
    fn accuracy_is_quadratic_in_the_size() {
        let beckmann = Beckmann::new(0.01, 0.4).unwrap();
        let [coarse, fine] =
            [64, 128].map(|size| ConditionalTable::new(&beckmann, size).unwrap().accuracy(&beckmann));
        assert!(coarse.variation < 3e-3 && coarse.coordinates < 4e-3, "{coarse:?}");
        for ratio in [coarse.variation / fine.variation, coarse.coordinates / fine.coordinates] {
            assert_abs_diff_eq!(ratio / 4.0, 1.0, epsilon = 0.1, "{coarse:?} {fine:?}");
        }
    }
}
