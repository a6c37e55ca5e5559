//! The NDF of an existing normal map.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;

use crate::error::{NdfError, in_range};
use crate::map::b_spline::{area_inside, averaged_kernel, edge, first_texel};
use crate::map::packed::ndf_map::NdfMap;
use crate::map::reconstruction::Reconstruction;
use crate::map::texels::Measure;
use asperity_core::math;

/// Estimates the NDF of a normal map by counting its normals with a smooth kernel.
///
/// The counts are over (n_x, n_y), in the texels of an [`NdfMap`].
///
/// ```text
/// K(x) = B(x/h)/h,   B = the quadratic B-spline:   ¾ − t² for |t| < ½,   (3/2 − |t|)²/2 for ½ ≤ |t| < 3/2
/// D(texel) = (1/N) Σ_n K̄(n_x) K̄(n_y) / ∫_disk K̄ K̄,      K̄ = K averaged over the texel
/// ```
///
/// - **Kernel:** the product of two quadratic B-splines of width `h`, with support ±3h/2 and
///   standard deviation h/2, integrated exactly over each texel. Any `h` is possible, and `h = 0`
///   is a plain histogram. The variance of the estimate is the variance of the normals plus h²/4
///   along each axis.
/// - **At the rim** the part of the kernel inside the disk is scaled to 1, so each normal has
///   weight 1 and none is lost.
/// - **Normals** are per texel of the bump map, that is per unit of macro area, so the estimate is
///   `D` itself ([`Measure::ProjectedSolidAngle`]). Their `z` is not used. Normals outside the disk
///   and NaN are not counted.
///
/// ```
/// use asperity_ndf_sampling::{Ndf, NdfEstimator, glam::Vec3};
///
/// let mut estimator = NdfEstimator::new(64, 0.1)?;
/// for n in [Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8), Vec3::Z] {
///     estimator.add(n);
/// }
/// assert_eq!(estimator.count(), 3);
/// let ndf = estimator.finish()?;
/// // The peak of the kernel is (¾/h)², of which each normal has a third.
/// assert!(ndf.d(Vec3::new(0.6, 0.0, 0.8)) > 17.0);
/// assert_eq!(ndf.d(Vec3::new(0.0, 0.6, 0.8)), 0.0);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// With the size and width of [`NdfEstimator::suited`] three normal maps of 256² (rolling ground,
/// cobbles, tiles that are flat nearly everywhere), in floats and in 8 bits, were converted to
/// Gaussian coordinates and back. `T` returns the normals within 10⁻⁵ degrees. A
/// [`NormalLut`](crate::NormalLut) of 256² returns them within 0.001°, 0.015° and 0.002° on
/// average. (With the estimate constant on each texel the error of the table is ten times as
/// large.)
///
/// Kautz, Heidrich, Seidel 2001, section 7, estimate the distribution of an existing bump map by
/// its histogram. The kernel is the quadratic one of Parzen 1962, "On Estimation of a Probability
/// Density Function and Mode", of the spline family.
#[derive(Clone, Debug)]
pub struct NdfEstimator {
    size: usize,
    width: f64,
    /// The area inside the disk of each texel, row by row.
    areas: Vec<f32>,
    density: Vec<f64>,
    count: u64,
    /// The averaged kernel along x and y at the last normal, kept to reuse its memory.
    kernels: [Vec<f64>; 2],
}

impl NdfEstimator {
    /// Creates an estimator over `size · size` texels with kernels of width `h`, in units of n_x.
    ///
    /// # Errors
    /// A `size` of 0 or of more than [`NdfMap::MAX_TEXELS`] texels; a width that is negative, NaN
    /// or above 1.
    pub fn new(size: usize, width: f32) -> Result<Self, NdfError> {
        let texels = match size.checked_mul(size) {
            Some(texels) if (1..=NdfMap::MAX_TEXELS).contains(&texels) => texels,
            _ => {
                return Err(NdfError::Size {
                    parameter: "size",
                    value: size,
                    min: 1,
                    max: NdfMap::MAX_TEXELS.isqrt(),
                });
            }
        };
        in_range("width", width, [0.0, 1.0])?;
        Ok(Self::build(size, f64::from(width), texels))
    }

    fn build(size: usize, width: f64, texels: usize) -> Self {
        let edges = |k: usize| [edge(k, size), edge(k + 1, size)];
        let areas = (0..size)
            .flat_map(|j| (0..size).map(move |i| (i, j)))
            .map(|(i, j)| area_inside(edges(i), edges(j)) as f32)
            .collect();
        Self { size, width, areas, density: vec![0.0; texels], count: 0, kernels: [Vec::new(), Vec::new()] }
    }

