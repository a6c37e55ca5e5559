//! Draws a plot on the SVG backend.

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::DrawingArea;
use plotters::element::{Circle, PathElement, Polygon, Rectangle, Text};
use plotters::prelude::{Cartesian2d, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontDesc, FontFamily, FontStyle, TextStyle};

use crate::gallery::plot::ink::{Dash, Ink, Stroke, colour, line, line_of};
use crate::gallery::plot::place::{LETTERS, UNIT, spread, units, width_of};
use crate::gallery::plot::{Mark, Names, Plot};

/// Length of a legend's sample in CSS pixels.
const SAMPLE: f64 = 22.0;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
/// Last finite point of a line, its stroke, its name.
type Named<'a> = ([f64; 2], Stroke, &'a str);
type Drawing = Result<(), Box<dyn std::error::Error + Send + Sync>>;

impl Plot {
    pub(super) fn draw(&self, area: &Area<'_>) -> Drawing {
        let named: Vec<_> = self.named().collect();
        let longest = named.iter().map(|(_, _, n)| width_of(n)).fold(0.0, f64::max);
        let right = if self.names == Names::AtEnds { longest + 10.0 } else { 12.0 };
        let ticks = self.y.ticks.iter().map(|(_, t)| width_of(t)).fold(0.0, f64::max);
        let rows = match self.names {
            Names::Above => self.legend(&named, ticks + 12.0),
            Names::AtEnds | Names::Hidden => Vec::new(),
        };
        let head = rows.last().map_or(0, |row| row.1 + 1) + u32::from(!self.y.label.is_empty());
        let chart = ChartBuilder::on(area)
            .margin_left(units(ticks + 12.0))
            .margin_right(units(right))
            .margin_top(units(14.0 + 20.0 * f64::from(head)))
            .margin_bottom(units(if self.x.label.is_empty() { 26.0 } else { 42.0 }))
            .build_cartesian_2d(
                self.x.place(self.x.range[0])..self.x.place(self.x.range[1]),
                self.y.place(self.y.range[0])..self.y.place(self.y.range[1]),
            )?;
        self.draw_axes(area, &chart)?;
        for mark in &self.marks {
            self.draw_mark(area, &chart, mark)?;
        }
        match self.names {
            Names::AtEnds => self.name_at_ends(area, &chart, &named),
            Names::Above => name_above(area, &rows, &named),
            Names::Hidden => Ok(()),
        }
    }

