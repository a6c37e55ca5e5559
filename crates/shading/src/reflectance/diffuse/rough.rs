//! Geometry of two directions, and checks, for rough diffuse BRDFs.

use glam::Vec3;

use crate::error::ShadingError;
use crate::math::sqrt;
use crate::parameter::{color, within};

pub(super) fn checked(albedo: Vec3, roughness: f32, most: f32) -> Result<(Vec3, f32), ShadingError> {
    Ok((color("albedo", albedo)?, within("roughness", roughness, [0.0, most])?))
}

/// `s = ωi·ωo − cos θ_i cos θ_o` and `s / t`, where `t` is the larger cosine for positive `s` and 1
/// otherwise.
#[inline]
pub(super) fn stretched(wi: Vec3, wo: Vec3) -> f32 {
    let s = wi.truncate().dot(wo.truncate());
    if s > 0.0 { s / wi.z.max(wo.z) } else { s }
}

/// sin θ of a unit direction from its horizontal part, because `1 − cos² θ` has no digits near the
/// normal.
#[inline]
pub(super) fn sine(w: Vec3) -> f32 {
    let r = w.truncate();
    sqrt(r.dot(r)).min(1.0)
}
