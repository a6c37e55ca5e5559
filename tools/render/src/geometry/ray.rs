//! Rays with differentials, and their hits: surface points with frames.

use asperity_shading::{Footprint, PixelEllipse, SurfacePoint};
use glam::{Mat3, Vec2, Vec3};

/// A ray and its derivatives per pixel, to the right and down.
///
/// Igehy 1999, "Tracing Ray Differentials".
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    pub origin: Vec3,
    /// Unit length.
    pub direction: Vec3,
    pub origin_by: [Vec3; 2],
    pub direction_by: [Vec3; 2],
}

impl Ray {
    /// Returns the derivatives of the position at a hit: the pixel's footprint in the tangent
    /// plane.
    pub fn spread(&self, hit: &Hit) -> [Vec3; 2] {
        let along = self.direction / self.direction.dot(hit.normal);
        let moved = |k: usize| self.origin_by[k] + hit.t * self.direction_by[k];
        let spread = |moved: Vec3| moved - along * moved.dot(hit.normal);
        [spread(moved(0)), spread(moved(1))]
    }

    /// Returns the round footprint of a pixel at a hit: as wide as the ray's cone, elongated by the
    /// inclination.
    pub fn footprint(&self, hit: &Hit) -> Footprint {
        let [dx, dy] = [0, 1].map(|k| self.origin_by[k] + hit.t * self.direction_by[k]);
        let cone = Footprint::from_derivatives(dx, dy).width();
        Footprint::from_distance(1.0, cone, self.direction.dot(hit.normal))
    }

    /// Returns the ray that continues from `origin` behind a hit: straight on, or refracted by the
    /// ratio of the sines.
    pub fn transmitted(&self, hit: &Hit, direction: Vec3, origin: Vec3) -> Self {
        let [before, behind] = [self.direction, direction].map(|d| d.cross(hit.normal).length());
        // Within half a degree of the normal the sines are too imprecise, but rays hardly bend
        // there.
        let eta = if before > 0.01 { (behind / before).clamp(0.25, 4.0) } else { 1.0 };
        let straight =
            Self { origin, direction, origin_by: self.spread(hit), direction_by: self.direction_by };
        let m = (eta * self.direction - direction).try_normalize();
        let m = m.map(|m| if m.dot(self.direction) > 0.0 { -m } else { m });
        match m.and_then(|m| self.refracted(hit, m, eta, origin)) {
            Some(bent) => Self { direction, ..bent },
            None => straight,
        }
    }

    /// Returns the ray reflected at a hit by a facet of normal `m`, from `origin`. Its
    /// differentials include the surface's curvature.
    pub fn mirrored(&self, hit: &Hit, m: Vec3, origin: Vec3) -> Self {
        self.turned(hit, m, 1.0, [2.0 * self.direction.dot(m), 2.0], origin)
    }

    /// Returns the ray refracted by a facet of normal `m`, which points toward the ray. `eta` is
    /// the ratio of the index in front to the index behind. Returns `None` for total internal
    /// reflection.
    pub fn refracted(&self, hit: &Hit, m: Vec3, eta: f32, origin: Vec3) -> Option<Self> {
        let cosine = self.direction.dot(m);
        let square = 1.0 - eta * eta * (1.0 - cosine * cosine);
        if square <= 0.0 {
            return None;
        }
        let behind = -square.sqrt();
        let mu = [eta * cosine - behind, eta - eta * eta * cosine / behind];
        Some(self.turned(hit, m, eta, mu, origin))
    }

    /// Returns the ray in direction η D − μ m, given μ and its derivative by D·m.
    fn turned(&self, hit: &Hit, m: Vec3, eta: f32, [mu, by_cosine]: [f32; 2], origin: Vec3) -> Self {
        let spread = self.spread(hit);
        let by = |k: usize| {
            // Change of the unit normal over the step along the surface.
            let turn = hit.bend * spread[k];
            let turn = turn - hit.normal * turn.dot(hit.normal);
            let by = self.direction_by[k].dot(m) + self.direction.dot(turn);
            eta * self.direction_by[k] - (mu * turn + by_cosine * by * m)
        };
        let direction = (eta * self.direction - mu * m).normalize();
        Self { origin, direction, origin_by: spread, direction_by: [by(0), by(1)] }
    }

    /// Returns a ray from a hit in any direction, with a cone of this angle.
    pub fn scattered(&self, hit: &Hit, direction: Vec3, angle: f32, origin: Vec3) -> Self {
        let (x, y) = direction.any_orthonormal_pair();
        Self { origin, direction, origin_by: self.spread(hit), direction_by: [angle * x, angle * y] }
    }
}

