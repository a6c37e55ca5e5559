//! Writes the files of a set: each map in each format, and the documents that reference them.

use rayon::prelude::*;

use crate::bake::formats::{exr, ktx2, png};
use crate::bake::set::Set;
use crate::bake::{gltf, materialx, provenance};
use crate::cli::bake::BakedFormat as Format;
use crate::failure::Result;
use crate::output::Output;

/// Writes all files, each atomically.
pub(super) fn write(set: &Set<'_>, output: &Output) -> Result<()> {
    let maps = set.maps();
    let files: Vec<_> =
        maps.iter().flat_map(|map| set.formats.iter().map(move |format| (map, *format))).collect();
    set.bar.set_length(files.iter().map(|(map, format)| map.texels_of(*format)).sum());
    files.par_iter().with_max_len(1).try_for_each(|(map, format)| {
        output.stream(&map.file(*format), |file| match format {
            Format::Png => png::write(file, map),
            Format::Exr => exr::write(file, map),
            Format::Ktx2 => ktx2::write(file, map),
        })
    })?;
    gltf::write(set, output)?;
    materialx::write(set, output)?;
    provenance::write(set, output)
}
