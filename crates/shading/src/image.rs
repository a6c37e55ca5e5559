//! Validation of images.

use glam::Vec3;

use crate::error::ShadingError;

/// The default storage of a table: owned. Without `alloc`, in static memory.
#[cfg(feature = "alloc")]
pub(crate) type Entries<T> = alloc::vec::Vec<T>;

/// The default storage of a table: owned. Without `alloc`, in static memory.
#[cfg(not(feature = "alloc"))]
pub(crate) type Entries<T> = &'static [T];

/// The number of texels of an image of this size, if it is between 1 and `max`.
pub(crate) const fn texel_count(width: usize, height: usize, max: usize) -> Result<usize, ShadingError> {
    match width.saturating_mul(height) {
        0 => Err(ShadingError::Size { parameter: "width · height", value: 0, min: 1, max }),
        texels if texels <= max => Ok(texels),
        value => Err(ShadingError::Size { parameter: "width · height", value, min: 1, max }),
    }
}

/// Returns an error unless a slice has the expected length.
pub(crate) const fn check_len(
    parameter: &'static str,
    expected: usize,
    got: usize,
) -> Result<(), ShadingError> {
    if got == expected { Ok(()) } else { Err(ShadingError::Length { parameter, expected, got }) }
}

/// Returns an error for the first texel that violates the rule.
pub(crate) fn check_texels(
    parameter: &'static str,
    texels: impl Iterator<Item = Vec3>,
    rule: &'static str,
    valid: impl Fn(Vec3) -> bool,
) -> Result<(), ShadingError> {
    match texels.enumerate().find(|&(_, texel)| !valid(texel)) {
        Some((index, value)) => Err(ShadingError::Element { parameter, index, value, rule }),
        None => Ok(()),
    }
}
