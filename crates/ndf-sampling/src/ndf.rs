//! The trait that every normal density function fulfils.

use glam::{Vec2, Vec3};

/// A normal density function together with a bijection from Gaussian coordinates to its normals.
pub trait Ndf {
    /// The density `D(m)` of facet normals, in sr⁻¹, with `∫ D cos θ dω = 1`.
    fn density(&self, m: Vec3) -> f32;

    /// `T(z)`: if `z` is standard Gaussian in the plane, `T(z)` has the density `D` over the macro surface.
    fn from_gaussian(&self, z: Vec2) -> Vec3;

    /// `T⁻¹(m)`: the Gaussian coordinates of the normal `m`.
    fn to_gaussian(&self, m: Vec3) -> Vec2;
}
