//! Figures 1 and 3 of Cochran, Lewis and Hart: two fractal functions and their integrals.

use asperity_fif::{FixedFif, paper};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};
use crate::gallery::plot::{Axis, Ink, Names, Plot, Stroke};

/// Absolute error of every value drawn, far below a pixel.
const TOLERANCE: f64 = 1e-6;

/// A plot over the domain of these functions.
pub(super) fn plot(size: [f64; 2], y: Axis, names: Names) -> Plot {
    Plot::new(size, Axis::linear("x", [0.0, 2.0], 0.5), y, names)
}

/// Of a plot that takes half of the page's width.
pub(super) const HALF: [f64; 2] = [520.0, 330.0];

pub(crate) fn draw_functions(_: &Context<'_>) -> Result<Drawn, Failure> {
    let panel = |[name, alt, label]: [&str; 3], fif: &FixedFif<2, 2>, range| -> Result<Panel, Failure> {
        let curve = outline(fif);
        let knots = paper::KNOTS.map(|x| [x, fif.evaluate(x, TOLERANCE).value]);
        plot(HALF, Axis::linear("", range, 0.5), Names::AtEnds)
            .area(curve.clone(), 0.0, 1, 0.07)
            .line(knots, Stroke::dashed(Ink::Muted).wide(0.9))
            .curve(name, curve, Stroke::solid(1).wide(1.2))
            .dots(knots, 2, 3.5)
            .panel(name, label, alt)
    };
    let f = [
        "f",
        "Graph of f: a symmetric mound with bumps on bumps, 4/3 high",
        "f, vertical factors 1/2 and 1/2",
    ];
    let g = [
        "g",
        "Graph of g: jagged peaks up to almost 2 on the left, and a hanging copy of them on the right",
        "g, vertical factors 17/20 and \u{2212}17/20",
    ];
    let panels = vec![panel(f, &paper::f()?, [0.0, 1.5])?, panel(g, &paper::g()?, [-1.0, 2.0])?];
    Ok(Drawn::new(2, panels).fact("knots", "0, 1, 2").fact("tolerance", format!("{TOLERANCE:e}")))
}

pub(crate) fn draw_integrals(_: &Context<'_>) -> Result<Drawn, Failure> {
    let panel = |[stem, name, rough]: [&str; 3], alt: &str, fif: [&dyn Fn(f64) -> f64; 2], mut plot: Plot| {
        let touched = TANGENTS.map(|x| [x, fif[0](x)]);
        for [x, y] in touched {
            let rise = fif[1](x);
            let reach = 0.2 / (1.0 + rise * rise).sqrt();
            let ends = [[x - reach, y - rise * reach], [x + reach, y + rise * reach]];
            plot = plot.line(ends, Stroke::solid(Ink::Text).wide(1.0));
        }
        let label = format!("{name} and its derivative {rough}");
        plot.dots(touched, Ink::Text, 2.6).panel(stem, label, alt)
    };
    let mut panels = Vec::new();
    for (names, alt, integral, slope, range) in [
        (
            ["f-hat", "f\u{302}", "f"],
            "The integral of f rises from 0 to 2 like a soft step; f is drawn thin",
            paper::f_hat()?,
            paper::f()?,
            [0.0, 2.0],
        ),
        (
            ["g-hat", "\u{11d}", "g"],
            "The integral of g rises with many small undulations to 1; g, drawn thin, is jagged",
            paper::g_hat()?,
            paper::g()?,
            [-1.0, 2.0],
        ),
    ] {
        let curves = plot(HALF, Axis::linear("", range, 0.5), Names::AtEnds)
            .curve(names[2], outline(&slope), Stroke::solid(2).wide(0.6))
            .curve(names[1], outline(&integral), Stroke::solid(1).wide(2.0));
        let values: [&dyn Fn(f64) -> f64; 2] =
            [&|x| integral.evaluate(x, TOLERANCE).value, &|x| slope.evaluate(x, TOLERANCE).value];
        panels.push(panel(names, alt, values, curves)?);
    }
    Ok(Drawn::new(2, panels)
        .fact("knots", "0, 1, 2")
        .fact("tangents at", "1/4, 2/3, 6/5, 7/4")
        .fact("tolerance", format!("{TOLERANCE:e}")))
}

const TANGENTS: [f64; 4] = [0.25, 2.0 / 3.0, 1.2, 1.75];

/// The graph as it looks at the plot's resolution: of every narrow column the lowest and the highest of some points.
///
/// A rough function drawn through equally spaced points would miss its peaks. A column is a cell of these functions, over
/// which they repeat themselves; f has its maximum at 1/3 of the domain, g its extrema at 3/14 and 5/7: all are 126ths.
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

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn the_outline_finds_the_peaks_that_knots_miss() {
        let (f, g) = (paper::f().unwrap(), paper::g().unwrap());
        let top = |points: Vec<[f64; 2]>| points.iter().fold(f64::MIN, |top, p| top.max(p[1]));
        assert_abs_diff_eq!(top(outline(&f)), 4.0 / 3.0, epsilon = 1e-5);
        // Exact maximum 41969/21609 at 3/7; one unit in the last place of x changes g by 5e-4.
        assert_abs_diff_eq!(top(outline(&g)), 41969.0 / 21609.0, epsilon = 1e-3);
        assert!(outline(&g).windows(2).all(|w| w[0][0] <= w[1][0]));
    }
}
