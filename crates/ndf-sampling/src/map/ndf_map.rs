//! A normal density that is given as an image or as a function on the hemispherical map of normals.

use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use crate::map::cdf::Cdf;
use crate::map::disk::to_normal;
use crate::map::error::{MAX_TEXELS, NdfMapError};
use crate::map::reconstruction::Reconstruction;
use crate::map::texels::{Measure, columns_of_texels, texel_edges, texel_meets};
use crate::ndf::Ndf;
use crate::numeric::normal_distribution::{inverse_phi, phi};

/// The farthest Gaussian coordinate of a map: `1 − Φ` of it is the resolution of `f64` below 1.
const FARTHEST: f64 = 8.125;

/// Points per side at which a function is averaged over a texel.
const POINTS: usize = 4;

/// A normal density, constant on each texel of the (x, y) map and clipped to the disk, with its exact sampling.
///
/// ```text
/// x = (n_x + 1)/2,  y = (n_y + 1)/2;      T(z) = (M, C)⁻¹(Φ(z₁), Φ(z₂)),   T⁻¹(m) = Φ⁻¹(M(x), C(y|x))
/// ```
///
/// - **Layout:** texel `j·width + i` covers `[i, i+1]/width × [j, j+1]/height`: the first row has `n_y = −1`. An image file
///   whose first row is its top is turned over first.
/// - **Outside the disk** texels count nothing and are not even read; a texel at the rim counts with its part inside.
/// - **Scale:** any; the density is normalised to `∫ D cos θ dω = 1`.
/// - **Total:** see [`Ndf`]; `T` always lands where the density has weight, up to the rounding of the normal to `f32`.
///   `T⁻¹` of a direction where it has none is on the border of what has.
/// - **The flat normal** is at `to_gaussian(Vec3::Z)`, not at `z = 0`, which is the median, unless the map is symmetric.
/// - **Resolution:** a roughness under about 6 texels (`α · size/2 < 6`) is not resolved: use [`Ggx`](crate::Ggx) or
///   [`Beckmann`](crate::Beckmann) there.
/// - **Masking and visible normals:** by [`Masked`](crate::Masked).
/// - **Accuracy:** a bilinear map of a function errs by the square of a texel: `m` by less than ½ over the square of the roughness in texels,
///   `M` by less than a tenth of that. `T⁻¹(T(z)) = z` to the rounding of `m` to `f32`: 1.2e-7 times the slope of `z` over the normal.
///
/// ```
/// use asperity_ndf_sampling::{Measure, Ndf, NdfMap, Reconstruction, glam::{Vec2, Vec3}};
///
/// // Two lobes, painted.
/// let lobe = |n: Vec3, x: f32| f32::exp(-40.0 * ((n.x - x) * (n.x - x) + n.y * n.y));
/// let map = NdfMap::from_fn(64, 64, Measure::Normals, Reconstruction::Constant, |n| lobe(n, -0.4) + lobe(n, 0.4))?;
/// assert!(map.density(Vec3::new(0.4, 0.0, 0.9165)) > 10.0 * map.density(Vec3::Z));
/// let z = Vec2::new(0.3, -1.0);
/// assert!(map.to_gaussian(map.from_gaussian(z)).abs_diff_eq(z, 1e-5));
/// # Ok::<(), asperity_ndf_sampling::NdfMapError>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, section 4. The paper draws a texel and uses its centre; here the density is sampled exactly.
#[derive(Clone, Debug, PartialEq)]
#[doc(alias = "distribution 2d")]
#[doc(alias = "tabulated")]
pub struct NdfMap {
    cdf: Cdf,
}

impl NdfMap {
    /// The map of the `width · height` values `texels`.
    ///
    /// # Errors
    /// A map without texels or with more than [`MAX_TEXELS`]; a slice of another length; a texel, not outside the disk, that
    /// is negative, NaN or infinite (the first one is named); no texel with weight.
    pub fn from_texels(
        width: usize,
        height: usize,
        texels: &[f32],
        measure: Measure,
        reconstruction: Reconstruction,
    ) -> Result<Self, NdfMapError> {
        let expected = check_size(width, height)?;
        if texels.len() != expected {
            return Err(NdfMapError::Texels { expected, got: texels.len() });
        }
        let columns = columns_of_texels(width, height, texels, measure, reconstruction)?;
        Cdf::new(columns).map(|cdf| Self { cdf }).ok_or(NdfMapError::Black { width, height })
    }

