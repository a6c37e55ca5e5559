//! A figure of the gallery: its name, its function, and the result.

use asperity_render::integrator::adaptive::{Goal, Grain, render_until};
use asperity_render::integrator::pixels::{Sampling, Watch, render, rows};
use asperity_render::sampling::sampler::Sampler;
use asperity_render::{geometry::camera::Camera, image::Image, scene::Scene};
use glam::Vec3;
use serde::{Deserialize, Serialize};

use asperity::failure::{Interrupted, Result};

/// A figure of the gallery.
#[derive(Clone, Copy)]
pub(crate) struct Figure {
    /// Name on the command line and stem of the files, e.g. `kautz-1-sphere`.
    pub(crate) name: &'static str,
    /// Renders the figure.
    pub(crate) draw: fn(&Context<'_>) -> Result<Drawn>,
}

/// Creates a figure from a name and its function.
pub(crate) const fn figure(name: &'static str, draw: fn(&Context<'_>) -> Result<Drawn>) -> Figure {
    Figure { name, draw }
}

/// A function of position, of which a figure shows several.
pub(crate) type Shown<'a, P, T> = &'a (dyn Fn(P) -> T + Sync);

/// Settings of a figure, from the command line.
pub(crate) struct Context<'a> {
    /// Side of a square panel in pixels; other panels scale with it.
    pub(crate) size: u32,
    /// Samples per pixel; figures may multiply it.
    pub(crate) samples_per_pixel: u32,
    /// Noise target of still lifes.
    pub(crate) goal: Goal,
    /// Seed of all random decisions.
    pub(crate) seed: u32,
    /// Whether GPU drivers may render shaders, which compiles a program for minutes.
    pub(crate) drivers: bool,
    /// The figure's progress, hidden without a terminal, and the interrupt flag. Long loops call
    /// [`Context::checkpoint`] once per row.
    pub(crate) watch: Watch<'a>,
}

impl Context<'_> {
    /// Returns [`Interrupted`] once the user has pressed Ctrl-C.
    pub(crate) fn checkpoint(&self) -> Result<(), Interrupted> {
        Interrupted::check(self.watch.interrupted)
    }

    /// Returns a square panel of the figure's size.
    pub(crate) fn square(&self) -> Sampling {
        self.sampling([12, 12], 1)
    }

    /// Returns a panel of the figure's size, scaled in twelfths, with `times` its samples.
    pub(crate) fn sampling(&self, [width, height]: [u32; 2], times: u32) -> Sampling {
        Sampling {
            width: self.size * width / 12,
            height: self.size * height / 12,
            samples_per_pixel: self.samples_per_pixel.saturating_mul(times),
            seed: self.seed,
        }
    }

    /// Renders the mean of a radiance over each pixel, at points in pixels from the top left.
    pub(crate) fn render(
        &self,
        sampling: Sampling,
        radiance: impl Fn(f32, f32) -> Vec3 + Sync,
    ) -> Result<Image> {
        render(sampling, self.watch, radiance)
    }

    /// Renders a scene in linear radiance.
    pub(crate) fn draw(&self, scene: &Scene<'_, '_>, sampling: Sampling, camera: &Camera) -> Result<Image> {
        scene.draw(sampling, camera, self.watch)
    }

    /// Renders a scene to the noise target, in linear radiance.
    pub(crate) fn still(
        &self,
        scene: &Scene<'_, '_>,
        sampling: Sampling,
        camera: &Camera,
    ) -> Result<(Image, Grain)> {
        scene.draw_until(sampling, &self.goal, camera, self.watch)
    }

    /// Renders the mean of a radiance over each pixel to the noise target, at points in pixels from
    /// the top left.
    pub(crate) fn still_of(
        &self,
        sampling: Sampling,
        radiance: impl Fn(f32, f32, &mut Sampler) -> Vec3 + Sync,
    ) -> Result<(Image, Grain)> {
        render_until(sampling, &self.goal, self.watch, radiance)
    }

    /// Renders a scene from an eye toward a target, with this field of view in radians.
    pub(crate) fn look(
        &self,
        scene: &Scene<'_, '_>,
        sampling: Sampling,
        [eye, target]: [Vec3; 2],
        field: f32,
    ) -> Result<Image> {
        self.draw(scene, sampling, &Camera::new(eye, target, field, sampling.width, sampling.height))
    }

    /// Computes rows on all threads and returns them in order.
    pub(crate) fn rows<T: Send, R: IntoIterator<Item = T>>(
        &self,
        count: usize,
        row: impl Fn(usize) -> R + Sync,
    ) -> Result<Vec<T>> {
        rows(count, self.watch, row)
    }
}

