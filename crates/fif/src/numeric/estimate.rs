//! A number of the calculus with a bound of its error and its conditioning.

use crate::numeric::interval::{Bounded, Interval};
use crate::numeric::polynomial::{LEAST, UNIT};

/// An integral, a moment or a mean, with what is known about its error.
///
/// The parts that it is the sum of are integrals over cells times powers of the cells' factors. Where they cancel, the
/// sum has fewer digits than its parts: `condition` says how many.
///
/// ```
/// let f = asperity_fif::paper::f()?;
/// let whole = f.integral_over(0.0, 2.0);
/// assert!((whole.value - 2.0).abs() <= whole.bound && whole.bound < 1e-13);
/// # Ok::<(), asperity_fif::SystemError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Estimate {
    /// The approximation; NaN when an argument was NaN.
    pub value: f64,
    /// Bound of the absolute error: truncation, rounding, and the rounding of the ends of the interval.
    pub bound: f64,
    /// `Σ |part| / |Σ part|`, 1 or more: the factor by which relative errors of the parts count in the sum. Infinite when
    /// the value is 0 and a part is not.
    pub condition: f64,
}

/// Written as [`Bounded`], without the conditioning.
impl core::fmt::Display for Estimate {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        core::fmt::Display::fmt(&Bounded { value: self.value, bound: self.bound }, f)
    }
}

impl Estimate {
    pub(crate) const NAN: Self = Self { value: f64::NAN, bound: f64::NAN, condition: f64::NAN };

    /// From the sum, the sum of magnitudes and the bound.
    pub(crate) fn new(value: f64, magnitude: f64, bound: f64) -> Self {
        let condition = if magnitude > value.abs() { magnitude / value.abs() } else { 1.0 };
        Self { value, bound, condition }
    }

    /// `[value − bound, value + bound]`, rounded outward.
    #[inline]
    pub fn interval(self) -> Interval {
        Interval { lo: self.value, hi: self.value }.inflated(self.bound)
    }

    /// A value that is no sum.
    pub(crate) fn of(Bounded { value, bound }: Bounded) -> Self {
        Self { value, bound, condition: 1.0 }
    }

    /// The product of two estimates.
    pub(crate) fn product(self, other: Self) -> Self {
        let bounded = |estimate: Self| Bounded { value: estimate.value, bound: estimate.bound };
        let Bounded { value, bound } = bounded(self).product(bounded(other));
        Self { value, bound, condition: self.condition * other.condition }
    }

    /// The estimate times a number.
    pub(crate) fn scaled(self, factor: f64) -> Self {
        let value = self.value * factor;
        if factor.abs() == 1.0 {
            return Self { value, ..self };
        }
        let bound = 1.0001 * self.bound * factor.abs() + UNIT * value.abs() + 2.0 * LEAST;
        Self { value, bound, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_holds_the_value_with_its_error() {
        let estimate = Estimate::new(2.0, 6.0, 0.25);
        let Interval { lo, hi } = estimate.interval();
        assert!(lo <= 1.75 && hi >= 2.25 && hi - lo < 0.5 + 2e-15, "{lo} to {hi}");
        assert_eq!((estimate.condition, Estimate::new(2.0, 1.0, 0.0).condition), (3.0, 1.0));
        assert!(Estimate::new(0.0, 1.0, 0.0).condition.is_infinite());
    }
}
