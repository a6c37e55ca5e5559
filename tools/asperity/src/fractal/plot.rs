//! A plot of a function as SVG: curve, knots and few ticks.

use std::fmt::Write;

use crate::fractal::curve::Curve;

const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 540.0;
/// Margin for the numbers of the vertical axis.
const LEFT: f64 = 64.0;
/// Margin for the numbers of the horizontal axis.
const BELOW: f64 = 40.0;
/// The other margins.
const MARGIN: f64 = 20.0;

/// Returns the file.
pub(super) fn svg(curve: &Curve) -> String {
    let [x, y] = [0, 1].map(|axis| extent(curve.points.iter().map(|point| point[axis])));
    let across = |value: f64| LEFT + (value - x[0]) / (x[1] - x[0]) * (WIDTH - LEFT - MARGIN);
    let up = |value: f64| HEIGHT - BELOW - (value - y[0]) / (y[1] - y[0]) * (HEIGHT - BELOW - MARGIN);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" \
         font-size=\"14\" fill=\"#56606b\">\n<rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#ffffff\"/>\n"
    );
    let (right, bottom) = (WIDTH - MARGIN, HEIGHT - BELOW);
    for (value, text) in ticks(x) {
        let at = across(value);
        let _ = writeln!(svg, "<path d=\"M{at:.2} {MARGIN}V{bottom}\" stroke=\"#e6e9ec\"/>");
        let _ = writeln!(
            svg,
            "<text x=\"{at:.2}\" y=\"{:.2}\" text-anchor=\"middle\">{text}</text>",
            bottom + 22.0
        );
    }
    for (value, text) in ticks(y) {
        let at = up(value);
        let _ = writeln!(svg, "<path d=\"M{LEFT} {at:.2}H{right}\" stroke=\"#e6e9ec\"/>");
        let _ = writeln!(
            svg,
            "<text x=\"{:.2}\" y=\"{:.2}\" text-anchor=\"end\">{text}</text>",
            LEFT - 10.0,
            at + 5.0
        );
    }
    svg += "<path fill=\"none\" stroke=\"#b4441c\" stroke-width=\"1.5\" stroke-linejoin=\"round\" d=\"";
    for (index, &[x, y]) in curve.points.iter().enumerate() {
        let _ = write!(svg, "{}{:.2} {:.2}", if index == 0 { "M" } else { "L" }, across(x), up(y));
    }
    svg += "\"/>\n";
    for &[x, y] in &curve.knots {
        let _ =
            writeln!(svg, "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"4\" fill=\"#1c2a38\"/>", across(x), up(y));
    }
    svg + "</svg>\n"
}

/// Returns the ends of finite numbers, apart by at least a little.
fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [low, high] =
        values.fold([f64::MAX, f64::MIN], |[low, high], value| [low.min(value), high.max(value)]);
    let size = low.abs().max(high.abs());
    let around = if size > 0.0 { 0.5 * size } else { 1.0 };
    if high - low > 1e-9 * size { [low, high] } else { [low - around, high + around] }
}

/// Returns about six round numbers of an interval with their text.
fn ticks([low, high]: [f64; 2]) -> impl Iterator<Item = (f64, String)> {
    let rough = (high - low) / 6.0;
    let decade = 10.0_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * decade).into_iter().find(|step| *step >= rough);
    let step = step.unwrap_or(rough);
    let decimals = (-step.log10().floor()).clamp(0.0, 12.0) as usize;
    let first = (low / step).ceil();
    (0..16)
        .map(move |i| (first + f64::from(i)) * step)
        .take_while(move |value| *value <= high + 1e-9 * step)
        .map(move |value| {
            let text = format!("{:.decimals$}", value + 0.0);
            (value, text.replace('-', "−"))
        })
}
