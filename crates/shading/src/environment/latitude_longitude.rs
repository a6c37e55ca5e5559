//! A latitude–longitude image of all directions with bilinear lookup across its seam and poles.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use core::f32::consts::{PI, TAU};
use core::ops::Deref;

use glam::Vec3;

use crate::environment::interface::{Environment, is_direction};
use crate::error::ShadingError;
use crate::image::{Entries, check_len, check_texels, texel_count};
use crate::math::{atan2, cos, floor, sin, sqrt};

/// The maximum number of texels of an image.
pub(super) const MAX_TEXELS: usize = 1 << 28;

/// The largest channel value, so that sums over the largest image stay within `f32`.
const BRIGHTEST: f32 = 1e30;

/// A latitude–longitude image of linear radiance, with owned or borrowed texels.
///
/// ```text
/// x = ½ − atan2(ω_y, ω_x)/2π,   y = θ/π = atan2(√(ω_x² + ω_y²), ω_z)/π          from the upper left, in sides of the image
/// ```
///
/// - **Layout:** texel `row · width + column` has its center at `x = (column + ½)/width`, `y =
///   (row + ½)/height`. The first row is at the zenith. The middle of the image faces +x and its
///   right half −y, as seen from inside.
/// - **Lookup:** bilinear in x and y between the centers. It wraps in x. Beyond the first and the
///   last row it blends to the mean of that row at the pole, so the radiance is continuous on the
///   whole sphere.
/// - **Samples:** the default of [`Environment`], uniform on the sphere. For samples by brightness
///   use an [`EnvironmentMap`](super::EnvironmentMap).
///
/// ```
/// use asperity_shading::environment::LatitudeLongitude;
/// use asperity_shading::{Environment, glam::Vec3};
///
/// // A bright zenith over a dark ground.
/// let texels = [Vec3::splat(3.0), Vec3::ONE];
/// let image = LatitudeLongitude::new(1, 2, &texels[..])?;
/// assert_eq!(image.radiance(Vec3::Z), Vec3::splat(3.0));
/// assert!((image.radiance(Vec3::Y) - Vec3::splat(2.0)).length() < 1e-5);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatitudeLongitude<S = Entries<Vec3>> {
    width: usize,
    height: usize,
    texels: S,
    /// The radiance at the zenith and at the nadir.
    poles: [Vec3; 2],
}

/// A point of the image between rows and columns of centers.
///
/// Row 0 and row `height + 1` are the poles.
#[derive(Clone, Copy, Debug)]
pub(super) struct ImagePosition {
    /// The rows `strip` and `strip + 1`.
    pub(super) strip: usize,
    /// Fraction of the height of the row above the direction, by angle, in [0, 1].
    pub(super) down: f32,
    /// The columns `column` and the next.
    pub(super) column: usize,
    /// Fraction of the width of the column before the direction, in [0, 1].
    pub(super) along: f32,
    /// The angle to the zenith.
    pub(super) theta: f32,
}

impl LatitudeLongitude<&[Vec3]> {
    /// The unit direction of the center of a texel in an image of this size.
    ///
    /// Columns and rows beyond the image continue around the sphere; a size of 0 returns (1, 0, 0).
    #[must_use]
    pub fn direction(width: usize, height: usize, column: usize, row: usize) -> Vec3 {
        if width == 0 || height == 0 {
            return Vec3::X;
        }
        let theta = PI * ((row as f32 + 0.5) / height as f32);
        let phi = PI - TAU * ((column as f32 + 0.5) / width as f32);
        Vec3::new(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta))
    }
}