    /// Creates an estimator with a size and width suited to these normals.
    ///
    /// ```text
    /// h = 2 σ N^{−1/6}, at least two steps of an 8-bit map (4/255);      size = 2ᵏ, 256 ≤ size ≤ 1024, texel ≤ h/3
    /// ```
    ///
    /// with `σ` the smaller of the standard deviations of n_x and n_y. This is the rate at which
    /// kernels in the plane narrow in Scott 1992, "Multivariate Density Estimation", eq. 6.41, with
    /// the standard deviation h/2 of this kernel. The standard deviation of an NDF increases by
    /// N^{−1/3}/2 relative, 1.2 % for a map of 256².
    #[must_use]
    pub fn suited(normals: &[Vec3]) -> Self {
        let mut sums = [0.0_f64; 5];
        for n in normals.iter().filter(|n| counts(**n)) {
            let (x, y) = (f64::from(n.x), f64::from(n.y));
            for (sum, term) in sums.iter_mut().zip([1.0, x, y, x * x, y * y]) {
                *sum += term;
            }
        }
        let [count, x, y, xx, yy] = sums;
        let count = count.max(1.0);
        let variance = (xx / count - (x / count) * (x / count)).min(yy / count - (y / count) * (y / count));
        let narrowing = math::exp_f64(-math::ln_f64(count) / 6.0);
        let width = (2.0 * math::sqrt_f64(variance.max(0.0)) * narrowing).max(STEPS);
        let size = [256, 512].into_iter().find(|&size| 2.0 / size as f64 <= width / 3.0).unwrap_or(1024);
        Self::build(size, width, size * size)
    }

    /// The number of texels along a side.
    #[inline]
    #[must_use]
    pub const fn size(&self) -> usize {
        self.size
    }

    /// The width `h` of the kernel.
    #[inline]
    #[must_use]
    pub const fn width(&self) -> f32 {
        self.width as f32
    }

    /// The number of counted normals.
    #[inline]
    #[must_use]
    pub const fn count(&self) -> u64 {
        self.count
    }

    /// Counts a normal; ignores NaN and normals outside the disk by more than rounding.
    pub fn add(&mut self, n: Vec3) {
        if !counts(n) {
            return;
        }
        let size = self.size;
        let [first, row] = [n.x, n.y].map(|c| first_texel(f64::from(c), self.width, size));
        let [along_x, along_y] = &mut self.kernels;
        averaged_kernel(f64::from(n.x), self.width, first, size, along_x);
        averaged_kernel(f64::from(n.y), self.width, row, size, along_y);
        let texels = || (row * size..).step_by(size).zip(&*along_y);
        let mut inside = 0.0;
        for (start, ky) in texels() {
            let areas = self.areas.get(start + first..).unwrap_or_default();
            inside += ky * along_x.iter().zip(areas).map(|(kx, &area)| kx * f64::from(area)).sum::<f64>();
        }
        // A point kernel in a texel that only touches the disk.
        if inside <= 0.0 {
            return;
        }
        for (start, ky) in texels() {
            let density = self.density.get_mut(start + first..).unwrap_or_default();
            for (kx, density) in along_x.iter().zip(density) {
                *density += kx * ky / inside;
            }
        }
        self.count += 1;
    }

    /// The current NDF as texels, for [`NdfMap::from_texels`] with
    /// [`Measure::ProjectedSolidAngle`].
    ///
    /// Texels outside the disk are 0.
    #[must_use]
    pub fn texels(&self) -> Vec<f32> {
        let scale = 1.0 / (self.count.max(1) as f64);
        let scaled = |(density, &area): (&f64, &f32)| if area > 0.0 { (density * scale) as f32 } else { 0.0 };
        self.density.iter().zip(&self.areas).map(scaled).collect()
    }

    /// Builds the NDF, bilinear between the texels and ready to be sampled.
    ///
    /// # Errors
    /// [`NdfError::NoWeight`] if no normal was counted.
    pub fn finish(self) -> Result<NdfMap, NdfError> {
        NdfMap::from_texels(
            self.size,
            self.size,
            &self.texels(),
            Measure::ProjectedSolidAngle,
            Reconstruction::Bilinear,
        )
        .map_err(|_| NdfError::NoWeight { parameter: "normals" })
    }
}

impl Extend<Vec3> for NdfEstimator {
    fn extend<I: IntoIterator<Item = Vec3>>(&mut self, normals: I) {
        for n in normals {
            self.add(n);
        }
    }
}

