//! The elliptic footprint of a pixel, and the round footprints that cover it.

use glam::{Vec2, Vec3};

use crate::math::sqrt;
use crate::pixel::footprint::Footprint;

/// Elliptic footprint of a pixel on a surface seen at an angle.
///
/// A texture with round footprints blurs too much along the short axis if it uses the long one, and
/// aliases if it uses the short one. A few round footprints along the long axis solve both, as in
/// anisotropic texture filtering.
///
/// ```
/// use asperity_shading::{PixelEllipse, glam::Vec3};
///
/// // A pixel twelve times as long as it is wide, in taps of a quarter of that.
/// let pixel = PixelEllipse::from_derivatives(Vec3::new(0.01, 0.0, 0.0), Vec3::new(0.0, 0.12, 0.0));
/// let taps: Vec<Vec3> = pixel.taps(4).map(|tap| tap.offset).collect();
/// assert_eq!(taps.len(), 4);
/// assert!((taps[3] - taps[0]).length() - 0.09 < 1e-6);
/// assert!(pixel.taps(4).all(|tap| (tap.footprint.width() - 0.03).abs() < 1e-6));
/// ```
#[doc(alias = "anisotropic filtering")]
#[doc(alias = "ewa")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelEllipse {
    /// The long axis, with the length of the pixel.
    major: Vec3,
    /// The short axis, with the width of the pixel.
    minor: Vec3,
    /// Widths along the long and the short axis.
    widths: [Footprint; 2],
}

/// One of the round footprints that cover a [`PixelEllipse`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tap {
    /// The offset of its center from the center of the pixel.
    pub offset: Vec3,
    /// Its width.
    pub footprint: Footprint,
}

impl PixelEllipse {
    /// The ellipse spanned by the screen-space derivatives of the surface position.
    ///
    /// They are for one pixel to the right and one down.
    ///
    /// ```text
    /// [dx dy] = U diag(σ₁, σ₂) Vᵀ,   major axis σ₁ u₁, minor width σ₂
    /// ```
    ///
    /// Non-finite derivatives return a pixel that resolves nothing.
    #[must_use]
    pub fn from_derivatives(dx: Vec3, dy: Vec3) -> Self {
        let scale = dx.abs().max_element().max(dy.abs().max_element());
        if !(scale > 0.0 && dx.is_finite() && dy.is_finite()) {
            return Footprint::from_derivatives(dx, dy).into();
        }
        let (dx, dy) = (dx / scale, dy / scale);
        let (e, f, g) = (dx.dot(dx), dx.dot(dy), dy.dot(dy));
        let root = sqrt((e - g) * (e - g) + 4.0 * f * f);
        let long = 0.5 * (e + g + root);
        // The eigenvector by its larger component. The smaller eigenvalue is from the determinant,
        // which keeps its digits.
        let (x, y) = if e > g { (0.5 * (e - g + root), f) } else { (f, 0.5 * (g - e + root)) };
        // All axes of a circle are equal.
        let (x, y) = if x == 0.0 && y == 0.0 { (1.0, 0.0) } else { (x, y) };
        let major = (x * dx + y * dy).normalize_or_zero() * sqrt(long);
        let cross = dx.cross(dy);
        let short = sqrt(cross.dot(cross)) / sqrt(long);
        let minor = cross.cross(major).normalize_or_zero() * short;
        Self {
            major: scale * major,
            minor: scale * minor,
            widths: [sqrt(long), short].map(|w| Footprint::from_width(scale * w)),
        }
    }

    /// An axis-aligned pixel of these widths in the plane of texture coordinates.
    ///
    /// The plane is the first two components.
    ///
    /// A NaN width is read as infinite, a negative width as its magnitude.
    #[must_use]
    pub fn aligned(widths: Vec2) -> Self {
        let [u, v] = widths.to_array().map(|width| Footprint::from_width(width).width());
        let (along_u, along_v) = (Vec3::new(u, 0.0, 0.0), Vec3::new(0.0, v, 0.0));
        let [major, minor] = if u >= v { [along_u, along_v] } else { [along_v, along_u] };
        Self { major, minor, widths: [u.max(v), u.min(v)].map(Footprint::from_width) }
    }

