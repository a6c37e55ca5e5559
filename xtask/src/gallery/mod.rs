//! `cargo xtask gallery`: the tables, then every figure, then the pages.

pub(crate) mod figure;
pub(crate) mod figures;
pub(crate) mod page;
pub(crate) mod panels;
pub(crate) mod plot;
pub(crate) mod power_spectrum;

use std::{sync::atomic::AtomicBool, time::Instant};

use crate::{
    failure::Failure,
    gallery::{
        figure::{Context, Drawn, Figure, Picture},
        figures::figures,
        page::{PanelRecord, Record},
    },
    output::{Output, sha256},
    progress,
};

/// What the command line asked for.
pub(crate) struct Settings {
    pub(crate) size: u32,
    pub(crate) samples_per_pixel: u32,
    pub(crate) seed: u32,
    /// Names of figures, or parts of names; empty for all.
    pub(crate) only: Vec<String>,
    /// Draw also what is already there.
    pub(crate) afresh: bool,
}

/// The figures whose names contain one of the words; every word must match one.
pub(crate) fn chosen(only: &[String]) -> Result<Vec<&'static Figure>, Failure> {
    for word in only {
        if !figures().any(|figure| figure.name.contains(word.as_str())) {
            let names: Vec<_> = figures().map(|figure| figure.name).collect();
            return Err(format!("no figure is called `{word}`; there are {}", names.join(", ")).into());
        }
    }
    let wanted = |figure: &&Figure| only.is_empty() || only.iter().any(|w| figure.name.contains(w.as_str()));
    Ok(figures().filter(wanted).collect())
}

/// Draws the chosen figures into `output` and writes the pages over all that are there.
pub(crate) fn draw(settings: &Settings, output: &Output, interrupted: &AtomicBool) -> Result<(), Failure> {
    let program = program_digest()?;
    let wanted = chosen(&settings.only)?;
    for (index, figure) in wanted.iter().enumerate() {
        let key = format!(
            "{program} size {} spp {} seed {}",
            settings.size, settings.samples_per_pixel, settings.seed
        );
        let place = format!("{:>2}/{}", index + 1, wanted.len());
        if !settings.afresh && recorded(figure, output).is_some_and(|r| r.key == key && is_whole(&r, output))
        {
            progress::say(&format!("{place} {:<26} already drawn", figure.name));
            continue;
        }
        let bar = progress::bar(&format!("{place} {:<26}", figure.name));
        let context = Context {
            size: settings.size,
            samples_per_pixel: settings.samples_per_pixel,
            seed: settings.seed,
            progress: &bar,
            interrupted,
        };
        let start = Instant::now();
        let drawn = (figure.draw)(&context);
        bar.finish_and_clear();
        let drawn = drawn?;
        let seconds = start.elapsed().as_secs_f64();
        let record = store(figure, &drawn, seconds, key, settings.seed, output)?;
        output.write(&format!("{}.json", figure.name), &serde_json::to_vec_pretty(&record)?)?;
        progress::say(&format!("{place} {:<26} {seconds:6.1} s", figure.name));
    }
    let records: Vec<_> = figures()
        .filter_map(|figure| recorded(figure, output))
        .filter(|record| is_whole(record, output))
        .collect();
    let drawing = |file: &str| String::from_utf8(output.read(file).unwrap_or_default()).unwrap_or_default();
    for page in page::PAGES {
        let text = page.gallery(&records, env!("CARGO_PKG_VERSION"), drawing);
        output.write(page.file, text.as_bytes())?;
    }
    Ok(())
}

// A picture is up to date only if this very program drew it.
fn program_digest() -> Result<String, Failure> {
    Ok(sha256(&std::fs::read(std::env::current_exe()?)?))
}

fn recorded(figure: &Figure, output: &Output) -> Option<Record> {
    serde_json::from_slice(&output.read(&format!("{}.json", figure.name))?).ok()
}

fn is_whole(record: &Record, output: &Output) -> bool {
    record.panels.iter().all(|p| output.read(&p.file).is_some_and(|bytes| sha256(&bytes) == p.sha256))
}

fn store(
    figure: &Figure,
    drawn: &Drawn,
    seconds: f64,
    key: String,
    seed: u32,
    output: &Output,
) -> Result<Record, Failure> {
    let mut panels = Vec::new();
    for panel in &drawn.panels {
        let (bytes, ending, pixels) = match &panel.picture {
            Picture::Raster(image) => (image.png()?, "png", Some((image.width, image.height))),
            Picture::Vector(svg) => (svg.clone().into_bytes(), "svg", None),
        };
        let file = format!("{}-{}.{ending}", figure.name, panel.stem);
        let sha256 = output.write(&file, &bytes)?;
        let (label, alt) = (panel.label.clone(), panel.alt.clone());
        panels.push(PanelRecord { file, sha256, label, alt, span: panel.span, pixels });
    }
    Ok(Record {
        name: figure.name.into(),
        title: figure.title.into(),
        source: figure.source.into(),
        caption: figure.caption.into(),
        seed,
        seconds,
        key,
        columns: drawn.columns,
        panels,
        parameters: drawn.parameters.clone(),
        table: drawn.table.as_ref().map(|table| (table.head.clone(), table.rows.clone())),
    })
}
