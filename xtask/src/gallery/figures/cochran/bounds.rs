//! Rigorous boxes over the cells of a function, and those that a ray opens: figure 4 of Cochran, Lewis and Hart.

use asperity_fif::{FixedFif, Interval, paper};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};
use crate::gallery::figures::cochran::curves::{HALF, outline, plot};
use crate::gallery::plot::{Axis, Ink, Names, Stroke};

/// The levels shown.
const LEVELS: [u32; 3] = [2, 4, 6];

/// Brackets of extrema are searched down to this width.
const WIDTH: f64 = 1e-9;

pub(crate) fn draw_bounds(context: &Context<'_>) -> Result<Drawn, Failure> {
    let functions = [("f", paper::f()?, [0.0, 1.7]), ("g", paper::g()?, [-2.0, 3.0])];
    context.progress.inc_length(6);
    let mut panels = Vec::new();
    let mut rows = LEVELS.map(|level| vec![level.to_string(), (1_u32 << level).to_string()]);
    for (name, fif, range) in &functions {
        for (level, row) in LEVELS.into_iter().zip(&mut rows) {
            let boxes: Option<Vec<_>> = cells(level).map(|cell| Boxes::of(fif, &cell)).collect();
            let boxes = boxes.ok_or("a cell without bounds")?;
            panels.push(boxes_panel(name, fif, level, &boxes, *range)?);
            let width = 2.0 / boxes.len() as f64;
            let highest = boxes.iter().map(|b| b.searched.width()).fold(0.0, f64::max);
            let area: f64 = boxes.iter().map(|b| width * b.searched.width()).sum();
            let opened: f64 = boxes.iter().map(|b| width * b.mapped.width()).sum();
            row.extend([highest, opened, area].map(|value| format!("{value:.4}")));
            context.progress.inc(1);
            context.checkpoint()?;
        }
    }
    let of = |name: &str| {
        ["highest box", "area outlined", "area filled"].map(|quantity| format!("{name}: {quantity}"))
    };
    let head = ["level", "cells"].map(str::to_owned).into_iter().chain(of("f")).chain(of("g"));
    Ok(Drawn::new(3, panels).fact("brackets of extrema", "1e-9 wide").table(head, rows))
}

/// The digits of every cell of a level, from left to right.
fn cells(level: u32) -> impl Iterator<Item = Vec<usize>> {
    (0..1_usize << level).map(move |cell| (0..level).rev().map(|bit| cell >> bit & 1).collect())
}

/// The interval of a cell of a system with the knots 0, 1, 2.
fn place(digits: &[usize]) -> [f64; 2] {
    let left = digits.iter().rev().fold(0.0, |left, &digit| 0.5 * left + digit as f64);
    [left, left + 2.0 / f64::from(1_u32 << digits.len())]
}

/// The two bounds of a cell.
struct Boxes {
    x: [f64; 2],
    /// The image of the whole range.
    mapped: Interval,
    /// The extrema, bracketed.
    searched: Interval,
}

impl Boxes {
    fn of(fif: &FixedFif<2, 2>, digits: &[usize]) -> Option<Self> {
        let x = place(digits);
        let mapped = fif.value_at_address(digits.iter().copied(), 0.0)?.interval();
        let searched = fif.extrema_over(x[0], x[1], WIDTH)?.enclosure();
        Some(Self { x, mapped, searched })
    }
}

fn boxes_panel(
    name: &str,
    fif: &FixedFif<2, 2>,
    level: u32,
    boxes: &[Boxes],
    range: [f64; 2],
) -> Result<Panel, Failure> {
    let mut plot = plot([360.0, 300.0], Axis::linear("", range, 0.5), Names::Hidden);
    let border = if level > 5 { 0.5 } else { 0.7 };
    for b in boxes {
        plot = plot.frame(b.x, [b.searched.lo, b.searched.hi], 1, 0.22, 0.0);
        plot = plot.frame(b.x, [b.mapped.lo, b.mapped.hi], 1, 0.0, border);
    }
    plot.line(outline(fif), Stroke::solid(Ink::Text).wide(0.7)).panel(
        format!("{name}-{level}"),
        format!("{name}, level {level}: {} cells", boxes.len()),
        format!("The graph of {name} in {} boxes", boxes.len()),
    )
}

/// Levels that the ray descends.
const DEEPEST: usize = 10;

/// Height at x = 0 and slope of the rays.
const RAYS: [[f64; 2]; 2] = [[1.52, -0.5], [2.3, -0.9]];

