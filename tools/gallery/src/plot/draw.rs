//! Draws a plot on the SVG backend.

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::DrawingArea;
use plotters::element::{Circle, PathElement, Polygon, Rectangle, Text};
use plotters::prelude::{Cartesian2d, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontDesc, FontFamily, FontStyle, ShapeStyle, TextStyle};

use crate::plot::ink::{Ink, Stroke, color};
use crate::plot::place::{LETTERS, UNIT, spread, units, width_of};
use crate::plot::{Mark, Names, Plot};

/// Length of a legend's line sample in CSS pixels.
const SAMPLE: f64 = 22.0;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
/// Last finite point of a line, stroke, name.
type Named<'a> = ([f64; 2], Stroke, &'a str);
/// A position in integer drawing units.
type Place = (i32, i32);
type Drawing = Result<(), Box<dyn std::error::Error + Send + Sync>>;

impl Plot {
    pub(super) fn draw(&self, area: &Area<'_>) -> Drawing {
        let named: Vec<_> = self.named().collect();
        let longest = named.iter().map(|(_, _, n)| width_of(n)).fold(0.0, f64::max);
        // Half of the last tick's text extends beyond the axis.
        let beyond = self.x.ticks.last().map_or(0.0, |(_, text)| 0.5 * width_of(text) + 4.0);
        let right = if self.names == Names::AtEnds { longest + 10.0 } else { beyond.max(12.0) };
        let left = self.y.ticks.iter().map(|(_, t)| width_of(t)).fold(0.0, f64::max) + 12.0;
        let rows = if self.names == Names::Above { self.legend(&named, left) } else { Vec::new() };
        let head = rows.last().map_or(0, |row| row.1 + 1) + u32::from(!self.y.label.is_empty());
        let [x, y] = [&self.x, &self.y].map(|axis| axis.range.map(axis.place));
        let chart = ChartBuilder::on(area)
            .margin_left(units(left))
            .margin_right(units(right))
            .margin_top(units(14.0 + 20.0 * f64::from(head)))
            .margin_bottom(units(if self.x.label.is_empty() { 26.0 } else { 42.0 }))
            .build_cartesian_2d(x[0]..x[1], y[0]..y[1])?;
        let canvas = Canvas { plot: self, area, chart };
        canvas.draw_axes()?;
        for mark in &self.marks {
            canvas.draw_mark(mark)?;
        }
        match self.names {
            Names::AtEnds => canvas.name_at_ends(&named),
            Names::Above => canvas.name_above(&rows, &named),
            Names::Hidden => Ok(()),
        }
    }

    /// Returns the named lines: last finite point, stroke, name.
    fn named(&self) -> impl Iterator<Item = Named<'_>> {
        self.marks.iter().filter_map(|mark| match mark {
            Mark::Line { points, stroke, name } if !name.is_empty() => {
                Some((*points.iter().rfind(|p| is_finite(p))?, *stroke, name.as_str()))
            }
            _ => None,
        })
    }

    /// Returns left edge in CSS pixels and row of each legend entry, in rows of the plot's width.
    fn legend(&self, named: &[Named<'_>], left: f64) -> Vec<(f64, u32)> {
        let (mut x, mut row) = (left, 0);
        let mut places = Vec::with_capacity(named.len());
        for (_, _, name) in named {
            let width = SAMPLE + 6.0 + width_of(name);
            if x + width > self.size[0] && x > left {
                (x, row) = (left, row + 1);
            }
            places.push((x, row));
            x += width + 18.0;
        }
        places
    }
}

/// A plot with the area and the chart it is drawn on.
struct Canvas<'a, 'b> {
    plot: &'a Plot,
    area: &'a Area<'b>,
    chart: Chart<'a, 'b>,
}

impl Canvas<'_, '_> {
    fn at(&self, [x, y]: [f64; 2]) -> Place {
        self.chart.backend_coord(&((self.plot.x.place)(x), (self.plot.y.place)(y)))
    }

    fn path(&self, places: impl Into<Vec<Place>>, style: ShapeStyle) -> Drawing {
        Ok(self.area.draw(&PathElement::new(places, style))?)
    }

    fn words(&self, text: &str, place: Place, ink: Ink, h: HPos, v: VPos) -> Drawing {
        // The backend divides the size by 1.24, its estimate of a font's line height.
        let font = FontDesc::new(FontFamily::Name("system-ui"), LETTERS * UNIT * 1.24, FontStyle::Normal);
        let mut style = TextStyle::from(font).pos(Pos::new(h, v));
        style.color = color(ink, false).to_backend_color();
        Ok(self.area.draw(&Text::new(text, place, style))?)
    }

