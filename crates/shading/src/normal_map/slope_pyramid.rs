//! A normal map whose levels store slopes in groups.

#[cfg(feature = "alloc")]
use alloc::{vec, vec::Vec};
use core::ops::Deref;

use glam::{Vec2, Vec3};

use crate::error::ShadingError;
use crate::image::{Entries, check_len, check_texels, texel_count};
#[cfg(feature = "alloc")]
use crate::math::sqrt;
use crate::math::{floor, log2};
use crate::normal_map::bilinear::{bilinear, corners};
use crate::normal_map::levels::{fill, last_level, level_size, level_start};
use crate::normal_map::slope_lobes::{SlopeLobes, centers};
use crate::pixel::{Footprint, PixelEllipse, Tap};

/// The steepest slope of a normal map: 88°.
///
/// Otherwise one texel at the horizon would dominate the variance.
#[cfg(feature = "alloc")]
const STEEPEST: f32 = 32.0;

/// A periodic map of slopes with levels, whose texels have the moments of slopes in `K` groups.
///
/// - **Layout:** texel `row · width + column` has its center at `u = (column + ½)/width`, `v =
///   (row + ½)/height`; the map repeats. Slopes `(n_x, n_y)/n_z` are along u and v.
/// - **Close up** the map is bilinear between the centers, and a point is one slope.
/// - **Levels:** the texels of the first level have the exact moments of the bilinear field over
///   their squares. The texels of every other level have the moments of the area that they cover.
///   Therefore **the mean over the map of the first and second moments is the same at every
///   footprint.**
/// - **Groups:** found in the bilinear field of slopes. Each group is shaded as a Gaussian; `K = 1`
///   is LEAN mapping.
///
/// [`new`](Self::new) and [`from_normals`](Self::from_normals) own slopes and levels,
/// [`from_borrowed`](Self::from_borrowed) borrows them.
///
#[cfg_attr(feature = "alloc", doc = "```")]
#[cfg_attr(not(feature = "alloc"), doc = "```ignore")]
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::level_of_detail::ResolvedBumps;
/// use asperity_shading::{Beckmann, Footprint, SlopePyramid};
///
/// // Grooves, and the roughness of the stone.
/// let normals: Vec<Vec3> =
///     (0..64 * 64).map(|k| Vec3::new(if k % 16 < 2 { 0.8 } else { 0.0 }, 0.0, 1.0).normalize()).collect();
/// let map = SlopePyramid::<4>::from_normals(64, 64, &normals)?;
/// let stone = Beckmann::isotropic(0.2)?;
/// let (h, uv) = (Vec3::new(0.6, 0.0, 0.8), Vec2::new(0.6, 0.3));
/// let seen = |width| map.sample(uv, Footprint::from_width(width)).density(stone, ResolvedBumps::FAR, h);
/// // Sides of grooves are invisible on the flat part, and all visible from afar.
/// assert!(seen(0.0) < 0.01 && seen(1.0) > 0.5);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Accuracy
///
/// The error of the mean radiance over the map compared with the mean of its points, at the worst
/// distance: the root mean square over half vectors, divided by their mean. *Bricks* are rounded,
/// with edges of several texels. *Seams* are two texels wide, with slopes of ±0.9 along every 16th
/// column. *Crossed seams* are also along every 16th row. Between seams the map is flat.
///
/// | map | roughness | averaged normals | Toksvig | K = 1 | 4 | 8 | 16 |
/// |---|---|---|---|---|---|---|---|
/// | bricks | 0.2 | 1.30 | 0.64 | 0.63 | 0.38 | 0.039 | 0.010 |
/// | bricks | 0.4 | 0.60 | 0.18 | 0.13 | 0.071 | 0.005 | 0.002 |
/// | seams | 0.2 | | | 0.54 | 0.014 | 0.006 | 0.006 |
/// | seams | 0.4 | | | 0.12 | 0.002 | 0.002 | 0.002 |
/// | crossed seams | 0.2 | | | 0.82 | 0.62 | 0.022 | 0.015 |
/// | crossed seams | 0.4 | | | 0.19 | 0.12 | 0.004 | 0.003 |
///
/// Use at least 8 groups for a map with edges in several directions.
///
/// - **Storage:** for each texel a slope and 1⅓ [`SlopeLobes`], of 24 K bytes.
///
/// Olano, Baker 2010, *LEAN Mapping*. Its levels start from the texels, so up close, between
/// texels, there is a covariance that the surface does not have. The groups follow Han, Sun,
/// Ramamoorthi, Grinspun 2007, *Frequency Domain Normal Map Filtering*, §5.
#[doc(alias = "lean")]
#[doc(alias = "toksvig")]
#[doc(alias = "mipmap")]
#[doc(alias = "leadr")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlopePyramid<const K: usize, S = Entries<Vec2>, L = Entries<SlopeLobes<K>>> {
    pub(super) size: [usize; 2],
    pub(super) slopes: S,
    pub(super) centers: [Vec2; K],
    pub(super) lobes: L,
}