/// Estimates the NDF of these normals, with [`NdfEstimator::suited`].
///
/// # Errors
/// [`NdfError::NoWeight`] if none is a valid normal.
///
/// ```
/// use asperity_ndf_sampling::{Beckmann, Ndf, estimate_ndf, glam::{Vec2, Vec3}};
///
/// // Normals of a known NDF, here on a lattice of quantiles, and the NDF estimated from them.
/// let beckmann = Beckmann::isotropic(0.4)?;
/// let at = |k: usize| (k as f32 + 0.5) / 100.0;
/// let normals: Vec<Vec3> =
///     (0..10_000).map(|k| beckmann.sample(Vec2::new(at(k % 100), at(k / 100)))).collect();
/// let estimate = estimate_ndf(&normals)?;
/// assert!((estimate.d(Vec3::Z) / beckmann.d(Vec3::Z) - 1.0).abs() < 0.05);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "histogram")]
pub fn estimate_ndf(normals: &[Vec3]) -> Result<NdfMap, NdfError> {
    let mut estimator = NdfEstimator::suited(normals);
    estimator.extend(normals.iter().copied());
    estimator.finish()
}

/// The smallest automatic kernel width: two steps of an 8-bit map, whose comb it then hides.
const STEPS: f64 = 4.0 / 255.0;

/// Whether it is a normal inside the disk, up to rounding.
fn counts(n: Vec3) -> bool {
    n.x * n.x + n.y * n.y <= 1.0 + 1e-5
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    /// Mass, mean and variance of the texels of an estimate.
    fn moments(texels: &[f32], size: usize) -> [f64; 5] {
        let cell = 4.0 / (size * size) as f64;
        let mut sums = [0.0; 5];
        for (k, &density) in texels.iter().enumerate() {
            let at = |k: usize| edge(k, size) + 1.0 / size as f64;
            let (x, y, mass) = (at(k % size), at(k / size), f64::from(density) * cell);
            for (sum, term) in sums.iter_mut().zip([1.0, x, y, x * x, y * y]) {
                *sum += term * mass;
            }
        }
        sums
    }

    #[test]
    fn kernel_keeps_mass_and_mean_and_adds_its_variance() {
        for width in [0.0, 0.01, 0.1, 0.3] {
            let mut estimator = NdfEstimator::new(128, width).unwrap();
            estimator.add(Vec3::new(0.123, -0.234, 0.9));
            let [mass, x, y, xx, yy] = moments(&estimator.texels(), 128);
            // The width of a texel adds its rounding, because averaging over it is another
            // convolution.
            let texel = 2.0 / 128.0;
            assert_abs_diff_eq!(mass, 1.0, epsilon = 1e-5, "{width}");
            assert_abs_diff_eq!(x, 0.123, epsilon = 0.5 * texel, "{width}: {x} {y}");
            assert_abs_diff_eq!(y, -0.234, epsilon = 0.5 * texel, "{width}: {x} {y}");
            let expected = f64::from(width * width) / 4.0;
            for variance in [xx - x * x, yy - y * y] {
                assert_abs_diff_eq!(variance, expected, epsilon = 0.26 * texel * texel, "{width}");
            }
        }
    }

    #[test]
    fn normals_at_the_rim_have_weight_one() {
        for width in [0.0, 0.02, 0.5] {
            for n in [Vec3::X, Vec3::NEG_Y, Vec3::new(0.6, 0.8, 0.0), Vec3::new(-0.71, 0.704, 0.0)] {
                let mut estimator = NdfEstimator::new(33, width).unwrap();
                estimator.add(n);
                let mass: f64 =
                    estimator.texels().iter().zip(&estimator.areas).map(|(&d, &a)| f64::from(d * a)).sum();
                assert_abs_diff_eq!(mass, 1.0, epsilon = 1e-5, "{width} {n}");
                assert!(estimator.finish().is_ok());
            }
        }
    }

    #[test]
    fn areas_fill_the_disk() {
        let estimator = NdfEstimator::new(20, 0.0).unwrap();
        let area: f32 = estimator.areas.iter().sum();
        assert_abs_diff_eq!(area, core::f32::consts::PI, epsilon = 1e-2, "{area}");
    }

    #[test]
    fn estimate_of_a_single_direction_is_valid() {
        let flat = estimate_ndf(&[Vec3::Z; 10]).unwrap();
        assert!(crate::Ndf::d(&flat, Vec3::Z) > 1000.0);
    }
}
