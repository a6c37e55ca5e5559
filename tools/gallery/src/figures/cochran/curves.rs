//! Figures 1 and 3 of Cochran, Lewis and Hart: two fractal functions and their integrals, their
//! second integrals with fractal curvature, and the dimension of graphs against their vertical
//! factor, by the formula and by box counting.

use asperity_fif::{FifError, FixedFif, cochran_2000};

use crate::figure::{Context, Drawn, Panel};
use crate::plot::{Axis, Ink, Names, Plot, Stroke};
use asperity::failure::Result;

/// Absolute error of every plotted value, far below a pixel.
const TOLERANCE: f64 = 1e-6;

/// Creates a plot over the domain of these functions.
pub(super) fn plot(size: [f64; 2], y: Axis, names: Names) -> Plot {
    Plot::new(size, Axis::linear("x", [0.0, 2.0], 0.5), y, names)
}

/// Size of a plot that takes half of the page's width.
pub(super) const HALF: [f64; 2] = [520.0, 330.0];

pub(crate) fn draw_functions(_: &Context<'_>) -> Result<Drawn> {
    let panel = |name, fif: &FixedFif<2, 2>, range, label, alt| {
        let curve = outline(fif);
        let knots = [0.0, 1.0, 2.0].map(|x| [x, fif.evaluate(x, TOLERANCE).value]);
        plot(HALF, Axis::linear("", range, 0.5), Names::AtEnds)
            .area(curve.clone(), 1, 0.07)
            .line(knots, Stroke::dashed(Ink::Muted).wide(0.9))
            .curve(name, curve, Stroke::solid(1).wide(1.2))
            .dots(knots, 2, 3.5)
            .panel(name, label, alt)
    };
    let f = "Graph of f: a symmetric mound of height 4/3, with bumps on bumps";
    let g = "Graph of g: jagged peaks up to almost 2 on the left, and an inverted copy on the right";
    let panels = vec![
        panel("f", &cochran_2000::f()?, [0.0, 1.5], "f, vertical factors 1/2 and 1/2", f)?,
        panel("g", &cochran_2000::g()?, [-1.0, 2.0], "g, vertical factors 17/20 and −17/20", g)?,
    ];
    Ok(Drawn::new(2, panels).fact("knots", "0, 1, 2").fact("tolerance", format!("{TOLERANCE:e}")))
}

pub(crate) fn draw_integrals(_: &Context<'_>) -> Result<Drawn> {
    const AT: [f64; 4] = [0.25, 2.0 / 3.0, 1.2, 1.75];
    let panel = |[stem, name, rough]: [&str; 3], slope: &FixedFif<2, 2>, range, alt| -> Result<Panel> {
        let integral: FixedFif<2, 3> = slope.integral(0.0)?;
        let touched = AT.map(|x| {
            let rise = slope.evaluate(x, TOLERANCE).value;
            (x, [integral.evaluate(x, TOLERANCE).value, rise, 0.0], 0.2 / rise.hypot(1.0))
        });
        let curves = plot(HALF, Axis::linear("", range, 0.5), Names::AtEnds)
            .curve(rough, outline(slope), Stroke::solid(2).wide(0.6))
            .curve(name, outline(&integral), Stroke::solid(1).wide(2.0));
        touching(curves, touched, 1.0).panel(stem, format!("{name} and its derivative {rough}"), alt)
    };
    let f = "The integral of f rises from 0 to 2 like a soft step; f is the thin line";
    let g = "The integral of g rises with many small undulations to 1; g, the thin line, is jagged";
    let panels = vec![
        panel(["f-hat", "f\u{302}", "f"], &cochran_2000::f()?, [0.0, 2.0], f)?,
        panel(["g-hat", "ĝ", "g"], &cochran_2000::g()?, [-1.0, 2.0], g)?,
    ];
    Ok(Drawn::new(2, panels)
        .fact("knots", "0, 1, 2")
        .fact("tangents at", "1/4, 2/3, 6/5, 7/4")
        .fact("tolerance", format!("{TOLERANCE:e}")))
}

