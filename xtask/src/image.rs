//! An image of linear radiance, row by row from the top left.

use glam::Vec3;

/// Linear RGB pixels.
pub(crate) struct Image {
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// `width · height` pixels from the top left.
    pub(crate) pixels: Vec<Vec3>,
}
