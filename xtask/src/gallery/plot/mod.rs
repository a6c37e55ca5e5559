//! Small plots as SVG: thin lines, few ticks, names beside the curves, colours of the page that shows them.

mod axis;
mod draw;
mod ink;
mod place;

pub(crate) use axis::Axis;
pub(crate) use ink::{Dash, Ink, Stroke};

use plotters::{drawing::IntoDrawingArea, prelude::SVGBackend};

use crate::failure::Failure;
use ink::dress;
use place::units;

/// A plot: two axes and what is drawn between them, first mark lowest.
pub(crate) struct Plot {
    /// Said by screen readers.
    pub(crate) title: String,
    /// Width and height in CSS pixels at natural size; the picture scales with its column.
    pub(crate) size: [f64; 2],
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) names: Names,
    pub(crate) marks: Vec<Mark>,
}

/// Where the names of the lines stand.
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
pub(crate) enum Mark {
    /// A line through points, with a name for the legend (or an empty one).
    Line { points: Vec<[f64; 2]>, stroke: Stroke, name: String },
    /// The area between a curve and a height.
    Area { points: Vec<[f64; 2]>, base: f64, ink: Ink, opacity: f64 },
    /// A rectangle, filled and framed.
    Frame {
        x: [f64; 2],
        y: [f64; 2],
        ink: Ink,
        /// Of the filling; 0 leaves it out.
        opacity: f64,
        /// Of the border in CSS pixels; 0 leaves it out.
        width: f64,
    },
    /// Round dots with a halo in the background's colour; the radius in CSS pixels.
    Dots { points: Vec<[f64; 2]>, ink: Ink, radius: f64 },
    /// A few words that end at a point, moved by some CSS pixels (right and down).
    Note { at: [f64; 2], shift: [f64; 2], text: String, ink: Ink },
    /// A few words that begin right behind a point.
    Label { at: [f64; 2], text: String, ink: Ink },
}

impl Plot {
    /// The picture as a complete `<svg>` element.
    ///
    /// # Errors
    /// What the drawing backend reports; it writes to memory, so none is expected.
    pub(crate) fn svg(&self) -> Result<String, Failure> {
        let mut text = String::new();
        {
            let size = (units(self.size[0]), units(self.size[1]));
            let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
            self.draw(&area).map_err(|error| error.to_string())?;
            area.present().map_err(|error| error.to_string())?;
        }
        Ok(dress(&text, &self.title, self.size))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(names: Names, points: Vec<[f64; 2]>) -> Plot {
        Plot {
            title: "a < b & c".to_owned(),
            size: [400.0, 260.0],
            x: Axis::log2("zoom", [0.25, 4.0], 1),
            y: Axis::linear("ratio <1>", [-1.0, 1.0], 0.5),
            names,
            marks: vec![
                Mark::Area { points: points.clone(), base: 0.0, ink: Ink::Series(2), opacity: 0.1 },
                Mark::Line {
                    points: points.clone(),
                    stroke: Stroke::dashed(Ink::Series(1)),
                    name: "f & g".to_owned(),
                },
                Mark::Dots { points, ink: Ink::Series(7), radius: 3.0 },
                Mark::Frame { x: [0.5, 1.0], y: [-0.5, 0.5], ink: Ink::Series(4), opacity: 0.0, width: 1.0 },
                Mark::Note { at: [1.0, 0.0], shift: [0.0, -8.0], text: "here".to_owned(), ink: Ink::Muted },
                Mark::Label { at: [1.0, 0.0], text: "x > y".to_owned(), ink: Ink::Muted },
            ],
        }
    }

    #[test]
    fn colours_are_the_page_s_and_texts_are_escaped() {
        for names in [Names::AtEnds, Names::Above, Names::Hidden] {
            let svg = plot(names, vec![[0.25, -1.0], [1.0, 0.5], [4.0, 1.0]]).svg().unwrap();
            assert!(!svg.contains("=\"#") && !svg.contains("rgb"), "{svg}");
            for name in ["ink", "muted", "rule", "card", "series-1", "series-2", "series-3", "series-4"] {
                assert!(svg.contains(&format!("var(--{name})")), "{name} is missing");
            }
            assert!(svg.contains("<title>a &lt; b &amp; c</title>") && svg.contains("ratio &lt;1&gt;"));
            assert!(svg.contains("x &gt; y"), "{svg}");
            assert_eq!(svg.contains("f &amp; g"), names != Names::Hidden);
            assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"));
        }
    }

    #[test]
    fn points_that_are_not_finite_break_the_line() {
        let nan = f64::NAN;
        let points = vec![
            [0.25, 0.0],
            [0.5, 0.5],
            [nan, 0.0],
            [1.0, f64::INFINITY],
            [2.0, 0.0],
            [4.0, 0.5],
            [nan, nan],
        ];
        let svg = plot(Names::AtEnds, points).svg().unwrap();
        assert!(!svg.contains("NaN") && !svg.contains("inf") && !svg.contains("-2147483648"), "{svg}");
        assert_eq!(svg.matches("dasharray").count(), 2, "two runs of two points");
        assert_eq!(svg.matches("<circle").count(), 8, "four dots with their halos");
    }
}