pub(crate) fn draw_second_integrals(_: &Context<'_>) -> Result<Drawn> {
    const AT: [f64; 4] = [0.3, 2.0 / 3.0, 1.2, 1.75];
    const FINE: f64 = 1e-9;
    let panel = |names: [&str; 3], rough: &FixedFif<2, 2>, range| -> Result<Panel> {
        let first: FixedFif<2, 3> = rough.integral(0.0)?;
        let second: FixedFif<2, 4> = first.integral(0.0)?;
        let touched = AT.map(|x| {
            let orders = [second.evaluate(x, FINE), first.evaluate(x, FINE), rough.evaluate(x, FINE)];
            (x, orders.map(|bounded| bounded.value), 0.2)
        });
        let curves = plot(HALF, Axis::linear("", range, 0.5), Names::AtEnds)
            .curve(names[0], outline(rough), Stroke::solid(3).wide(0.6))
            .curve(names[1], outline(&first), Stroke::solid(2).wide(1.1))
            .curve(names[2], outline(&second), Stroke::solid(1).wide(3.6));
        touching(curves, touched, 0.9).panel(
            names[0],
            format!("{}, its derivative {} and its second derivative {}", names[2], names[1], names[0]),
            format!(
                "A smooth arc, {}, over its rougher derivative and its jagged second derivative",
                names[2]
            ),
        )
    };
    let panels = vec![
        panel(["f", "f\u{302}", "f\u{302}\u{302}"], &cochran_2000::f()?, [0.0, 2.15])?,
        panel(["g", "ĝ", "ĝ\u{302}"], &cochran_2000::g()?, [-1.0, 2.0])?,
    ];
    Ok(Drawn::new(2, panels)
        .fact("vertical factors", "1/2, 1/4, 1/8 and ±17/20, ±17/40, ±17/80")
        .fact("parabolas at", "3/10, 2/3, 6/5, 7/4")
        .fact("tolerance", "1e-9"))
}

/// A point, the value and two derivatives there, and the distance to which their Taylor polynomial
/// is plotted.
type Taylor = (f64, [f64; 3], f64);

/// Adds tangents or parabolas that touch a curve, and dots where they do.
fn touching(mut plot: Plot, touched: [Taylor; 4], width: f64) -> Plot {
    for &(x, [value, slope, bend], reach) in &touched {
        let steps = if bend == 0.0 { 1 } else { 16 };
        let point = |step: f64| [x + step, value + step * (slope + 0.5 * step * bend)];
        let points = (-steps..=steps).map(|k| point(reach * f64::from(k) / f64::from(steps)));
        plot = plot.line(points, Stroke::solid(Ink::Text).wide(width));
    }
    plot.dots(touched.map(|(x, [value, ..], _)| [x, value]), Ink::Text, 2.6)
}

/// Returns the graph at the plot's resolution: the minimum and the maximum of several points per
/// narrow column.
///
/// Equally spaced points of a rough function would miss its peaks. A column is a cell of these
/// functions, over which they repeat themselves. f has its maximum at 1/3 of the domain, and g its
/// extrema at 3/14 and 5/7: all are multiples of 1/126.
pub(super) fn outline<const C: usize>(fif: &FixedFif<2, C>) -> Vec<[f64; 2]> {
    const COLUMNS: u32 = 512;
    const POINTS: u32 = 126;
    let domain = fif.domain();
    let width = domain.width() / f64::from(COLUMNS);
    let mut points = vec![[domain.lo, fif.end_values()[0]]];
    for column in 0..COLUMNS {
        let sample = |k: u32| {
            let x = domain.lo + width * (f64::from(column) + f64::from(k) / f64::from(POINTS));
            [x, fif.evaluate(x, TOLERANCE).value]
        };
        let samples: Vec<_> = (1..POINTS).map(sample).collect();
        let low = samples.iter().copied().min_by(|a, b| a[1].total_cmp(&b[1]));
        let high = samples.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1]));
        let mut pair: Vec<_> = low.into_iter().chain(high).collect();
        pair.sort_by(|a, b| a[0].total_cmp(&b[0]));
        points.append(&mut pair);
    }
    points.push([domain.hi, fif.end_values()[1]]);
    points
}

/// Vertical factors for box counting.
const COUNTED: [f64; 7] = [0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95];

/// Vertical factors of the plotted graphs.
const DRAWN: [f64; 3] = [0.3, 0.7, 0.95];

