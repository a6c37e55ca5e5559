//! The integral of a fractal interpolation function, and its derivative where there is one.

use core::cell::Cell as CoreCell;

use crate::map::Piece;
use crate::storage::Storage;
use crate::system::Fif;
use crate::system_error::SystemError;

impl<S: AsRef<[Piece<C>]>, const C: usize> Fif<S, C> {
    /// `∫ f` over the whole domain.
    ///
    /// ```text
    /// ∫ f = Σ a_n ∫ q_n / (1 − Σ a_n α_n),   over [x_0, x_N]
    /// ```
    ///
    /// Cochran, Lewis, Hart 2000, eq. 30.
    #[must_use]
    pub fn total_integral(&self) -> f64 {
        let width = self.domain().width();
        let (mut sum, mut rest) = (0.0, 0.0);
        for piece in self.pieces() {
            let a = piece.s[1] - piece.s[0];
            sum += a * width * mean(&piece.local);
            // Σ a_n = 1, so the denominator is a sum of positive terms.
            rest += a * (1.0 - piece.map().alpha);
        }
        sum / rest
    }

    /// The integral `f̂(x) = y0 + ∫ f` from `x_0` to `x`, again a fractal interpolation function, one degree higher.
    ///
    /// ```text
    /// ŷ_j = ŷ_0 + Σ_{n ≤ j} a_n (α_n (ŷ_N − ŷ_0) + ∫ q_n over [x_0, x_N])
    /// F̂_j(x, y) = a_j α_j y + q̂_j(x),   q̂_j(x) = ŷ_{j−1} − a_j α_j ŷ_0 + a_j ∫_{x_0}^x q_j
    /// ```
    ///
    /// The caller chooses the storage `T` and its number of coefficients `K ≥ C + 1`. Integrate twice for the second
    /// integral. Cochran, Lewis, Hart 2000, eq. 29–33; the upper limit of eq. 31 reads `x_N`.
    ///
    /// ```
    /// use asperity_fif::{FixedFif, paper};
    /// let f_hat: FixedFif<2, 3> = paper::f()?.integral(0.0)?;
    /// assert_eq!(f_hat.pieces()[1].map().q, [1.0, 0.5, -0.125]); // eq. 38
    /// assert_eq!(f_hat.end_values(), [0.0, 2.0]);
    /// # Ok::<(), asperity_fif::SystemError>(())
    /// ```
    ///
    /// # Errors
    /// [`SystemError::Degree`] when `K < C + 1`; [`SystemError::Length`] when `T` holds another number of maps;
    /// [`SystemError::OrdinateNotFinite`] for `y0`; [`SystemError::Unbounded`] when the numbers overflow.
    pub fn integral<T: Storage<K>, const K: usize>(&self, y0: f64) -> Result<Fif<T, K>, SystemError> {
        if K < C + 1 {
            return Err(SystemError::Degree { expected: C + 1, found: K });
        }
        if !y0.is_finite() {
            return Err(SystemError::OrdinateNotFinite { knot: 0, value: y0 });
        }
        let x0 = self.domain().lo;
        let width = self.domain().width();
        let rise = self.total_integral();
        let maps = self.pieces().len();
        // Partial sums, asked for in ascending order; the last one is kept.
        let partial = CoreCell::new((0, 0.0));
        let ordinate = |j: usize| {
            if j == maps {
                return y0 + rise;
            }
            let (from, start) = if partial.get().0 <= j { partial.get() } else { (0, 0.0) };
            let parts = self.pieces().iter().take(j).skip(from).map(|piece| {
                (piece.s[1] - piece.s[0]) * (piece.map().alpha * rise + width * mean(&piece.local))
            });
            let sum = parts.fold(start, |sum, part| sum + part);
            partial.set((j, sum));
            y0 + sum
        };
        let factor = |j: usize| self.pieces().get(j).map_or(0.0, |p| (p.s[1] - p.s[0]) * p.map().alpha);
        let polynomial = |j: usize| {
            let piece = self.pieces().get(j)?;
            let a = piece.s[1] - piece.s[0];
            let mut q = [0.0; K];
            for ((power, out), c) in q.iter_mut().enumerate().skip(1).zip(piece.map().q) {
                *out = a * c / power as f64;
            }
            let at_x0 = crate::polynomial::horner(&q, x0);
            if let Some(first) = q.first_mut() {
                *first = ordinate(j) - factor(j) * y0 - at_x0;
            }
            Some(q)
        };
        Fif::assemble(maps, |j| self.knot(j), ordinate, factor, polynomial)
    }

