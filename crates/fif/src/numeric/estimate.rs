//! Values with error bounds, and estimates with their conditioning.

use asperity_core::Interval;

use crate::numeric::polynomial::{LEAST, UNIT};

/// A value with an error bound: the exact value is in `value ± bound`.
///
/// ```
/// let value = asperity_fif::Bounded { value: 1.25, bound: 1e-9 };
/// assert_eq!(format!("{value} and {value:.3}"), "1.25 ± 1e-9 and 1.250 ± 1e-9");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Bounded {
    /// The approximation.
    pub value: f64,
    /// Bound of the absolute error, including truncation and rounding; NaN if `value` is NaN.
    pub bound: f64,
}

/// Formats as `value ± bound`.
///
/// The value has the precision of the format, and the bound is in full as a power of ten.
impl core::fmt::Display for Bounded {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        core::fmt::Display::fmt(&self.value, f)?;
        write!(f, " ± {:e}", self.bound)
    }
}

impl Bounded {
    pub(crate) const NAN: Self = Self { value: f64::NAN, bound: f64::NAN };

    /// The middle of an enclosure.
    pub(crate) fn around(range: Interval) -> Self {
        let value = range.middle();
        Self { value, bound: (0.5 * range.width() + f64::EPSILON * value.abs()).next_up() }
    }

    /// `[value − bound, value + bound]`, rounded outward.
    #[inline]
    pub fn interval(self) -> Interval {
        Interval { lo: self.value, hi: self.value }.inflated(self.bound)
    }

    /// Clamps the value and the bound, given that the exact value also lies in `range`.
    pub(crate) fn within(self, range: Interval) -> Self {
        let value = range.nearest(self.value);
        let farthest = (range.hi - value).max(value - range.lo).next_up();
        // NaN remains NaN.
        let bound = if self.bound > farthest { farthest } else { self.bound };
        if self.value.is_nan() { Self::NAN } else { Self { value, bound } }
    }

    /// The product of two values, `|f g| ≤ |f| δ_g + |g| δ_f + δ_f δ_g`.
    #[inline]
    pub(crate) fn product(self, other: Self) -> Self {
        let value = self.value * other.value;
        let bound =
            self.value.abs() * other.bound + other.value.abs() * self.bound + self.bound * other.bound;
        Self { value, bound: 1.0001 * bound + 0.5 * f64::EPSILON * value.abs() + 4.0 * f64::from_bits(1) }
    }
}

/// An integral, a moment or a mean, with its error bound and conditioning.
///
/// It is a sum of integrals over cells times powers of the scalings of the cells. If the terms
/// cancel, the sum has fewer digits than the terms, as measured by `condition`.
///
/// ```
/// let f = asperity_fif::cochran_2000::f()?;
/// let whole = f.integral_over(0.0, 2.0);
/// assert!((whole.value - 2.0).abs() <= whole.bound && whole.bound < 1e-13);
/// # Ok::<(), asperity_fif::FifError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Estimate {
    /// The approximation; NaN if an argument was NaN.
    pub value: f64,
    /// Bound of the absolute error, including truncation, rounding, and the rounding of the ends of
    /// the interval.
    pub bound: f64,
    /// `Σ |part| / |Σ part|`, at least 1: the amplification of relative errors of the parts.
    ///
    /// Infinite if the value is 0 and a part is not.
    pub condition: f64,
}

/// Formats like [`Bounded`], without the conditioning.
impl core::fmt::Display for Estimate {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        core::fmt::Display::fmt(&Bounded { value: self.value, bound: self.bound }, f)
    }
}

impl Estimate {
    pub(crate) const NAN: Self = Self { value: f64::NAN, bound: f64::NAN, condition: f64::NAN };

    /// Creates an estimate from the sum, the sum of magnitudes and the bound.
    pub(crate) fn new(value: f64, magnitude: f64, bound: f64) -> Self {
        let condition = if magnitude > value.abs() { magnitude / value.abs() } else { 1.0 };
        Self { value, bound, condition }
    }

    /// `[value − bound, value + bound]`, rounded outward.
    #[inline]
    pub fn interval(self) -> Interval {
        Interval { lo: self.value, hi: self.value }.inflated(self.bound)
    }

    /// An estimate from a value that is not a sum.
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
    fn interval_contains_the_value_with_its_error() {
        let estimate = Estimate::new(2.0, 6.0, 0.25);
        let Interval { lo, hi } = estimate.interval();
        assert!(lo <= 1.75 && hi >= 2.25 && hi - lo < 0.5 + 2e-15, "{lo} to {hi}");
        assert_eq!((estimate.condition, Estimate::new(2.0, 1.0, 0.0).condition), (3.0, 1.0));
        assert!(Estimate::new(0.0, 1.0, 0.0).condition.is_infinite());
    }
}
