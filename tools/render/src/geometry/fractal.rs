//! A fractal height field as a shape: any surface over two coordinates, scaled in height, visible
//! at any zoom that `f64` allows.

use asperity_fif::{
    FifError, FixedFif, HeightField, Intersect, Interval, Ray,
    glam::{DVec2, DVec3},
};
use glam::{Mat3, Vec3};

use crate::geometry::{mesh::Probe, ray::Hit};

/// The surface `z = rise · (f(x, y) − base)`, of which the scene contains a neighborhood.
pub struct Fractal {
    surface: Box<dyn Intersect + Send + Sync>,
    rise: f64,
    base: f64,
    /// The position of the scene's origin, and the length of its unit.
    place: DVec3,
    unit: f64,
    /// Tolerated error of a hit along the ray.
    tolerance: f64,
}

/// Rays ignore the surface closer than this to their start.
const NEAR: f64 = 1e-5;

impl Fractal {
    /// Creates the surface with heights above `base` multiplied by `rise`.
    pub fn new(surface: impl Intersect + Send + Sync + 'static, rise: f64, base: f64) -> Self {
        // Errors along the ray: a tenth of `NEAR`, and far below the size of pixels.
        Self { surface: Box::new(surface), rise, base, place: DVec3::ZERO, unit: 1.0, tolerance: 1e-6 }
    }

    /// The square `f̂(x) f̂(y)` of a function's integral, with heights multiplied by `rise`.
    pub fn square<const N: usize>(slope: FixedFif<N, 2>, rise: f64) -> Result<Self, FifError> {
        let curve: FixedFif<N, 3> = slope.integral(0.0)?;
        Ok(Self::new(HeightField::new(curve, curve).tabulated(), rise, 0.0))
    }

    /// Sets the tolerated error of hits. It should be less than a pixel.
    pub fn within(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// Returns a scene around this position with this unit length. Rays in `f32` are exact at every
    /// zoom.
    pub fn magnified(self, place: DVec3, unit: f64) -> Self {
        Self { place, unit, ..self }
    }

    /// Returns the unscaled surface.
    pub fn surface(&self) -> &(dyn Intersect + Send + Sync) {
        self.surface.as_ref()
    }

    /// Returns the height at a point.
    pub fn height(&self, p: DVec2) -> f64 {
        (self.surface.evaluate(p.x, p.y, 1e-5).value - self.base) * self.rise
    }

    /// Returns the first hit of a probe. Its normal points upward, and is `z` where the surface is
    /// not differentiable.
    pub fn intersect(&self, probe: &Probe) -> Option<Hit> {
        let ray = self.ray(probe);
        let hit = self.surface.intersect_within(&ray, Interval::new(NEAR, f64::INFINITY), self.tolerance)?;
        let slope = hit.gradient.unwrap_or(DVec2::ZERO) * self.rise;
        let normal = DVec3::new(-slope.x, -slope.y, 1.0).normalize().as_vec3();
        let position = probe.place(probe.eye() + probe.direction().as_dvec3() * hit.t);
        let tangent = (Vec3::X - normal * normal.x).normalize_or(Vec3::Y);
        let tangents = [Vec3::new(1.0, 0.0, slope.x as f32), Vec3::new(0.0, 1.0, slope.y as f32)];
        let uv = probe.world(position).truncate();
        Some(Hit {
            t: hit.t as f32,
            position,
            normal,
            flat: normal,
            lift: [Vec3::ZERO; 2],
            tangent,
            uv,
            triangle: None,
            tangents,
            bend: Mat3::ZERO,
        })
    }

    /// Whether a probe hits the surface, for shadows.
    pub fn hides(&self, probe: &Probe) -> bool {
        self.surface.occluded(&self.ray(probe), Interval::new(NEAR, f64::INFINITY))
    }

    /// Converts a probe to a ray against the unscaled surface.
    fn ray(&self, probe: &Probe) -> Ray {
        let (p, d) = (self.place + self.unit * probe.eye(), self.unit * probe.direction().as_dvec3());
        Ray {
            origin: DVec3::new(p.x, p.y, p.z / self.rise + self.base),
            direction: DVec3::new(d.x, d.y, d.z / self.rise),
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use asperity_fif::cochran_2000;

    use super::*;

    #[test]
    fn normal_of_raised_surface() {
        let surface = || Fractal::square(cochran_2000::f().unwrap(), 0.25).unwrap();
        let fractal = surface();
        let hit = fractal.intersect(&Probe::new(Vec3::new(1.0, 1.0, 5.0), Vec3::NEG_Z)).unwrap();
        assert_eq!(hit.t, 4.75);
        // At (1, 1) both partial derivatives of f̂ f̂ are 1.
        let expected = Vec3::new(-0.25, -0.25, 1.0).normalize();
        assert_abs_diff_eq!(hit.normal, expected, epsilon = 1e-6);
        let hides = |direction| fractal.hides(&Probe::new(Vec3::ONE, direction));
        assert!(hides(Vec3::NEG_Z) && !hides(Vec3::Z));
        let near = surface().magnified(DVec3::new(1.0, 1.0, 0.25), 1e-3);
        let hit = near.intersect(&Probe::new(Vec3::Z, Vec3::NEG_Z)).unwrap();
        assert_abs_diff_eq!(hit.t, 1.0, epsilon = 1e-6);
        assert_abs_diff_eq!(hit.normal, expected, epsilon = 1e-6);
    }
}
