//! Student's t distribution in one dimension: density, tail, mean excess, and slopes seen by a
//! view.

use core::f64::consts::PI;

use crate::density::visible_slopes::{LEAST_U, ZENITH};
use crate::numeric::normal_distribution::inverse_gaussian_cdf;
use asperity_core::math;

/// Student's t distribution with `ν > 0` degrees of freedom.
///
/// ```text
/// f(z) = Γ((ν+1)/2) / (√(νπ) Γ(ν/2)) · (1 + z²/ν)^(−(ν+1)/2)
/// ```
///
/// Accuracy: 1e-13 relative for the density, the tail and the excess, for `ν` from 1 to 10¹³.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StudentDistribution {
    /// The degrees of freedom ν.
    freedom: f64,
    /// `f(0)`.
    pub(crate) peak: f64,
}

impl StudentDistribution {
    /// Creates the distribution with `freedom` degrees of freedom, which must be positive.
    pub(crate) fn new(freedom: f64) -> Self {
        Self { freedom, peak: gamma_ratio(0.5 * freedom) / math::sqrt_f64(PI * freedom) }
    }

    /// `f(z)`.
    pub(crate) fn density(self, z: f64) -> f64 {
        self.peak * math::exp_f64(-0.5 * (self.freedom + 1.0) * math::ln_1p_f64(z * z / self.freedom))
    }

    /// `P(T > z)`.
    pub(crate) fn tail(self, z: f64) -> f64 {
        let (nu, y) = (self.freedom, z.abs());
        let upper = if y < self.seam() {
            0.5 - self.center(y)
        } else if y < FARTHEST {
            self.density(y) * (nu + y * y) / (nu * y) / (1.0 + self.fraction(y))
        } else {
            0.0
        };
        if z > 0.0 { upper } else { 1.0 - upper }
    }

    /// `E[max(0, T − z)]` for `z ≥ 0` and `ν > 1`; 0 for infinite `z` and NaN.
    pub(crate) fn excess(self, z: f64) -> f64 {
        let nu = self.freedom;
        if z < self.seam() {
            self.beyond(z) - z * (0.5 - self.center(z))
        } else if z < FARTHEST {
            // The same without the difference: the fraction is 1/(1 + k), and 1 − 1/(1 + k) is
            // k/(1 + k).
            let k = self.fraction(z);
            self.beyond(z) * (1.0 + (nu - 1.0) * k / (1.0 + k)) / nu
        } else {
            0.0
        }
    }

    /// The `u`-quantile of the slope seen by a view, whose density is ∝ `(b + x) f(x)` for `x ≥
    /// −b`.
    ///
    /// Works like [`visible_slope`](crate::density::visible_slopes::visible_slope), with `x`
    /// transformed by arsinh, in which power laws are straight. `ν > 1`; within 1e-12 in `u`.
    pub(crate) fn visible_slope(self, b: f64, u: f64) -> f64 {
        let u = u.max(LEAST_U);
        SeenSlopes::new(self, b).quantile(self.guess(u), [u, 1.0 - u])
    }

    /// The slope with the same fractions below and above it among the slopes seen by a view as `t`
    /// has among all slopes.
    ///
    /// The identity for views at the zenith. It increases, and never leaves `x ≥ −b`.
    pub(crate) fn visible_of_slope(self, b: f64, t: f64) -> f64 {
        SeenSlopes::new(self, b).quantile(t, [self.tail(-t), self.tail(t)])
    }

    /// The inverse of [`visible_of_slope`](Self::visible_of_slope).
    pub(crate) fn slope_of_visible(self, b: f64, x: f64) -> f64 {
        if x > -b {
            let seen = SeenSlopes::new(self, b);
            self.quantile_of([true, false].map(|is_left| seen.fraction(x, is_left).max(f64::MIN_POSITIVE)))
        } else {
            -FARTHEST
        }
    }

    /// The `u`-quantile of the distribution itself, within 1e-12 in `u`.
    pub(crate) fn quantile(self, u: f64) -> f64 {
        let u = u.max(LEAST_U);
        self.quantile_of([u, 1.0 - u])
    }

    /// The slope with the fractions `u` below and `rest` above it.
    fn quantile_of(self, [u, rest]: [f64; 2]) -> f64 {
        let side =
            |x: f64| Side { probability: self.tail(if u < 0.5 { -x } else { x }), density: self.density(x) };
        let start = if u < 0.5 { self.guess(u) } else { -self.guess(rest) };
        self.solve(start, -FARTHEST, [u, rest], side)
    }