impl<const K: usize, S, L> SlopePyramid<K, S, L> {
    /// The number of lobes in all levels of a map of this size; 0 for an invalid size.
    #[must_use]
    pub const fn lobes_len(width: usize, height: usize) -> usize {
        match texel_count(width, height, MAX_TEXELS) {
            Ok(_) => level_start(width, height, last_level(width, height) + 1),
            Err(_) => 0,
        }
    }
}

impl<'a, const K: usize> SlopePyramid<K, &'a [Vec2], &'a [SlopeLobes<K>]> {
    /// Creates the map of borrowed slopes and fills `lobes`.
    ///
    /// # Errors
    /// [`ShadingError`] for a map without texels or with more than 2²⁶, slices of another length,
    /// and the first slope with a coordinate that is not finite or beyond 10⁶.
    ///
    /// ```
    /// use asperity_shading::normal_map::{SlopeLobes, SlopePyramid};
    /// use asperity_shading::{Footprint, glam::Vec2};
    ///
    /// // Ridges along v.
    /// let slopes = [0.4, 0.4, -0.4, -0.4].map(|x| Vec2::new(x, 0.0));
    /// let mut lobes = [SlopeLobes::<2>::default(); SlopePyramid::<2>::lobes_len(4, 1)];
    /// let ridges = SlopePyramid::from_borrowed(4, 1, &slopes, &mut lobes)?;
    ///
    /// let near = ridges.sample(Vec2::new(0.25, 0.5), Footprint::from_width(0.0)).moments();
    /// assert!((near.mean.x - 0.4).abs() < 1e-6 && near.covariance[0] < 1e-6);
    /// let far = ridges.sample(Vec2::new(0.25, 0.5), Footprint::from_width(1.0));
    /// assert!(far.moments().mean.x.abs() < 1e-6 && far.moments().covariance[0] > 0.1);
    /// // Both sides are preserved as separate lobes.
    /// assert!(far.lobes().iter().all(|side| side.weight == 0.5 && side.moments.mean.x.abs() > 0.25));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    pub fn from_borrowed(
        width: usize,
        height: usize,
        slopes: &'a [Vec2],
        lobes: &'a mut [SlopeLobes<K>],
    ) -> Result<Self, ShadingError> {
        check_slopes(width, height, slopes)?;
        check_len("lobes", Self::lobes_len(width, height), lobes.len())?;
        let (size, centers) = ([width, height], centers([width, height], slopes));
        fill(size, slopes, &centers, lobes);
        Ok(Self { size, slopes, centers, lobes })
    }
}

#[cfg(feature = "alloc")]
impl<const K: usize> SlopePyramid<K, Vec<Vec2>, Vec<SlopeLobes<K>>> {
    /// Creates the map of these slopes.
    ///
    /// # Errors
    /// See [`from_borrowed`](Self::from_borrowed).
    pub fn new(width: usize, height: usize, slopes: Vec<Vec2>) -> Result<Self, ShadingError> {
        check_slopes(width, height, &slopes)?;
        let mut lobes = vec![
            SlopeLobes::default();
            SlopePyramid::<K, &[Vec2], &[SlopeLobes<K>]>::lobes_len(width, height)
        ];
        let (size, centers) = ([width, height], centers([width, height], &slopes));
        fill(size, &slopes, &centers, &mut lobes);
        Ok(Self { size, slopes, centers, lobes })
    }

