//! The dimension of graphs against their vertical factor, by the formula and by counting boxes.

use asperity_fif::{FixedFif, SystemError, paper::KNOTS};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};
use crate::gallery::figures::cochran::curves::{HALF, outline, plot};
use crate::gallery::plot::{Axis, Names, Plot, Stroke};

/// Vertical factors whose boxes are counted.
const COUNTED: [f64; 7] = [0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95];

/// Vertical factors whose graphs are drawn.
const DRAWN: [f64; 3] = [0.3, 0.7, 0.95];

/// Levels between which boxes are counted.
const LEVELS: [u32; 2] = [6, 9];

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    context.progress.inc_length(COUNTED.len() as u64);
    let mut dots = Vec::new();
    for alpha in COUNTED {
        dots.push([alpha, counted(&symmetric(1.0, alpha)?).ok_or("a cell without bounds")?]);
        context.progress.inc(1);
        context.checkpoint()?;
    }
    let mut panels = vec![by_factor(dots)?];
    for alpha in DRAWN {
        panels.push(graph(alpha)?);
    }
    Ok(Drawn::new(2, panels)
        .fact("boxes counted at levels", "6 and 9")
        .fact("knots", "0, 1, 2 and 0, 1/2, 2"))
}

/// Both maps with the same factor, the middle knot at `middle`.
fn symmetric(middle: f64, alpha: f64) -> Result<FixedFif<2, 2>, SystemError> {
    FixedFif::affine(&[KNOTS[0], middle, KNOTS[2]], &[0.0, 1.0, 0.0], &[alpha; 2])
}

/// The slope of the logarithm of the number of boxes between the two levels.
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

fn by_factor(dots: Vec<[f64; 2]>) -> Result<Panel, Failure> {
    let curve = |middle: f64| -> Result<Vec<[f64; 2]>, SystemError> {
        let alphas = (1..200).map(|k| 0.005 * f64::from(k));
        alphas.map(|alpha| Ok([alpha, symmetric(middle, alpha)?.dimension().middle()])).collect()
    };
    let x = Axis::linear("vertical factor \u{3b1}", [0.0, 1.0], 0.25);
    Plot::new(HALF, x, Axis::linear("dimension", [0.9, 2.05], 0.25), Names::Above)
        .curve("knots 0, 1/2, 2", curve(0.5)?, Stroke::dashed(2))
        .curve("knots 0, 1, 2", curve(1.0)?, Stroke::solid(1).wide(2.0))
        .dots(dots, 1, 3.2)
        .panel(
            "plot",
            "Dimension by the formula; dots: boxes counted",
            "The dimension stays 1 up to the factor 1/2 and rises to 2 at factor 1; counted boxes lie on the curve",
        )
}

fn graph(alpha: f64) -> Result<Panel, Failure> {
    let fif = symmetric(1.0, alpha)?;
    let range = fif.range();
    let step = if range.hi > 4.0 { 2.0 } else { 0.5 };
    let y = Axis::linear("", [range.lo.min(0.0), 1.05 * range.hi], step);
    plot(HALF, y, Names::Hidden).line(outline(&fif), Stroke::solid(1).wide(1.0)).panel(
        format!("graph-{}", (100.0 * alpha).round()),
        format!("\u{3b1} = {alpha}, dimension {:.3}", fif.dimension().middle()),
        format!("The graph with vertical factor {alpha}"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::abs_diff_eq;

    #[test]
    fn counted_boxes_agree_with_the_formula() {
        for alpha in [0.7, 0.9] {
            let fif = symmetric(1.0, alpha).unwrap();
            // Over three levels the smooth part of the graph still counts; measured 0.03.
            let apart = counted(&fif).unwrap() - fif.dimension().middle();
            assert!(abs_diff_eq!(apart, 0.0, epsilon = 0.06), "{alpha}: {apart}");
        }
    }
}