    /// Lines that have a name: last finite point, stroke, name.
    fn named(&self) -> impl Iterator<Item = Named<'_>> {
        self.marks.iter().filter_map(|mark| match mark {
            Mark::Line { points, stroke, name } if !name.is_empty() => {
                let end = points.iter().rev().find(|p| p[0].is_finite() && p[1].is_finite())?;
                Some((*end, *stroke, name.as_str()))
            }
            _ => None,
        })
    }

    fn at(&self, chart: &Chart<'_, '_>, point: [f64; 2]) -> (i32, i32) {
        chart.backend_coord(&(self.x.place(point[0]), self.y.place(point[1])))
    }

    fn draw_axes(&self, area: &Area<'_>, chart: &Chart<'_, '_>) -> Drawing {
        let (left, bottom) = self.at(chart, [self.x.range[0], self.y.range[0]]);
        let (right, top) = self.at(chart, [self.x.range[1], self.y.range[1]]);
        for (value, text) in &self.y.ticks {
            let (_, y) = self.at(chart, [self.x.range[0], *value]);
            area.draw(&PathElement::new([(left, y), (right, y)], line(Ink::Rule, 0.75)))?;
            let place = (left - units(7.0) as i32, y);
            area.draw(&words(text, place, Ink::Muted, HPos::Right, VPos::Center))?;
        }
        let axis = line(Ink::Muted, 0.9);
        area.draw(&PathElement::new([(left, bottom), (right, bottom)], axis))?;
        for (value, text) in &self.x.ticks {
            let (x, _) = self.at(chart, [*value, self.y.range[0]]);
            let end = bottom + units(4.0) as i32;
            area.draw(&PathElement::new([(x, bottom), (x, end)], axis))?;
            let place = (x, bottom + units(8.0) as i32);
            area.draw(&words(text, place, Ink::Muted, HPos::Center, VPos::Top))?;
        }
        if !self.x.label.is_empty() {
            let place = ((left + right) / 2, bottom + units(26.0) as i32);
            area.draw(&words(&self.x.label, place, Ink::Text, HPos::Center, VPos::Top))?;
        }
        if !self.y.label.is_empty() {
            let place = (units(4.0) as i32, top - units(24.0) as i32);
            area.draw(&words(&self.y.label, place, Ink::Text, HPos::Left, VPos::Top))?;
        }
        Ok(())
    }

    fn draw_mark(&self, area: &Area<'_>, chart: &Chart<'_, '_>, mark: &Mark) -> Drawing {
        match mark {
            Mark::Line { points, stroke, .. } => {
                let style = line_of(*stroke);
                for run in finite_runs(points) {
                    let path: Vec<_> = run.iter().map(|&p| self.at(chart, p)).collect();
                    area.draw(&PathElement::new(path, style))?;
                }
            }
            Mark::Area { points, base, ink, opacity } => {
                for run in finite_runs(points) {
                    let (first, last) = (run[0], run[run.len() - 1]);
                    let mut path: Vec<_> = run.iter().map(|&p| self.at(chart, p)).collect();
                    path.push(self.at(chart, [last[0], *base]));
                    path.push(self.at(chart, [first[0], *base]));
                    area.draw(&Polygon::new(path, colour(*ink, Dash::Solid).mix(*opacity).filled()))?;
                }
            }
            Mark::Frame { x, y, ink, opacity, width } => {
                let (a, b) = (self.at(chart, [x[0], y[0]]), self.at(chart, [x[1], y[1]]));
                let fill = colour(*ink, Dash::Solid).mix(*opacity).filled();
                let corners = [(a.0.min(b.0), a.1.min(b.1)), (a.0.max(b.0), a.1.max(b.1))];
                area.draw(&Rectangle::new(corners, fill))?;
                if *width > 0.0 {
                    let ring = [a, (b.0, a.1), b, (a.0, b.1), a, (b.0, a.1)];
                    area.draw(&PathElement::new(ring, line(*ink, *width)))?;
                }
            }
            Mark::Dots { points, ink, radius } => {
                for &point in points.iter().filter(|p| p[0].is_finite() && p[1].is_finite()) {
                    let place = self.at(chart, point);
                    for (ink, radius) in [(Ink::Card, radius + 1.5), (*ink, *radius)] {
                        let fill = colour(ink, Dash::Solid).filled();
                        area.draw(&Circle::new(place, units(radius), fill))?;
                    }
                }
            }
            Mark::Note { at, shift, text, ink } => {
                let (x, y) = self.at(chart, *at);
                let place = (x + (shift[0] * UNIT) as i32, y + (shift[1] * UNIT) as i32);
                area.draw(&words(text, place, *ink, HPos::Right, VPos::Center))?;
            }
            Mark::Label { at, text, ink } => {
                let (x, y) = self.at(chart, *at);
                let place = (x + units(8.0) as i32, y);
                area.draw(&words(text, place, *ink, HPos::Left, VPos::Center))?;
            }
        }
        Ok(())
    }

    fn name_at_ends(&self, area: &Area<'_>, chart: &Chart<'_, '_>, named: &[Named<'_>]) -> Drawing {
        let places: Vec<_> = named.iter().map(|(end, ..)| self.at(chart, *end)).collect();
        let heights: Vec<_> = places.iter().map(|p| f64::from(p.1)).collect();
        let apart = spread(&heights, LETTERS * 1.15 * UNIT);
        for (((_, stroke, name), (x, _)), y) in named.iter().zip(places).zip(apart) {
            let place = (x + units(7.0) as i32, y.round() as i32);
            area.draw(&words(name, place, stroke.ink, HPos::Left, VPos::Center))?;
        }
        Ok(())
    }

    /// Left edge in CSS pixels and row of each sample of the legend, in rows as wide as the plot.
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

fn name_above(area: &Area<'_>, rows: &[(f64, u32)], named: &[Named<'_>]) -> Drawing {
    for ((_, stroke, name), &(x, row)) in named.iter().zip(rows) {
        let (left, right) = (units(x) as i32, units(x + SAMPLE) as i32);
        let y = units(12.0 + 20.0 * f64::from(row)) as i32;
        area.draw(&PathElement::new([(left, y), (right, y)], line_of(*stroke)))?;
        let place = (right + units(6.0) as i32, y);
        area.draw(&words(name, place, Ink::Text, HPos::Left, VPos::Center))?;
    }
    Ok(())
}

fn words(text: &str, place: (i32, i32), ink: Ink, h: HPos, v: VPos) -> Text<'static, (i32, i32), &str> {
    // The backend divides the size by 1.24, its guess of a font's line height.
    let font = FontDesc::new(FontFamily::Name("system-ui"), LETTERS * UNIT * 1.24, FontStyle::Normal);
    let mut style = TextStyle::from(font).pos(Pos::new(h, v));
    style.color = colour(ink, Dash::Solid).to_backend_color();
    Text::new(text, place, style)
}

/// Runs of two and more finite points.
fn finite_runs(points: &[[f64; 2]]) -> impl Iterator<Item = &[[f64; 2]]> {
    points.split(|p| !(p[0].is_finite() && p[1].is_finite())).filter(|run| run.len() > 1)
}