/// Levels between which boxes are counted.
const LEVELS: [u32; 2] = [6, 9];

pub(crate) fn draw_dimension(context: &Context<'_>) -> Result<Drawn> {
    context.watch.progress.inc_length(COUNTED.len() as u64);
    let mut dots = Vec::new();
    for alpha in COUNTED {
        dots.push([alpha, counted(&symmetric(1.0, alpha)?).ok_or("the cell has no bounds")?]);
        context.watch.progress.inc(1);
        context.checkpoint()?;
    }
    let panels = [by_factor(dots)].into_iter().chain(DRAWN.map(graph)).collect::<Result<_, _>>()?;
    Ok(Drawn::new(2, panels)
        .fact("boxes counted at levels", "6 and 9")
        .fact("knots", "0, 1, 2 and 0, 1/2, 2"))
}

/// Both maps with the same factor, the middle knot at `middle`.
fn symmetric(middle: f64, alpha: f64) -> Result<FixedFif<2, 2>, FifError> {
    FixedFif::affine(&[0.0, middle, 2.0], &[0.0, 1.0, 0.0], &[alpha; 2])
}

/// Returns the slope of the logarithm of the number of boxes between the two levels.
fn counted(fif: &FixedFif<2, 2>) -> Option<f64> {
    let logs = LEVELS.map(|level| {
        let side = 2.0 / f64::from(1_u32 << level);
        let boxes = (0..1_u32 << level).map(|cell| {
            let left = side * f64::from(cell);
            Some(fif.extrema_over(left, left + side, 0.05 * side)?.enclosure().width() / side + 1.0)
        });
        boxes.sum::<Option<f64>>().map(f64::log2)
    });
    Some((logs[1]? - logs[0]?) / f64::from(LEVELS[1] - LEVELS[0]))
}

fn by_factor(dots: Vec<[f64; 2]>) -> Result<Panel> {
    let curve = |middle: f64| -> Result<Vec<[f64; 2]>, FifError> {
        let alphas = (1..200).map(|k| 0.005 * f64::from(k));
        alphas.map(|alpha| Ok([alpha, symmetric(middle, alpha)?.dimension().middle()])).collect()
    };
    let alt = "The dimension stays 1 up to the factor 1/2 and rises to 2 at factor 1; counted boxes lie on the curve";
    let x = Axis::linear("vertical factor α", [0.0, 1.0], 0.25);
    Plot::new(HALF, x, Axis::linear("dimension", [0.9, 2.05], 0.25), Names::Above)
        .curve("knots 0, 1/2, 2", curve(0.5)?, Stroke::dashed(2))
        .curve("knots 0, 1, 2", curve(1.0)?, Stroke::solid(1).wide(2.0))
        .dots(dots, 1, 3.2)
        .panel("plot", "Dimension by the formula; dots: box counting", alt)
}

fn graph(alpha: f64) -> Result<Panel> {
    let fif = symmetric(1.0, alpha)?;
    let range = fif.range();
    let step = if range.hi > 4.0 { 2.0 } else { 0.5 };
    let y = Axis::linear("", [range.lo.min(0.0), 1.05 * range.hi], step);
    plot(HALF, y, Names::Hidden).line(outline(&fif), Stroke::solid(1).wide(1.0)).panel(
        format!("graph-{}", (100.0 * alpha).round()),
        format!("α = {alpha}, dimension {:.3}", fif.dimension().middle()),
        format!("The graph with vertical factor {alpha}"),
    )
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn outline_finds_peaks_between_knots() {
        let (f, g) = (cochran_2000::f().unwrap(), cochran_2000::g().unwrap());
        let top = |points: Vec<[f64; 2]>| points.iter().fold(f64::MIN, |top, p| top.max(p[1]));
        assert_abs_diff_eq!(top(outline(&f)), 4.0 / 3.0, epsilon = 1e-5);
        // Exact maximum 41969/21609 at 3/7. One unit in the last place of x changes g by 5e-4.
        assert_abs_diff_eq!(top(outline(&g)), 41969.0 / 21609.0, epsilon = 1e-3);
        assert!(outline(&g).windows(2).all(|w| w[0][0] <= w[1][0]));
    }
}