    /// The slope with the fractions `u` below and `rest` above it, found from `start` and not below
    /// `least`.
    fn solve(self, start: f64, least: f64, [u, rest]: [f64; 2], side: impl Fn(f64) -> Side) -> f64 {
        let (mut low, mut high, mut x) = (least, FARTHEST, start.min(FARTHEST));
        for _ in 0..MOST_STEPS {
            let Side { probability, density } = side(x);
            let stretch = math::sqrt_f64(self.freedom + x * x);
            // Newton steps in arsinh(x/√ν), for √u at the left, where the edge is a square, and for
            // the logarithm at the right.
            let (step, too_low) = if u < 0.5 {
                let probability = probability.max(f64::MIN_POSITIVE);
                (2.0 * (math::sqrt_f64(u * probability) - probability) / (density * stretch), probability < u)
            } else {
                let probability = probability.max(f64::MIN_POSITIVE);
                (math::ln_f64(probability / rest) * probability / (density * stretch), probability > rest)
            };
            if too_low {
                low = x;
            } else {
                high = x;
            }
            let grown = math::exp_m1_f64(step.clamp(-LONGEST, LONGEST));
            let (sinh, cosh1) = (0.5 * (grown + grown / (1.0 + grown)), 0.5 * grown * grown / (1.0 + grown));
            let next = x + x * cosh1 + stretch * sinh;
            // Outside the bracket, or NaN: use its middle.
            let next = if next >= low && next <= high { next } else { middle(low, high) };
            let moved = (next - x).abs();
            x = next;
            // A Newton step squares the error.
            if moved < 1e-7 * (1.0 + x.abs()) {
                break;
            }
        }
        x
    }

    /// An approximate quantile: Wallace's transform of the Gaussian quantile.
    fn guess(self, u: f64) -> f64 {
        let nu = self.freedom;
        let z = inverse_gaussian_cdf(u) * (8.0 * nu + 3.0) / (8.0 * nu + 1.0);
        let t = math::sqrt_f64(nu * math::exp_m1_f64((z * z / nu).min(600.0)));
        if z < 0.0 { -t } else { t }
    }

    /// The point at which the continued fraction replaces the series at 0. Both need about 30 terms
    /// there.
    fn seam(self) -> f64 {
        math::sqrt_f64(9.0 * self.freedom / (self.freedom + 18.0))
    }

    /// `∫_z^∞ t f(t) dt = (ν + z²)/(ν − 1) f(z)`, even in `z`.
    fn beyond(self, z: f64) -> f64 {
        if z.abs() < FARTHEST { (self.freedom + z * z) / (self.freedom - 1.0) * self.density(z) } else { 0.0 }
    }

    /// `P(0 < T < z) = z f(z) ₂F₁(1, (ν+1)/2; 3/2; z²/(ν+z²))`, a series of positive terms.
    fn center(self, z: f64) -> f64 {
        let y = z * z / (self.freedom + z * z);
        let (mut term, mut sum) = (1.0, 1.0);
        for k in 0..MOST_TERMS {
            let k = f64::from(k);
            term *= (0.5 * (self.freedom + 1.0) + k) / (1.5 + k) * y;
            sum += term;
            if term < 1e-17 * sum {
                break;
            }
        }
        z * self.density(z) * sum
    }

    /// `k` of `1/(1 + k) = ₂F₁(½, 1; ν/2 + 1; −ν/z²) = P(T > z) · ν z/((ν + z²) f(z))`, by Gauss's
    /// continued fraction.
    ///
    /// Its terms are positive for every `ν`. For `ν → ∞` it becomes Laplace's fraction for the
    /// Gaussian tail.
    fn fraction(self, z: f64) -> f64 {
        let (c, ratio) = (0.5 * self.freedom, self.freedom / (z * z));
        // Steed's algorithm: each step adds the difference of two convergents.
        let term = |n: u32| {
            let (k, odd) = (f64::from(n / 2), n % 2 == 1);
            let (m, above) = if odd { (0.5 + k, c + k) } else { (k, c - 0.5 + k) };
            let n = f64::from(n);
            ratio * m * above / ((c + n - 1.0) * (c + n))
        };
        let (mut d, mut step) = (1.0, term(1));
        let mut k = step;
        for n in 2..MOST_TERMS {
            let a = term(n);
            d = 1.0 / (1.0 + a * d);
            step *= d - 1.0;
            k += step;
            if step.abs() < 1e-16 * k {
                break;
            }
        }
        k
    }
}

