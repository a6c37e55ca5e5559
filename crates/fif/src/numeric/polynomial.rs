//! Polynomials on the unit interval: monomial form for points, Bernstein form for cells.
//!
//! A cell of a fractal interpolation function is `A f + p`, with a polynomial `p` that is
//! restricted repeatedly. In Bernstein form the restriction is de Casteljau's algorithm with only
//! convex combinations. It is therefore stable at every depth, and the coefficients enclose the
//! values.

use asperity_core::Interval;

/// Unit roundoff, `2⁻⁵³`.
pub(crate) const UNIT: f64 = f64::EPSILON / 2.0;

/// The smallest positive number, `2⁻¹⁰⁷⁴`.
pub(crate) const LEAST: f64 = f64::from_bits(1);

/// `Σ c_i xⁱ` by Horner's rule, starting with the last coefficient, because a product with zero
/// would be kept.
#[inline(always)]
#[must_use]
pub(crate) fn horner<const C: usize>(c: &[f64; C], x: f64) -> f64 {
    let Some((&last, others)) = c.split_last() else { return 0.0 };
    others.iter().rev().fold(last, |sum, &c| sum * x + c)
}

/// `Σ |c_i| |x|ⁱ`, the scale of the rounding error of [`horner`].
#[must_use]
pub(crate) fn magnitude<const C: usize>(c: &[f64; C], x: f64) -> f64 {
    let mut sum = 0.0;
    for &coefficient in c.iter().rev() {
        sum = sum * x.abs() + coefficient.abs();
    }
    sum
}

/// The larger of two numbers, or NaN if either is NaN; `max` would ignore an overflow to NaN.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

/// Falling factorial `k (k − 1) … (k − m + 1)`, the factor of the `m`-th derivative of the `k`-th
/// power.
#[cfg(feature = "alloc")]
pub(crate) fn falling(k: usize, m: usize) -> f64 {
    (0..m).fold(1.0, |product, i| product * k.saturating_sub(i) as f64)
}

/// [`magnitude`] of all derivatives at 1: `Σ_k k!/(k − m)! |c_k|` for every order `m`.
#[cfg(feature = "alloc")]
#[must_use]
pub(crate) fn magnitudes<const C: usize>(c: &[f64; C]) -> [f64; C] {
    let mut sums = [0.0; C];
    for (k, c) in c.iter().enumerate() {
        let mut term = c.abs();
        for (m, sum) in sums.iter_mut().enumerate().take(k + 1) {
            *sum += term;
            term *= (k - m) as f64;
        }
    }
    sums
}

/// Coefficients of `p(a x + b)` (Cochran, Lewis, Hart 2000, eq. 28, by repeated Horner steps).
#[must_use]
pub(crate) fn substitute<const C: usize>(p: &[f64; C], a: f64, b: f64) -> [f64; C] {
    let mut out = [0.0; C];
    for (step, &coefficient) in p.iter().rev().enumerate() {
        // out ← out · (a x + b) + coefficient; after `step` steps the degree is `step`.
        for i in (0..=step.min(C.saturating_sub(1))).rev() {
            let lower = if i > 0 { out[i - 1] } else { 0.0 };
            out[i] = out[i] * b + lower * a;
        }
        if let Some(first) = out.first_mut() {
            *first += coefficient;
        }
    }
    out
}

/// Bernstein coefficients on `[0, 1]` of `Σ c_i sⁱ`:
///
/// ```text
/// b_k = Σ_{i ≤ k} C(k, i)/C(D, i) c_i
/// ```
#[must_use]
pub(crate) fn bernstein<const C: usize>(c: &[f64; C]) -> [f64; C] {
    let mut b = *c;
    let degree = C.saturating_sub(1);
    let mut choose = 1.0;
    for (i, value) in b.iter_mut().enumerate() {
        *value /= choose;
        choose = choose * (degree - i.min(degree)) as f64 / (i + 1) as f64;
    }
    // Sums of finite differences: b_k = Σ C(k, i) Δⁱ.
    for pass in 1..C {
        for k in (pass..C).rev() {
            b[k] += b[k - 1];
        }
    }
    b
}

/// The hull of Bernstein coefficients, which contains the polynomial up to rounding; 0 if empty.
#[inline]
pub(crate) fn hull<const C: usize>(b: &[f64; C]) -> Interval {
    let Some((&first, rest)) = b.split_first() else { return Interval::new(0.0, 0.0) };
    rest.iter().fold(Interval::new(first, first), |all, &b| all.hull(Interval::new(b, b)))
}

/// Bernstein coefficients of the same polynomial on `[s0, s1] ⊂ [0, 1]`.
///
/// The error of each coefficient is at most [`restriction_error`]` · max|b|`.
#[inline]
#[must_use]
pub(crate) fn restrict<const C: usize>(b: &[f64; C], s0: f64, s1: f64) -> [f64; C] {
    let mut out = *b;
    if s1 < 1.0 {
        for pass in 1..C {
            for k in (pass..C).rev() {
                out[k] = (1.0 - s1) * out[k - 1] + s1 * out[k];
            }
        }
    }
    if s0 > 0.0 {
        let t = s0 / s1;
        for pass in 1..C {
            for k in 0..C - pass {
                out[k] = (1.0 - t) * out[k] + t * out[k + 1];
            }
        }
    }
    out
}

/// Error bound of [`restrict`], relative to the largest coefficient.
///
/// One linear interpolation rounds its two products, its sum and the difference in its first
/// weight: 3 units. Its parameter is a knot in units of the domain, with two roundings, or a
/// quotient of two such knots, with five. Each enters both weights: 13 units. Halving is exact
/// except for the sum.
#[must_use]
pub(crate) fn restriction_error<const C: usize>(s0: f64, s1: f64) -> f64 {
    let split = |t: f64| match t {
        0.0 | 1.0 => 0.0,
        0.5 => 1.0,
        _ => 13.0,
    };
    C.saturating_sub(1) as f64 * UNIT * (split(s1) + split(s0 / s1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    const P: [f64; 4] = [0.3, -1.25, 2.0, 0.7];

    #[test]
    fn substitute_composes_with_an_affine_argument() {
        let p = substitute(&P, 0.4, -0.3);
        for i in 0..=10 {
            let x = f64::from(i) * 0.2 - 1.0;
            assert_abs_diff_eq!(horner(&p, x), horner(&P, 0.4 * x - 0.3), epsilon = 1e-14);
        }
        assert_eq!(substitute(&[], 0.4, 1.0), [0.0; 0]);
    }

    #[test]
    fn restrict_preserves_the_polynomial() {
        let b = bernstein(&P);
        assert_abs_diff_eq!(b[0], P[0], epsilon = 1e-15);
        assert_abs_diff_eq!(b[3], horner(&P, 1.0), epsilon = 1e-15);
        let (s0, s1) = (0.2, 0.55);
        let direct = bernstein(&substitute(&P, s1 - s0, s0));
        for (got, want) in restrict(&b, s0, s1).iter().zip(direct) {
            assert_abs_diff_eq!(*got, want, epsilon = 1e-15);
        }
    }
}
