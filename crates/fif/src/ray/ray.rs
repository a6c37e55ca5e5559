//! Rays and their hits.

use glam::{DVec2, DVec3};

/// A half line `origin + t direction` for `t ≥ 0`; the direction need not have unit length.
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

/// An intersection of a ray and a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The parameter of the ray, in units of its direction.
    pub t: f64,
    /// Position along the first axis, within the domain.
    pub x: f64,
    /// Position along the second axis, within the domain.
    pub y: f64,
    /// The height of the surface at `(x, y)`.
    ///
    /// It differs from the height of the ray by the change of the surface over the rounding error
    /// of `t`, which is large next to spikes of rough surfaces.
    pub height: f64,
    /// `(∂h/∂x, ∂h/∂y)`, if the surface is differentiable.
    pub gradient: Option<DVec2>,
    /// The upward unit normal, if the surface is differentiable.
    pub normal: Option<DVec3>,
    /// Whether this is the first hit, except for others up to 10⁻¹² of the domain before it.
    ///
    /// `false`: the ray grazes the surface here within the rounding error, or a search limit was
    /// reached and an earlier hit may exist. A guaranteed crossing is always reported.
    pub certain: bool,
}

/// End of a search along a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Root {
    pub(crate) t: f64,
    pub(crate) certain: bool,
}

/// The target of a search along a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Aim {
    First,
    /// Any hit, as soon as one is certain.
    Any,
}
