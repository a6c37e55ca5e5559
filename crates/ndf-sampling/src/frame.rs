//! Orthonormal tangent frames, by the minimal rotation from (0, 0, 1).

use glam::Vec3;

/// An orthonormal, right-handed frame: `tangent × bitangent = normal`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Unit tangent **t**, the local x axis.
    pub tangent: Vec3,
    /// Unit bitangent **b**, the local y axis.
    pub bitangent: Vec3,
    /// Unit normal **n**, the local z axis.
    pub normal: Vec3,
}