    /// Creates the map of normals whose first row is at v = 0; slopes are clamped to 32.
    ///
    /// # Errors
    /// See [`from_borrowed`](Self::from_borrowed); also the first normal with `n.z < 0`, zero,
    /// or NaN.
    pub fn from_normals(width: usize, height: usize, normals: &[Vec3]) -> Result<Self, ShadingError> {
        check_len("normals", texel_count(width, height, MAX_TEXELS)?, normals.len())?;
        check_texels("normals", normals.iter().copied(), "a normal above the horizon", |n| {
            n.is_finite() && n.z >= 0.0 && n != Vec3::ZERO
        })?;
        let mut slopes = Vec::with_capacity(normals.len());
        for &n in normals {
            let slope = Vec2::new(n.x, n.y) / n.z.max(f32::MIN_POSITIVE);
            // Divided by the larger coordinate first, because the square of a slope on the horizon
            // overflows `f32`.
            let slope = slope * (1e9 / slope.abs().max_element()).min(1.0);
            slopes.push(slope * (STEEPEST / sqrt(slope.length_squared())).min(1.0));
        }
        Self::new(width, height, slopes)
    }
}

impl<const K: usize, S: Deref<Target = [Vec2]>, L: Deref<Target = [SlopeLobes<K>]>> SlopePyramid<K, S, L> {
    /// Borrowed view of the map.
    #[must_use]
    pub fn view(&self) -> SlopePyramid<K, &[Vec2], &[SlopeLobes<K>]> {
        SlopePyramid { size: self.size, slopes: &self.slopes, centers: self.centers, lobes: &self.lobes }
    }

    /// Width and height, slopes, centers of the groups, and the lobes of all levels, for shaders.
    pub(crate) fn parts(&self) -> ([usize; 2], &[Vec2], &[Vec2; K], &[SlopeLobes<K>]) {
        (self.size, &self.slopes, &self.centers, &self.lobes)
    }

    /// The last level, which has one texel for the whole map.
    #[must_use]
    pub fn last_level(&self) -> u32 {
        last_level(self.size[0], self.size[1])
    }

    /// The slopes of the whole map.
    #[must_use]
    pub fn whole(&self) -> SlopeLobes<K> {
        self.lobes.last().copied().unwrap_or_default()
    }

    /// The slope at a point, bilinear between texel centers; NaN coordinates are read as 0.
    #[must_use]
    pub fn slope(&self, uv: Vec2) -> Vec2 {
        bilinear(uv, self.size, &self.slopes)
    }

    /// The slopes in one level, bilinear between texel centers; the level is clamped to the last.
    ///
    /// The differences between the means of the texels contribute to the covariance.
    #[must_use]
    pub fn level(&self, uv: Vec2, level: u32) -> SlopeLobes<K> {
        let level = level.min(self.last_level());
        let start = level_start(self.size[0], self.size[1], level);
        let parts = corners(uv, level_size(self.size[0], self.size[1], level));
        SlopeLobes::mixed(
            parts.map(|(weight, k)| (weight, self.lobes.get(start + k).copied().unwrap_or_default())),
        )
    }

    /// Lobes within a round pixel around a point, trilinear between levels.
    ///
    /// ```text
    /// p = width of the pixel · max(width, height):   p ≥ 1: levels ⌊log₂ p⌋ and the next;   p < 1: p² of level 0, the rest a point
    /// ```
    ///
    /// `footprint` is in the unit of `uv`, in which the map has side 1. Continuous in both; where
    /// nothing is resolved it is [`whole`](Self::whole).
    #[must_use]
    pub fn sample(&self, uv: Vec2, footprint: Footprint) -> SlopeLobes<K> {
        let pixel = footprint.width() * self.size[0].max(self.size[1]) as f32;
        if pixel < 1.0 {
            let share = pixel * pixel;
            return SlopeLobes::mixed([
                (1.0 - share, SlopeLobes::point(self.slope(uv), &self.centers)),
                (share, self.level(uv, 0)),
            ]);
        }
        let level = log2(pixel).min(self.last_level() as f32);
        let first = floor(level);
        let share = level - first;
        SlopeLobes::mixed([
            (1.0 - share, self.level(uv, first as u32)),
            (share, self.level(uv, first as u32 + 1)),
        ])
    }

