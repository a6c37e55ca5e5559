//! Closed intervals with outward rounding.

use core::fmt;

/// A closed interval `[lo, hi]` with outward rounding, so that results enclose the exact result.
///
/// Each bound moves out by one unit in the last place after a rounding to nearest. Operations on
/// NaN may return any interval.
///
/// ```
/// use asperity_core::Interval;
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

    /// The intersection of both; empty (`lo > hi`) if they are disjoint.
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

    /// The number in the interval nearest to `value`, NaN for NaN; unspecified for an empty
    /// interval.
    ///
    /// Unlike `f64::clamp` it does not panic for an empty interval, so no panic is linked.
    #[inline]
    #[must_use]
    pub fn nearest(self, value: f64) -> f64 {
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

/// `a b` with `0 · ∞ = 0`, as required by interval arithmetic.
#[inline]
fn times(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

/// Written `[lo, hi]`, with the precision of the format: `{:.3}` rounds both ends to the nearest,
/// not outward.
impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("[")?;
        fmt::Display::fmt(&self.lo, f)?;
        f.write_str(", ")?;
        fmt::Display::fmt(&self.hi, f)?;
        f.write_str("]")
    }
}

#[cfg(feature = "approx")]
crate::macros::impl_approx! { f64; Interval: i => i.lo, i.hi; }

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_matches_clamp() {
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
    fn operations_enclose_exact_result() {
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
    fn product_of_zero_and_entire_is_zero() {
        let zero = Interval::new(0.0, 0.0).product(Interval::ENTIRE);
        assert!(zero.width() < 1e-300, "{zero:?}");
    }
}
