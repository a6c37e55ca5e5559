//! `asperity filter`: roughness maps whose mip levels have the variance that normal maps lose.

mod container;
mod edits;
mod image;
mod levels;
mod material;
mod nodes;
mod output;
mod report;
mod splice;
pub mod summary;
mod tails;
mod texels;
mod texture;
mod texture_file;

use std::sync::atomic::AtomicBool;

use asperity_render::failure::Interrupted;

use crate::cli::filter::{Filter, FilteredFormat};
use crate::failure::Result;
use crate::filter::container::Container;
use crate::filter::edits::Edits;
use crate::filter::material::Materials;
use crate::filter::output::Files;
use crate::filter::summary::Summary;
use crate::progress;

/// Filters a file and prints what was done.
pub(crate) fn run(wanted: &Filter, interrupted: &AtomicBool) -> Result<()> {
    let summary = filter(wanted, interrupted)?;
    summary.lines(wanted.report).iter().for_each(|line| progress::say(&progress::one_line(line)));
    let changed = summary.materials.iter().any(|material| material.outcome.is_ok());
    if changed && wanted.format == FilteredFormat::Zstd && cfg!(not(feature = "basis")) {
        progress::note(
            "the new textures are uncompressed, which KHR_texture_basisu does not allow; a program with the feature \
             `basis` compresses them",
        );
    }
    Ok(())
}

/// Filters a file.
///
/// Nothing is written unless everything succeeds.
pub fn filter(wanted: &Filter, interrupted: &AtomicBool) -> Result<Summary> {
    let name = wanted.model.display();
    let named = |error: crate::failure::Failure| -> crate::failure::Failure {
        if error.is::<Interrupted>() { error } else { format!("model `{name}`: {error}").into() }
    };
    let mut files = Files::new(wanted)?;
    let gltf = Container::open(&wanted.model).map_err(named)?;
    nodes::check(gltf.list("nodes")).map_err(named)?;
    files.check()?;
    let mut edits = Edits::new(&gltf);
    let mut materials = Materials::new(&gltf, wanted);
    let bar = progress::bar("filter");
    bar.set_length(gltf.list("materials").len() as u64);
    let mut summary = Summary::default();
    for index in 0..gltf.list("materials").len() {
        Interrupted::check(interrupted)?;
        let filtered = materials.filter(index, &mut edits, &mut files, interrupted).map_err(named)?;
        summary.materials.extend(filtered);
        bar.inc(1);
    }
    bar.finish_and_clear();
    edits.finish(&mut files).map_err(named)?;
    summary.files = files.write()?;
    Ok(summary)
}

#[cfg(test)]
mod tests;
