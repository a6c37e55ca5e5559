//! The moments of a function over its domain, the basis of integrals of `wᵏ fᵖ` over its cells.

use crate::numeric::bernstein::{Form, SIZE, binomials, power, rounding};
use crate::numeric::elimination::solve;
use crate::numeric::polynomial::{LEAST, UNIT, hull};
use crate::system::error::FifError;
use crate::system::fif::FifRef;

/// The largest power of `f` in an integral.
pub(crate) const MAX_POWER: usize = 8;

/// The largest `k + p (C − 1)` of an integral of `xᵏ fᵖ`.
pub(crate) const MAX_MOMENT_DEGREE: usize = SIZE - 1;

/// `∫ u^l (1 − u)^(n−l) f^m` over the domain scaled to `[0, 1]`, for every `m ≤ p` with `n = k + D
/// (p − m)`.
///
/// With `f∘L_j = α_j f + q_j` the functional equation is, for each `m`, a system of `n + 1` linear
/// equations whose right side has only lower powers. Scaled by binomials (Bernstein polynomials sum
/// to one) its matrix is `1 − T`, where the column sums of `|T|` are at most `Σ a_j |α_j|^m < 1`.
/// It is diagonally dominant by columns, so elimination needs no pivots, and a residual proves the
/// error. Triangular systems in powers of `x` would later need differences of large numbers.
pub(crate) struct MomentBasis {
    values: [[f64; SIZE]; MAX_POWER + 1],
    /// Bound of `Σ_l C(n, l) |error_l|`.
    errors: [f64; MAX_POWER + 1],
    degree: usize,
    top: usize,
}

impl MomentBasis {
    pub(crate) fn new<const C: usize>(fif: FifRef<'_, C>, k: usize, p: usize) -> Result<Self, FifError> {
        if p > MAX_POWER {
            return Err(FifError::OutOfRange { parameter: "p", value: p, min: 0, max: MAX_POWER });
        }
        let degree = C.saturating_sub(1);
        let top = degree.saturating_mul(p).saturating_add(k);
        if top > MAX_MOMENT_DEGREE {
            return Err(FifError::Degree { parameter: "`x^k f^p`", max: MAX_MOMENT_DEGREE, got: top });
        }
        let mut basis =
            Self { values: [[0.0; SIZE]; MAX_POWER + 1], errors: [0.0; MAX_POWER + 1], degree, top };
        for (out, choose) in basis.values[0].iter_mut().zip(binomials(top)) {
            *out = 1.0 / ((top + 1) as f64 * choose);
        }
        basis.errors[0] = 2.0 * UNIT + 8.0 * SIZE as f64 * LEAST;
        for m in 1..=p {
            basis.solve(fif, m);
        }
        Ok(basis)
    }

    /// The moments with `f^m`, and the bound of their error.
    pub(crate) fn power(&self, m: usize) -> (&[f64], f64) {
        let values: &[f64] = self.values.get(m).map_or(&[], |values| values);
        (values, self.errors.get(m).copied().unwrap_or(f64::NAN))
    }

    fn solve<const C: usize>(&mut self, fif: FifRef<'_, C>, p: usize) {
        let n = self.top - self.degree * p;
        let range = fif.range().magnitude();
        let mut matrix = [[0.0; SIZE]; SIZE];
        let mut right = [0.0; SIZE];
        for (i, row) in matrix.iter_mut().enumerate() {
            row[i] = 1.0;
        }
        let (mut own, mut inherited, mut largest) = (0.0, 0.0, 0.0_f64);
        for piece in fif.pieces() {
            let (alpha, [s0, s1]) = (piece.map().alpha, piece.s);
            let a = piece.map().a;
            let q = Form::from_bernstein(&piece.bernstein);
            let q_size = hull(&piece.bernstein).magnitude();
            // Σ_m C(p, m) α^m ∫ q^(p−m) f^m against every u^l w^(n−l).
            let mut inner = [0.0; SIZE];
            let mut q_power = Form::ONE;
            let mut choose = 1.0;
            for m in (0..p).rev() {
                q_power = q_power.product(&q);
                choose = choose * (m + 1) as f64 / (p - m) as f64;
                let factor = choose * power(alpha, m);
                for (l, sum) in inner.iter_mut().enumerate().take(n + 1) {
                    *sum += factor * q_power.against(&self.values[m][l..])[0];
                }
                inherited += a * factor.abs() * power(q_size, p - m) * self.errors[m];
            }
            let factor = a * power(alpha, p);
            for (i, (row, sum)) in matrix.iter_mut().zip(&mut right).enumerate().take(n + 1) {
                let basis = Form::power_of_linear([s0, s1], i)
                    .product(&Form::power_of_linear([1.0 - s0, 1.0 - s1], n - i));
                for ((entry, part), inner) in row.iter_mut().zip(basis.c).zip(inner).take(n + 1) {
                    *entry -= factor * part;
                    *sum += a * part * inner;
                }
            }
            let size = alpha.abs() * range + q_size;
            own += factor.abs();
            inherited += a * p as f64 * power(size, p - 1) * piece.slack;
            largest = largest.max(power(size, p));
        }
        let (mut reduced, mut solution) = (matrix, right);
        solve(reduced.as_flattened_mut(), SIZE, solution.get_mut(..=n).unwrap_or_default());
        let mut residual = 0.0;
        for ((row, right), choose) in matrix.iter().zip(right).zip(binomials(n)) {
            let sum = row.iter().zip(&solution).take(n + 1).fold(right, |sum, (m, x)| sum - m * x);
            residual += choose * sum.abs();
        }
        // The roundings of the entries, and those of the knots in units of the domain.
        let entries = (rounding(self.top) + 4.0 * (fif.pieces().len() + n) as f64 * UNIT) * 2.0 * largest
            + 8.0 * (fif.pieces().len() * SIZE * (p + 1)) as f64 * LEAST;
        self.errors[p] = (residual + entries + inherited) / (1.0 - own).max(f64::MIN_POSITIVE) * 1.01;
        self.values[p] = solution;
    }
}