/// The distribution of the slopes along a view, with the density `∝ (b + x) f(x)` for `x ≥ −b`.
struct SeenSlopes {
    of: StudentDistribution,
    b: f64,
    total: f64,
    /// The part of the left side that the edge cuts off.
    edge: f64,
}

impl SeenSlopes {
    fn new(of: StudentDistribution, b: f64) -> Self {
        let b = if b < ZENITH { b } else { ZENITH };
        let beyond = of.beyond(b);
        Self { of, b, total: b * of.tail(-b) + beyond, edge: b * of.tail(b) - beyond }
    }

    /// The fraction on one side of `x ≥ −b`.
    fn fraction(&self, x: f64, is_left: bool) -> f64 {
        let &Self { of, b, total, edge } = self;
        if is_left {
            (b * of.tail(-x) - of.beyond(x) - edge) / total
        } else {
            (b * of.tail(x) + of.beyond(x)) / total
        }
    }

    /// The slope with the fractions `u` below and `rest` above it, of which `slope` is about the
    /// quantile among all slopes.
    fn quantile(&self, slope: f64, [u, rest]: [f64; 2]) -> f64 {
        let &Self { of, b, total, .. } = self;
        let y = b + slope;
        let start = if y > 0.0 {
            // Correct for b → ∞ to the second order in 1/b.
            slope + 2.0 / (math::sqrt_f64(y * y + 4.0) + y)
        } else {
            // At the edge the distribution starts like a square.
            math::sqrt_f64(2.0 * u * total / of.density(b)).min(b + 1.0) - b
        };
        of.solve(start, -b, [u, rest], |x| Side {
            // Below the median the left part is small, above it the right part.
            probability: self.fraction(x, u < 0.5),
            density: (b + x) * of.density(x) / total,
        })
    }
}

/// Values for solving a quantile: the fraction on the smaller side of a point, and the density
/// there.
struct Side {
    probability: f64,
    density: f64,
}

/// Beyond it squares overflow, and slopes belong to normals at the horizon.
const FARTHEST: f64 = 1e150;
/// More steps than any quantile needs (measured: 12).
const MOST_STEPS: u32 = 100;
/// More terms than either expansion needs (measured: 60).
const MOST_TERMS: u32 = 500;
/// The longest step of arsinh(x/√ν).
const LONGEST: f64 = 600.0;

/// A point between `low` and `high`, by their logarithms where they differ by orders of magnitude.
fn middle(low: f64, high: f64) -> f64 {
    let bend = |x: f64| if x < 0.0 { -math::ln_1p_f64(-x) } else { math::ln_1p_f64(x) };
    let m = 0.5 * (bend(low) + bend(high));
    if m < 0.0 { -math::exp_m1_f64(-m) } else { math::exp_m1_f64(m) }
}