/// A rendered figure: panels, parameters and a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Drawn<P = Picture> {
    /// Number of square panels per row on a wide page.
    pub(crate) columns: u32,
    /// The images, in reading order.
    pub(crate) panels: Vec<Panel<P>>,
    /// Named parameters, shown below the caption.
    pub(crate) parameters: Vec<(String, String)>,
    /// Measurements shown as a table: header, then rows.
    pub(crate) table: Option<(Vec<String>, Vec<Vec<String>>)>,
}

impl Drawn {
    /// Creates a figure with panels in columns, without parameters and table.
    pub(crate) fn new(columns: u32, panels: Vec<Panel>) -> Self {
        Self { columns, panels, parameters: Vec::new(), table: None }
    }

    /// Creates an image per case, with the texts of [`Panel::new`].
    pub(crate) fn pictures<W: Into<String>, C>(
        columns: u32,
        cases: impl IntoIterator<Item = ([W; 3], C)>,
        mut picture: impl FnMut(C) -> Result<Image>,
    ) -> Result<Self> {
        let mut panels = Vec::new();
        for ([stem, label, alt], case) in cases {
            panels.push(Panel::new(stem, label, alt, picture(case)?));
        }
        Ok(Self::new(columns, panels))
    }

    /// Adds a parameter.
    #[expect(clippy::needless_pass_by_value, reason = "numbers are passed by value")]
    pub(crate) fn fact(mut self, name: &str, value: impl ToString) -> Self {
        self.parameters.push((name.to_owned(), value.to_string()));
        self
    }

    /// Adds the noise of the images, from lowest to highest.
    pub(crate) fn grain(self, grains: &[Grain]) -> Self {
        let range = |of: fn(&Grain) -> f32| {
            let ends = grains.iter().map(of).fold([f32::INFINITY, 0.0_f32], |[a, b], x| [a.min(x), b.max(x)]);
            let [low, high] = ends.map(|end| format!("{end:.1}"));
            if low == high { low } else { format!("{low} to {high}") }
        };
        self.fact("median relative error of a displayed pixel", range(|grain| 100.0 * grain.median) + " %")
            .fact("samples per pixel, mean", range(|grain| grain.samples))
    }

    /// Adds a table of measurements.
    pub(crate) fn table(
        self,
        head: impl IntoIterator<Item = impl Into<String>>,
        rows: impl IntoIterator<Item = impl Into<Vec<String>>>,
    ) -> Self {
        let head = head.into_iter().map(Into::into).collect();
        Self { table: Some((head, rows.into_iter().map(Into::into).collect())), ..self }
    }
}

/// An image of a figure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Panel<P = Picture> {
    /// Stem of its file, unique in the figure, e.g. `zoom-4`.
    pub(crate) stem: String,
    /// A short label below the image.
    pub(crate) label: String,
    /// Alternative text.
    pub(crate) alt: String,
    /// Relative width in its row: 1 for a square panel, 2 for twice the width.
    pub(crate) span: u32,
    /// The image.
    #[serde(flatten)]
    pub(crate) picture: P,
}

impl Panel {
    /// Creates an image of one column from file stem, label and alternative text.
    pub(crate) fn new(
        stem: impl Into<String>,
        label: impl Into<String>,
        alt: impl Into<String>,
        picture: impl Into<Picture>,
    ) -> Self {
        Self { stem: stem.into(), label: label.into(), alt: alt.into(), span: 1, picture: picture.into() }
    }
}

/// Pixels or vector graphics.
pub(crate) enum Picture {
    /// Linear pixels, written as an sRGB PNG.
    Raster(Image),
    /// A complete `<svg>` element whose colors are the page's custom properties.
    Vector(String),
}

impl From<Image> for Picture {
    fn from(image: Image) -> Self {
        Self::Raster(image)
    }
}
