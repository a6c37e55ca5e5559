//! The frame of the slopes along and across a view.

use core::f64::consts::SQRT_2;

use glam::Vec3;

use crate::density::roughness::Roughness;
use crate::microfacet::above;
use asperity_core::math;

/// The azimuth of a view among slopes in standard deviations of Beckmann, `√2 s/α`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ViewAxis {
    cos: f64,
    sin: f64,
    /// The cotangent of the angle of the view: slopes below its negative face away.
    pub(crate) cotangent: f64,
}

impl ViewAxis {
    /// The axis of `v`; along x, with an infinite cotangent, if the view has no azimuth.
    pub(crate) fn new(alpha: Roughness, v: Vec3) -> Self {
        let w = alpha.stretch(above(v));
        let (x, y) = (f64::from(w.x), f64::from(w.y));
        let lateral = math::sqrt_f64(x * x + y * y);
        if lateral > 0.0 {
            Self { cos: x / lateral, sin: y / lateral, cotangent: SQRT_2 * f64::from(w.z) / lateral }
        } else {
            Self { cos: 1.0, sin: 0.0, cotangent: f64::INFINITY }
        }
    }

    /// The coordinates along and across the view.
    pub(crate) fn to_view(self, x: f64, y: f64) -> [f64; 2] {
        [self.cos * x + self.sin * y, self.cos * y - self.sin * x]
    }

    /// The coordinates along x and y.
    pub(crate) fn to_surface(self, along: f64, across: f64) -> [f64; 2] {
        [self.cos * along - self.sin * across, self.sin * along + self.cos * across]
    }
}