    /// The doubled semi-axes, long and short; zero vectors for a round footprint.
    #[must_use]
    pub const fn axes(&self) -> [Vec3; 2] {
        [self.major, self.minor]
    }

    /// The pixel scaled with its surface by this factor.
    #[must_use]
    pub fn scaled(&self, by: f32) -> Self {
        let widths = self.widths.map(|width| Footprint::from_width(width.width() * by));
        Self { major: self.major * by, minor: self.minor * by, widths }
    }

    /// Returns the maximum change of a function with this gradient across the pixel; ∞ for an
    /// invalid gradient.
    #[must_use]
    pub fn change(&self, gradient: Vec3) -> f32 {
        let round = self.major == Vec3::ZERO;
        let change = if round {
            gradient.length() * self.widths[0].width()
        } else {
            gradient.dot(self.major).abs() + gradient.dot(self.minor).abs()
        };
        if gradient != Vec3::ZERO && change >= 0.0 { change } else { f32::INFINITY }
    }

    /// Returns the sides of the bounding box of a pixel in the plane of texture coordinates.
    #[must_use]
    pub fn sides(&self) -> Vec2 {
        if self.major == Vec3::ZERO {
            Vec2::splat(self.widths[0].width())
        } else {
            (self.major.abs() + self.minor.abs()).truncate()
        }
    }

    /// The width along the long axis.
    #[must_use]
    pub const fn long(&self) -> Footprint {
        self.widths[0]
    }

    /// The width along the short axis.
    #[must_use]
    pub const fn short(&self) -> Footprint {
        self.widths[1]
    }

    /// Equal round footprints along the long axis that cover the pixel: offsets from its center,
    /// and width.
    ///
    /// Their number is the ratio of the axes, at least 1 and at most `most` (and 64). They are
    /// evenly spaced, and as wide as the short axis or their spacing, whichever is larger. The
    /// pixel sees the mean of a texture over them.
    pub fn taps(&self, most: u32) -> impl Iterator<Item = Tap> + use<> {
        let [long, short] = self.widths.map(|width| width.width());
        let ratio = long / short;
        let most = most.clamp(1, 64);
        // A pixel without an axis, or without bounds, is one tap.
        let count = if self.major == Vec3::ZERO {
            1
        } else if ratio < most as f32 {
            // The cast of NaN is 0.
            (ratio + 0.999) as u32
        } else {
            most
        };
        let count = count.max(1);
        let width = Footprint::from_width(if count == 1 { long } else { short.max(long / count as f32) });
        let major = self.major;
        (0..count)
            .map(move |k| Tap { offset: major * ((k as f32 + 0.5) / count as f32 - 0.5), footprint: width })
    }

    /// Twice as many taps along either axis, half as wide, if there are enough.
    ///
    /// For textures whose mean over a pixel is closer to the mean of its four quarters than to a
    /// single wide footprint.
    ///
    /// Up to `most` (and 64) on one or two lines along the long axis. Two lines for pixels with an
    /// axis ratio of at most a quarter of `most`; otherwise as [`taps`](Self::taps).
    ///
    /// ```
    /// use asperity_shading::{PixelEllipse, glam::Vec3};
    ///
    /// let pixel = PixelEllipse::from_derivatives(Vec3::new(0.01, 0.0, 0.0), Vec3::new(0.0, 0.01, 0.0));
    /// assert_eq!(pixel.fine_taps(32).count(), 4);
    /// assert!(pixel.fine_taps(32).all(|tap| (tap.footprint.width() - 0.005).abs() < 1e-6));
    /// ```
    pub fn fine_taps(&self, most: u32) -> impl Iterator<Item = Tap> + use<> {
        let [long, short] = self.widths.map(|width| width.width());
        let most = most.clamp(1, 64);
        // Written so that NaN, from a pixel without an axis, has one line.
        let two = 4.0 * long <= most as f32 * short && self.minor != Vec3::ZERO;
        let (lines, across) = if two { (2, Footprint::from_width(0.5 * short)) } else { (1, self.widths[1]) };
        let line = Self { widths: [self.widths[0], across], ..*self };
        let minor = self.minor;
        (0..lines).flat_map(move |k| {
            let aside = minor * ((k as f32 + 0.5) / lines as f32 - 0.5);
            line.taps(most / lines).map(move |tap| Tap { offset: aside + tap.offset, ..tap })
        })
    }
}

