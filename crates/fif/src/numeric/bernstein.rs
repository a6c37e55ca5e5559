//! Polynomials in `u` and `w = 1 − u`: the Bernstein form with its binomials multiplied in.
//!
//! A product is a convolution, and a change of interval substitutes two linear forms. Where the
//! numbers are positive, nothing cancels.

use crate::numeric::polynomial::UNIT;

/// The highest degree, plus one.
pub(crate) const SIZE: usize = 33;

/// `Σ c_l u^l w^(n−l)`.
#[derive(Clone, Copy)]
pub(crate) struct Form {
    pub(crate) c: [f64; SIZE],
    pub(crate) degree: usize,
}

impl Form {
    pub(crate) const ONE: Self = {
        let mut c = [0.0; SIZE];
        c[0] = 1.0;
        Self { c, degree: 0 }
    };

    /// Creates the form from Bernstein coefficients; those beyond [`SIZE`] are ignored.
    pub(crate) fn from_bernstein<const C: usize>(b: &[f64; C]) -> Self {
        let degree = C.saturating_sub(1).min(SIZE - 1);
        let mut c = [0.0; SIZE];
        for ((out, b), choose) in c.iter_mut().zip(b).zip(binomials(degree)) {
            *out = choose * b;
        }
        Self { c, degree }
    }

    /// `(w0 w + w1 u)^power`, the power of the linear function with these values at the ends.
    pub(crate) fn power_of_linear(ends: [f64; 2], power: usize) -> Self {
        let degree = power.min(SIZE - 1);
        let mut form = Self { c: [0.0; SIZE], degree };
        let mut rising = 1.0;
        for (out, choose) in form.c.iter_mut().zip(binomials(degree)) {
            *out = choose * rising;
            rising *= ends[1];
        }
        let mut falling = 1.0;
        for out in form.c.iter_mut().take(degree + 1).rev() {
            *out *= falling;
            falling *= ends[0];
        }
        form
    }

    /// The product; degrees beyond [`SIZE`] are truncated.
    pub(crate) fn product(&self, other: &Self) -> Self {
        let mut out = Self { c: [0.0; SIZE], degree: (self.degree + other.degree).min(SIZE - 1) };
        for (i, a) in self.c.iter().take(self.degree + 1).enumerate() {
            for (sum, b) in out.c.iter_mut().skip(i).zip(other.c.iter().take(other.degree + 1)) {
                *sum += a * b;
            }
        }
        out
    }

    /// `Σ c_l m_l` and `Σ |c_l m_l|`: the integral against a measure with the moments `m_l = ∫ u^l
    /// w^(n−l)`.
    pub(crate) fn against(&self, moments: &[f64]) -> [f64; 2] {
        let (mut sum, mut magnitude) = (0.0, 0.0);
        for (c, m) in self.c.iter().take(self.degree + 1).zip(moments) {
            sum += c * m;
            magnitude += (c * m).abs();
        }
        [sum, magnitude]
    }
}

/// `C(n, 0), C(n, 1), …, C(n, n)`, exact up to n = 53.
pub(crate) fn binomials(n: usize) -> impl Iterator<Item = f64> {
    let mut choose = 1.0;
    (0..=n).map(move |l| {
        let now = choose;
        choose = choose * (n - l) as f64 / (l + 1) as f64;
        now
    })
}

/// `x^n` by multiplication, because `powi` rounds differently on each platform.
pub(crate) fn power(x: f64, n: usize) -> f64 {
    (0..n).fold(1.0, |product, _| product * x)
}

/// Relative rounding error of sums and products of forms up to degree `degree`.
///
/// It is relative to the sum of magnitudes.
pub(crate) fn rounding(degree: usize) -> f64 {
    4.0 * (degree + 4) as f64 * UNIT
}