pub(crate) fn draw_descent(_: &Context<'_>) -> Result<Drawn, Failure> {
    let functions = [("f", paper::f()?, [0.0, 1.7]), ("g", paper::g()?, [-2.0, 3.0])];
    let (mut panels, mut rows) = (Vec::new(), Vec::new());
    for ((name, fif, range), ray) in functions.iter().zip(RAYS) {
        let mut walk = Walk { fif, ray, tried: Vec::new() };
        let met = walk.descend(&mut Vec::new());
        let first = met.ok_or("a ray without a hit")?;
        panels.push(descent_panel(name, &walk, &first, *range)?);
        rows.push([
            (*name).to_owned(),
            format!("y = {} \u{2212} {} x", ray[0], -ray[1]),
            walk.tried.len().to_string(),
            walk.tried.iter().filter(|t| t.opened).count().to_string(),
            format!("[{:.5}, {:.5}]", first.x[0], first.x[1]),
            format!("{:.5}", first.y.width()),
        ]);
    }
    let head = ["graph", "ray", "boxes tried", "opened", "box of the hit", "its height"];
    Ok(Drawn::new(2, panels).fact("levels", DEEPEST.to_string()).table(head, rows))
}

/// A box that the ray was tried against.
#[derive(Clone)]
struct Tried {
    x: [f64; 2],
    y: Interval,
    level: usize,
    opened: bool,
}

/// The ordered descent of a ray that goes to the right, `[height at 0, slope]`.
struct Walk<'a> {
    fif: &'a FixedFif<2, 2>,
    ray: [f64; 2],
    tried: Vec<Tried>,
}

impl Walk<'_> {
    /// The first box of the last level that the ray meets beneath the cell.
    fn descend(&mut self, digits: &mut Vec<usize>) -> Option<Tried> {
        let x = place(digits);
        let y = self.fif.value_at_address(digits.iter().copied(), 0.0)?.interval();
        let [a, b] = x.map(|x| self.ray[0] + self.ray[1] * x);
        let opened = a.min(b) <= y.hi && a.max(b) >= y.lo;
        let this = Tried { x, y, level: digits.len(), opened };
        self.tried.push(this.clone());
        if !opened || digits.len() == DEEPEST {
            return opened.then_some(this);
        }
        for digit in 0..2 {
            digits.push(digit);
            let met = self.descend(digits);
            digits.pop();
            if met.is_some() {
                return met;
            }
        }
        None
    }
}

fn descent_panel(name: &str, walk: &Walk<'_>, first: &Tried, range: [f64; 2]) -> Result<Panel, Failure> {
    let mut plot = plot(HALF, Axis::linear("", range, 0.5), Names::Hidden);
    for tried in &walk.tried {
        let opacity = if tried.opened { 0.05 + 0.02 * tried.level as f64 } else { 0.0 };
        let ink = if tried.opened { Ink::Series(1) } else { Ink::Muted };
        plot = plot.frame(tried.x, [tried.y.lo, tried.y.hi], ink, opacity, 0.6);
    }
    let hit = 0.5 * (first.x[0] + first.x[1]);
    let along = |x: f64| [x, walk.ray[0] + walk.ray[1] * x];
    plot.line(outline(walk.fif), Stroke::solid(Ink::Text).wide(0.7))
        .line([along(0.0), along(hit)], Stroke::solid(2).wide(1.5))
        .line([along(hit), along(2.0)], Stroke::dashed(2).wide(0.8))
        .dots([along(hit)], 2, 3.2)
        .panel(
            name,
            format!("A ray and the graph of {name}"),
            format!("A ray that sinks towards the graph of {name}, with the boxes around its way"),
        )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn searched_boxes_lie_in_mapped_ones_and_hold_the_graph() {
        for fif in [paper::f().unwrap(), paper::g().unwrap()] {
            for digits in LEVELS.into_iter().flat_map(cells) {
                let b = Boxes::of(&fif, &digits).unwrap();
                // One unit in the last place of x changes g by 5e-4, and cells are searched with such a margin.
                assert!(
                    b.mapped.inflated(4e-3).contains(b.searched.lo)
                        && b.mapped.inflated(4e-3).contains(b.searched.hi)
                );
                for k in 0..=20 {
                    let x = b.x[0] + (b.x[1] - b.x[0]) * f64::from(k) / 20.0;
                    assert!(b.searched.contains(fif.evaluate(x, 1e-12).value), "{digits:?} {x}");
                }
            }
        }
    }

    #[test]
    fn the_ray_is_above_the_graph_before_its_box() {
        for (fif, ray) in [paper::f().unwrap(), paper::g().unwrap()].iter().zip(RAYS) {
            let mut walk = Walk { fif, ray, tried: Vec::new() };
            let first = walk.descend(&mut Vec::new()).unwrap();
            for k in 0..1000 {
                let x = first.x[0] * f64::from(k) / 1000.0;
                assert!(ray[0] + ray[1] * x > fif.evaluate(x, 1e-9).value, "{x}");
            }
            assert!(walk.tried.len() < 80, "{}", walk.tried.len());
        }
    }
}
