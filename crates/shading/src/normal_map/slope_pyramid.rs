//! A normal map with the slopes of its levels in groups, made of normals.

use alloc::vec;
use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use crate::image::ImageError;
use crate::math::sqrt;
use crate::normal_map::levels::fill;
use crate::normal_map::slope_lobes::{SlopeLobes, centres};
use crate::normal_map::slope_pyramid_ref::{SlopePyramidRef, check_slopes};

/// The steepest slope of a normal map: 88°. One texel on the horizon would leave no other a share of the variance.
const STEEPEST: f32 = 32.0;

/// A [`SlopePyramidRef`] that owns its slopes and its levels.
///
/// ```
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::level_of_detail::Coordinates;
/// use asperity_shading::{Beckmann, Footprint, SlopePyramid};
///
/// // Grooves, and the roughness of the stone.
/// let normals: Vec<Vec3> =
///     (0..64 * 64).map(|k| Vec3::new(if k % 16 < 2 { 0.8 } else { 0.0 }, 0.0, 1.0).normalize()).collect();
/// let map = SlopePyramid::<4>::from_normals(64, 64, &normals)?;
/// let stone = Beckmann::isotropic(0.2)?;
/// let (h, uv) = (Vec3::new(0.6, 0.0, 0.8), Vec2::new(0.6, 0.3));
/// let seen = |width| map.as_ref().sample(uv, Footprint::from_width(width)).density(stone, Coordinates::FAR, h);
/// // On the flat the side of a groove does not show; from afar all of them do.
/// assert!(seen(0.0) < 0.01 && seen(1.0) > 0.5);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "lean")]
#[doc(alias = "toksvig")]
#[doc(alias = "mipmap")]
#[doc(alias = "leadr")]
#[derive(Clone, Debug, PartialEq)]
pub struct SlopePyramid<const K: usize> {
    size: [usize; 2],
    slopes: Vec<Vec2>,
    centres: [Vec2; K],
    lobes: Vec<SlopeLobes<K>>,
}

impl<const K: usize> SlopePyramid<K> {
    /// The map of these slopes.
    ///
    /// # Errors
    /// The errors of [`SlopePyramidRef::new`].
    pub fn new(width: usize, height: usize, slopes: Vec<Vec2>) -> Result<Self, ImageError> {
        check_slopes(width, height, &slopes)?;
        let mut lobes = vec![SlopeLobes::default(); SlopePyramidRef::<K>::lobes_len(width, height)];
        let (size, centres) = ([width, height], centres([width, height], &slopes));
        fill(size, &slopes, &centres, &mut lobes);
        Ok(Self { size, slopes, centres, lobes })
    }

    /// The slopes of a normal map whose first row is at v = 0; slopes above 32 count as 32.
    ///
    /// # Errors
    /// The errors of [`SlopePyramidRef::new`], and for the first normal with `n.z < 0`, with no direction, or
    /// that is no number.
    pub fn from_normals(width: usize, height: usize, normals: &[Vec3]) -> Result<Self, ImageError> {
        let mut slopes = Vec::with_capacity(normals.len());
        for (index, &n) in normals.iter().enumerate() {
            if !(n.is_finite() && n.z >= 0.0 && n != Vec3::ZERO) {
                return Err(ImageError::Normal { index, value: n });
            }
            let slope = Vec2::new(n.x, n.y) / n.z.max(f32::MIN_POSITIVE);
            // By the greater coordinate first: the square of a slope on the horizon leaves the range of `f32`.
            let slope = slope * (1e9 / slope.abs().max_element()).min(1.0);
            slopes.push(slope * (STEEPEST / sqrt(slope.length_squared())).min(1.0));
        }
        Self::new(width, height, slopes)
    }

    /// Borrowed view of the map.
    #[must_use]
    pub fn as_ref(&self) -> SlopePyramidRef<'_, K> {
        SlopePyramidRef::from_parts(self.size, &self.slopes, self.centres, &self.lobes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn slopes_are_those_of_the_normals() {
        let normals =
            [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, -1.0, 0.0), Vec3::new(3.0, 0.0, 4.0)];
        let map = SlopePyramid::<2>::from_normals(2, 2, &normals).unwrap();
        let expected = [Vec2::ZERO, Vec2::new(0.75, 0.0), Vec2::new(0.0, -STEEPEST), Vec2::new(0.75, 0.0)];
        for (got, expected) in map.slopes.iter().zip(expected) {
            assert_abs_diff_eq!(*got, expected, epsilon = 1e-4);
        }
        for bad in [Vec3::ZERO, Vec3::NEG_Z, Vec3::NAN, Vec3::INFINITY] {
            let refused = SlopePyramid::<2>::from_normals(1, 2, &[Vec3::Z, bad]).unwrap_err();
            assert!(matches!(refused, ImageError::Normal { index: 1, .. }), "{refused}");
        }
        assert!(SlopePyramid::<2>::from_normals(3, 1, &[Vec3::Z]).is_err());
    }

    #[test]
    fn it_is_what_it_borrows() {
        let map = SlopePyramid::<2>::new(3, 2, (0..6).map(|k| Vec2::new(k as f32, (k * k) as f32)).collect());
        let map = map.unwrap();
        let mut lobes = [SlopeLobes::default(); 7];
        let borrowed = SlopePyramidRef::new(3, 2, &map.slopes, &mut lobes).unwrap();
        assert_eq!(map.as_ref(), borrowed);
    }
}
