//! Files of a map: what engines and painters load.

pub(super) mod exr;
pub(super) mod ktx2;
pub(super) mod png;

use asperity::cli::BakedFormat as Format;

/// The ending of a format's files.
pub(super) const fn ending(format: Format) -> &'static str {
    match format {
        Format::Png => "png",
        Format::Exr => "exr",
        Format::Ktx2 => "ktx2",
    }
}

/// Whether a file of the format has all levels.
pub(super) const fn has_levels(format: Format) -> bool {
    !matches!(format, Format::Png)
}
