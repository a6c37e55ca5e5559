//! The times as bars: ours at its highest level and the fastest peer's, on a scale of doublings.

use super::table::number;
use super::times::{OURS, Ratio, Times};
use crate::failure::Failure;
use crate::gallery::plot::{Axis, HPos, Names, Plot, Stroke};

/// Height of a row in CSS pixels.
const ROW: f64 = 34.0;

/// The chart as a picture that stands alone, light or dark as its reader prefers.
pub(crate) fn svg(times: &Times) -> Result<String, Failure> {
    let rows: Vec<_> =
        times.rows.iter().filter_map(|row| row.best().map(|best| (row.name.as_str(), best))).collect();
    plot(&rows).svg("Nanoseconds per sample of Asperity and of the fastest peer")
}

fn plot(rows: &[(&str, Ratio<'_>)]) -> Plot {
    let all = || rows.iter().flat_map(|(_, ratio)| [ratio.ours.median(), ratio.peer.median()]);
    let low = all().fold(1.0, f64::min).log2().floor().exp2() / 2.0;
    // The longest bar takes up 0.7 of the width; the words behind it have the rest.
    let high = low * (all().fold(2.0, f64::max) / low).powf(1.0 / 0.7);
    let count = rows.len() as f64;
    let ticks: Vec<_> =
        rows.iter().enumerate().map(|(index, (name, _))| (count - index as f64 - 0.5, *name)).collect();
    let x = Axis::log2("nanoseconds per sample", [low, high]);
    let y = Axis::linear("", [0.0, count.max(1.0)], 1.0).with_ticks(&ticks);
    // Of the lines of the legend: a single point draws nothing.
    let (nowhere, thick) = ([[1.0, 0.0]], |series: u8| Stroke::solid(series).wide(8.0));
    let mut plot = Plot::new([1100.0, ROW * count.max(1.0) + 110.0], x, y, Names::Above)
        .curve("Asperity at its highest level", nowhere, thick(1))
        .curve("the fastest peer at that level or below", nowhere, thick(2));
    for (index, (_, ratio)) in rows.iter().enumerate() {
        let middle = count - index as f64 - 0.5;
        for (of, ink, y) in [(ratio.ours, 1, [0.02, 0.36]), (ratio.peer, 2, [-0.36, -0.02])] {
            let words = if of.library == OURS {
                format!("{} {}, ratio {:.2}", number(of.median()), of.level, ratio.value())
            } else {
                format!("{} {}, {}", number(of.median()), of.level, of.library)
            };
            let y = y.map(|y| middle + y);
            plot = plot.frame([low, of.median()], y, ink, 0.85, 0.0);
            plot = plot.words(HPos::Left, [of.median(), (y[0] + y[1]) / 2.0], words);
        }
    }
    plot
}

#[cfg(test)]
mod tests {
    use super::super::times::tests::row;
    use super::*;

    #[test]
    fn each_row_has_two_bars_and_the_colours_come_along() {
        let times = Times { step: 0.05, rounds: 3, rows: vec![row(), row()] };
        let svg = svg(&times).unwrap();
        assert_eq!(svg.matches("<rect").count(), 5, "two rows of two bars, and the card: {svg}");
        assert!(svg.contains("2.00 avx2, ratio 2.50") && svg.contains("5.00 sse4.1, fast"), "{svg}");
        assert!(!svg.contains("var(") && svg.contains("prefers-color-scheme: dark"), "{svg}");
    }

    #[test]
    fn nothing_measured_is_an_empty_chart() {
        let svg = svg(&Times { step: 0.05, rounds: 3, rows: Vec::new() }).unwrap();
        assert!(svg.matches("<rect").count() == 1 && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
}
