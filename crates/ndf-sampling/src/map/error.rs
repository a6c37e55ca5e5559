//! Refusals of images and functions that are no densities of normals.

use asperity_core::error_enum;

/// The most texels a map may have; it then takes 220 MB.
pub const MAX_TEXELS: usize = 1 << 24;

error_enum! {
    /// Refusal of an image or a function that is no density of normals.
    pub enum NdfMapError {
        /// The map has no texels, or more than [`MAX_TEXELS`].
        Size { width: usize, height: usize } =>
            "size must be 1 to {MAX_TEXELS} texels, got {width} × {height}";
        /// The slice has not `width · height` texels.
        Texels { expected: usize, got: usize } => "texels must be {expected}, got {got}";
        /// A texel, at `index = row · width + column`, is NaN, infinite or negative.
        Texel { index: usize, value: f32 } => "texel {index} must be finite and not negative, got {value}";
        /// No texel inside the disk has weight.
        Black { width: usize, height: usize } =>
            "texels inside the disk must have weight, got {width} × {height} black ones";
    }
}
