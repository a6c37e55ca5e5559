//! Closed intervals with outward rounding, and values with an error bound.

use core::fmt;

/// A closed interval `[lo, hi]`; every operation rounds outward, so the result encloses the exact one.
///
/// Each bound moves out by one unit in the last place after a rounding to nearest. NaN is not an interval's
/// bound: an operation on one may give any interval.
///
/// ```
/// use asperity_fif::Interval;
/// let third = Interval::new(1.0, 1.0).product(Interval::new(1.0 / 3.0, 1.0 / 3.0));
/// assert!(third.lo < 1.0 / 3.0 && 1.0 / 3.0 < third.hi);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Interval {
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

impl Interval {
    /// The whole line, `[−∞, ∞]`.
    pub const ENTIRE: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };
    /// The empty interval, neutral for [`Interval::hull`].
    pub const EMPTY: Self = Self { lo: f64::INFINITY, hi: f64::NEG_INFINITY };

    /// The interval from `lo` to `hi`; empty when `lo > hi`.
    #[inline]
    pub const fn new(lo: f64, hi: f64) -> Self {
        Self { lo, hi }
    }

    /// The smallest interval that contains both.
    #[inline]
    pub fn hull(self, other: Self) -> Self {
        Self {
            lo: if other.lo < self.lo { other.lo } else { self.lo },
            hi: if other.hi > self.hi { other.hi } else { self.hi },
        }
    }

    /// The common part of both; empty (`lo > hi`) when there is none.
    #[inline]
    pub fn intersection(self, other: Self) -> Self {
        Self {
            lo: if other.lo > self.lo { other.lo } else { self.lo },
            hi: if other.hi < self.hi { other.hi } else { self.hi },
        }
    }

    /// Whether `value` lies inside; false for NaN.
    #[inline]
    #[must_use]
    pub fn contains(self, value: f64) -> bool {
        self.lo <= value && value <= self.hi
    }

    /// The number inside that is nearest to `value`, NaN for NaN; of an empty interval any.
    ///
    /// `f64::clamp` panics for an empty interval, and its panic is linked wherever the compiler cannot exclude one.
    #[inline]
    pub(crate) fn nearest(self, value: f64) -> f64 {
        if value < self.lo {
            self.lo
        } else if value > self.hi {
            self.hi
        } else {
            value
        }
    }

    /// `hi − lo`, negative when empty.
    #[inline]
    #[must_use]
    pub fn width(self) -> f64 {
        self.hi - self.lo
    }

    /// The midpoint.
    #[inline]
    #[must_use]
    pub fn middle(self) -> f64 {
        0.5 * self.lo + 0.5 * self.hi
    }

    /// `max(|lo|, |hi|)`.
    #[inline]
    #[must_use]
    pub fn magnitude(self) -> f64 {
        let (a, b) = (self.lo.abs(), self.hi.abs());
        if a > b { a } else { b }
    }

    /// Both ends moved outward by `margin` and one unit in the last place.
    #[inline]
    pub fn inflated(self, margin: f64) -> Self {
        Self { lo: (self.lo - margin).next_down(), hi: (self.hi + margin).next_up() }
    }

    /// An enclosure of `{u + v}`.
    #[inline]
    pub fn sum(self, other: Self) -> Self {
        Self { lo: (self.lo + other.lo).next_down(), hi: (self.hi + other.hi).next_up() }
    }

    /// An enclosure of `{s u}` for a number `s`.
    #[inline]
    pub fn scaled(self, s: f64) -> Self {
        let (a, b) = (times(s, self.lo), times(s, self.hi));
        let (lo, hi) = if s < 0.0 { (b, a) } else { (a, b) };
        Self { lo: lo.next_down(), hi: hi.next_up() }
    }

    /// An enclosure of `{u v}`.
    #[inline]
    pub fn product(self, other: Self) -> Self {
        let p = [
            times(self.lo, other.lo),
            times(self.lo, other.hi),
            times(self.hi, other.lo),
            times(self.hi, other.hi),
        ];
        let (mut lo, mut hi) = (p[0], p[0]);
        for &v in &p[1..] {
            lo = if v < lo { v } else { lo };
            hi = if v > hi { v } else { hi };
        }
        Self { lo: lo.next_down(), hi: hi.next_up() }
    }
}

/// `a b` with `0 · ∞ = 0`, as interval arithmetic wants it.
#[inline]
fn times(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

/// Written `[lo, hi]`, with the precision of the format: `{:.3}` rounds both ends to the nearest, not outward.
impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("[")?;
        fmt::Display::fmt(&self.lo, f)?;
        f.write_str(", ")?;
        fmt::Display::fmt(&self.hi, f)?;
        f.write_str("]")
    }
}

/// A value with a bound of its error: the exact one lies in `value ± bound`.
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
    /// Bound of the absolute error, truncation and rounding together; NaN when `value` is NaN.
    pub bound: f64,
}

/// Written `value ± bound`, the value with the precision of the format, the bound in full as a power of ten.
impl fmt::Display for Bounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.value, f)?;
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

    /// The value that is known to lie in `range` as well: itself, unless the range says more.
    pub(crate) fn within(self, range: Interval) -> Self {
        let value = range.nearest(self.value);
        let farthest = (range.hi - value).max(value - range.lo).next_up();
        // NaN stays.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_values_are_written_with_the_asked_precision() {
        let third = Interval::new(-1.0 / 3.0, 0.5);
        assert_eq!(alloc::format!("{} {third:.2}", Interval::new(-1.0, 0.5)), "[-1, 0.5] [-0.33, 0.50]");
        let value = Bounded { value: 2.0 / 3.0, bound: 2.5e-13 };
        assert_eq!(alloc::format!("{value:.4}, {}", Bounded::NAN), "0.6667 ± 2.5e-13, NaN ± NaN");
    }

    #[test]
    fn the_nearest_number_inside_is_that_of_clamp() {
        let numbers = [f64::NEG_INFINITY, -2.0, -0.0, 0.0, 1e-310, 0.5, 1.0, 3.0, f64::INFINITY, f64::NAN];
        for (lo, hi) in [(-1.0, 1.0), (0.0, 0.5), (-0.0, 0.0), (f64::NEG_INFINITY, 2.0), (1.0, 1.0)] {
            for x in numbers {
                assert_eq!(
                    Interval::new(lo, hi).nearest(x).to_bits(),
                    x.clamp(lo, hi).to_bits(),
                    "{x} in {lo} to {hi}"
                );
            }
        }
        let _ = Interval::new(1.0, -1.0).nearest(0.0);
    }

    #[test]
    fn operations_enclose_the_exact_result() {
        let a = Interval::new(-1.0, 2.0);
        let b = Interval::new(-3.0, 0.5);
        let p = a.product(b);
        assert!(p.lo < -6.0 && p.lo > -6.0001 && p.hi > 3.0 && p.hi < 3.0001, "{p:?}");
        let s = a.scaled(-2.0);
        assert!(s.contains(-4.0) && s.contains(2.0) && s.width() < 6.0001, "{s:?}");
        assert!(a.sum(b).contains(-4.0) && a.sum(b).contains(2.5));
        assert_eq!(a.hull(Interval::EMPTY), a);
        assert!(a.intersection(Interval::new(3.0, 4.0)).width() < 0.0);
    }

    #[test]
    fn zero_times_the_whole_line_is_zero() {
        let zero = Interval::new(0.0, 0.0).product(Interval::ENTIRE);
        assert!(zero.width() < 1e-300, "{zero:?}");
    }
}
