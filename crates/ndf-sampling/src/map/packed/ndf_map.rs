//! An NDF from an image or a function on the hemispherical map of normals.

use alloc::vec::Vec;

use glam::Vec3;

use crate::density::delegate::delegate_ndf;
use crate::error::NdfError;
use crate::map::marginal::Marginal;
use crate::map::packed::layout::Layout;
use crate::map::packed::pack::pack;
use crate::map::packed::packed_map::PackedMapRef;
use crate::map::reconstruction::Reconstruction;
use crate::map::texels::{Measure, columns_of_texels, texel_edges, texel_meets};
use crate::ndf::Ndf;

/// Points per side over which a function is averaged in a texel.
const POINTS: usize = 4;

/// An NDF tabulated on the (x, y) map and clipped to the disk, with exact inversion sampling.
///
/// ```text
/// x = (n_x + 1)/2,  y = (n_y + 1)/2;      T(z) = (M, C)⁻¹(Φ(z₁), Φ(z₂)),   T⁻¹(m) = Φ⁻¹(M(x), C(y|x))
/// ```
///
/// - **Layout:** texel `j·width + i` covers `[i, i+1]/width × [j, j+1]/height`: the first row has
///   `n_y = −1`. Flip an image file whose first row is its top.
/// - **Outside the disk** texels are ignored and not even read. The part of a rim texel inside the
///   disk is used.
/// - **Scale:** arbitrary; the density is normalized to `∫ D cos θ dω = 1`.
/// - **Any input:** see [`Ndf`]. `T` always returns normals where the density has weight, up to the
///   rounding of the normal to `f32`. `T⁻¹` of a direction without weight is on the border of the
///   support.
/// - **The flat normal** is at `invert(Vec3::Z)`. It is not at `z = 0`, the median, unless the
///   map is symmetric.
/// - **Resolution:** a roughness below about 6 texels (`α · size/2 < 6`) is not resolved. Use
///   [`Ggx`](crate::Ggx) or [`Beckmann`](crate::Beckmann) there.
/// - **Masking and visible normals:** by [`Masked`](crate::Masked).
/// - **Accuracy:** the error of a bilinear map of a function is quadratic in the texel size. The
///   error of `M` is below a twentieth over the square of the roughness in texels. Marginal and
///   conditional are summed in `f64` and stored in `f32`, see [`PackedMapRef`].
/// - **Storage:** one array of about 14 bytes per texel (10 for constant texels) and 110 to 150
///   bytes for each piece of the distribution of `n_x`. There are 930 pieces plus a few per row and
///   column. [`array`](Self::array) returns the array for files, flash and shaders.
///
/// ```
/// use asperity_ndf_sampling::{Measure, Ndf, NdfMap, Reconstruction, glam::{Vec2, Vec3}};
///
/// // Two lobes, painted.
/// let lobe = |n: Vec3, x: f32| f32::exp(-40.0 * ((n.x - x) * (n.x - x) + n.y * n.y));
/// let map = NdfMap::from_fn(64, 64, Measure::ProjectedSolidAngle, Reconstruction::Constant, |n| lobe(n, -0.4) + lobe(n, 0.4))?;
/// assert!(map.d(Vec3::new(0.4, 0.0, 0.9165)) > 10.0 * map.d(Vec3::Z));
/// let z = Vec2::new(0.3, -1.0);
/// assert!(map.invert(map.warp_gaussian(z)).abs_diff_eq(z, 1e-5));
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, section 4. The paper draws a texel and uses its center; here the
/// density is sampled exactly.
#[derive(Clone, Debug, PartialEq)]
#[doc(alias = "distribution 2d")]
#[doc(alias = "tabulated")]
pub struct NdfMap {
    array: Vec<f32>,
    layout: Layout,
}

impl NdfMap {
    /// The maximum number of texels of a map, which then takes 220 MB.
    pub const MAX_TEXELS: usize = 1 << 24;

    /// Creates the map from the `width · height` values `texels`.
    ///
    /// # Errors
    /// A map without texels or with more than [`MAX_TEXELS`](Self::MAX_TEXELS); a slice of another
    /// length; a texel inside the disk that is negative, NaN or infinite (the error contains the
    /// first); no texel with weight.
    pub fn from_texels(
        width: usize,
        height: usize,
        texels: &[f32],
        measure: Measure,
        reconstruction: Reconstruction,
    ) -> Result<Self, NdfError> {
        let expected = check_size(width, height)?;
        if texels.len() != expected {
            return Err(NdfError::Length { parameter: "texels", expected, got: texels.len() });
        }
        let columns = columns_of_texels(width, height, texels, measure, reconstruction)?;
        let marginal = Marginal::new(columns).ok_or(NdfError::NoWeight { parameter: "texels" })?;
        let (layout, array) = pack(&marginal);
        Ok(Self { array, layout })
    }

    /// Creates the map of a function.
    ///
    /// For [`Reconstruction::Constant`] the function is averaged over those of 4×4 points of each
    /// texel that are inside the disk. Otherwise it is evaluated at the centers, or at the nearest
    /// point of the rim for a center outside the disk.
    ///
    /// The arguments of the function are unit normals with `n.z > 0`.
    ///
    /// # Errors
    /// See [`NdfMap::from_texels`], for these values.
    pub fn from_fn(
        width: usize,
        height: usize,
        measure: Measure,
        reconstruction: Reconstruction,
        mut f: impl FnMut(Vec3) -> f32,
    ) -> Result<Self, NdfError> {
        let mut texels = Vec::with_capacity(check_size(width, height)?);
        for (i, j) in (0..height).flat_map(|j| (0..width).map(move |i| (i, j))) {
            texels.push(if !texel_meets(i, width, j, height) {
                0.0
            } else if reconstruction == Reconstruction::Constant {
                average(texel_edges(i, width), texel_edges(j, height), &mut f)
            } else {
                at_center(texel_edges(i, width), texel_edges(j, height), &mut f)
            });
        }
        Self::from_texels(width, height, &texels, measure, reconstruction)
    }

