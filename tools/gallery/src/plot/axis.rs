//! An axis: a range, a scale and its ticks.

/// A range of values and its ticks.
pub(crate) struct Axis {
    /// The quantity with its unit; may be empty.
    pub(super) label: String,
    /// Maps a value to its position: the identity or the logarithm.
    pub(super) place: fn(f64) -> f64,
    pub(super) range: [f64; 2],
    pub(super) ticks: Vec<(f64, String)>,
}

impl Axis {
    /// Creates a linear axis with a tick at every multiple of `step`.
    pub(crate) fn linear(label: &str, range: [f64; 2], step: f64) -> Self {
        let whole = |value: f64| (value - value.round()).abs() < 1e-9;
        let decimals = (0..6).find(|&d| whole(step * 10f64.powi(d))).unwrap_or(6) as usize;
        let tick = |k: i64| (k as f64 * step, decimal(k as f64 * step, decimals));
        let ticks = multiples(range, step).map(tick).collect();
        Self { label: label.to_owned(), place: |value| value, range, ticks }
    }

    /// Creates a logarithmic axis with a tick at every power of two. The range must be positive.
    pub(crate) fn log2(label: &str, range: [f64; 2]) -> Self {
        let tick = |k: i64| {
            let power = 2f64.powi(k as i32);
            (power, if k < 0 { format!("1/{}", 1.0 / power) } else { power.to_string() })
        };
        let ticks = multiples(range.map(f64::log2), 1.0).map(tick).collect();
        Self { label: label.to_owned(), place: f64::log2, range, ticks }
    }

    /// Sets custom ticks.
    pub(crate) fn with_ticks(mut self, ticks: &[(f64, &str)]) -> Self {
        self.ticks = ticks.iter().map(|&(v, t)| (v, t.to_owned())).collect();
        self
    }
}

/// Returns the integers whose multiples of a step lie in a range.
fn multiples(range: [f64; 2], step: f64) -> impl Iterator<Item = i64> {
    (range[0] / step - 1e-9).ceil() as i64..=(range[1] / step + 1e-9).floor() as i64
}

/// Formats a decimal with a true minus sign and without negative zero.
pub(crate) fn decimal(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value.abs());
    let sign = value < 0.0 && text.bytes().any(|b| matches!(b, b'1'..=b'9'));
    if sign { format!("\u{2212}{text}") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_have_the_decimals_of_their_step() {
        let texts = |axis: Axis| axis.ticks.into_iter().map(|(_, text)| text).collect::<Vec<_>>();
        let quarters = ["\u{2212}0.50", "\u{2212}0.25", "0.00", "0.25", "0.50"];
        assert_eq!(texts(Axis::linear("", [-0.5, 0.55], 0.25)), quarters);
        assert_eq!(texts(Axis::linear("", [0.0, 2.0], 1.0)), ["0", "1", "2"]);
        assert_eq!(texts(Axis::log2("", [0.25, 2.0])), ["1/4", "1/2", "1", "2"]);
    }
}