impl<S: Deref<Target = [Vec3]>> LatitudeLongitude<S> {
    /// Creates the image from these texels.
    ///
    /// # Errors
    /// [`ShadingError`] for an image without texels or with more than 2²⁸, a slice of another
    /// length, and the first texel with a channel that is negative, NaN or above 10³⁰.
    pub fn new(width: usize, height: usize, texels: S) -> Result<Self, ShadingError> {
        check_len("texels", texel_count(width, height, MAX_TEXELS)?, texels.len())?;
        check_texels("texels", texels.iter().copied(), "between 0 and 1e30 in each component", |texel| {
            texel.cmpge(Vec3::ZERO).all() && texel.cmple(Vec3::splat(BRIGHTEST)).all()
        })?;
        let mean = |row: Option<&[Vec3]>| {
            row.unwrap_or_default().iter().fold(Vec3::ZERO, |sum, texel| sum + *texel / width as f32)
        };
        let poles = [mean(texels.get(..width)), mean(texels.get(texels.len() - width..))];
        Ok(Self { width, height, texels, poles })
    }

    /// The number of columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// The number of rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// The texels, row by row.
    #[must_use]
    pub fn texels(&self) -> &[Vec3] {
        &self.texels
    }

    /// The image, borrowed.
    #[inline]
    pub(super) fn view(&self) -> LatitudeLongitude<&[Vec3]> {
        LatitudeLongitude { width: self.width, height: self.height, texels: &self.texels, poles: self.poles }
    }

    /// The value at a center, or at a pole.
    #[inline]
    pub(super) fn node(&self, row: usize, column: usize) -> Vec3 {
        if row == 0 {
            self.poles[0]
        } else if row > self.height {
            self.poles[1]
        } else {
            self.texels.get((row - 1) * self.width + column).copied().unwrap_or_default()
        }
    }

    /// The angle to the zenith of a row of centers, or of a pole.
    #[inline]
    pub(super) fn theta(&self, row: usize) -> f32 {
        if row == 0 {
            0.0
        } else if row > self.height {
            PI
        } else {
            PI * (row as f32 - 0.5) / self.height as f32
        }
    }

    /// The position of a direction on the image; `None` for an invalid direction.
    #[inline]
    pub(super) fn place(&self, direction: Vec3) -> Option<ImagePosition> {
        if !is_direction(direction) {
            return None;
        }
        // Scaled, because squares of large and small components leave the range of `f32`.
        let Vec3 { x, y, z } = direction / direction.abs().max_element();
        let theta = atan2(sqrt(x * x + y * y), z);
        let row = theta * (self.height as f32 / PI) + 0.5;
        let strip = (floor(row) as usize).min(self.height);
        let (above, below) = (self.theta(strip), self.theta(strip + 1));
        let across = (0.5 - atan2(y, x) / TAU) * self.width as f32 - 0.5;
        let left = floor(across);
        Some(ImagePosition {
            strip,
            down: ((theta - above) / (below - above)).clamp(0.0, 1.0),
            // −1 is the last column, and `width` the first.
            column: (left as i64).rem_euclid(self.width as i64) as usize,
            along: (across - left).clamp(0.0, 1.0),
            theta,
        })
    }

    /// The next column.
    #[inline]
    pub(super) fn next(&self, column: usize) -> usize {
        if column + 1 < self.width { column + 1 } else { 0 }
    }
}

#[cfg(feature = "alloc")]
impl LatitudeLongitude<Vec<Vec3>> {
    /// Creates an image of `width · height` checked texels with these radiances at zenith and
    /// nadir.
    pub(super) const fn with_poles(width: usize, height: usize, texels: Vec<Vec3>, poles: [Vec3; 2]) -> Self {
        Self { width, height, texels, poles }
    }
}

