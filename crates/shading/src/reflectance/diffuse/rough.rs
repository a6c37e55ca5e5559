//! What the rough diffuse reflectances share: their parameters' checks and the geometry of two directions.

use core::fmt;

use glam::{Vec2, Vec3};

use crate::math::sqrt;
use crate::reflectance::brdf::share;

/// Why a rough diffuse reflectance was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum DiffuseError {
    /// A component of the albedo is outside `[0, 1]`.
    Albedo(f32),
    /// The roughness is outside its range.
    Roughness {
        /// The roughness that was given.
        value: f32,
        /// The greatest one.
        most: f32,
    },
}

impl fmt::Display for DiffuseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Albedo(c) => write!(f, "a component of the albedo is {c}, outside [0, 1]"),
            Self::Roughness { value, most } => write!(f, "the roughness is {value}, outside [0, {most}]"),
        }
    }
}

impl core::error::Error for DiffuseError {}

pub(super) fn checked(albedo: Vec3, roughness: f32, most: f32) -> Result<(Vec3, f32), DiffuseError> {
    let albedo = share(albedo).map_err(DiffuseError::Albedo)?;
    if (0.0..=most).contains(&roughness) {
        Ok((albedo, roughness))
    } else {
        Err(DiffuseError::Roughness { value: roughness, most })
    }
}

/// `s = ωi·ωo − cos θ_i cos θ_o` and `s / t`, where `t` is the larger cosine for positive `s` and 1 otherwise.
#[inline]
pub(super) fn stretched(wi: Vec3, wo: Vec3) -> f32 {
    let s = flat(wi).dot(flat(wo));
    if s > 0.0 { s / wi.z.max(wo.z) } else { s }
}

#[inline]
pub(super) fn flat(w: Vec3) -> Vec2 {
    Vec2::new(w.x, w.y)
}

/// sin θ of a unit direction, from its horizontal part: near the normal `1 − cos² θ` has no digits.
#[inline]
pub(super) fn sine(w: Vec3) -> f32 {
    let r = flat(w);
    sqrt(r.dot(r)).min(1.0)
}
