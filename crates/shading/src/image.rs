//! Validation of images and its error.

use asperity_core::error_enum;
use glam::Vec3;

error_enum! {
    /// Error for an invalid environment image or normal map. Texels are counted `row · width +
    /// column`.
    ///
    /// The example needs the feature `alloc`.
    ///
    #[cfg_attr(feature = "alloc", doc = "```")]
    #[cfg_attr(not(feature = "alloc"), doc = "```ignore")]
    /// use asperity_shading::{EnvironmentMap, ImageError, glam::Vec3};
    ///
    /// let error = EnvironmentMap::new(1, 2, vec![Vec3::ONE, Vec3::NEG_X]).unwrap_err();
    /// assert_eq!(error, ImageError::Negative { index: 1, value: Vec3::NEG_X });
    /// assert_eq!(error.to_string(), "texel 1 must not be negative, got [-1, 0, 0]");
    /// ```
    pub enum ImageError {
        /// The width or the height is 0.
        Empty { width: usize, height: usize } => "image must not be empty, got {width} × {height}";
        /// There are too many texels.
        TooLarge { width: usize, height: usize, most: usize } =>
            "image must have at most {most} texels, got {width} × {height}";
        /// The length of the slice is not `width · height`.
        SizeMismatch { width: usize, height: usize, len: usize } =>
            "number of texels must match the image of {width} × {height}, got {len}";
        /// The length of the table of an environment, or of the levels of a normal map, is wrong.
        TableMismatch { needed: usize, len: usize } => "table must have {needed} entries, got {len}";
        /// A channel or a coordinate of a texel is NaN or too far from 0, or the third component of
        /// a slope is 0.
        TooFar { index: usize, value: Vec3, most: f32 } =>
            "texel {index} must be at most {most:e} in each component, got {value}";
        /// A channel of a texel is negative.
        Negative { index: usize, value: Vec3 } => "texel {index} must not be negative, got {value}";
        /// A normal is below the horizon or NaN.
        Normal { index: usize, value: Vec3 } => "texel {index} must be a normal above the horizon, got {value}";
    }
}

/// The number of texels of an image of this size, if it is not 0 and at most `most`.
pub(crate) const fn texel_count(width: usize, height: usize, most: usize) -> Result<usize, ImageError> {
    match width.checked_mul(height) {
        Some(0) => Err(ImageError::Empty { width, height }),
        Some(texels) if texels <= most => Ok(texels),
        _ => Err(ImageError::TooLarge { width, height, most }),
    }
}

/// Checks the number of texels and that all components are within a bound of 0.
pub(crate) fn check_texels(
    [width, height]: [usize; 2],
    needed: usize,
    texels: impl ExactSizeIterator<Item = Vec3>,
    most: f32,
) -> Result<(), ImageError> {
    if texels.len() != needed {
        return Err(ImageError::SizeMismatch { width, height, len: texels.len() });
    }
    for (index, value) in texels.enumerate() {
        if !value.abs().cmple(Vec3::splat(most)).all() {
            return Err(ImageError::TooFar { index, value, most });
        }
    }
    Ok(())
}