/// Hit of a ray on a shape.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Ray parameter: the distance for a unit direction.
    pub t: f32,
    /// Relative to the focus of its [`Probe`](crate::geometry::mesh::Probe).
    pub position: Vec3,
    /// Unit length, outward.
    pub normal: Vec3,
    /// Unit length, outward; for a triangle the geometric normal, independent of the normals of its
    /// corners.
    pub flat: Vec3,
    /// Offsets from the triangle to the smooth surface implied by its normals, outward and inward.
    /// Light rays start there.
    pub lift: [Vec3; 2],
    /// Unit length, orthogonal to the normal; the local x axis of an anisotropic density.
    pub tangent: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
    /// The index of a triangle of a mesh, and the weights of its corners.
    pub triangle: Option<(u32, [f32; 3])>,
    /// ∂P/∂u and ∂P/∂v.
    pub tangents: [Vec3; 2],
    /// Curvature as the derivative of the normal along the surface: dn = bend · dP, before
    /// normalization.
    pub bend: Mat3,
}

impl Hit {
    /// Returns the hit with normals facing the origin of a ray in `direction`, so that the inside
    /// of a spout is shaded like the outside.
    pub fn flip_to_visible(self, direction: Vec3) -> Self {
        let mut hit = self.consistent(direction);
        if hit.flat.dot(direction) > 0.0 {
            (hit.normal, hit.flat, hit.bend) = (-hit.normal, -hit.flat, -hit.bend);
            hit.lift.swap(0, 1);
        }
        hit
    }

    /// Returns the hit with its shading normal on the visible side of the geometric normal. At
    /// silhouettes the interpolated normal may point away from a viewer who sees the triangle,
    /// which would be lit from behind.
    pub fn consistent(mut self, direction: Vec3) -> Self {
        /// Cosine at which a normal is barely visible.
        const GRAZING: f32 = 0.01;
        let side = self.flat.dot(direction).signum();
        let cosine = side * self.normal.dot(direction);
        if cosine < GRAZING && self.flat.dot(direction).abs() > GRAZING {
            self.normal = (self.normal + side * (GRAZING - cosine) * direction).normalize_or(self.flat);
        }
        self
    }

    /// Returns the point for evaluating a material, with its pixel.
    pub fn point(&self, pixel: impl Into<PixelEllipse>) -> SurfacePoint {
        SurfacePoint::new(self.position, self.normal, pixel).with_uv(self.uv, self.tangents)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{camera::Camera, shape::Shape};

    /// Returns the ray of the pixel after the sphere.
    fn after(camera: &Camera, x: f32, y: f32, eta: Option<f32>) -> Ray {
        let ray = camera.ray(x, y);
        let hit = Shape::Sphere.intersect(ray.origin, ray.direction).unwrap();
        match eta {
            Some(eta) => ray.refracted(&hit, hit.normal, eta, hit.position).unwrap(),
            None => ray.mirrored(&hit, hit.normal, hit.position),
        }
    }

    #[test]
    fn differentials_at_a_sphere_match_neighboring_rays() {
        let camera = Camera::new(Vec3::new(4.0, -1.0, 2.0), Vec3::ZERO, 0.6, 200, 200);
        for eta in [None, Some(1.0 / 1.5)] {
            for (x, y) in [(100.0, 100.0), (140.0, 80.0), (60.0, 120.0)] {
                let ray = after(&camera, x, y, eta);
                for (k, [dx, dy]) in [[0.5, 0.0], [0.0, 0.5]].into_iter().enumerate() {
                    let (a, b) = (after(&camera, x + dx, y + dy, eta), after(&camera, x - dx, y - dy, eta));
                    let (origin, direction) = (a.origin - b.origin, a.direction - b.direction);
                    // Second derivatives over half a pixel of 3 mrad, at up to 50 degrees.
                    assert!(
                        (ray.origin_by[k] - origin).length() < 0.002 * origin.length(),
                        "{eta:?}, {x}, {y}"
                    );
                    assert!(
                        (ray.direction_by[k] - direction).length() < 0.002 * direction.length(),
                        "{eta:?}, {x}, {y}: {} {direction}",
                        ray.direction_by[k]
                    );
                }
            }
        }
    }

    #[test]
    fn grazing_ray_inside_glass_is_totally_reflected() {
        let camera = Camera::new(Vec3::new(4.0, -1.0, 2.0), Vec3::ZERO, 0.6, 200, 200);
        let ray = camera.ray(30.0, 100.0);
        let hit = Shape::Plane.intersect(ray.origin, ray.direction).unwrap();
        assert!(ray.refracted(&hit, hit.normal, 3.0, hit.position).is_none());
    }
}
