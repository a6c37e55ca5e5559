//! Small plots as SVG: thin lines, few ticks, names beside the curves, colours of the page, which each carries along.

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

/// A plot: two axes and what is drawn between them, first mark lowest.
pub(crate) struct Plot {
    /// Width and height in CSS pixels at natural size; the picture scales with its column.
    size: [f64; 2],
    x: Axis,
    y: Axis,
    names: Names,
    marks: Vec<Mark>,
}

/// Place of the lines' names.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Names {
    /// At the right end of each line, moved apart where they would touch.
    AtEnds,
    /// In rows above the plot, with a sample of each line.
    Above,
    /// Nowhere.
    Hidden,
}

/// Something drawn in the plot's coordinates. Points that are not finite are left out and break a line.
enum Mark {
    Line { points: Vec<[f64; 2]>, stroke: Stroke, name: String },
    Area { points: Vec<[f64; 2]>, ink: Ink, opacity: f64 },
    Frame { x: [f64; 2], y: [f64; 2], ink: Ink, fill: f64, width: f64 },
    Dots { points: Vec<[f64; 2]>, ink: Ink, radius: f64 },
    Words { at: [f64; 2], text: String, side: HPos },
}

impl Plot {
    /// An empty plot of a size in CSS pixels.
    pub(crate) fn new(size: [f64; 2], x: Axis, y: Axis, names: Names) -> Self {
        Self { size, x, y, names, marks: Vec::new() }
    }

    fn with(mut self, mark: Mark) -> Self {
        self.marks.push(mark);
        self
    }

    /// A line through points, without a name.
    pub(crate) fn line(self, points: impl IntoIterator<Item = [f64; 2]>, stroke: Stroke) -> Self {
        self.curve("", points, stroke)
    }

    /// A line through points, with a name for the legend.
    pub(crate) fn curve(
        self,
        name: impl Into<String>,
        points: impl IntoIterator<Item = [f64; 2]>,
        stroke: Stroke,
    ) -> Self {
        self.with(Mark::Line { points: points.into_iter().collect(), stroke, name: name.into() })
    }

    /// The area between a curve and the height 0.
    pub(crate) fn area(self, points: Vec<[f64; 2]>, ink: impl Into<Ink>, opacity: f64) -> Self {
        self.with(Mark::Area { points, ink: ink.into(), opacity })
    }

    /// A rectangle, filled with this opacity and framed by a border in CSS pixels; 0 leaves out either.
    pub(crate) fn frame(self, x: [f64; 2], y: [f64; 2], ink: impl Into<Ink>, fill: f64, width: f64) -> Self {
        self.with(Mark::Frame { x, y, ink: ink.into(), fill, width })
    }

    /// Round dots with a halo in the background's colour; the radius in CSS pixels.
    pub(crate) fn dots(
        self,
        points: impl IntoIterator<Item = [f64; 2]>,
        ink: impl Into<Ink>,
        radius: f64,
    ) -> Self {
        self.with(Mark::Dots { points: points.into_iter().collect(), ink: ink.into(), radius })
    }

    /// A few words that begin right behind a point, or end right before it.
    pub(crate) fn words(self, side: HPos, at: [f64; 2], text: impl Into<String>) -> Self {
        self.with(Mark::Words { at, text: text.into(), side })
    }

    /// The plot as a panel; its title is the picture in words.
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

    /// The picture as a complete `<svg>` element with a title, which screen readers say.
    ///
    /// # Errors
    /// Everything that the drawing backend reports; it writes to memory, so none is expected.
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
    fn colours_come_along_light_and_dark_and_texts_are_escaped() {
        for names in [Names::AtEnds, Names::Above, Names::Hidden] {
            let svg = plot(names, vec![[0.25, -1.0], [1.0, 0.5], [4.0, 1.0]]).svg("a < b & c").unwrap();
            assert!(!svg.contains("var(") && !svg.contains("#A5") && !svg.contains("rgb"), "{svg}");
            for name in ["ink", "muted", "rule", "card", "series-1", "series-2", "series-3", "series-4"] {
                let [day, night] = asperity::html::colour(name);
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
    fn points_that_are_not_finite_break_the_line() {
        let (nan, inf) = (f64::NAN, f64::INFINITY);
        let (x, y) = ([0.25, 0.5, nan, 1.0, 2.0, 4.0, nan], [0.0, 0.5, 0.0, inf, 0.0, 0.5, nan]);
        let points = x.into_iter().zip(y).map(<[f64; 2]>::from).collect();
        let svg = plot(Names::AtEnds, points).svg("a < b & c").unwrap();
        assert!(!svg.contains("NaN") && !svg.contains("inf") && !svg.contains("-2147483648"), "{svg}");
        assert_eq!(svg.matches("dasharray").count(), 2, "two runs of two points");
        assert_eq!(svg.matches("<circle").count(), 8, "four dots with their halos");
    }
}
