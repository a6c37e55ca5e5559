//! `cargo xtask tables`: every table of the project, in formats that others read, each with a picture.

mod density;
mod fif;
mod made;
mod noise;
mod noise_cdf;
mod noise_cellular;
mod noise_levels;
mod noise_means;
mod noise_pictures;
mod shipped;

use std::sync::atomic::AtomicBool;

use serde_json::json;

use crate::cli::Tables;
use crate::failure::{Failure, Interrupted};
use crate::gallery::page;
use crate::input::density::{Density, NORMAL_MAP};
use crate::input::fif_system::System;
use crate::output::Output;
use crate::progress;
use made::Made;
pub(crate) use shipped::{check, ship};

/// The tables of one thing: a density, a noise, a fractal interpolation function.
pub(crate) struct Set {
    /// Its folder: `ndf/ggx-0.2-0.4`.
    folder: String,
    /// A heading of a few words.
    title: String,
    make: Box<dyn Fn() -> Result<Made, Failure>>,
}

/// The tables that the gallery is drawn from.
pub(crate) fn default_sets() -> Result<Vec<Set>, Failure> {
    let mut sets = vec![
        Set::new("noise/lattice".into(), "Noise lattice".into(), || noise::lattice(1)),
        Set::new("noise/cdf".into(), "Noise distributions G".into(), noise::distributions),
    ];
    sets.extend(Density::of_the_gallery()?.into_iter().map(Set::density));
    sets.extend(System::of_the_gallery()?.into_iter().map(Set::system));
    Ok(sets)
}

/// The tables of what the user names; the default ones if that is nothing.
pub(crate) fn chosen_sets(wanted: &Tables) -> Result<Vec<Set>, Failure> {
    let Tables { ndf, normal_map, images, fif, .. } = wanted;
    let mut sets = Vec::new();
    let normal_maps = normal_map.iter().map(|file| format!("{NORMAL_MAP}{}", file.display()));
    for text in ndf.iter().cloned().chain(normal_maps) {
        sets.push(Set::density(Density::parse(&text, *images)?));
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

/// Makes the sets, writes their files and the page over them.
pub(crate) fn build(sets: &[Set], output: &Output, interrupted: &AtomicBool) -> Result<(), Failure> {
    let bar = progress::bar("tables");
    bar.set_length(sets.len() as u64);
    let mut rows = String::new();
    for set in sets {
        Interrupted::check(interrupted)?;
        rows += &store(set, &(set.make)()?, output)?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    let about = "Textures are OpenEXR with 32-bit floats, arrays are NumPy's .npy, parameters and checksums are JSON. The \
                 same inputs give the same bytes, on any number of threads.";
    let rest = format!("<main class=\"wide\">\n{rows}</main>\n");
    let page = page::page("Asperity tables", "Tables", about, &rest);
    output.write("index.html", page.as_bytes())?;
    progress::say(&format!("tables: {} sets", sets.len()));
    Ok(())
}

fn store(set: &Set, made: &Made, output: &Output) -> Result<String, Failure> {
    let folder = output.inside(&set.folder)?;
    let mut digests = serde_json::Map::new();
    let mut links = String::new();
    for (name, bytes) in &made.files {
        digests.insert(name.clone(), folder.write(name, bytes)?.into());
        let size = match bytes.len() {
            few @ ..10_000 => format!("{few} bytes"),
            many => format!("{} kB", many.div_ceil(1000)),
        };
        let folder = page::escape(&set.folder);
        links += &format!("<a href=\"{folder}/{name}\">{name}</a> <span>{size}</span><br>");
    }
    folder.write("picture.png", &made.picture.png()?)?;
    let provenance = json!({
        "title": set.title,
        "made_by": format!("asperity {}", env!("CARGO_PKG_VERSION")),
        "parameters": made.parameters,
        "sha256": digests,
    });
    folder.write("parameters.json", &serde_json::to_vec_pretty(&provenance)?)?;
    Ok(format!(
        "<article><h3>{}</h3><p class=\"caption\">{}</p><div class=\"panels\" style=\"grid-template-columns: \
         minmax(0, 1fr) minmax(0, 2fr)\"><figure><img src=\"{folder}/picture.png\" alt=\"{0}\" width=\"{}\" \
         height=\"{}\"></figure><p class=\"source\">{links}<a href=\"{folder}/parameters.json\">parameters.json</a>\
         </p></div></article>\n",
        page::escape(&set.title),
        page::escape(&made.text),
        made.picture.width,
        made.picture.height,
        folder = page::escape(&set.folder),
    ))
}