    /// The map of a function: averaged over 4×4 points of each texel (those that are inside the disk) for
    /// [`Reconstruction::Constant`], else at the centres (or where the rim is nearest to a centre outside the disk).
    ///
    /// The function gets unit normals with `n.z > 0`.
    ///
    /// # Errors
    /// The errors of [`NdfMap::from_texels`], for these values.
    pub fn from_fn(
        width: usize,
        height: usize,
        measure: Measure,
        reconstruction: Reconstruction,
        mut f: impl FnMut(Vec3) -> f32,
    ) -> Result<Self, NdfMapError> {
        let mut texels = Vec::with_capacity(check_size(width, height)?);
        for (i, j) in (0..height).flat_map(|j| (0..width).map(move |i| (i, j))) {
            texels.push(if !texel_meets(i, width, j, height) {
                0.0
            } else if reconstruction == Reconstruction::Constant {
                average(texel_edges(i, width), texel_edges(j, height), &mut f)
            } else {
                at_centre(texel_edges(i, width), texel_edges(j, height), &mut f)
            });
        }
        Self::from_texels(width, height, &texels, measure, reconstruction)
    }

    /// The map of another normal density, by [`NdfMap::from_fn`].
    ///
    /// # Errors
    /// The errors of [`NdfMap::from_fn`].
    pub fn from_ndf<N: Ndf + ?Sized>(
        width: usize,
        height: usize,
        reconstruction: Reconstruction,
        ndf: &N,
    ) -> Result<Self, NdfMapError> {
        Self::from_fn(width, height, Measure::Normals, reconstruction, |m| ndf.density(m))
    }

    /// The marginal and conditional distribution functions, their inverses, and the density over the map.
    #[inline]
    #[must_use]
    pub const fn cdf(&self) -> &Cdf {
        &self.cdf
    }
}

impl Ndf for NdfMap {
    #[inline]
    fn density(&self, m: Vec3) -> f32 {
        let [x, y] = on_map(m);
        let (nx, ny) = (to_normal(x), to_normal(y));
        // A unit normal at the rim may be outside the disk by the rounding of its coordinates.
        if m.z > 0.0 && nx * nx + ny * ny <= 1.0 + 1e-6 {
            (0.25 * self.cdf.value([x, y])) as f32
        } else {
            0.0
        }
    }

    /// `(M, C)⁻¹(u)`, without the detour over Gaussian numbers.
    #[inline]
    fn sample(&self, u: Vec2) -> Vec3 {
        let [x, y] = self.cdf.inverse([u.x, u.y].map(f64::from));
        upward(to_normal(x), to_normal(y))
    }

    #[inline]
    fn from_gaussian(&self, z: Vec2) -> Vec3 {
        let u =
            [z.x, z.y].map(|z| if z.is_nan() { 0.5 } else { phi(f64::from(z).clamp(-FARTHEST, FARTHEST)) });
        let [x, y] = self.cdf.inverse(u);
        upward(to_normal(x), to_normal(y))
    }

    #[inline]
    fn to_gaussian(&self, m: Vec3) -> Vec2 {
        let [z1, z2] = self.cdf.forward(on_map(m)).map(|u| inverse_phi(u).clamp(-FARTHEST, FARTHEST) as f32);
        Vec2::new(z1, z2)
    }
}

/// The map coordinates of a normal.
#[inline]
fn on_map(m: Vec3) -> [f64; 2] {
    [m.x, m.y].map(|n| (f64::from(n) + 1.0) * 0.5)
}

/// The unit normal over a point of the disk; just above the horizon at its rim.
#[inline]
fn upward(nx: f64, ny: f64) -> Vec3 {
    let nz2 = (1.0 - nx * nx) - ny * ny;
    Vec3::new(nx as f32, ny as f32, asperity_core::math::sqrt_f64(nz2.max(1e-15)) as f32)
}