    /// The derivative system, when `f` is continuously differentiable.
    ///
    /// ```text
    /// α′_j = α_j/a_j        q′_j(x) = (d/dx q_j)(x)/a_j
    /// ```
    ///
    /// Cochran, Lewis, Hart 2000, eq. 34–36, which also need `|α_j| < a_j` and the join-up of the derivative's system.
    ///
    /// ```
    /// use asperity_fif::{FixedFif, SystemError, paper};
    /// let slope: FixedFif<2, 2> = paper::f_hat()?.derivative()?;
    /// assert_eq!(slope.evaluate(0.7, 1e-12).value, paper::f()?.evaluate(0.7, 1e-12).value);
    /// let none: Result<FixedFif<2, 1>, _> = paper::f()?.derivative();
    /// assert!(matches!(none, Err(SystemError::SteepFactor { .. })));
    /// # Ok::<(), SystemError>(())
    /// ```
    ///
    /// # Errors
    /// [`SystemError::SteepFactor`] or [`SystemError::JoinUp`] when `f` has no continuous derivative of this form;
    /// [`SystemError::Degree`] when `K + 1 < C`; [`SystemError::Length`] when `T` holds another number of maps.
    pub fn derivative<T: Storage<K>, const K: usize>(&self) -> Result<Fif<T, K>, SystemError> {
        if K + 1 < C {
            return Err(SystemError::Degree { expected: C - 1, found: K });
        }
        for (j, piece) in self.pieces().iter().enumerate() {
            let (a, alpha) = (piece.s[1] - piece.s[0], piece.map().alpha);
            if alpha.abs() >= a {
                return Err(SystemError::SteepFactor { map: j + 1, alpha, a });
            }
        }
        let domain = self.domain();
        let last = self.pieces().len().saturating_sub(1);
        let alpha = |j: usize| self.pieces().get(j).map_or(0.0, |p| p.map().alpha / (p.s[1] - p.s[0]));
        let q = |j: usize| {
            let piece = self.pieces().get(j)?;
            let mut q = [0.0; K];
            for (out, (power, c)) in q.iter_mut().zip(piece.map().q.iter().enumerate().skip(1)) {
                *out = power as f64 * c / (piece.s[1] - piece.s[0]);
            }
            Some(q)
        };
        let at = |j: usize, x: f64| q(j).map_or(0.0, |q| crate::polynomial::horner(&q, x));
        let d0 = at(0, domain.lo) / (1.0 - alpha(0));
        let d_end = at(last, domain.hi) / (1.0 - alpha(last));
        let ordinate = |j: usize| match j {
            0 => d0,
            j if j > last => d_end,
            j => alpha(j - 1) * d_end + at(j - 1, domain.hi),
        };
        Fif::assemble(last + 1, |j| self.knot(j), ordinate, alpha, q)
    }

    fn knot(&self, j: usize) -> f64 {
        self.pieces().get(j).map_or(self.domain().hi, |piece| piece.x()[0])
    }
}

/// `∫ Σ c_i sⁱ` over `[0, 1]`.
fn mean<const C: usize>(local: &[f64; C]) -> f64 {
    local.iter().enumerate().rev().map(|(i, c)| c / (i + 1) as f64).sum()
}

#[cfg(test)]
mod tests {
    use crate::{FixedFif, SystemError, paper};

    #[test]
    fn a_rough_function_has_no_derivative() {
        let steep: Result<FixedFif<2, 1>, _> = paper::f().unwrap().derivative();
        assert_eq!(steep.unwrap_err(), SystemError::SteepFactor { map: 1, alpha: 0.5, a: 0.5 });
        // Gentle factors, but a corner at the middle knot.
        let corner = FixedFif::<2, 2>::affine(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0], &[0.1, 0.1]).unwrap();
        let none: Result<FixedFif<2, 1>, _> = corner.derivative();
        assert!(matches!(none, Err(SystemError::JoinUp { map: 2, .. })), "{none:?}");
    }

    #[test]
    fn the_derivative_of_the_integral_is_the_function() {
        let g = paper::g().unwrap();
        let back: FixedFif<2, 2> = paper::g_hat().unwrap().derivative().unwrap();
        for (a, b) in back.pieces().iter().zip(g.pieces()) {
            assert!(
                (a.map().alpha - b.map().alpha).abs() < 1e-15 && a.map().q == b.map().q,
                "{a:?} != {b:?}"
            );
        }
    }
}
