//! The surface point at which a material is evaluated.

use asperity_ndf_sampling::Frame;
use glam::{Vec2, Vec3};

use crate::bump::surface_gradient;
use crate::pixel::{Footprint, PixelEllipse, Tap};

/// A surface point with its pixel: the input of every material.
///
/// ```
/// use asperity_shading::{Footprint, SurfacePoint, glam::Vec3};
///
/// let point = SurfacePoint::new(Vec3::new(0.2, 0.1, 0.5), Vec3::Z, Footprint::from_width(1e-3));
/// assert_eq!((point.tangents, point.footprint().width()), ([Vec3::X, Vec3::Y], 1e-3));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The position in model space, at which noises are sampled.
    pub position: Vec3,
    /// The unit normal of the surface without bumps.
    pub normal: Vec3,
    /// The texture coordinates, the domain of seams, scratches, fibers and bricks.
    pub uv: Vec2,
    /// `∂P/∂u` and `∂P/∂v`.
    pub tangents: [Vec3; 2],
    /// The pixel on the surface.
    pub pixel: PixelEllipse,
}

impl SurfacePoint {
    /// Creates a point without texture coordinates.
    ///
    /// `uv` is 0, and the tangents are those of [`Frame::from_normal`].
    ///
    /// The pixel is a [`Footprint`] or a [`PixelEllipse`].
    #[must_use]
    pub fn new(position: Vec3, normal: Vec3, pixel: impl Into<PixelEllipse>) -> Self {
        let frame = Frame::from_normal(normal);
        let tangents = [frame.tangent, frame.bitangent];
        Self { position, normal: frame.normal, uv: Vec2::ZERO, tangents, pixel: pixel.into() }
    }

    /// Adds texture coordinates and the derivatives of the position by them.
    #[must_use]
    pub fn with_uv(self, uv: Vec2, tangents: [Vec3; 2]) -> Self {
        Self { uv, tangents, ..self }
    }

    /// Scales the surface, including texture coordinates.
    ///
    /// For example 0.01 for a scene in centimeters and a material in meters.
    #[must_use]
    pub fn scaled(self, by: f32) -> Self {
        Self { position: self.position * by, uv: self.uv * by, pixel: self.pixel.scaled(by), ..self }
    }

    /// The width of the pixel: its long axis.
    #[must_use]
    pub const fn footprint(&self) -> Footprint {
        self.pixel.long()
    }

    /// Points with round footprints along the long axis of the pixel, to be averaged.
    ///
    /// See [`PixelEllipse::taps`].
    pub fn taps(self, most: u32) -> impl Iterator<Item = Self> {
        let [u, v] = self.texture().0;
        self.pixel.taps(most).map(move |Tap { offset, footprint }| {
            let moved = Vec2::new(u.dot(offset), v.dot(offset));
            let uv = if moved.is_finite() { self.uv + moved } else { self.uv };
            Self { position: self.position + offset, uv, pixel: footprint.into(), ..self }
        })
    }

    /// The frame of the surface without bumps, for the facets of a [`Bsdf`](crate::Bsdf).
    ///
    /// z is along the normal, and x as close to `∂P/∂u` as orthogonality permits.
    #[must_use]
    pub fn frame(&self) -> Frame {
        Frame::from_normal_tangent(self.normal, self.tangents[0])
    }

    /// The gradients of the texture coordinates.
    pub(crate) fn texture(&self) -> TextureGradients {
        TextureGradients([Vec2::X, Vec2::Y].map(|axis| surface_gradient(self.normal, self.tangents, axis)))
    }

    /// The change of a function with this gradient across the pixel; ∞ for an invalid gradient.
    pub(crate) fn change(&self, gradient: Vec3) -> f32 {
        self.pixel.change(gradient)
    }

    /// The pixel in texture coordinates, as a box along their axes.
    pub(crate) fn uv_pixel(&self) -> PixelEllipse {
        self.texture().pixel(&self.pixel)
    }
}

/// Gradients of u and v along a surface; zero where the tangents are parallel.
#[derive(Clone, Copy)]
pub(crate) struct TextureGradients([Vec3; 2]);

impl TextureGradients {
    /// The surface gradient of a function with this slope in texture coordinates; zero if it is not
    /// finite.
    pub(crate) fn of(&self, slope: Vec2) -> Vec3 {
        let [u, v] = self.0;
        let gradient = u * slope.x + v * slope.y;
        if gradient.is_finite() { gradient } else { Vec3::ZERO }
    }

    /// A pixel in texture coordinates, as a box along their axes.
    pub(crate) fn pixel(&self, pixel: &PixelEllipse) -> PixelEllipse {
        let [u, v] = self.0.map(|gradient| pixel.change(gradient));
        PixelEllipse::aligned(Vec2::new(u, v))
    }

    /// The width of a pixel in texture coordinates: the larger of the changes of u and of v across
    /// it.
    pub(crate) fn width(&self, pixel: &PixelEllipse) -> f32 {
        self.pixel(pixel).long().width()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn taps_have_interpolated_texture_coordinates() {
        // Half a unit of u and a quarter of v per unit of length, on a slope.
        let tangents = [Vec3::new(1.2, 0.0, 1.6), Vec3::new(0.0, 4.0, 0.0)];
        let normal = Vec3::new(-0.8, 0.0, 0.6);
        let pixel = PixelEllipse::from_derivatives(Vec3::new(0.24, 0.4, 0.32), Vec3::new(0.06, -0.1, 0.08));
        let point = SurfacePoint::new(Vec3::ONE, normal, pixel).with_uv(Vec2::new(0.25, 0.75), tangents);
        let (mut middle, mut count) = (Vec3::ZERO, 0.0);
        for tap in point.taps(8) {
            let moved = tap.uv - point.uv;
            let there = point.position + tangents[0] * moved.x + tangents[1] * moved.y;
            assert_abs_diff_eq!(tap.position, there, epsilon = 1e-6);
            assert_eq!((tap.normal, tap.tangents), (point.normal, point.tangents));
            assert_eq!(tap.footprint(), tap.pixel.short());
            middle += tap.position;
            count += 1.0;
        }
        assert!(count > 1.0 && count <= 8.0, "{count}");
        assert_abs_diff_eq!(middle / count, point.position, epsilon = 1e-6);
        // Degenerate tangents leave the coordinates unchanged.
        let nowhere = point.with_uv(Vec2::X, [Vec3::X, Vec3::X]);
        assert!(nowhere.taps(8).all(|tap| tap.uv == Vec2::X));
    }
}
