//! Figures 1 and 3 of Cochran, Lewis and Hart: two fractal functions and their integrals.

use asperity_fif::{FixedFif, paper};

use crate::{
    failure::Failure,
    gallery::{
        figure::{Context, Drawn, Figure},
        panels::{fact, vector},
        plot::{Axis, Ink, Mark, Names, Plot, Stroke},
    },
};

pub(crate) const FUNCTIONS: Figure = Figure {
    name: "cochran-1-functions",
    title: "Two fractal functions through the same three points",
    source: "Cochran, Lewis and Hart 2000, figure 1",
    caption: "Both curves run through (0, 0), (1, 1) and (2, 0), and both are made of two shrunken copies of \
              themselves. For f each copy keeps half of the height: a continuous curve of length infinite but of \
              dimension 1, the blancmange curve. For g the copies keep 17/20 of it and the right one is turned over: \
              the graph has dimension 1.77.",
    draw: draw_functions,
};

pub(crate) const INTEGRALS: Figure = Figure {
    name: "cochran-3-integrals",
    title: "Their integrals, which have a slope everywhere",
    source: "Cochran, Lewis and Hart 2000, figure 3",
    caption: "The integral of a fractal interpolation function is one again, with smaller vertical factors: 1/4 for \
              the integral of f, \u{b1}17/40 for that of g. Its derivative is the function of figure 1, drawn thin, so \
              the short tangents are exact. The curves look smooth; the roughness has moved into their slope.",
    draw: draw_integrals,
};

/// Absolute error of every value drawn, far below a pixel.
const TOLERANCE: f64 = 1e-6;

fn draw_functions(context: &Context<'_>) -> Result<Drawn, Failure> {
    let panel = |stem: &str, name: &str, alt: &str, label: &str, fif: &FixedFif<2, 2>, y: Axis| {
        let curve = outline(fif);
        let knots = paper::KNOTS.map(|x| [x, fif.evaluate(x, TOLERANCE).value]);
        let plot = Plot {
            title: alt.to_owned(),
            size: SIZE,
            x: Axis::linear("x", [0.0, 2.0], 0.5),
            y,
            names: Names::AtEnds,
            marks: vec![
                Mark::Area { points: curve.clone(), base: 0.0, ink: Ink::Series(1), opacity: 0.07 },
                Mark::Line {
                    points: knots.to_vec(),
                    stroke: Stroke::dashed(Ink::Muted).wide(0.9),
                    name: String::new(),
                },
                Mark::Line {
                    points: curve,
                    stroke: Stroke::solid(Ink::Series(1)).wide(1.2),
                    name: name.to_owned(),
                },
                Mark::Dots { points: knots.to_vec(), ink: Ink::Series(2), radius: 3.5 },
            ],
        };
        vector(stem, label, alt, &plot)
    };
    context.progress.inc_length(2);
    let f = panel(
        "f",
        "f",
        "Graph of f: a symmetric mound with bumps on bumps, 4/3 high",
        "f, vertical factors 1/2 and 1/2",
        &paper::f()?,
        Axis::linear("", [0.0, 1.5], 0.5),
    )?;
    context.progress.inc(1);
    let g = panel(
        "g",
        "g",
        "Graph of g: jagged peaks up to almost 2 on the left, and a hanging copy of them on the right",
        "g, vertical factors 17/20 and \u{2212}17/20",
        &paper::g()?,
        Axis::linear("", [-1.0, 2.0], 0.5),
    )?;
    context.progress.inc(1);
    Ok(Drawn {
        panels: vec![f, g],
        parameters: vec![fact("knots", "0, 1, 2"), tolerance()],
        table: None,
        columns: 2,
    })
}

fn draw_integrals(context: &Context<'_>) -> Result<Drawn, Failure> {
    let panel = |stem: &str,
                 names: [&str; 2],
                 alt: &str,
                 label: &str,
                 integral: &FixedFif<2, 3>,
                 slope: &FixedFif<2, 2>,
                 y: Axis| {
        let mut marks = vec![
            Mark::Line {
                points: outline(slope),
                stroke: Stroke::solid(Ink::Series(2)).wide(0.6),
                name: names[1].to_owned(),
            },
            Mark::Line {
                points: outline(integral),
                stroke: Stroke::solid(Ink::Series(1)).wide(2.0),
                name: names[0].to_owned(),
            },
        ];
        let touched = TANGENTS.map(|x| [x, integral.evaluate(x, TOLERANCE).value]);
        for [x, y] in touched {
            let rise = slope.evaluate(x, TOLERANCE).value;
            let reach = 0.2 / (1.0 + rise * rise).sqrt();
            marks.push(Mark::Line {
                points: vec![[x - reach, y - rise * reach], [x + reach, y + rise * reach]],
                stroke: Stroke::solid(Ink::Text).wide(1.0),
                name: String::new(),
            });
        }
        marks.push(Mark::Dots { points: touched.to_vec(), ink: Ink::Text, radius: 2.6 });
        let plot = Plot {
            title: alt.to_owned(),
            size: SIZE,
            x: Axis::linear("x", [0.0, 2.0], 0.5),
            y,
            names: Names::AtEnds,
            marks,
        };
        vector(stem, label, alt, &plot)
    };
    context.progress.inc_length(2);
    let f = panel(
        "f-hat",
        ["f\u{302}", "f"],
        "The integral of f rises from 0 to 2 like a soft step; f is drawn thin",
        "f\u{302} and its derivative f",
        &paper::f_hat()?,
        &paper::f()?,
        Axis::linear("", [0.0, 2.0], 0.5),
    )?;
    context.progress.inc(1);
    let g = panel(
        "g-hat",
        ["\u{11d}", "g"],
        "The integral of g rises with many small undulations to 1; g, drawn thin, is jagged",
        "\u{11d} and its derivative g",
        &paper::g_hat()?,
        &paper::g()?,
        Axis::linear("", [-1.0, 2.0], 0.5),
    )?;
    context.progress.inc(1);
    Ok(Drawn {
        panels: vec![f, g],
        parameters: vec![fact("knots", "0, 1, 2"), fact("tangents at", "1/4, 2/3, 6/5, 7/4"), tolerance()],
        table: None,
        columns: 2,
    })
}

const SIZE: [f64; 2] = [520.0, 330.0];

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

fn tolerance() -> (String, String) {
    fact("tolerance", &format!("{TOLERANCE:e}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outline_finds_the_peaks_that_knots_miss() {
        let (f, g) = (paper::f().unwrap(), paper::g().unwrap());
        let top = |points: Vec<[f64; 2]>| points.iter().fold(f64::MIN, |top, p| top.max(p[1]));
        assert!((top(outline(&f)) - 4.0 / 3.0).abs() < 1e-5);
        // Exact maximum 41969/21609 at 3/7; one unit in the last place of x changes g by 5e-4.
        assert!((top(outline(&g)) - 41969.0 / 21609.0).abs() < 1e-3);
        assert!(outline(&g).windows(2).all(|w| w[0][0] <= w[1][0]));
    }
}
