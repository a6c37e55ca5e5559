//! Figure 2 of Cochran, Lewis and Hart: contractions that close in on the point of evaluation.

use asperity_fif::{FixedFif, Map, paper};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};
use crate::gallery::figures::cochran::curves::{outline, plot};
use crate::gallery::plot::{Axis, Ink, Names, Stroke};

/// L2∘L1∘L2∘L1∘L2∘L2, indices from 0.
const ADDRESS: [usize; 6] = [1, 0, 1, 0, 1, 1];

/// The point with [`ADDRESS`] repeated for ever: `x = a x + b` with `a = 1/64` and `b = 43/32`.
const POINT: f64 = 86.0 / 63.0;

pub(crate) fn draw(_: &Context<'_>) -> Result<Drawn, Failure> {
    let (f, g) = (paper::f()?, paper::g()?);
    let panels = vec![
        ladder()?,
        boxes("f", &f, Axis::linear("", [0.0, 1.75], 0.5))?,
        boxes("g", &g, Axis::linear("", [-2.0, 2.0], 1.0))?,
    ];
    let head = ["after", "interval", "f: bound |A|\u{b7}R", "f: error", "g: bound |A|\u{b7}R", "g: error"];
    let rows = (0..=ADDRESS.len()).map(|level| {
        let [lo, hi] = interval(level);
        let mut row = vec![address(level), format!("[{lo}, {hi}]")];
        for (fif, maps) in [(&f, &paper::F_MAPS), (&g, &paper::G_MAPS)] {
            row.extend(estimate(fif, maps, level).map(|value| format!("{value:.4}")));
        }
        row
    });
    Ok(Drawn::new(3, panels)
        .fact("point", "86/63")
        .fact("R of f", format!("{:.4}", 0.5 * f.range().width()))
        .fact("R of g", format!("{:.4}", 0.5 * g.range().width()))
        .table(head, rows))
}

/// The composite of the first `level` maps.
fn composite(maps: &[Map<2>; 2], level: usize) -> Map<2> {
    ADDRESS
        .iter()
        .take(level)
        .filter_map(|&j| maps.get(j))
        .fold(Map::IDENTITY, |outer, map| outer.compose(map))
}

/// The image of the domain under the first `level` horizontal contractions.
fn interval(level: usize) -> [f64; 2] {
    let map = composite(&paper::F_MAPS, level);
    [map.b, 2.0 * map.a + map.b]
}

/// Bound and true error of the value after `level` steps, with the middle of the range for the rest.
fn estimate(fif: &FixedFif<2, 2>, maps: &[Map<2>; 2], level: usize) -> [f64; 2] {
    let map = composite(maps, level);
    let range = fif.range();
    let (_, value) = map.apply((POINT - map.b) / map.a, range.middle());
    // The point nearest to 86/63 in f64 is not that point; its address is.
    let exact = fif.value_at_address(ADDRESS.into_iter().cycle(), 1e-12).map_or(f64::NAN, |v| v.value);
    [0.5 * map.alpha.abs() * range.width(), (value - exact).abs()]
}

fn address(level: usize) -> String {
    let names: Vec<_> = ADDRESS.iter().take(level).map(|j| ["L\u{2081}", "L\u{2082}"][*j]).collect();
    if names.is_empty() { "identity".to_owned() } else { names.join("\u{2218}") }
}

fn ladder() -> Result<Panel, Failure> {
    let levels = ADDRESS.len();
    let end = -(levels as f64) - 0.55;
    let y = Axis::linear("", [-6.7, 0.5], 1.0).with_ticks(&[]);
    let mut plot =
        plot(SIZE, y, Names::Hidden).line([[POINT, 0.0], [POINT, end]], Stroke::dashed(Ink::Muted).wide(0.9));
    for level in 0..=levels {
        let y = -(level as f64);
        let shade = 0.12 + 0.76 * level as f64 / levels as f64;
        plot = plot.frame(interval(level), [y - 0.28, y + 0.28], 1, shade, 0.8);
        if let Some(&next) = ADDRESS.get(level) {
            let name = ["L\u{2081}", "L\u{2082}"][next];
            plot = plot.note([interval(level + 1)[0], y - 1.0], [-8.0, 0.0], name, Ink::Muted);
        }
    }
    let alt = "Seven bars, each half as long as the one above, closing in on 86/63";
    plot.panel("intervals", "The intervals, by the maps of the address", alt)
}

fn boxes(name: &str, fif: &FixedFif<2, 2>, y: Axis) -> Result<Panel, Failure> {
    let mut plot = plot(SIZE, y, Names::Hidden).line(outline(fif), Stroke::solid(Ink::Muted).wide(0.7));
    for level in 1..=ADDRESS.len() {
        let Some(bounded) = fif.value_at_address(ADDRESS.into_iter().take(level), 0.0) else { continue };
        let range = bounded.interval();
        plot = plot.frame(interval(level), [range.lo, range.hi], 1, 0.13, 0.9);
    }
    let exact = fif.value_at_address(ADDRESS.into_iter().cycle(), 1e-9).map_or(f64::NAN, |v| v.value);
    let alt = format!("Graph of {name} with six nested boxes around the point at 86/63");
    plot.dots([[POINT, exact]], 2, 2.6).panel(
        format!("boxes-{name}"),
        format!("The boxes over the graph of {name}"),
        alt,
    )
}

const SIZE: [f64; 2] = [360.0, 330.0];

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn intervals_nest_and_errors_stay_within_their_bounds() {
        let (f, g) = (paper::f().unwrap(), paper::g().unwrap());
        for level in 0..=ADDRESS.len() {
            let [lo, hi] = interval(level);
            assert!(lo < POINT && POINT < hi);
            assert_abs_diff_eq!(hi - lo, 2.0 / f64::from(1_u32 << level), epsilon = 1e-15);
            for (fif, maps) in [(&f, &paper::F_MAPS), (&g, &paper::G_MAPS)] {
                let [bound, error] = estimate(fif, maps, level);
                assert!(error <= bound, "level {level}: {error} > {bound}");
            }
        }
        assert_eq!(interval(6), [43.0 / 32.0, 11.0 / 8.0]);
    }
}