    /// Creates the map of another NDF, by [`NdfMap::from_fn`].
    ///
    /// # Errors
    /// See [`NdfMap::from_fn`].
    pub fn from_ndf<N: Ndf + ?Sized>(
        width: usize,
        height: usize,
        reconstruction: Reconstruction,
        ndf: &N,
    ) -> Result<Self, NdfError> {
        Self::from_fn(width, height, Measure::ProjectedSolidAngle, reconstruction, |m| ndf.d(m))
    }

    /// The map as a borrowed view, which has the array methods.
    #[inline]
    #[must_use]
    pub fn view(&self) -> PackedMapRef<'_> {
        PackedMapRef::of(self.layout, &self.array)
    }

    /// The map as one array of `f32`, for [`PackedMapRef::new`].
    ///
    /// It has the same bits on every machine with the same rounding.
    #[inline]
    #[must_use]
    pub fn array(&self) -> &[f32] {
        &self.array
    }

    /// Converts the map into its array.
    #[inline]
    #[must_use]
    pub fn into_array(self) -> Vec<f32> {
        self.array
    }
}

delegate_ndf!(NdfMap, view);

/// The unit normal over a point of the disk; just above the horizon at its rim.
#[inline]
fn upward(nx: f64, ny: f64) -> Vec3 {
    let nz2 = (1.0 - nx * nx) - ny * ny;
    Vec3::new(nx as f32, ny as f32, asperity_core::math::sqrt_f64(nz2.max(1e-15)) as f32)
}

/// `f` at the center of the texel, or at the rim in its direction.
fn at_center([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], f: &mut impl FnMut(Vec3) -> f32) -> f32 {
    let (x, y) = (0.5 * (x0 + x1), 0.5 * (y0 + y1));
    let inward = 1.0 / asperity_core::math::sqrt_f64((x * x + y * y).max(1.0));
    f(upward(x * inward, y * inward))
}

/// The mean of `f` over the grid points of a texel that are inside the disk.
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

fn check_size(width: usize, height: usize) -> Result<usize, NdfError> {
    match width.checked_mul(height) {
        Some(texels) if (1..=NdfMap::MAX_TEXELS).contains(&texels) => Ok(texels),
        _ => Err(NdfError::Size {
            parameter: "width · height",
            value: width.saturating_mul(height),
            min: 1,
            max: NdfMap::MAX_TEXELS,
        }),
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::ndf::totality;
    use asperity_core::assert_abs_diff_eq;
    use glam::Vec2;
    use std::vec;

    #[test]
    fn texels_outside_the_disk_are_not_read() {
        let mut texels = vec![1.0; 64];
        for corner in [0, 7, 56, 63] {
            texels[corner] = f32::NAN;
        }
        let map = NdfMap::from_texels(8, 8, &texels, Measure::ProjectedSolidAngle, Reconstruction::Constant)
            .unwrap();
        assert_abs_diff_eq!(map.d(Vec3::Z), core::f32::consts::FRAC_1_PI, epsilon = 1e-6);
    }

    #[test]
    fn first_row_is_at_negative_y() {
        let map =
            NdfMap::from_texels(1, 2, &[1.0, 0.0], Measure::ProjectedSolidAngle, Reconstruction::Constant)
                .unwrap();
        assert!(map.d(Vec3::new(0.0, -0.6, 0.8)) > 0.6);
        assert_eq!(map.d(Vec3::new(0.0, 0.6, 0.8)), 0.0);
    }

    #[test]
    fn from_gaussian_of_nan_is_the_median() {
        let map = NdfMap::from_fn(8, 8, Measure::ProjectedSolidAngle, Reconstruction::Constant, |n| {
            1.5 + n.x + 0.4 * n.y
        })
        .unwrap();
        for z in [-1.0, 0.3] {
            assert_eq!(map.warp_gaussian(Vec2::new(f32::NAN, z)), map.warp_gaussian(Vec2::new(0.0, z)));
            assert_eq!(map.warp_gaussian(Vec2::new(z, f32::NAN)), map.warp_gaussian(Vec2::new(z, 0.0)));
        }
    }

    #[test]
    fn rim_is_above_the_horizon() {
        for size in 1..6 {
            let map =
                NdfMap::from_fn(size, size, Measure::ProjectedSolidAngle, Reconstruction::Constant, |_| 1.0)
                    .unwrap();
            for k in -900..=900 {
                for far in [-9.0, 9.0] {
                    let m = map.warp_gaussian(Vec2::new(k as f32 * 0.01, far));
                    assert_abs_diff_eq!(m.length(), 1.0, epsilon = 1e-6, "{size} {k}");
                    assert!(m.z > 0.0, "{size} {k}: {m}");
                    assert!(map.d(m) > 0.3 && map.invert(m).is_finite(), "{size} {k}: {m}");
                }
            }
        }
    }

    #[test]
    fn accepts_every_input() {
        let ggx = crate::Ggx::new(0.4, 0.7).unwrap();
        totality::check(&NdfMap::from_ndf(16, 8, Reconstruction::Constant, &ggx).unwrap());
    }
}