impl<S: Deref<Target = [Vec3]>> Environment for LatitudeLongitude<S> {
    #[inline]
    fn radiance(&self, direction: Vec3) -> Vec3 {
        let Some(place) = self.place(direction) else { return Vec3::ZERO };
        let next = self.next(place.column);
        let row = |row| self.node(row, place.column).lerp(self.node(row, next), place.along);
        row(place.strip).lerp(row(place.strip + 1), place.down).max(Vec3::ZERO)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use asperity_core::assert_abs_diff_eq;
    use std::string::ToString;

    const SIZE: [usize; 2] = [8, 4];

    fn texels() -> [Vec3; 32] {
        core::array::from_fn(|k| Vec3::new(k as f32, ((k * 7) % 32) as f32, ((k * 13) % 5) as f32))
    }

    #[test]
    fn radiance_at_centers_is_the_texel() {
        let (texels, [width, height]) = (texels(), SIZE);
        let image = LatitudeLongitude::new(width, height, &texels[..]).unwrap();
        for (k, texel) in texels.into_iter().enumerate() {
            let direction = LatitudeLongitude::direction(width, height, k % width, k / width);
            assert_abs_diff_eq!(image.radiance(direction), texel, epsilon = 2e-4, "{k}");
            // Directions of any length.
            for scale in [1e-38, 1e-3, 1e38] {
                assert_abs_diff_eq!(image.radiance(direction * scale), texel, epsilon = 2e-4, "{k}, {scale}");
            }
        }
        // As seen from inside: the middle of an upright image faces +x, its right half −y.
        let front = LatitudeLongitude::direction(2, 1, 1, 0);
        assert!(front.y < -0.99 && LatitudeLongitude::direction(3, 1, 1, 0).x > 0.99, "{front}");
    }

    #[test]
    fn radiance_is_continuous_at_the_seam_and_at_the_poles() {
        let texels = texels();
        let image = LatitudeLongitude::new(SIZE[0], SIZE[1], &texels[..]).unwrap();
        for k in 0..200 {
            let theta = 0.0157 * k as f32;
            let seam = |y: f32| image.radiance(Vec3::new(-theta.sin(), y, theta.cos()));
            assert_abs_diff_eq!(seam(1e-6), seam(-1e-6), epsilon = 2e-3, "{theta}");
            let (sin, cos) = (0.0314 * k as f32).sin_cos();
            for (z, first) in [(1.0, 0), (-1.0, 24)] {
                let mean = texels[first..first + 8].iter().sum::<Vec3>() / 8.0;
                let near = image.radiance(Vec3::new(1e-5 * cos, 1e-5 * sin, z));
                assert_abs_diff_eq!(near, mean, epsilon = 1e-3, "{k}");
            }
        }
        assert_eq!(image.radiance(Vec3::Z), image.poles[0]);
        assert_eq!(image.radiance(Vec3::NEG_Z), image.poles[1]);
    }

    #[test]
    fn radiance_accepts_every_direction() {
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1e-45, 3e38, -1.0];
        for (texels, size) in [(&texels()[..], SIZE), (&[Vec3::ONE][..], [1, 1])] {
            let image = LatitudeLongitude::new(size[0], size[1], texels).unwrap();
            for (x, y) in bad.into_iter().flat_map(|x| bad.map(|y| (x, y))) {
                for z in bad {
                    let direction = Vec3::new(x, y, z);
                    let radiance = image.radiance(direction);
                    assert!(radiance.is_finite() && radiance.min_element() >= 0.0, "{direction}: {radiance}");
                    assert!(is_direction(direction) || radiance == Vec3::ZERO, "{direction}: {radiance}");
                }
            }
        }
    }

    #[test]
    fn new_rejects_invalid_images() {
        let refused = |width, height, texels: &[Vec3]| {
            LatitudeLongitude::new(width, height, texels).unwrap_err().to_string()
        };
        assert_eq!(refused(0, 4, &[]), "`width · height` must be between 1 and 268435456, got 0");
        assert_eq!(
            refused(1 << 27, 4, &[]),
            "`width · height` must be between 1 and 268435456, got 536870912"
        );
        assert_eq!(refused(2, 2, &[Vec3::ONE; 3]), "`texels` must have 4 elements, got 3");
        assert_eq!(
            refused(1, 2, &[Vec3::ONE, Vec3::new(0.0, f32::NAN, 1.0)]),
            "`texels[1]` must be between 0 and 1e30 in each component, got [0, NaN, 1]"
        );
        assert_eq!(
            refused(1, 1, &[Vec3::new(0.0, -0.5, 1.0)]),
            "`texels[0]` must be between 0 and 1e30 in each component, got [0, -0.5, 1]"
        );
        assert!(LatitudeLongitude::new(1, 1, &[Vec3::splat(-0.0)][..]).is_ok());
    }
}
