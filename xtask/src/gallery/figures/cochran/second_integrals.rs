//! The second integrals of the functions of Cochran, Lewis and Hart, whose curvature is fractal.

use asperity_fif::{FixedFif, paper};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};
use crate::gallery::figures::cochran::curves::{HALF, outline, plot};
use crate::gallery::plot::{Axis, Ink, Names, Stroke};

const TOLERANCE: f64 = 1e-9;

/// Abscissas at which parabolas touch.
const TOUCHED: [f64; 4] = [0.3, 2.0 / 3.0, 1.2, 1.75];

/// Half width of a parabola.
const REACH: f64 = 0.2;

pub(crate) fn draw(_: &Context<'_>) -> Result<Drawn, Failure> {
    let panels = vec![
        panel(["f", "f\u{302}", "f\u{302}\u{302}"], &paper::f()?, [0.0, 2.15])?,
        panel(["g", "\u{11d}", "\u{11d}\u{302}"], &paper::g()?, [-1.0, 2.0])?,
    ];
    Ok(Drawn::new(2, panels)
        .fact("vertical factors", "1/2, 1/4, 1/8 and \u{b1}17/20, \u{b1}17/40, \u{b1}17/80")
        .fact("parabolas at", "3/10, 2/3, 6/5, 7/4")
        .fact("tolerance", "1e-9"))
}

fn panel(names: [&str; 3], rough: &FixedFif<2, 2>, range: [f64; 2]) -> Result<Panel, Failure> {
    let first: FixedFif<2, 3> = rough.integral(0.0)?;
    let second: FixedFif<2, 4> = first.integral(0.0)?;
    let mut plot = plot(HALF, Axis::linear("", range, 0.5), Names::AtEnds)
        .curve(names[0], outline(rough), Stroke::solid(3).wide(0.6))
        .curve(names[1], outline(&first), Stroke::solid(2).wide(1.1))
        .curve(names[2], outline(&second), Stroke::solid(1).wide(3.6));
    let touched = TOUCHED.map(|x| jet(x, rough, &first, &second));
    for jet in touched {
        let points = (-16..=16).map(|k| jet.parabola(REACH * f64::from(k) / 16.0));
        plot = plot.line(points, Stroke::solid(Ink::Text).wide(0.9));
    }
    plot.dots(touched.map(|jet| jet.parabola(0.0)), Ink::Text, 2.6).panel(
        names[0],
        format!("{}, its derivative {} and its second derivative {}", names[2], names[1], names[0]),
        format!("A smooth arc, {}, over its rougher derivative and its jagged second derivative", names[2]),
    )
}

/// Value, slope and second derivative at a point.
#[derive(Clone, Copy)]
struct Jet {
    x: f64,
    orders: [f64; 3],
}

fn jet(x: f64, rough: &FixedFif<2, 2>, first: &FixedFif<2, 3>, second: &FixedFif<2, 4>) -> Jet {
    let orders = [
        second.evaluate(x, TOLERANCE).value,
        first.evaluate(x, TOLERANCE).value,
        rough.evaluate(x, TOLERANCE).value,
    ];
    Jet { x, orders }
}

impl Jet {
    /// The point of the parabola that is `step` to the right.
    fn parabola(&self, step: f64) -> [f64; 2] {
        let [value, slope, bend] = self.orders;
        [self.x + step, value + step * (slope + 0.5 * step * bend)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parabola_leaves_the_curve_by_less_than_the_bend_changes() {
        let rough = paper::f().unwrap();
        let first: FixedFif<2, 3> = rough.integral(0.0).unwrap();
        let second: FixedFif<2, 4> = first.integral(0.0).unwrap();
        for x in TOUCHED {
            let jet = jet(x, &rough, &first, &second);
            for step in [-REACH, -0.01, 0.01, REACH] {
                let [at, height] = jet.parabola(step);
                let [lo, hi] = [x.min(at), x.max(at)];
                let bend = rough.extrema_over(lo, hi, 1e-6).unwrap().enclosure().width();
                let apart = (second.evaluate(at, 1e-12).value - height).abs();
                // Taylor's remainder: half the step's square times what the second derivative changes by.
                assert!(apart <= 0.5 * step * step * bend + 1e-9, "{x} {step}: {apart}");
                assert!(apart > 1e-9, "{x} {step}: no parabola");
            }
        }
    }
}
