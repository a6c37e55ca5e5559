//! `asperity tables`: exports every table in common formats, each with an image.

mod density;
mod fif;
mod made;
mod noise;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use asperity_render::image::Format;
use serde_json::json;

use crate::failure::{Failure, Interrupted};
use crate::html;
use crate::input::density::{Density, NORMAL_MAP};
use crate::input::fif_system::System;
use crate::input::images::Images;
use crate::output::{Output, sha256};
use crate::progress;
use made::Made;

/// The tables of one object: a density, a noise, or a fractal interpolation function.
pub struct Set {
    /// Output folder, e.g. `ndf/ggx-0.2-0.4`.
    folder: String,
    /// A short heading.
    title: String,
    make: Box<dyn Fn() -> Result<Made, Failure>>,
}

/// Returns the tables that the gallery uses.
pub fn default_sets() -> Result<Vec<Set>, Failure> {
    let mut sets = vec![
        Set::new("noise/lattice".into(), "Noise lattice".into(), || noise::lattice(1)),
        Set::new("noise/cdf".into(), "Noise distributions G".into(), noise::distributions),
    ];
    sets.extend(Density::of_the_gallery()?.into_iter().map(Set::density));
    sets.extend(System::of_the_gallery()?.into_iter().map(Set::system));
    Ok(sets)
}

/// Returns the tables of the given inputs, or the default tables if no input is given.
pub fn chosen_sets(
    ndf: &[String],
    normal_map: &[PathBuf],
    images: Images,
    fif: &[PathBuf],
) -> Result<Vec<Set>, Failure> {
    let mut sets = Vec::new();
    let normal_maps = normal_map.iter().map(|file| format!("{NORMAL_MAP}{}", file.display()));
    for text in ndf.iter().cloned().chain(normal_maps) {
        sets.push(Set::density(Density::parse(&text, images)?));
    }
    for path in fif {
        sets.push(Set::system(System::read(path)?));
    }
    if sets.is_empty() { default_sets() } else { Ok(sets) }
}

impl Set {
    fn new(folder: String, title: String, make: impl Fn() -> Result<Made, Failure> + 'static) -> Self {
        Self { folder, title, make: Box::new(make) }
    }

    fn density(density: Density) -> Self {
        let folder = format!("ndf/{}", density.slug());
        Self::new(folder, density.name(), move || density::tables(&density))
    }

    fn system(system: System) -> Self {
        let folder = format!("fif/{}", system.slug());
        Self::new(folder, system.name(), move || fif::tables(&system))
    }
}

/// Computes the sets and writes their files and an index page.
pub fn build(sets: &[Set], output: &Output, interrupted: &AtomicBool) -> Result<(), Failure> {
    each(sets, interrupted, |folder, name, bytes| {
        let into = if folder.is_empty() { output.clone() } else { output.inside(folder)? };
        Ok(into.write(name, bytes)?)
    })?;
    progress::say(&format!("exporting {} table sets", sets.len()));
    Ok(())
}

/// Recomputes the sets, compares them byte by byte with the files of a folder, and lists the files
/// that differ.
pub fn compare(sets: &[Set], place: &Path, interrupted: &AtomicBool) -> Result<(), Failure> {
    let mut others = Vec::new();
    each(sets, interrupted, |folder, name, bytes| {
        let path = place.join(folder).join(name);
        if fs::read(&path).ok().as_deref() != Some(bytes) {
            others.push(path.display().to_string());
        }
        Ok(())
    })?;
    if others.is_empty() {
        return Ok(());
    }
    let hint = "run the same command without `--check` to write them";
    Err(format!("missing or out of date: {}; {hint}", others.join(", ")).into())
}

/// Passes every file of the sets and the index page to `hand`: folder, name, bytes.
fn each(
    sets: &[Set],
    interrupted: &AtomicBool,
    mut hand: impl FnMut(&str, &str, &[u8]) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let bar = progress::bar("tables");
    bar.set_length(sets.len() as u64);
    let mut rows = String::new();
    for set in sets {
        Interrupted::check(interrupted)?;
        rows += &files(set, &(set.make)()?, &mut hand)?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    let about = "Textures are OpenEXR with 32-bit floats, arrays are NumPy .npy files, parameters and checksums are JSON. The \
                 bytes depend only on the inputs, not on the number of threads.";
    let rest = format!("<main class=\"wide\">\n{rows}</main>\n");
    hand("", "index.html", html::page("Asperity tables", "Tables", about, &rest).as_bytes())
}

/// Passes on the files of a set, and returns its row of the index page.
fn files(
    set: &Set,
    made: &Made,
    hand: &mut impl FnMut(&str, &str, &[u8]) -> Result<(), Failure>,
) -> Result<String, Failure> {
    let mut digests = serde_json::Map::new();
    let mut links = String::new();
    for (name, bytes) in &made.files {
        hand(&set.folder, name, bytes)?;
        digests.insert(name.clone(), sha256(bytes).into());
        let size = match bytes.len() {
            few @ ..10_000 => format!("{few} bytes"),
            many => format!("{} kB", many.div_ceil(1000)),
        };
        let folder = html::escape(&set.folder);
        links += &format!("<a href=\"{folder}/{name}\">{name}</a> <span>{size}</span><br>");
    }
    hand(&set.folder, "picture.png", &made.picture.encode(Format::Png)?)?;
    let provenance = json!({
        "title": set.title,
        "made_by": format!("asperity {}", env!("CARGO_PKG_VERSION")),
        "parameters": made.parameters,
        "sha256": digests,
    });
    hand(&set.folder, "parameters.json", &serde_json::to_vec_pretty(&provenance)?)?;
    Ok(format!(
        "<article><h3>{}</h3><p class=\"caption\">{}</p><div class=\"panels\" style=\"grid-template-columns: \
         minmax(0, 1fr) minmax(0, 2fr)\"><figure><img src=\"{folder}/picture.png\" alt=\"{0}\" width=\"{}\" \
         height=\"{}\"></figure><p class=\"source\">{links}<a href=\"{folder}/parameters.json\">parameters.json</a>\
         </p></div></article>\n",
        html::escape(&set.title),
        html::escape(&made.text),
        made.picture.width,
        made.picture.height,
        folder = html::escape(&set.folder),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    static GO: AtomicBool = AtomicBool::new(false);

    #[test]
    fn compare_finds_a_flipped_byte_in_any_file() {
        let scratch = tempfile::tempdir().unwrap();
        let sets = [
            Set::new("noise/lattice".into(), "Noise lattice".into(), || noise::lattice(1)),
            Set::system(System::of_the_gallery().unwrap().remove(0)),
        ];
        build(&sets, &Output::new(scratch.path()).unwrap(), &GO).unwrap();
        compare(&sets, scratch.path(), &GO).unwrap();
        let folders = ["noise/lattice", &sets[1].folder, ""].map(|folder| scratch.path().join(folder));
        let files: Vec<_> = folders
            .iter()
            .flat_map(|folder| fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()))
            .filter(|path| path.is_file())
            .collect();
        assert!(files.len() > 8);
        for (turn, file) in files.iter().enumerate() {
            let mut bytes = fs::read(file).unwrap();
            let at = turn * 7919 % bytes.len();
            bytes[at] ^= 1 << (turn % 8);
            fs::write(file, bytes).unwrap();
        }
        fs::remove_file(&files[0]).unwrap();
        let said = compare(&sets, scratch.path(), &GO).unwrap_err().to_string();
        for file in &files {
            assert!(said.contains(file.to_str().unwrap()), "{} is missing in {said}", file.display());
        }
    }
}