    /// Lobes within an elongated pixel (anisotropic filtering).
    ///
    /// Uses up to `most` round footprints along its long axis.
    ///
    /// The ellipse is in the unit of `uv`, from the derivatives of `(u, v, 0)` by one pixel to the
    /// right and one down.
    #[must_use]
    pub fn sample_along(&self, uv: Vec2, pixel: &PixelEllipse, most: u32) -> SlopeLobes<K> {
        SlopeLobes::mixed(pixel.taps(most).map(|Tap { offset, footprint }| {
            let Vec3 { x, y, .. } = offset;
            (1.0, self.sample(uv + Vec2::new(x, y), footprint))
        }))
    }
}

/// The maximum number of texels of a map.
const MAX_TEXELS: usize = 1 << 26;

/// The largest coordinate of a slope, so that squares and sums over a map stay within `f32`.
const FARTHEST: f32 = 1e6;

/// Returns an error for a wrong number of slopes, or for the first invalid slope.
fn check_slopes(width: usize, height: usize, slopes: &[Vec2]) -> Result<(), ShadingError> {
    check_len("slopes", texel_count(width, height, MAX_TEXELS)?, slopes.len())?;
    let texels = slopes.iter().map(|slope| slope.extend(0.0));
    check_texels("slopes", texels, "between -1e6 and 1e6 in each component", |slope| {
        slope.abs().cmple(Vec3::splat(FARTHEST)).all()
    })
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::normal_map::slope_moments::SlopeMoments;
    use asperity_core::assert_abs_diff_eq;
    use std::{format, string::ToString};

    const SIZE: usize = 16;

    fn values() -> [Vec2; SIZE * SIZE] {
        core::array::from_fn(|k| {
            let turn = core::f32::consts::TAU / SIZE as f32;
            let (x, y) = ((k % SIZE) as f32 * turn, (k / SIZE) as f32 * turn);
            Vec2::new(x.sin() + 0.3 * (3.0 * y).cos(), (x + 2.0 * y).cos())
        })
    }

    #[test]
    fn mean_moments_are_equal_at_every_footprint() {
        let (values, mut lobes) = (values(), [SlopeLobes::<3>::default(); 341]);
        let map = SlopePyramid::from_borrowed(SIZE, SIZE, &values, &mut lobes).unwrap();
        let whole = map.whole().moments();
        for width in [0.0, 0.01, 0.05, 0.0625, 0.1, 0.3, 0.7, 1.0, 3.0, f32::INFINITY] {
            let pixel = Footprint::from_width(width);
            let points = (0..64 * 64).map(|k| {
                let uv = Vec2::new((k % 64) as f32 + 0.5, (k / 64) as f32 + 0.5) / 64.0;
                (1.0, map.sample(uv, pixel).moments())
            });
            let got = SlopeMoments::mixed(points);
            assert_abs_diff_eq!(got.mean, whole.mean, epsilon = 1e-4, "{width}");
            for (got, whole) in got.covariance.into_iter().zip(whole.covariance) {
                // Measured: 1.8e-3, from the mean over points in place of the integral.
                assert_abs_diff_eq!(got, whole, epsilon = 3e-3, "{width}");
            }
        }
    }

    #[test]
    fn sample_along_is_anisotropic() {
        let (values, mut lobes) = (values(), [SlopeLobes::<3>::default(); 341]);
        let map = SlopePyramid::from_borrowed(SIZE, SIZE, &values, &mut lobes).unwrap();
        let uv = Vec2::new(0.3, 0.6);
        let pixel = PixelEllipse::from_derivatives(Vec3::X * 1e-3, Vec3::Y * 0.25);
        let seen = map.sample_along(uv, &pixel, 16).moments();
        let points = (0..256).map(|k| {
            (1.0, SlopeMoments::point(map.slope(uv + Vec2::Y * 0.25 * ((k as f32 + 0.5) / 256.0 - 0.5))))
        });
        let exact = SlopeMoments::mixed(points);
        assert_abs_diff_eq!(seen.mean, exact.mean, epsilon = 0.02);
        assert_abs_diff_eq!(seen.covariance[2], exact.covariance[2], epsilon = 0.02);
        let round = map.sample(uv, pixel.long()).moments();
        assert!((round.mean - exact.mean).length() > 0.05, "{round:?} {exact:?}");
    }

    #[test]
    fn sample_accepts_every_input() {
        let (values, mut lobes) = (values(), [SlopeLobes::<3>::default(); 341]);
        let map = SlopePyramid::from_borrowed(SIZE, SIZE, &values, &mut lobes).unwrap();
        for x in [f32::NAN, f32::INFINITY, -1e30, -1e-9, 0.0, 1.0, 1e30] {
            for width in [0.0, 1e-30, 0.0625, 1.0, 1e30, f32::NAN, f32::INFINITY] {
                let got = map.sample(Vec2::new(x, 0.4), Footprint::from_width(width)).moments();
                assert!(got.mean.is_finite(), "{x}, {width}: {got:?}");
                assert!(got.covariance.iter().all(|c| c.is_finite()), "{x}, {width}: {got:?}");
            }
        }
        let pixel = PixelEllipse::from_derivatives(Vec3::NAN, Vec3::X);
        assert!(
            (map.sample_along(Vec2::ONE, &pixel, 8).moments().mean - map.whole().moments().mean).length()
                < 1e-6
        );
        let refused = SlopePyramid::<1, _, _>::from_borrowed(1, 1, &[Vec2::ONE], &mut []).unwrap_err();
        assert_eq!(refused.to_string(), "`lobes` must have 1 elements, got 0");
    }

    #[test]
    fn new_rejects_invalid_maps() {
        let refused = |width, height, slopes| {
            SlopePyramid::<1, _, _>::from_borrowed(width, height, slopes, &mut []).unwrap_err().to_string()
        };
        assert_eq!(refused(0, 4, &[]), "`width · height` must be between 1 and 67108864, got 0");
        assert_eq!(
            refused(usize::MAX, 2, &[]),
            format!("`width · height` must be between 1 and 67108864, got {}", usize::MAX)
        );
        assert_eq!(refused(2, 2, &[Vec2::ONE; 3]), "`slopes` must have 4 elements, got 3");
        assert_eq!(
            refused(1, 2, &[Vec2::ONE, Vec2::NAN]),
            "`slopes[1]` must be between -1e6 and 1e6 in each component, got [NaN, NaN, 0]"
        );
    }

    #[test]
    #[cfg(feature = "alloc")]
    fn from_normals_computes_slopes() {
        let normals =
            [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, -1.0, 0.0), Vec3::new(3.0, 0.0, 4.0)];
        let map = SlopePyramid::<2>::from_normals(2, 2, &normals).unwrap();
        let expected = [Vec2::ZERO, Vec2::new(0.75, 0.0), Vec2::new(0.0, -STEEPEST), Vec2::new(0.75, 0.0)];
        for (got, expected) in map.slopes.iter().zip(expected) {
            assert_abs_diff_eq!(*got, expected, epsilon = 1e-4);
        }
        for bad in [Vec3::ZERO, Vec3::NEG_Z, Vec3::NAN, Vec3::INFINITY] {
            let refused = SlopePyramid::<2>::from_normals(1, 2, &[Vec3::Z, bad]).unwrap_err();
            let message = format!("`normals[1]` must be a normal above the horizon, got {bad}");
            assert_eq!(refused.to_string(), message);
        }
        assert!(SlopePyramid::<2>::from_normals(3, 1, &[Vec3::Z]).is_err());
    }
}
