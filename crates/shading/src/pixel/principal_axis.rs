//! The principal axis of second moments in the plane.

use glam::Vec2;

use crate::math::sqrt;

/// The unit axis along which the moments `[xx, xy, yy]` are largest, x if no axis is; and half the
/// difference of the moments along the axis and across it.
pub(crate) fn principal_axis([xx, xy, yy]: [f32; 3]) -> (Vec2, f32) {
    let half = 0.5 * (xx - yy);
    let apart = sqrt(half * half + xy * xy);
    // The eigenvector by its larger component.
    let axis = if half > 0.0 { Vec2::new(half + apart, xy) } else { Vec2::new(xy, apart - half) };
    (axis.normalize_or(Vec2::X), apart)
}