    fn draw_axes(&self) -> Drawing {
        let (x, y) = (&self.plot.x, &self.plot.y);
        let [(left, bottom), (right, top)] = [0, 1].map(|end| self.at([x.range[end], y.range[end]]));
        let step = |pixels: f64| units(pixels) as i32;
        for (value, text) in &y.ticks {
            let (_, y) = self.at([x.range[0], *value]);
            self.path([(left, y), (right, y)], Stroke::solid(Ink::Rule).wide(0.75).style())?;
            self.words(text, (left - step(7.0), y), Ink::Muted, HPos::Right, VPos::Center)?;
        }
        let axis = Stroke::solid(Ink::Muted).wide(0.9).style();
        self.path([(left, bottom), (right, bottom)], axis)?;
        for (value, text) in &x.ticks {
            let (x, _) = self.at([*value, y.range[0]]);
            self.path([(x, bottom), (x, bottom + step(4.0))], axis)?;
            self.words(text, (x, bottom + step(8.0)), Ink::Muted, HPos::Center, VPos::Top)?;
        }
        if !x.label.is_empty() {
            let place = ((left + right) / 2, bottom + step(26.0));
            self.words(&x.label, place, Ink::Text, HPos::Center, VPos::Top)?;
        }
        if !y.label.is_empty() {
            self.words(&y.label, (step(4.0), top - step(24.0)), Ink::Text, HPos::Left, VPos::Top)?;
        }
        Ok(())
    }

    fn draw_mark(&self, mark: &Mark) -> Drawing {
        match mark {
            Mark::Line { points, stroke, .. } => {
                for run in finite_runs(points) {
                    self.path(run.iter().map(|&p| self.at(p)).collect::<Vec<_>>(), stroke.style())?;
                }
            }
            Mark::Area { points, ink, opacity } => {
                for run in finite_runs(points) {
                    let foot = [run[run.len() - 1], run[0]].map(|[x, _]| [x, 0.0]);
                    let path: Vec<_> = run.iter().chain(&foot).map(|&p| self.at(p)).collect();
                    self.area.draw(&Polygon::new(path, fill(*ink, *opacity)))?;
                }
            }
            Mark::Frame { x, y, ink, fill: opacity, width } => {
                let (a, b) = (self.at([x[0], y[0]]), self.at([x[1], y[1]]));
                let corners = [(a.0.min(b.0), a.1.min(b.1)), (a.0.max(b.0), a.1.max(b.1))];
                self.area.draw(&Rectangle::new(corners, fill(*ink, *opacity)))?;
                if *width > 0.0 {
                    self.path(
                        [a, (b.0, a.1), b, (a.0, b.1), a, (b.0, a.1)],
                        Stroke::solid(*ink).wide(*width).style(),
                    )?;
                }
            }
            Mark::Dots { points, ink, radius } => {
                for &point in points.iter().filter(|p| is_finite(p)) {
                    for (ink, radius) in [(Ink::Card, radius + 1.5), (*ink, *radius)] {
                        self.area.draw(&Circle::new(self.at(point), units(radius), fill(ink, 1.0)))?;
                    }
                }
            }
            Mark::Words { at, text, side } => {
                let (x, y) = self.at(*at);
                let aside = units(8.0) as i32 * if matches!(side, HPos::Left) { 1 } else { -1 };
                self.words(text, (x + aside, y), Ink::Muted, *side, VPos::Center)?;
            }
        }
        Ok(())
    }

    fn name_at_ends(&self, named: &[Named<'_>]) -> Drawing {
        let places: Vec<_> = named.iter().map(|(end, ..)| self.at(*end)).collect();
        let heights: Vec<_> = places.iter().map(|p| f64::from(p.1)).collect();
        let apart = spread(&heights, LETTERS * 1.15 * UNIT);
        for (((_, stroke, name), (x, _)), y) in named.iter().zip(places).zip(apart) {
            let place = (x + units(7.0) as i32, y.round() as i32);
            self.words(name, place, stroke.ink, HPos::Left, VPos::Center)?;
        }
        Ok(())
    }

    fn name_above(&self, rows: &[(f64, u32)], named: &[Named<'_>]) -> Drawing {
        for ((_, stroke, name), &(x, row)) in named.iter().zip(rows) {
            let [left, right, words] = [x, x + SAMPLE, x + SAMPLE + 6.0].map(|x| units(x) as i32);
            let y = units(12.0 + 20.0 * f64::from(row)) as i32;
            self.path([(left, y), (right, y)], stroke.style())?;
            self.words(name, (words, y), Ink::Text, HPos::Left, VPos::Center)?;
        }
        Ok(())
    }
}

fn fill(ink: Ink, opacity: f64) -> ShapeStyle {
    color(ink, false).mix(opacity).filled()
}

fn is_finite(point: &[f64; 2]) -> bool {
    point.iter().all(|x| x.is_finite())
}

/// Returns runs of two or more finite points.
fn finite_runs(points: &[[f64; 2]]) -> impl Iterator<Item = &[[f64; 2]]> {
    points.split(|p| !is_finite(p)).filter(|run| run.len() > 1)
}
