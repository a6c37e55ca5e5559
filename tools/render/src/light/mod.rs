//! Lamps, environments, and backgrounds.

pub mod environments;
pub mod lamps;

use glam::Vec3;

use crate::{image::tone::hex, interpolation::smoothstep};

/// Returns the background at image point `(x, y)`, both in `[0, 1]` from the top left: a dark
/// neutral gradient that suits light and dark paper.
pub fn background(x: f32, y: f32) -> Vec3 {
    let (dx, dy) = (x - 0.5, y - 0.42);
    let distance = (dx * dx + dy * dy).sqrt() / 0.75;
    hex(0x3c_4047).lerp(hex(0x1d_1f23), smoothstep(0.0, 1.0, distance))
}