/// A round pixel.
impl From<Footprint> for PixelEllipse {
    fn from(footprint: Footprint) -> Self {
        Self { major: Vec3::ZERO, minor: Vec3::ZERO, widths: [footprint; 2] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn axes_are_the_singular_values() {
        // A rotated and stretched circle: P = U diag(3, 0.5) Vᵀ.
        for k in 0..40 {
            let (a, b) = (0.3 * k as f32, 0.71 * k as f32);
            let (u1, u2) = (Vec3::new(a.cos(), a.sin(), 0.0), Vec3::new(-a.sin(), a.cos(), 0.0));
            let (dx, dy) = (3.0 * b.cos() * u1 - 0.5 * b.sin() * u2, 3.0 * b.sin() * u1 + 0.5 * b.cos() * u2);
            let pixel = PixelEllipse::from_derivatives(dx, dy);
            assert_abs_diff_eq!(pixel.long().width(), 3.0, epsilon = 1e-5, "{k}");
            assert_abs_diff_eq!(pixel.short().width(), 0.5, epsilon = 1e-5, "{k}");
            assert!(pixel.major.cross(3.0 * u1).length() < 1e-4, "{k}: {pixel:?}");
            assert_eq!(pixel.long(), Footprint::from_derivatives(dx, dy));
        }
    }

    #[test]
    fn taps_cover_the_long_axis() {
        let pixel = PixelEllipse::from_derivatives(Vec3::new(0.2, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0));
        for (most, count) in [(1, 1), (3, 3), (5, 5), (16, 5), (0, 1)] {
            assert_eq!(pixel.taps(most).count(), count, "{most}");
            let sum: Vec3 = pixel.taps(most).map(|tap| tap.offset).sum();
            assert!(sum.length() < 1e-6);
            let width = 1.0 / count as f32;
            assert!(pixel.taps(most).all(|tap| (tap.footprint.width() - width).abs() < 1e-6), "{most}");
        }
    }

    #[test]
    fn invalid_pixels_resolve_nothing() {
        for bad in [Vec3::NAN, Vec3::INFINITY, Vec3::new(0.0, f32::NAN, 0.0)] {
            let pixel = PixelEllipse::from_derivatives(bad, Vec3::X);
            assert_eq!(pixel.long().width(), f32::INFINITY, "{bad}");
            assert_eq!(pixel.taps(8).count(), 1);
        }
        let point = PixelEllipse::from_derivatives(Vec3::ZERO, Vec3::ZERO);
        assert!(point.taps(8).eq([Tap { offset: Vec3::ZERO, footprint: Footprint::from_width(0.0) }]));
        let line = PixelEllipse::from_derivatives(Vec3::X, Vec3::ZERO);
        assert_eq!((line.short().width(), line.taps(8).count()), (0.0, 8));
        for scale in [1e-30, 1e30] {
            let pixel = PixelEllipse::from_derivatives(scale * Vec3::X, 2.0 * scale * Vec3::Y);
            assert_abs_diff_eq!(pixel.short().width() / scale, 1.0, epsilon = 1e-5);
        }
    }
}
