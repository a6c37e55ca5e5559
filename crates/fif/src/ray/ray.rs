//! Rays and their hits.

use glam::{DVec2, DVec3};

/// A half line, `origin + t direction` for `t ≥ 0`; the direction need not have unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Start of the half line.
    pub origin: DVec3,
    /// Direction; its length is the unit of `t`.
    pub direction: DVec3,
}

impl Ray {
    /// `origin + t direction`.
    #[inline]
    #[must_use]
    pub fn at(&self, t: f64) -> DVec3 {
        DVec3::new(
            self.origin.x + t * self.direction.x,
            self.origin.y + t * self.direction.y,
            self.origin.z + t * self.direction.z,
        )
    }
}

/// The point where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The ray's parameter, in units of its direction.
    pub t: f64,
    /// Position along the first axis, within the domain.
    pub x: f64,
    /// Position along the second axis, within the domain.
    pub y: f64,
    /// The surface's height at `(x, y)`. It differs from the ray's by what the surface changes over the rounding error of
    /// `t`, which is large next to spikes of rough surfaces.
    pub height: f64,
    /// `(∂h/∂x, ∂h/∂y)`, where the surface is differentiable.
    pub gradient: Option<DVec2>,
    /// The upward unit normal, where the surface is differentiable.
    pub normal: Option<DVec3>,
    /// Whether this is the first hit, but for others up to 10⁻¹² of the domain before it.
    ///
    /// `false`: the ray grazes the surface here within the rounding error, or a search limit was reached and an earlier hit
    /// may exist. A guaranteed crossing is always reported.
    pub certain: bool,
}

/// End of a search along a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Root {
    pub(crate) t: f64,
    pub(crate) certain: bool,
}

/// The aim of a search along a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Aim {
    First,
    /// Some hit, as soon as there is one for certain.
    Any,
}
