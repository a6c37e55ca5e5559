//! Cells of an NDF that is linear over the cosine: masses and their inverse.

/// A cell of the table, in units of cells along the cosine.
#[derive(Clone, Copy)]
pub(crate) struct Cell {
    index: f64,
    low: f64,
    high: f64,
}

impl Cell {
    #[inline]
    pub(crate) fn new(index: usize, low: f32, high: f32) -> Self {
        Self { index: index as f64, low: f64::from(low), high: f64::from(high) }
    }

    /// `∫₀^x (d + g s)(i + s) ds`
    #[inline]
    pub(crate) fn below(self, x: f64) -> f64 {
        let rise = self.high - self.low;
        x * (self.low * self.index + x * (0.5 * (self.low + rise * self.index) + x * rise / 3.0))
    }

    /// `∫₀^y (d′ − g s)(i + 1 − s) ds`
    #[inline]
    pub(crate) fn above(self, y: f64) -> f64 {
        let (rise, top) = (self.high - self.low, self.index + 1.0);
        y * (self.high * top + y * (-0.5 * (self.high + rise * top) + y * rise / 3.0))
    }

    /// The integrand at `x`.
    #[inline]
    pub(crate) fn weight(self, x: f64) -> f64 {
        (self.low + (self.high - self.low) * x) * (self.index + x)
    }
}

/// Inverts an increasing function on [0, 1], given with its derivative, by bracketed Newton steps.
#[inline]
pub(crate) fn invert(value: f64, f: impl Fn(f64) -> (f64, f64)) -> f64 {
    let (mut low, mut high, mut x) = (0.0, 1.0, 0.5);
    for _ in 0..60 {
        let (got, slope) = f(x);
        if got < value {
            low = x;
        } else {
            high = x;
        }
        // Rounding must not move a root at an end beyond it.
        let next = (x - (got - value) / slope).clamp(0.0, 1.0);
        let next = if next >= low && next <= high { next } else { 0.5 * (low + high) };
        let moved = (next - x).abs();
        x = next;
        // A Newton step squares the error.
        if moved <= 1e-7 * x {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn cell_masses_add_up_and_invert() {
        for (low, high) in [(1.0, 2.0), (0.0, 3.0), (3.0, 0.0), (1.0, 1.0)] {
            let cell = Cell::new(2, low, high);
            let whole = cell.below(1.0);
            for k in 0..=32 {
                let x = f64::from(k) / 32.0;
                let (below, above) = (cell.below(x), cell.above(1.0 - x));
                assert_abs_diff_eq!(below + above, whole, epsilon = 1e-14 * whole, "{low} {high} {x}");
                let back = invert(below, |x| (cell.below(x), cell.weight(x)));
                assert_abs_diff_eq!(cell.below(back), below, epsilon = 1e-13 * whole, "{low} {high} {x}");
            }
        }
    }
}
