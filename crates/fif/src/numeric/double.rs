//! Sums of two doubles, for positions that rounding must not move to another cell.

/// `hi + lo`, where `hi` is the nearest double: 106 bits; the order is that of the sums.
///
/// Dekker, *A floating-point technique for extending the available precision*, 1971.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Double {
    pub(crate) hi: f64,
    pub(crate) lo: f64,
}

impl From<f64> for Double {
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Double {
    /// `a / b`.
    pub(crate) fn ratio(a: f64, b: f64) -> Self {
        Self::from(a).over(b)
    }

    /// The exact `a + b` of doubles.
    #[inline]
    pub(crate) fn two_sum(a: f64, b: f64) -> Self {
        let sum = a + b;
        let part = sum - a;
        Self::sane(sum, (a - (sum - part)) + (b - part))
    }

    /// The exact `a b` of doubles, except for parts below 2⁻¹⁰²².
    #[inline]
    fn two_product(a: f64, b: f64) -> Self {
        const SPLIT: f64 = 134_217_729.0;
        let halves = |a: f64| {
            let high = SPLIT * a - (SPLIT * a - a);
            [high, a - high]
        };
        let (product, [a1, a2], [b1, b2]) = (a * b, halves(a), halves(b));
        Self::sane(product, a2 * b2 - (((product - a1 * b1) - a2 * b1) - a1 * b2))
    }

    /// Without the low part where it overflows.
    #[inline]
    fn sane(hi: f64, lo: f64) -> Self {
        Self { hi, lo: if lo.is_finite() { lo } else { 0.0 } }
    }

    #[inline]
    pub(crate) fn plus(self, other: Self) -> Self {
        let (sum, rest) = (Self::two_sum(self.hi, other.hi), Self::two_sum(self.lo, other.lo));
        let sum = Self::two_sum(sum.hi, sum.lo + rest.hi);
        Self::two_sum(sum.hi, sum.lo + rest.lo)
    }

    #[inline]
    pub(crate) fn minus(self, other: Self) -> Self {
        self.plus(Self { hi: -other.hi, lo: -other.lo })
    }

    #[inline]
    pub(crate) fn times(self, other: Self) -> Self {
        let product = Self::two_product(self.hi, other.hi);
        Self::two_sum(product.hi, product.lo + (self.hi * other.lo + self.lo * other.hi))
    }

    /// Times a power of two.
    #[inline]
    pub(crate) fn scaled(self, power: f64) -> Self {
        Self { hi: self.hi * power, lo: self.lo * power }
    }

    pub(crate) fn over(self, divisor: f64) -> Self {
        let first = self.hi / divisor;
        let rest = self.minus(Self::two_product(first, divisor));
        let second = rest.hi / divisor;
        Self::two_sum(first, if second.is_finite() { second } else { 0.0 })
    }

    /// `a / b` of doubles, to 2⁻¹⁰⁰ relative.
    pub(crate) fn quotient(self, divisor: Self) -> Self {
        let first = self.hi / divisor.hi;
        let rest = self.minus(divisor.times(Self::from(first)));
        let second = rest.hi / divisor.hi;
        let rest = rest.minus(divisor.times(Self::from(second)));
        let third = rest.hi / divisor.hi;
        let [second, third] = [second, third].map(|part| if part.is_finite() { part } else { 0.0 });
        let sum = Self::two_sum(first, second);
        Self::two_sum(sum.hi, sum.lo + third)
    }

    #[inline]
    pub(crate) fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    #[inline]
    pub(crate) fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thirds_are_accurate_to_a_hundred_bits() {
        let third = Double::ratio(1.0, 3.0);
        let rest = third.plus(third).plus(third).minus(Double::from(1.0));
        assert!(rest.hi.abs() < 2f64.powi(-104), "{rest:?}");
        let rest = third.times(third).times(Double::from(9.0)).minus(Double::from(1.0));
        assert!(rest.hi.abs() < 2f64.powi(-100), "{rest:?}");
        let near = Double::from(0.1).plus(Double::from(2f64.powi(-90)));
        assert!(near > Double::from(0.1) && near.hi == 0.1 && near.max(Double::from(0.1)) == near);
        assert_eq!(Double::ratio(1.0, 0.0).hi, f64::INFINITY);
        // (1/3) / (1/7) = 7/3.
        let quotient = third.quotient(Double::ratio(1.0, 7.0));
        let rest = quotient.times(Double::from(3.0)).minus(Double::from(7.0));
        assert!(rest.hi.abs() < 2f64.powi(-98), "{rest:?}");
    }
}
