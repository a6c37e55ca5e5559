//! An axis: a range, a scale and its ticks.

/// A range of values and its ticks.
pub(crate) struct Axis {
    /// The quantity, with its unit; may be empty.
    pub(super) label: String,
    scale: Scale,
    pub(super) range: [f64; 2],
    pub(super) ticks: Vec<(f64, String)>,
}

/// Scales of an axis.
#[derive(Clone, Copy, PartialEq)]
enum Scale {
    Linear,
    Log2,
}

impl Axis {
    /// An evenly divided axis with a tick at every multiple of `step`.
    pub(crate) fn linear(label: &str, range: [f64; 2], step: f64) -> Self {
        let decimals = (0..6).find(|&d| is_whole(step * 10f64.powi(d))).unwrap_or(6);
        let first = (range[0] / step - 1e-9).ceil() as i64;
        let last = (range[1] / step + 1e-9).floor() as i64;
        let ticks =
            (first..=last).map(|k| (k as f64 * step, decimal(k as f64 * step, decimals as usize))).collect();
        Self { label: label.to_owned(), scale: Scale::Linear, range, ticks }
    }

    /// An axis of doublings, with a tick at every `octaves`-th power of two; the range must be positive.
    pub(crate) fn log2(label: &str, range: [f64; 2], octaves: u32) -> Self {
        let step = i64::from(octaves.max(1));
        let first = (range[0].log2() / step as f64 - 1e-9).ceil() as i64;
        let last = (range[1].log2() / step as f64 + 1e-9).floor() as i64;
        let ticks = (first..=last)
            .map(|k| {
                let exponent = (k * step) as i32;
                let text = if exponent < 0 {
                    format!("1/{}", 2f64.powi(-exponent))
                } else {
                    format!("{}", 2f64.powi(exponent))
                };
                (2f64.powi(exponent), text)
            })
            .collect();
        Self { label: label.to_owned(), scale: Scale::Log2, range, ticks }
    }

    /// With ticks of one's own choice.
    pub(crate) fn with_ticks(mut self, ticks: &[(f64, &str)]) -> Self {
        self.ticks = ticks.iter().map(|&(v, t)| (v, t.to_owned())).collect();
        self
    }

    pub(super) fn place(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => value,
            Scale::Log2 => value.log2(),
        }
    }
}

fn is_whole(value: f64) -> bool {
    (value - value.round()).abs() < 1e-9
}

/// A decimal with a true minus sign and no negative zero.
fn decimal(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value.abs());
    let sign = value < 0.0 && text.bytes().any(|b| matches!(b, b'1'..=b'9'));
    if sign { format!("\u{2212}{text}") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().map(|(_, text)| text.as_str()).collect()
    }

    #[test]
    fn ticks_have_the_decimals_of_their_step() {
        assert_eq!(
            texts(&Axis::linear("", [-0.5, 0.55], 0.25)),
            ["\u{2212}0.50", "\u{2212}0.25", "0.00", "0.25", "0.50"]
        );
        assert_eq!(texts(&Axis::linear("", [0.0, 2.0], 1.0)), ["0", "1", "2"]);
        assert_eq!(texts(&Axis::log2("", [0.125, 8.0], 3)), ["1/8", "1", "8"]);
    }
}
