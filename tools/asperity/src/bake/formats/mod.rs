//! The file formats of a map.

pub(super) mod exr;
pub(super) mod ktx2;
pub(super) mod png;

use crate::cli::bake::BakedFormat as Format;

/// Returns the file extension of a format.
pub(super) const fn ending(format: Format) -> &'static str {
    match format {
        Format::Png => "png",
        Format::Exr => "exr",
        Format::Ktx2 => "ktx2",
    }
}

/// Whether a file of the format contains all mip levels.
pub(super) const fn has_levels(format: Format) -> bool {
    !matches!(format, Format::Png)
}
