//! The footprint of a pixel on the surface.

use asperity_noise::filtered_fraction;
use glam::Vec3;

use crate::math::sqrt;

/// The width of a pixel on the surface: the longest axis of its footprint.
///
/// The width is in the unit of the surface positions, at least 0, and never NaN. Invalid footprints
/// are infinitely wide, so nothing is resolved and the surface is shaded from afar.
///
/// ```
/// use asperity_shading::{Footprint, glam::Vec3};
///
/// // A pixel of 1 mrad at a distance of 2, seen at 60°, is 4 mrad·m long.
/// let pixel = Footprint::from_distance(2.0, 1e-3, 0.5);
/// assert!((pixel.width() - 4e-3).abs() < 1e-9);
/// assert!(pixel.width() >= Footprint::from_distance(2.0, 1e-3, 1.0).width());
/// ```
#[doc(alias = "ray differential")]
#[doc(alias = "ddx")]
#[doc(alias = "ddy")]
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Footprint {
    width: f32,
}

impl Footprint {
    /// Creates a footprint of this width; negative widths are read as their magnitude, NaN as
    /// infinite.
    #[must_use]
    pub const fn from_width(width: f32) -> Self {
        Self { width: if width.is_nan() { f32::INFINITY } else { width.abs() } }
    }

    /// The footprint of a pixel of `pixel_angle` radians at `distance`, on a surface seen at
    /// `cos_theta`.
    ///
    /// ```text
    /// width = distance · pixel_angle / |cos θ|
    /// ```
    ///
    /// `cos_theta` is the cosine between the direction to the eye and the surface normal; at the
    /// horizon the footprint is infinite. The width is the long axis of the pixel ellipse, so no
    /// direction on the surface is over-resolved.
    #[must_use]
    pub fn from_distance(distance: f32, pixel_angle: f32, cos_theta: f32) -> Self {
        Self::from_width(distance * pixel_angle / cos_theta)
    }

    /// The footprint spanned by the screen-space derivatives of the surface position.
    ///
    /// They are for one pixel to the right and one down.
    ///
    /// ```text
    /// width = σ₁ of [dx dy] = √(½ (E + G + √((E − G)² + 4 F²))),   E = dx·dx,  F = dx·dy,  G = dy·dy
    /// ```
    ///
    /// The largest singular value, between `max(|dx|, |dy|)` and √2 times it, is invariant to image
    /// rotation. The maximum alone misses the long axis of a pixel sheared along its diagonal. The
    /// derivatives come from ray differentials or from the positions seen by neighboring pixels.
    #[must_use]
    pub fn from_derivatives(dx: Vec3, dy: Vec3) -> Self {
        let scale = dx.abs().max_element().max(dy.abs().max_element());
        if scale == 0.0 {
            // `max` drops a NaN, which must not look like a point.
            return Self::from_width(if dx.is_nan() || dy.is_nan() { f32::NAN } else { 0.0 });
        }
        // Scaled, because squares of small or large derivatives leave the range of `f32`.
        let (dx, dy) = (dx / scale, dy / scale);
        let (e, f, g) = (dx.dot(dx), dx.dot(dy), dy.dot(dy));
        let root = sqrt((e - g) * (e - g) + 4.0 * f * f);
        Self::from_width(scale * sqrt(0.5 * (e + g + root)))
    }

    /// The kept fraction of an octave of noise with this frequency, in cells per unit of length.
    ///
    /// This is the smooth filter of two by the cells across the pixel, see
    /// [`FrequencyClamp`](crate::pixel::FrequencyClamp).
    ///
    /// ```text
    /// 1 − smoothstep(0.2, 0.6, width · frequency)
    /// ```
    ///
    /// [`filtered_fraction`] is the rest. Nilsson 2008, §4.1.6.
    #[must_use]
    pub fn kept(&self, frequency: f32) -> f32 {
        1.0 - filtered_fraction(self.width, frequency)
    }

    /// The width, in the unit of the surface positions.
    #[must_use]
    pub const fn width(&self) -> f32 {
        self.width
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn from_derivatives_is_the_longest_axis() {
        let cases = [
            (Vec3::X, Vec3::Y, 1.0),
            (2.0 * Vec3::X, 3.0 * Vec3::Z, 3.0),
            (Vec3::X, Vec3::X, core::f32::consts::SQRT_2),
            (Vec3::ZERO, Vec3::new(0.0, 0.3, 0.4), 0.5),
            (Vec3::ZERO, Vec3::ZERO, 0.0),
            (1e-30 * Vec3::X, 1e-30 * Vec3::Y, 1e-30),
            (1e30 * Vec3::X, 1e30 * Vec3::X, 1e30 * core::f32::consts::SQRT_2),
        ];
        for (dx, dy, expected) in cases {
            let width = Footprint::from_derivatives(dx, dy).width();
            assert_abs_diff_eq!(width, expected, epsilon = 1e-6 * expected, "{dx}, {dy}");
        }
    }

    #[test]
    fn width_is_invariant_to_image_rotation() {
        let (dx, dy) = (Vec3::new(1.0, 0.2, -0.3), Vec3::new(0.4, -0.1, 2.0));
        let width = Footprint::from_derivatives(dx, dy).width();
        for i in 0..32 {
            let (sin, cos) = (i as f32 * 0.2).sin_cos();
            let turned = Footprint::from_derivatives(cos * dx + sin * dy, cos * dy - sin * dx).width();
            assert_abs_diff_eq!(turned, width, epsilon = 2e-6 * width, "i = {i}");
        }
    }

    #[test]
    fn from_distance_equals_from_derivatives_on_a_slanted_plane() {
        // A pixel of 1 mrad at distance 5; the plane is tilted by 60° around the horizontal axis of
        // the pixel.
        let by_distance = Footprint::from_distance(5.0, 1e-3, 0.5).width();
        let dy = 5e-3 / 0.5 * Vec3::new(0.0, 0.5, 0.75_f32.sqrt());
        let by_derivatives = Footprint::from_derivatives(5e-3 * Vec3::X, dy).width();
        assert_abs_diff_eq!(by_distance, by_derivatives, epsilon = 1e-8);
    }

    #[test]
    fn invalid_footprints_are_infinitely_wide() {
        let unmeasured = [
            Footprint::from_width(f32::NAN),
            Footprint::from_width(f32::NEG_INFINITY),
            Footprint::from_distance(1.0, 1e-3, 0.0),
            Footprint::from_distance(0.0, 1e-3, 0.0),
            Footprint::from_distance(f32::INFINITY, 0.0, 1.0),
            Footprint::from_distance(1.0, f32::NAN, 1.0),
            Footprint::from_derivatives(Vec3::NAN, Vec3::X),
            Footprint::from_derivatives(Vec3::NAN, Vec3::ZERO),
            Footprint::from_derivatives(Vec3::X, Vec3::INFINITY),
        ];
        for (i, footprint) in unmeasured.into_iter().enumerate() {
            assert_eq!(footprint.width(), f32::INFINITY, "case {i}");
        }
        assert_eq!(Footprint::from_distance(-2.0, 1e-3, -0.5), Footprint::from_distance(2.0, 1e-3, 0.5));
    }
}
