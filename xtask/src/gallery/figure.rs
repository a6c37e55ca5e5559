//! What a figure of the gallery is: its place in a source, its caption, and the function that draws it.

use std::sync::atomic::{AtomicBool, Ordering};

use asperity_render::image::Image;
use indicatif::ProgressBar;

use crate::failure::{Failure, Interrupted};

/// One figure of the gallery.
#[derive(Clone, Copy)]
pub(crate) struct Figure {
    /// Name on the command line and stem of the files, `kautz-1-sphere`.
    pub(crate) name: &'static str,
    /// Heading, a few words.
    pub(crate) title: &'static str,
    /// The figure of the source that it reproduces, or `Asperity`.
    pub(crate) source: &'static str,
    /// What to see in it; two to four sentences, plain text.
    pub(crate) caption: &'static str,
    /// Draws it.
    pub(crate) draw: fn(&Context<'_>) -> Result<Drawn, Failure>,
}

/// What the command line decides for every figure.
pub(crate) struct Context<'a> {
    /// Side in pixels of a square panel; other panels scale with it.
    pub(crate) size: u32,
    /// Samples per pixel; a figure may multiply it.
    pub(crate) samples_per_pixel: u32,
    /// Seed of every random choice.
    pub(crate) seed: u32,
    /// The figure's progress; hidden when no terminal looks on.
    pub(crate) progress: &'a ProgressBar,
    /// Set when the user interrupts: long loops call [`Context::checkpoint`] once a row.
    pub(crate) interrupted: &'a AtomicBool,
}

impl Context<'_> {
    /// Returns [`Interrupted`] once the user has pressed Ctrl-C.
    pub(crate) fn checkpoint(&self) -> Result<(), Failure> {
        if self.interrupted.load(Ordering::Relaxed) { Err(Interrupted.into()) } else { Ok(()) }
    }
}

/// What a figure hands back.
pub(crate) struct Drawn {
    /// How many square panels stand side by side on a wide page.
    pub(crate) columns: u32,
    /// The pictures, in reading order.
    pub(crate) panels: Vec<Panel>,
    /// Parameters by name, shown under the caption.
    pub(crate) parameters: Vec<(String, String)>,
    /// Measured figures, shown as a table: header, then rows.
    pub(crate) table: Option<Table>,
}

/// One picture of a figure.
pub(crate) struct Panel {
    /// Stem of its file, unique in the figure: `zoom-4`.
    pub(crate) stem: String,
    /// A few words under the picture.
    pub(crate) label: String,
    /// The picture in words, for those who cannot see it.
    pub(crate) alt: String,
    /// Relative width in its row: 1 for a square panel, 2 for twice as wide.
    pub(crate) span: u32,
    /// The picture itself.
    pub(crate) picture: Picture,
}

/// Pixels or curves.
pub(crate) enum Picture {
    /// Linear pixels, written as an sRGB PNG.
    Raster(Image),
    /// A complete `<svg>` element whose colours are the page's custom properties.
    Vector(String),
}

/// A small table of measured values.
pub(crate) struct Table {
    /// Column heads.
    pub(crate) head: Vec<String>,
    /// Rows, as many cells as heads.
    pub(crate) rows: Vec<Vec<String>>,
}
