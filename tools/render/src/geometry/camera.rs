//! Cameras: pinhole and orthographic.

use glam::{DVec3, Vec3};

use crate::geometry::ray::Ray;

/// A pinhole or orthographic camera.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    eye: DVec3,
    right: Vec3,
    up: Vec3,
    forward: Vec3,
    /// Side of a pixel; for a pinhole at distance 1.
    pixel: f32,
    center: [f32; 2],
    parallel: bool,
}

impl Camera {
    /// Creates a camera at `eye` that looks at `target`, z up, with `height` pixels over the full
    /// angle `field` in radians.
    pub fn new(eye: impl Into<DVec3>, target: impl Into<DVec3>, field: f32, width: u32, height: u32) -> Self {
        let eye = eye.into();
        let forward = (target.into() - eye).as_vec3().normalize_or(Vec3::NEG_Z);
        // Looking straight down there is no up direction along z: y is up in the image.
        let right = forward.cross(Vec3::Z).try_normalize().unwrap_or(Vec3::X);
        Self {
            eye,
            right,
            up: right.cross(forward),
            forward,
            pixel: 2.0 * (0.5 * field).tan() / height as f32,
            center: [0.5 * width as f32, 0.5 * height as f32],
            parallel: false,
        }
    }

    /// Creates an orthographic camera that looks from `eye` at `target`, with `height` pixels over
    /// the length `extent`.
    pub fn parallel(eye: Vec3, target: Vec3, extent: f32, width: u32, height: u32) -> Self {
        let pixel = extent / height as f32;
        Self { pixel, parallel: true, ..Self::new(eye, target, 1.0, width, height) }
    }

    /// Returns the camera with positions relative to `place`.
    pub fn about(self, place: DVec3) -> Self {
        Self { eye: self.eye - place, ..self }
    }

    /// Returns the unit direction through image point `(x, y)`, in pixels from the top left.
    pub fn direction(&self, x: f32, y: f32) -> Vec3 {
        let across = (x - self.center[0]) * self.pixel;
        let above = (self.center[1] - y) * self.pixel;
        (self.forward + self.right * across + self.up * above).normalize()
    }

    /// Returns the ray through image point `(x, y)` with its derivatives per pixel.
    pub fn ray(&self, x: f32, y: f32) -> Ray {
        if self.parallel {
            let (across, above) = (x - self.center[0], self.center[1] - y);
            return Ray {
                origin: self.eye.as_vec3() + self.pixel * (across * self.right + above * self.up),
                direction: self.forward,
                origin_by: [self.pixel * self.right, -self.pixel * self.up],
                direction_by: [Vec3::ZERO; 2],
            };
        }
        let direction = self.direction(x, y);
        // The direction is a vector of depth 1, normalized.
        let scale = self.pixel * direction.dot(self.forward);
        let by = |axis: Vec3| scale * (axis - direction * direction.dot(axis));
        Ray {
            origin: self.eye.as_vec3(),
            direction,
            origin_by: [Vec3::ZERO; 2],
            direction_by: [by(self.right), by(-self.up)],
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::geometry::shape::Shape;

    #[test]
    fn footprint_is_distance_between_neighboring_hits() {
        let camera = Camera::new(Vec3::new(3.0, 0.0, 2.0), Vec3::ZERO, 0.6, 300, 200);
        let at = |x: f32, y: f32| {
            let ray = camera.ray(x, y);
            (ray, Shape::Plane.intersect(ray.origin, ray.direction).unwrap())
        };
        let (ray, hit) = at(150.0, 100.0);
        let up = at(150.0, 99.5).1.position.distance(at(150.0, 100.5).1.position);
        // The hyperbola of perspective over half a pixel: measured 1e-5 relative.
        assert_relative_eq!(ray.footprint(&hit).width(), up, max_relative = 1e-4);
        let across = at(149.5, 100.0).1.position.distance(at(150.5, 100.0).1.position);
        assert!(across < up);
    }

    #[test]
    fn looking_down_x_points_right() {
        let camera = Camera::new(Vec3::Z, Vec3::ZERO, 0.6, 100, 100);
        assert!(camera.direction(100.0, 50.0).x > 0.1);
        assert!(camera.direction(50.0, 0.0).y > 0.1);
    }
}