/// `f` at the texel's centre, or at the rim's point in its direction.
fn at_centre([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], f: &mut impl FnMut(Vec3) -> f32) -> f32 {
    let (x, y) = (0.5 * (x0 + x1), 0.5 * (y0 + y1));
    let inward = 1.0 / asperity_core::math::sqrt_f64((x * x + y * y).max(1.0));
    f(upward(x * inward, y * inward))
}

/// The mean of `f` over the points of a texel's grid that are inside the disk.
fn average([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], f: &mut impl FnMut(Vec3) -> f32) -> f32 {
    let (mut sum, mut count) = (0.0, 0u32);
    let at = |k: usize| (k as f64 + 0.5) / POINTS as f64;
    for (k, l) in (0..POINTS).flat_map(|k| (0..POINTS).map(move |l| (k, l))) {
        let (x, y) = (x0 + (x1 - x0) * at(k), y0 + (y1 - y0) * at(l));
        if x * x + y * y < 1.0 {
            sum += f64::from(f(upward(x, y)));
            count += 1;
        }
    }
    if count > 0 {
        return (sum / f64::from(count)) as f32;
    }
    // A sliver between the points: its corner nearest to the flat normal is inside.
    f(upward(0.0_f64.clamp(x0, x1), 0.0_f64.clamp(y0, y1)))
}

fn check_size(width: usize, height: usize) -> Result<usize, NdfMapError> {
    match width.checked_mul(height) {
        Some(texels) if (1..=MAX_TEXELS).contains(&texels) => Ok(texels),
        _ => Err(NdfMapError::Size { width, height }),
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::ndf::totality;
    use std::vec;

    #[test]
    fn texels_outside_the_disk_are_not_read() {
        let mut texels = vec![1.0; 64];
        for corner in [0, 7, 56, 63] {
            texels[corner] = f32::NAN;
        }
        let map = NdfMap::from_texels(8, 8, &texels, Measure::Normals, Reconstruction::Constant).unwrap();
        asperity_core::assert_abs_diff_eq!(
            map.density(Vec3::Z),
            core::f32::consts::FRAC_1_PI,
            epsilon = 1e-6
        );
    }

    #[test]
    fn first_row_is_at_negative_y() {
        let map = NdfMap::from_texels(1, 2, &[1.0, 0.0], Measure::Normals, Reconstruction::Constant).unwrap();
        assert!(map.density(Vec3::new(0.0, -0.6, 0.8)) > 0.6);
        assert_eq!(map.density(Vec3::new(0.0, 0.6, 0.8)), 0.0);
    }

    #[test]
    fn coordinate_that_is_not_a_number_is_the_median() {
        let map =
            NdfMap::from_fn(8, 8, Measure::Normals, Reconstruction::Constant, |n| 1.5 + n.x + 0.4 * n.y)
                .unwrap();
        for z in [-1.0, 0.3] {
            assert_eq!(map.from_gaussian(Vec2::new(f32::NAN, z)), map.from_gaussian(Vec2::new(0.0, z)));
            assert_eq!(map.from_gaussian(Vec2::new(z, f32::NAN)), map.from_gaussian(Vec2::new(z, 0.0)));
        }
    }

    #[test]
    fn rim_is_above_the_horizon() {
        for size in 1..6 {
            let map =
                NdfMap::from_fn(size, size, Measure::Normals, Reconstruction::Constant, |_| 1.0).unwrap();
            for k in -900..=900 {
                for far in [-9.0, 9.0] {
                    let m = map.from_gaussian(Vec2::new(k as f32 * 0.01, far));
                    asperity_core::assert_abs_diff_eq!(m.length(), 1.0, epsilon = 1e-6, "{size} {k}");
                    assert!(m.z > 0.0, "{size} {k}: {m}");
                    assert!(map.density(m) > 0.3 && map.to_gaussian(m).is_finite(), "{size} {k}: {m}");
                }
            }
        }
    }

    #[test]
    fn total_on_every_input() {
        let ggx = crate::Ggx::new(0.4, 0.7).unwrap();
        totality::check(&NdfMap::from_ndf(16, 8, Reconstruction::Constant, &ggx).unwrap());
    }
}
