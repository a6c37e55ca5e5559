//! Hits of rays: points of surfaces with their frames.

use asperity_shading::{PixelEllipse, SurfacePoint};
use glam::{Mat3, Vec2, Vec3};

/// Hit of a ray on a shape.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Ray parameter, the distance for a unit direction.
    pub t: f32,
    pub position: Vec3,
    /// Unit, outwards.
    pub normal: Vec3,
    /// Unit, orthogonal to the normal; the local x axis of an anisotropic density.
    pub tangent: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
    /// ∂P/∂u and ∂P/∂v.
    pub tangents: [Vec3; 2],
    /// Curvature, by the turn of the normal along the surface: dn = bend · dP, before it is made unit.
    pub bend: Mat3,
}

impl Hit {
    /// The point with its normal turned towards the eye of a ray in `direction`: the inside of a spout is
    /// shaded like the outside.
    pub fn facing(mut self, direction: Vec3) -> Self {
        if self.normal.dot(direction) > 0.0 {
            self.normal = -self.normal;
            self.bend = -self.bend;
        }
        self
    }

    /// The point at which a material is evaluated, with its pixel.
    pub fn point(&self, pixel: impl Into<PixelEllipse>) -> SurfacePoint {
        SurfacePoint::new(self.position, self.normal, pixel).with_uv(self.uv, self.tangents)
    }
}
