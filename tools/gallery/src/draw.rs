//! Renders figures and writes the gallery pages.

use std::{sync::atomic::AtomicBool, time::Instant};

use asperity_render::{image::Format, integrator::pixels::Watch};
use rayon::prelude::*;

use crate::captions::CAPTIONS;
use crate::cli::Gallery;
use crate::figure::{Context, Drawn, Figure, Panel, Picture};
use crate::page::{LIVE, Record, Stored, TABLES};
use asperity::failure::Result;
use asperity::output::{Output, sha256};
use asperity::progress;
use asperity::quality::Fineness;

/// Returns the figures whose names contain one of the words. Every word must match a figure.
pub(crate) fn chosen<'a>(all: &[&'a Figure], only: &[String]) -> Result<Vec<&'a Figure>> {
    for word in only {
        if !all.iter().any(|figure| figure.name.contains(word.as_str())) {
            let names: Vec<_> = all.iter().map(|figure| figure.name).collect();
            return Err(format!("no figure matches `{word}` (available: {})", names.join(", ")).into());
        }
    }
    let wanted = |figure: &&Figure| only.is_empty() || only.iter().any(|w| figure.name.contains(w.as_str()));
    Ok(all.iter().copied().filter(wanted).collect())
}

/// Prints name, title and source of the chosen figures.
pub(crate) fn list(all: &[&Figure], only: &[String]) -> Result<()> {
    for figure in chosen(all, only)? {
        let words = CAPTIONS.of(figure.name)?;
        progress::say(&format!("{:<26} {} ({})", figure.name, words.title, words.source));
    }
    Ok(())
}

/// Figures rendered first: fast ones from every source.
const FIRST: [&str; 10] = [
    "kautz-2-ndf",
    "cochran-1-functions",
    "noise-kind-perlin-2002",
    "noise-kind-gaussian",
    "cohen-marble-colors",
    "ndf-density-ggx",
    "cochran-4-bounds",
    "noise-cellular",
    "kautz-1-sphere",
    "kautz-4-teapot",
];

/// Splits the chosen figures into the figures rendered first and the rest.
pub(crate) fn first_ten(figures: Vec<&Figure>) -> [Vec<&Figure>; 2] {
    let (mut first, rest): (Vec<&Figure>, Vec<&Figure>) =
        figures.into_iter().partition(|figure| FIRST.contains(&figure.name));
    first.sort_by_key(|figure| FIRST.iter().position(|name| *name == figure.name));
    [first, rest]
}

/// Renders figures into `output`.
pub(crate) fn draw(
    figures: &[&Figure],
    wanted: &Gallery,
    output: &Output,
    interrupted: &AtomicBool,
) -> Result<()> {
    let &Gallery { quality, seed, .. } = wanted;
    let usual = quality.fineness();
    let samples_per_pixel = wanted.spp.unwrap_or(usual.samples_per_pixel);
    let size = wanted.size.unwrap_or(usual.size);
    let goal = Fineness { samples_per_pixel, ..usual }.goal();
    // An image is up to date only if the same program rendered it.
    let program = sha256(&std::fs::read(std::env::current_exe()?)?);
    let key = format!("{program} size {size} spp {samples_per_pixel} error {} seed {seed}", goal.error);
    for (index, figure) in figures.iter().enumerate() {
        let place = format!("{:>2}/{} {:<26}", index + 1, figures.len(), figure.name);
        if !wanted.force && recorded(figure, output).is_some_and(|r| r.key == key) {
            progress::say(&format!("{place} up to date"));
            continue;
        }
        let bar = progress::bar(&place);
        let context = Context {
            size,
            samples_per_pixel,
            goal,
            seed,
            drivers: !wanted.only.is_empty(),
            watch: Watch { progress: &bar, interrupted },
        };
        let start = Instant::now();
        let drawn = (figure.draw)(&context);
        bar.finish_and_clear();
        let drawn = drawn?;
        let seconds = start.elapsed().as_secs_f64();
        let (name, drawn) = (figure.name.to_owned(), store(figure, drawn, output)?);
        let record = Record { name, seed, seconds, key: key.clone(), drawn };
        output.write(&format!("{}.json", figure.name), &serde_json::to_vec_pretty(&record)?)?;
        progress::say(&format!("{place} {seconds:6.1} s"));
    }
    Ok(())
}

/// Writes the pages of all rendered figures, and prints the path of the first page.
pub(crate) fn write_pages(all: &[&Figure], output: &Output) -> Result<()> {
    let records: Vec<_> = all.iter().filter_map(|figure| recorded(figure, output)).collect();
    let drawing = |file: &str| String::from_utf8(output.read(file).unwrap_or_default()).unwrap_or_default();
    let beside = [TABLES, LIVE].map(|file| output.read(file).map(|_| file));
    let mut first = None;
    for page in CAPTIONS.pages.iter().filter(|page| page.shows(&records)) {
        output.write(page.file, page.gallery(&records, beside, drawing).as_bytes())?;
        first = first.or(Some(page.file));
    }
    if let Some(file) = first {
        let count = format!("{} of {}", records.len(), all.len());
        progress::say(&format!("gallery written to {} ({count} figures)", output.place(file)));
    }
    Ok(())
}

/// Returns the record of an earlier run, if all of its images are unchanged.
fn recorded(figure: &Figure, output: &Output) -> Option<Record> {
    let record: Record = serde_json::from_slice(&output.read(&format!("{}.json", figure.name))?).ok()?;
    let is = |file: &str, hash: &str| output.read(file).is_some_and(|bytes| sha256(&bytes) == hash);
    let whole =
        |p: &Stored| is(&p.file, &p.sha256) && p.light.as_ref().is_none_or(|(file, hash)| is(file, hash));
    record.drawn.panels.iter().all(|panel| whole(&panel.picture)).then_some(record)
}

/// Writes the images of a figure.
fn store(figure: &Figure, drawn: Drawn, output: &Output) -> Result<Drawn<Stored>> {
    let write = |stem: &str, ending: &str, bytes: &[u8]| -> Result<(String, String)> {
        let file = format!("{}-{stem}.{ending}", figure.name);
        output.write(&file, bytes)?;
        Ok((file, sha256(bytes)))
    };
    let stored = |Panel { stem, label, alt, span, picture }| {
        let ((file, sha256), light, pixels) = match picture {
            Picture::Raster(image) => {
                let (png, jpeg) = (image.encode(Format::Png)?, image.encode(Format::Jpeg)?);
                // With few colors, the lossless file is smaller.
                let light = (2 * jpeg.len() < png.len()).then(|| write(&stem, "jpg", &jpeg)).transpose()?;
                (write(&stem, "png", &png)?, light, Some((image.width, image.height)))
            }
            Picture::Vector(svg) => (write(&stem, "svg", svg.as_bytes())?, None, None),
        };
        Ok(Panel { stem, label, alt, span, picture: Stored { file, sha256, light, pixels } })
    };
    let Drawn { columns, panels, parameters, table } = drawn;
    let panels = panels.into_par_iter().map(stored).collect::<Result<_>>()?;
    Ok(Drawn { columns, panels, parameters, table })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::figures;

    #[test]
    fn first_ten_are_figures() {
        let [first, rest] = first_ten(figures());
        assert_eq!((first.len(), first.len() + rest.len()), (FIRST.len(), figures().len()));
        assert_eq!(first[0].name, FIRST[0]);
    }
}
