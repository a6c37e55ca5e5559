//! The unit normal of a graph.

use glam::{DVec2, DVec3};

use crate::math::sqrt;

/// Upward normal: `(−h_x, −h_y, 1)` scaled to length one; steep slopes do not overflow.
pub(crate) fn upward_normal(gradient: DVec2) -> DVec3 {
    let largest = gradient.x.abs().max(gradient.y.abs()).max(1.0);
    let (x, y, z) = (-gradient.x / largest, -gradient.y / largest, 1.0 / largest);
    let length = sqrt(x * x + y * y + z * z);
    DVec3::new(x / length, y / length, z / length)
}
