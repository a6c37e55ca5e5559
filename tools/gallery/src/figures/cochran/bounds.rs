//! Rigorous boxes over the cells of a function, boxes opened by a ray, and contractions toward a
//! point: figures 4 and 2 of Cochran, Lewis and Hart.

use asperity_fif::{FixedFif, Interval, Map, cochran_2000};

use crate::figure::{Context, Drawn, Panel};
use crate::figures::cochran::curves::{HALF, outline, plot};
use crate::plot::{Axis, HPos, Ink, Names, Stroke};
use asperity::failure::Result;

/// The levels shown.
const LEVELS: [u32; 3] = [2, 4, 6];

/// Brackets of extrema are refined to this width.
const WIDTH: f64 = 1e-9;

/// A function with its name and the range of its plots.
type Subject = (&'static str, FixedFif<2, 2>, [f64; 2]);

fn subjects() -> Result<[Subject; 2]> {
    Ok([("f", cochran_2000::f()?, [0.0, 1.7]), ("g", cochran_2000::g()?, [-2.0, 3.0])])
}

pub(crate) fn draw_bounds(context: &Context<'_>) -> Result<Drawn> {
    context.watch.progress.inc_length(6);
    let mut panels = Vec::new();
    let mut rows = LEVELS.map(|level| vec![level.to_string(), (1_u32 << level).to_string()]);
    for (name, fif, range) in &subjects()? {
        for (level, row) in LEVELS.into_iter().zip(&mut rows) {
            let mut plot = plot([360.0, 300.0], Axis::linear("", *range, 0.5), Names::Hidden);
            let border = if level > 5 { 0.5 } else { 0.7 };
            let (mut highest, mut opened, mut outlined) = (0.0_f64, 0.0, 0.0);
            for digits in cells(level) {
                let x = place(&digits);
                let mapped = mapped(fif, &digits).ok_or("the cell has no bounds")?;
                let searched =
                    fif.extrema_over(x[0], x[1], WIDTH).ok_or("the cell has no extrema")?.enclosure();
                plot = plot.frame(x, [searched.lo, searched.hi], 1, 0.22, 0.0);
                plot = plot.frame(x, [mapped.lo, mapped.hi], 1, 0.0, border);
                highest = highest.max(searched.width());
                opened += (x[1] - x[0]) * mapped.width();
                outlined += (x[1] - x[0]) * searched.width();
            }
            let count = 1_u32 << level;
            panels.push(plot.line(outline(fif), Stroke::solid(Ink::Text).wide(0.7)).panel(
                format!("{name}-{level}"),
                format!("{name}, level {level}: {count} cells"),
                format!("The graph of {name} in {count} boxes"),
            )?);
            row.extend([highest, opened, outlined].map(|value| format!("{value:.4}")));
            context.watch.progress.inc(1);
            context.checkpoint()?;
        }
    }
    let of = |name: &str| {
        ["highest box", "area outlined", "area filled"].map(|quantity| format!("{name}: {quantity}"))
    };
    let head = ["level", "cells"].map(str::to_owned).into_iter().chain(of("f")).chain(of("g"));
    Ok(Drawn::new(3, panels).fact("brackets of extrema", "1e-9 wide").table(head, rows))
}

/// Returns the digits of every cell of a level, from left to right.
fn cells(level: u32) -> impl Iterator<Item = Vec<usize>> {
    (0..1_usize << level).map(move |cell| (0..level).rev().map(|bit| cell >> bit & 1).collect())
}

/// Returns the interval of a cell, for a system with knots 0, 1, 2.
fn place(digits: &[usize]) -> [f64; 2] {
    let left = digits.iter().rev().fold(0.0, |left, &digit| 0.5 * left + digit as f64);
    [left, left + 2.0 / f64::from(1_u32 << digits.len())]
}

/// Returns the image of the whole range in a cell.
fn mapped(fif: &FixedFif<2, 2>, digits: &[usize]) -> Option<Interval> {
    Some(fif.value_at_address(digits.iter().copied(), 0.0)?.interval())
}

/// Levels that the ray descends.
const DEEPEST: usize = 10;

/// Height at x = 0 and slope of the rays.
const RAYS: [[f64; 2]; 2] = [[1.52, -0.5], [2.3, -0.9]];

pub(crate) fn draw_descent(_: &Context<'_>) -> Result<Drawn> {
    let (mut panels, mut rows) = (Vec::new(), Vec::new());
    for ((name, fif, range), [height, slope]) in subjects()?.iter().zip(RAYS) {
        let along = |x: f64| [x, height + slope * x];
        let mut tried = Vec::new();
        let first = descend(fif, &along, &mut Vec::new(), &mut tried).ok_or("a ray without a hit")?;
        let mut plot = plot(HALF, Axis::linear("", *range, 0.5), Names::Hidden);
        for &Tried { x, y, level, opened } in &tried {
            let opacity = if opened { 0.05 + 0.02 * level as f64 } else { 0.0 };
            let ink = if opened { Ink::Series(1) } else { Ink::Muted };
            plot = plot.frame(x, [y.lo, y.hi], ink, opacity, 0.6);
        }
        let hit = 0.5 * (first.x[0] + first.x[1]);
        panels.push(
            plot.line(outline(fif), Stroke::solid(Ink::Text).wide(0.7))
                .line([along(0.0), along(hit)], Stroke::solid(2).wide(1.5))
                .line([along(hit), along(2.0)], Stroke::dashed(2).wide(0.8))
                .dots([along(hit)], 2, 3.2)
                .panel(
                    *name,
                    format!("A ray and the graph of {name}"),
                    format!("A ray that descends toward the graph of {name}, with the boxes along its path"),
                )?,
        );
        rows.push([
            (*name).to_owned(),
            format!("y = {height} \u{2212} {} x", -slope),
            tried.len().to_string(),
            tried.iter().filter(|t| t.opened).count().to_string(),
            format!("[{:.5}, {:.5}]", first.x[0], first.x[1]),
            format!("{:.5}", first.y.width()),
        ]);
    }
    let head = ["graph", "ray", "boxes tried", "opened", "box of the hit", "its height"];
    Ok(Drawn::new(2, panels).fact("levels", DEEPEST).table(head, rows))
}

/// A box tested against the ray.
#[derive(Clone, Copy)]
struct Tried {
    x: [f64; 2],
    y: Interval,
    level: usize,
    opened: bool,
}

/// Returns the first box of the last level below the cell that a ray to the right hits, and all
/// boxes tested.
fn descend(
    fif: &FixedFif<2, 2>,
    ray: &impl Fn(f64) -> [f64; 2],
    digits: &mut Vec<usize>,
    tried: &mut Vec<Tried>,
) -> Option<Tried> {
    let (x, y) = (place(digits), mapped(fif, digits)?);
    let [a, b] = x.map(|x| ray(x)[1]);
    let opened = a.min(b) <= y.hi && a.max(b) >= y.lo;
    let this = Tried { x, y, level: digits.len(), opened };
    tried.push(this);
    if !opened || digits.len() == DEEPEST {
        return opened.then_some(this);
    }
    (0..2).find_map(|digit| {
        digits.push(digit);
        let met = descend(fif, ray, digits, tried);
        digits.pop();
        met
    })
}

/// L2∘L1∘L2∘L1∘L2∘L2, indices from 0.
const ADDRESS: [usize; 6] = [1, 0, 1, 0, 1, 1];

/// The point with [`ADDRESS`] repeated infinitely: `x = a x + b` with `a = 1/64` and `b = 43/32`.
const POINT: f64 = 86.0 / 63.0;

const SIZE: [f64; 2] = [360.0, 330.0];
const NAMES: [&str; 2] = ["L₁", "L₂"];

pub(crate) fn draw_contractions(_: &Context<'_>) -> Result<Drawn> {
    let (f, g) = (cochran_2000::f()?, cochran_2000::g()?);
    let panels = vec![
        ladder()?,
        boxes("f", &f, Axis::linear("", [0.0, 1.75], 0.5))?,
        boxes("g", &g, Axis::linear("", [-2.0, 2.0], 1.0))?,
    ];
    let head = ["after", "interval", "f: bound |A|·R", "f: error", "g: bound |A|·R", "g: error"];
    let rows = (0..=ADDRESS.len()).map(|level| {
        let ([lo, hi], names) = (place(&ADDRESS[..level]), ADDRESS[..level].iter().map(|&j| NAMES[j]));
        let after = names.collect::<Vec<_>>().join("∘");
        let mut row = vec![if level == 0 { "identity".into() } else { after }, format!("[{lo}, {hi}]")];
        for fif in [&f, &g] {
            row.extend(estimate(fif, level).map(|value| format!("{value:.4}")));
        }
        row
    });
    Ok(Drawn::new(3, panels)
        .fact("point", "86/63")
        .fact("R of f", format!("{:.4}", 0.5 * f.range().width()))
        .fact("R of g", format!("{:.4}", 0.5 * g.range().width()))
        .table(head, rows))
}

/// Returns the value at [`POINT`], computed from its address. The nearest f64 number is a different
/// point.
fn exact(fif: &FixedFif<2, 2>) -> f64 {
    fif.value_at_address(ADDRESS.into_iter().cycle(), 1e-12).map_or(f64::NAN, |v| v.value)
}

/// Returns bound and true error of the value after `level` steps, with the center of the range for
/// the rest.
fn estimate(fif: &FixedFif<2, 2>, level: usize) -> [f64; 2] {
    let map = ADDRESS[..level].iter().fold(Map::IDENTITY, |outer, &j| outer.compose(fif.pieces()[j].map()));
    let (_, value) = map.apply((POINT - map.b) / map.a, fif.range().middle());
    [0.5 * map.alpha.abs() * fif.range().width(), (value - exact(fif)).abs()]
}

fn ladder() -> Result<Panel> {
    let levels = ADDRESS.len();
    let end = -(levels as f64) - 0.55;
    let y = Axis::linear("", [-6.7, 0.5], 1.0).with_ticks(&[]);
    let mut plot =
        plot(SIZE, y, Names::Hidden).line([[POINT, 0.0], [POINT, end]], Stroke::dashed(Ink::Muted).wide(0.9));
    for level in 0..=levels {
        let y = -(level as f64);
        let shade = 0.12 + 0.76 * level as f64 / levels as f64;
        plot = plot.frame(place(&ADDRESS[..level]), [y - 0.28, y + 0.28], 1, shade, 0.8);
        if let Some(&next) = ADDRESS.get(level) {
            plot = plot.words(HPos::Right, [place(&ADDRESS[..=level])[0], y - 1.0], NAMES[next]);
        }
    }
    let alt = "Seven bars, each half as long as the one above, converging to 86/63";
    plot.panel("intervals", "The intervals, by the maps of the address", alt)
}

fn boxes(name: &str, fif: &FixedFif<2, 2>, y: Axis) -> Result<Panel> {
    let mut plot = plot(SIZE, y, Names::Hidden).line(outline(fif), Stroke::solid(Ink::Muted).wide(0.7));
    for level in 1..=ADDRESS.len() {
        let range = mapped(fif, &ADDRESS[..level]).ok_or("a cell without bounds")?;
        plot = plot.frame(place(&ADDRESS[..level]), [range.lo, range.hi], 1, 0.13, 0.9);
    }
    plot.dots([[POINT, exact(fif)]], 2, 2.6).panel(
        format!("boxes-{name}"),
        format!("The boxes over the graph of {name}"),
        format!("Graph of {name} with six nested boxes around the point at 86/63"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ray_is_above_the_graph_before_its_box() {
        for ((_, fif, _), [height, slope]) in subjects().unwrap().iter().zip(RAYS) {
            let (ray, mut tried) = (|x: f64| [x, height + slope * x], Vec::new());
            let first = descend(fif, &ray, &mut Vec::new(), &mut tried).unwrap();
            for x in (0..1000).map(|k| first.x[0] * f64::from(k) / 1000.0) {
                assert!(ray(x)[1] > fif.evaluate(x, 1e-9).value, "{x}");
            }
            assert!(tried.len() < 80, "{}", tried.len());
        }
    }

    #[test]
    fn intervals_nest_and_errors_stay_within_bounds() {
        let functions = [cochran_2000::f().unwrap(), cochran_2000::g().unwrap()];
        for level in 0..=ADDRESS.len() {
            let [lo, hi] = place(&ADDRESS[..level]);
            assert!(lo < POINT && POINT < hi && hi - lo == 2.0 / f64::from(1_u32 << level));
            for fif in &functions {
                let [bound, error] = estimate(fif, level);
                assert!(error <= bound, "level {level}: {error} > {bound}");
            }
        }
        assert_eq!(place(&ADDRESS), [43.0 / 32.0, 11.0 / 8.0]);
    }
}