/// `Γ(x + ½)/Γ(x)` for `x > 0`.
///
/// `√x (1 − 1/(8x) + 1/(128x²) + 5/(1024x³) − 21/(32768x⁴) − 399/(262144x⁵) + 869/(4194304x⁶))`,
/// Tricomi and Erdélyi 1951, after the recurrence to `x ≥ 50`, where the remainder is 2e-15.
fn gamma_ratio(x: f64) -> f64 {
    // Products rather than a product of quotients: 50! is 10⁶⁴.
    let (mut x, mut above, mut below) = (x, 1.0, 1.0);
    while x < 50.0 {
        above *= x;
        below *= x + 0.5;
        x += 1.0;
    }
    let t = 1.0 / (8.0 * x);
    let series = 1.0
        - t * (1.0
            - 0.5 * t * (1.0 + 5.0 * t * (1.0 - 1.05 * t * (1.0 + 19.0 * t * (1.0 - 869.0 / 798.0 * t)))));
    above / below * math::sqrt_f64(x) * series
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::density::visible_slopes;
    use crate::numeric::normal_distribution::gaussian_cdf;
    use asperity_core::assert_abs_diff_eq;

    /// Tails in closed form for ν = 1, 2, 3, 4.
    fn closed(nu: u32, z: f64) -> f64 {
        match nu {
            1 => (1.0 / z).atan() / PI,
            2 => {
                let root = (2.0 + z * z).sqrt();
                1.0 / (root * (root + z))
            }
            3 => {
                let t = z / 3.0_f64.sqrt();
                ((1.0 / t).atan() - t / (1.0 + t * t)) / PI
            }
            _ => {
                let (t, y) = (z / (4.0 + z * z).sqrt(), z * z / (4.0 + z * z));
                0.5 - t * (0.75 - 0.25 * y)
            }
        }
    }

    #[test]
    fn tails_equal_their_closed_forms() {
        for z in (1..400).map(|k| 0.02 * f64::from(k)) {
            for nu in 1..=4 {
                let (got, expected) = (StudentDistribution::new(f64::from(nu)).tail(z), closed(nu, z));
                // The closed forms are differences.
                assert_abs_diff_eq!(got, expected, epsilon = 1e-13 * expected + 1e-15, "{nu} {z}");
            }
            let (got, expected) = (StudentDistribution::new(1e13).tail(z), gaussian_cdf(-z));
            assert_abs_diff_eq!(got / expected, 1.0, epsilon = 1e-12 + z.powi(4) / 3e13, "{z}");
        }
        let student = StudentDistribution::new(5.0);
        assert_eq!([0.0, -f64::INFINITY, f64::INFINITY].map(|z| student.tail(z)), [0.5, 1.0, 0.0]);
        assert_abs_diff_eq!(student.tail(-0.7) + student.tail(0.7), 1.0, epsilon = 1e-15);
    }

    #[test]
    fn tail_is_continuous_at_the_seam() {
        for nu in [1.0, 1.5, 2.0, 5.0, 20.0, 1e3, 1e6, 1e13] {
            let student = StudentDistribution::new(nu);
            let seam = student.seam();
            let (left, right) = (seam * (1.0 - 1e-6), seam);
            let slope = (student.tail(left) - student.tail(right)) / (right - left) / student.density(seam);
            assert_abs_diff_eq!(slope, 1.0, epsilon = 1e-4, "{nu}");
            let fall = (student.excess(left) - student.excess(right)) / (right - left) / student.tail(seam);
            assert!((fall - 1.0).abs() < 1e-4 || nu == 1.0, "{nu}: {fall}");
        }
    }

    #[test]
    fn excess_equals_its_closed_forms() {
        for z in (1..600).map(|k| 0.02 * f64::from(k)) {
            let root = (2.0 + z * z).sqrt();
            // √(2 + z²)/2 − z/2
            let (got, expected) = (StudentDistribution::new(2.0).excess(z), 1.0 / (root + z));
            assert_abs_diff_eq!(got / expected, 1.0, epsilon = 1e-13, "{z}");
            let (got, expected) = (StudentDistribution::new(1e13).excess(z), visible_slopes::exact_excess(z));
            assert_abs_diff_eq!(got / expected, 1.0, epsilon = 1e-11 + z.powi(4) / 3e13, "{z}");
        }
        assert_eq!([f64::INFINITY, f64::NAN].map(|z| StudentDistribution::new(3.0).excess(z)), [0.0, 0.0]);
    }

    #[test]
    fn quantiles_invert_the_tail() {
        for nu in [1.5, 2.0, 3.0, 7.5, 100.0, 1e6] {
            let student = StudentDistribution::new(nu);
            for k in 0..=200 {
                let u = if k < 24 { 0.5_f64.powi(26 - k) } else { f64::from(k - 23) / 178.0 };
                let x = student.quantile(u);
                assert_abs_diff_eq!(student.tail(-x), u, epsilon = 1e-12, "{nu}: {x}");
            }
        }
    }

    #[test]
    fn visible_slopes_invert_their_distribution() {
        for nu in [1.02, 1.5, 2.0, 3.0, 10.0, 200.0, 1e9] {
            let student = StudentDistribution::new(nu);
            for b in [0.0, 1e-3, 0.3, 1.0, 4.0, 30.0, 1e4, 1e12, f64::INFINITY] {
                let total = b * student.tail(-b) + student.beyond(b);
                for k in 0..=100 {
                    let u = if k < 24 { 0.5_f64.powi(26 - k) } else { f64::from(k - 23) / 78.0 };
                    let x = student.visible_slope(b, u);
                    let right = if b < ZENITH {
                        (b * student.tail(x) + student.beyond(x)) / total
                    } else {
                        student.tail(x)
                    };
                    assert_abs_diff_eq!(1.0 - right, u, epsilon = 1e-12, "{nu} {b}: {x}");
                }
            }
        }
    }
}
