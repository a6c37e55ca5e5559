//! A fractal height field as an object of a scene: the square of one function, raised by a factor.

use asperity_fif::{
    Axis, Cached, FixedFif, FixedSmooth, HeightField, Interval, Ray, SystemError,
    glam::{DVec2, DVec3},
};

/// The surface `z = rise · ĥ(x) ĥ(y)`, where `ĥ` is the integral of a fractal function.
pub struct Fractal<const N: usize = 2> {
    axis: Axle<N>,
    rise: f64,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug)]
pub struct Meeting {
    /// The ray's parameter.
    pub t: f64,
    pub position: DVec3,
    /// Unit, towards the side that the ray comes from.
    pub normal: DVec3,
}

impl<const N: usize> Fractal<N> {
    /// The square of the integral of `slope`, its heights multiplied by `rise`.
    pub fn new(slope: FixedFif<N, 2>, rise: f64) -> Result<Self, SystemError> {
        Ok(Self { axis: Cached::new(FixedSmooth::integral(slope, 0.0)?), rise })
    }

    /// The side of the square that it stands on, from the origin.
    pub fn side(&self) -> f64 {
        self.axis.domain().hi
    }

    /// The first meeting beyond a hundred-thousandth of the direction's length.
    pub fn first_meeting(&self, origin: DVec3, direction: DVec3) -> Option<Meeting> {
        let (surface, ray) = self.flat(origin, direction);
        let hit = surface.first_hit_within(&ray, Interval::new(NEAR, f64::INFINITY), TOLERANCE)?;
        let slope = hit.gradient.unwrap_or(DVec2::ZERO) * self.rise;
        let up = DVec3::new(-slope.x, -slope.y, 1.0).normalize();
        let normal = if up.dot(direction) > 0.0 { -up } else { up };
        Some(Meeting { t: hit.t, position: origin + direction * hit.t, normal })
    }

    /// Whether anything of it lies between the point and the place `direction` away.
    pub fn hides(&self, origin: DVec3, direction: DVec3) -> bool {
        let (surface, ray) = self.flat(origin, direction);
        surface.hits_any(&ray, Interval::new(NEAR, 1.0))
    }

    /// The surface of heights as they are, and the ray beside it.
    fn flat(&self, origin: DVec3, direction: DVec3) -> (HeightField<&'_ Axle<N>, &'_ Axle<N>>, Ray) {
        let flat = |v: DVec3| DVec3::new(v.x, v.y, v.z / self.rise);
        (HeightField::new(&self.axis, &self.axis), Ray { origin: flat(origin), direction: flat(direction) })
    }
}

/// A ray does not meet the surface where it starts.
const NEAR: f64 = 1e-5;

/// Errors of meetings along the ray: a tenth of [`NEAR`], and far below the pixels.
const TOLERANCE: f64 = 1e-6;

type Axle<const N: usize> = Cached<FixedSmooth<N, 3, 2>>;

#[cfg(test)]
mod tests {
    use asperity_fif::paper;

    use super::*;

    #[test]
    fn the_normal_is_that_of_the_raised_surface() {
        let fractal = Fractal::new(paper::f().unwrap(), 0.25).unwrap();
        let meeting = fractal.first_meeting(DVec3::new(1.0, 1.0, 5.0), DVec3::NEG_Z).unwrap();
        assert!((meeting.t - 4.75).abs() < 1e-12);
        // At (1, 1) both partial derivatives of f̂ f̂ are 1.
        let expected = DVec3::new(-0.25, -0.25, 1.0).normalize();
        assert!(meeting.normal.distance(expected) < 1e-12, "{}", meeting.normal);
        assert!(fractal.hides(DVec3::new(1.0, 1.0, 1.0), DVec3::NEG_Z));
        assert!(!fractal.hides(DVec3::new(1.0, 1.0, 1.0), DVec3::new(0.0, 0.0, -0.5)));
    }
}
