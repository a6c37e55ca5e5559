//! Small SVG plots: thin lines, few ticks, direct labels, and embedded page colors.

mod axis;
mod draw;
mod ink;
mod place;

pub(crate) use axis::{Axis, decimal};
pub(crate) use ink::{Ink, Stroke};
pub(crate) use plotters::style::text_anchor::HPos;

use plotters::{drawing::IntoDrawingArea, prelude::SVGBackend};

use crate::figure::{Panel, Picture};
use asperity::failure::Result;
use ink::dress;
use place::units;

/// A plot: two axes and marks between them, drawn in order.
pub(crate) struct Plot {
    /// Width and height in CSS pixels at natural size. The image scales with its column.
    size: [f64; 2],
    x: Axis,
    y: Axis,
    names: Names,
    marks: Vec<Mark>,
}

/// Position of the lines' names.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Names {
    /// At the right end of each line, moved apart where they would overlap.
    AtEnds,
    /// In rows above the plot, with a sample of each line.
    Above,
    /// Hidden.
    Hidden,
}

/// A mark in plot coordinates. Non-finite points are skipped and break a line.
enum Mark {
    Line { points: Vec<[f64; 2]>, stroke: Stroke, name: String },
    Area { points: Vec<[f64; 2]>, ink: Ink, opacity: f64 },
    Frame { x: [f64; 2], y: [f64; 2], ink: Ink, fill: f64, width: f64 },
    Dots { points: Vec<[f64; 2]>, ink: Ink, radius: f64 },
    Words { at: [f64; 2], text: String, side: HPos },
}

impl Plot {
    /// Creates an empty plot of a size in CSS pixels.
    pub(crate) fn new(size: [f64; 2], x: Axis, y: Axis, names: Names) -> Self {
        Self { size, x, y, names, marks: Vec::new() }
    }

    fn with(mut self, mark: Mark) -> Self {
        self.marks.push(mark);
        self
    }

    /// Adds a line without a name.
    pub(crate) fn line(self, points: impl IntoIterator<Item = [f64; 2]>, stroke: Stroke) -> Self {
        self.curve("", points, stroke)
    }

    /// Adds a line with a name for the legend.
    pub(crate) fn curve(
        self,
        name: impl Into<String>,
        points: impl IntoIterator<Item = [f64; 2]>,
        stroke: Stroke,
    ) -> Self {
        self.with(Mark::Line { points: points.into_iter().collect(), stroke, name: name.into() })
    }

    /// Adds the area between a curve and height 0.
    pub(crate) fn area(self, points: Vec<[f64; 2]>, ink: impl Into<Ink>, opacity: f64) -> Self {
        self.with(Mark::Area { points, ink: ink.into(), opacity })
    }

    /// Adds a rectangle with this fill opacity and a border width in CSS pixels; 0 omits either.
    pub(crate) fn frame(self, x: [f64; 2], y: [f64; 2], ink: impl Into<Ink>, fill: f64, width: f64) -> Self {
        self.with(Mark::Frame { x, y, ink: ink.into(), fill, width })
    }

    /// Adds round dots with a halo in the background color; the radius is in CSS pixels.
    pub(crate) fn dots(
        self,
        points: impl IntoIterator<Item = [f64; 2]>,
        ink: impl Into<Ink>,
        radius: f64,
    ) -> Self {
        self.with(Mark::Dots { points: points.into_iter().collect(), ink: ink.into(), radius })
    }

    /// Adds text to the right or left of a point.
    pub(crate) fn words(self, side: HPos, at: [f64; 2], text: impl Into<String>) -> Self {
        self.with(Mark::Words { at, text: text.into(), side })
    }

    /// Renders the plot as a panel. The title is the alternative text.
    pub(crate) fn panel(
        self,
        stem: impl Into<String>,
        label: impl Into<String>,
        alt: impl Into<String>,
    ) -> Result<Panel> {
        let alt = alt.into();
        let picture = Picture::Vector(self.svg(&alt)?);
        Ok(Panel::new(stem, label, alt, picture))
    }

    /// Renders a complete `<svg>` element with a title for screen readers.
    ///
    /// # Errors
    ///
    /// Returns errors of the drawing backend. None is expected, because it writes to memory.
    pub(crate) fn svg(&self, title: &str) -> Result<String> {
        let mut text = String::new();
        {
            let area = SVGBackend::with_string(&mut text, self.size.map(units).into()).into_drawing_area();
            self.draw(&area).map_err(|error| error.to_string())?;
            area.present().map_err(|error| error.to_string())?;
        }
        Ok(dress(&text, title, self.size))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(names: Names, points: Vec<[f64; 2]>) -> Plot {
        let (x, y) = (Axis::log2("zoom", [0.25, 4.0]), Axis::linear("ratio <1>", [-1.0, 1.0], 0.5));
        Plot::new([400.0, 260.0], x, y, names)
            .area(points.clone(), 2, 0.1)
            .curve("f & g", points.clone(), Stroke::dashed(1))
            .dots(points, 7, 3.0)
            .frame([0.5, 1.0], [-0.5, 0.5], 4, 0.0, 1.0)
            .words(HPos::Right, [1.0, 0.0], "here")
            .words(HPos::Left, [1.0, 0.0], "x > y")
    }

    #[test]
    fn svg_has_light_and_dark_colors_and_escaped_text() {
        for names in [Names::AtEnds, Names::Above, Names::Hidden] {
            let svg = plot(names, vec![[0.25, -1.0], [1.0, 0.5], [4.0, 1.0]]).svg("a < b & c").unwrap();
            assert!(!svg.contains("var(") && !svg.contains("#A5") && !svg.contains("rgb"), "{svg}");
            for name in ["ink", "muted", "rule", "card", "series-1", "series-2", "series-3", "series-4"] {
                let [day, night] = asperity::html::color(name);
                let drawn = [format!(" fill=\"{day}\""), format!(" stroke=\"{day}\"")];
                assert!(drawn.iter().any(|attribute| svg.contains(attribute)), "{name} is missing");
                assert!(svg.contains(&format!("[fill=\"{day}\"] {{ fill: {night} }}")), "{name} stays light");
            }
            assert!(svg.contains("<title>a &lt; b &amp; c</title>") && svg.contains("ratio &lt;1&gt;"));
            assert!(svg.contains("x &gt; y"), "{svg}");
            assert_eq!(svg.contains("f &amp; g"), names != Names::Hidden);
            assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"));
        }
    }

    #[test]
    fn non_finite_points_break_the_line() {
        let (nan, inf) = (f64::NAN, f64::INFINITY);
        let (x, y) = ([0.25, 0.5, nan, 1.0, 2.0, 4.0, nan], [0.0, 0.5, 0.0, inf, 0.0, 0.5, nan]);
        let points = x.into_iter().zip(y).map(<[f64; 2]>::from).collect();
        let svg = plot(Names::AtEnds, points).svg("a < b & c").unwrap();
        assert!(!svg.contains("NaN") && !svg.contains("inf") && !svg.contains("-2147483648"), "{svg}");
        assert_eq!(svg.matches("dasharray").count(), 2, "two runs of two points");
        assert_eq!(svg.matches("<circle").count(), 8, "four dots with their halos");
    }
}
