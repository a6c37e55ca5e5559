//! Error for images and functions that are not valid NDFs.

use asperity_core::error_enum;

/// The maximum number of texels of a map, which then takes 220 MB.
pub const MAX_TEXELS: usize = 1 << 24;

error_enum! {
    /// Error for an image or a function that is not a valid NDF.
    pub enum NdfMapError {
        /// The map has no texels, or more than [`MAX_TEXELS`].
        Size { width: usize, height: usize } =>
            "size must be 1 to {MAX_TEXELS} texels, got {width} × {height}";
        /// The length of the slice is not `width · height`.
        Texels { expected: usize, got: usize } => "`texels` must have {expected} elements, got {got}";
        /// A texel, at `index = row · width + column`, is NaN, infinite or negative.
        Texel { index: usize, value: f32 } => "texel {index} must be finite and not negative, got {value}";
        /// All texels inside the disk are zero.
        Black { width: usize, height: usize } =>
            "all {width} × {height} texels inside the unit disk are zero";
    }
}
