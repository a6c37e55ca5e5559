//! Cubic polynomials with non-negative Bernstein coefficients, and their integrals, without
//! cancellation.

use asperity_core::math;

/// Coefficients.
pub(crate) type Cubic = [f64; 4];

/// The polynomial at `s`.
#[inline]
pub(crate) fn cubic([b0, b1, b2, b3]: Cubic, s: f64) -> f64 {
    let r = 1.0 - s;
    r * r * (r * b0 + 3.0 * s * b1) + s * s * (3.0 * r * b2 + s * b3)
}

/// The fraction of the integral over [0, 1] before `s`; 0 if the integral is 0.
#[cfg(feature = "alloc")]
#[inline]
pub(crate) fn fraction(marginal: Cubic, s: f64) -> f64 {
    let sums = partial_sums(marginal);
    if sums[3] > 0.0 { (quartic(sums, s) / sums[3]).min(1.0) } else { 0.0 }
}

/// The fraction, at least `least` away from an end at which the polynomial vanishes.
#[inline]
pub(crate) fn kept_away(marginal: Cubic, fraction: f64, least: f64) -> f64 {
    let [begin, .., end] = marginal;
    let faint = 2.5e-7 * marginal.iter().sum::<f64>();
    let least = least.min(0.5);
    fraction.max(if begin < faint { least } else { 0.0 }).min(if end < faint { 1.0 - least } else { 1.0 })
}

/// The position at which a fraction is reached, the inverse of [`fraction`].
///
/// In closed form for a linear polynomial, otherwise by bracketed Newton steps from there.
pub(crate) fn inverse_fraction(marginal: Cubic, fraction: f64) -> f64 {
    let [begin, .., end] = marginal;
    let sums = partial_sums(marginal);
    let target = fraction * sums[3];
    let root = math::sqrt_f64(begin * begin + fraction * (end * end - begin * begin));
    let mut s = fraction * (begin + end) / (begin + root);
    if !(s > 0.0 && s <= 1.0) {
        s = fraction;
    }
    let (mut low, mut high) = (0.0, 1.0);
    // Bisection where a step leaves the bracket, since the polynomial may vanish at an end.
    for _ in 0..64 {
        let excess = quartic(sums, s) - target;
        if excess.abs() <= 8.0 * f64::EPSILON * target {
            break;
        }
        if excess > 0.0 {
            high = s;
        } else {
            low = s;
        }
        let newton = s - 0.25 * excess / cubic(marginal, s);
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let still = (next - s).abs() <= f64::EPSILON * s;
        s = next;
        if still {
            break;
        }
    }
    s
}

/// The sums of the first one to four coefficients: the coefficients of four times the integral.
#[inline]
fn partial_sums([b0, b1, b2, b3]: Cubic) -> [f64; 4] {
    [b0, b0 + b1, b0 + b1 + b2, b0 + b1 + b2 + b3]
}

/// Four times the integral from 0 to `s`.
#[inline]
fn quartic([g1, g2, g3, g4]: [f64; 4], s: f64) -> f64 {
    let r = 1.0 - s;
    s * (r * r * (4.0 * r * g1 + 6.0 * s * g2) + s * s * (4.0 * r * g3 + s * g4))
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn inverse_fraction_round_trips() {
        for marginal in [
            [1.0; 4],
            [0.0, 1.0, 2.0, 3.0],
            [3.0, 0.0, 0.0, 1.0],
            [0.0, 0.0, 0.0, 1e-20],
            [1e20, 0.0, 0.0, 0.0],
            [0.0, 5.0, 1e-9, 0.0],
        ] {
            for k in 0..=1000 {
                let u = f64::from(k) / 1000.0;
                let error = fraction(marginal, inverse_fraction(marginal, u)) - u;
                assert_abs_diff_eq!(error, 0.0, epsilon = 4e-15, "{marginal:?} {u}: {error:e}");
            }
        }
    }
}
