//! Algorithm 2 of the source as printed, for comparison.

use crate::evaluate::value::MAX_DEPTH;
use crate::system::fif::System;
use crate::system::map::{Map, Piece};

impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    /// Algorithm 2 of the source as printed, which is **wrong by 0.38** for its own `g` at `ε =
    /// 10⁻³`.
    ///
    /// At 10⁻⁶ it is wrong by 0.075 (400,000 points).
    ///
    /// It composes the maps that close in on `x`, each by the binomial expansion of eq. 28, until
    /// the horizontal factor is at most `epsilon`, and then maps the middle control point. It has
    /// two errors, which are kept here. First, the horizontal factor does not bound the error of
    /// `y`, which is the product of the vertical scalings times the range. Second, the composite is
    /// evaluated at a knot, although `x` itself has an inverse image. Use [`System::evaluate`] or
    /// [`System::table`], which is 25 to 70 times as fast.
    ///
    /// NaN returns NaN; at most 4096 maps are composed.
    ///
    /// Cochran, Lewis, Hart 2000, Algorithm 2 and eq. 24–28.
    ///
    /// ```
    /// let g = asperity_fif::cochran_2000::g()?;
    /// let (printed, right) = (g.algorithm_two(1.9975, 1e-3), g.evaluate(1.9975, 1e-9));
    /// assert!((printed - right.value).abs() > 0.1);
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    #[must_use]
    pub fn algorithm_two(&self, x: f64, epsilon: f64) -> f64 {
        if x.is_nan() {
            return f64::NAN;
        }
        let pieces = self.pieces();
        let last = self.domain().hi;
        let mut composite = Map::<C>::IDENTITY;
        for _ in 0..MAX_DEPTH {
            if composite.a <= epsilon || epsilon.is_nan() {
                break;
            }
            let end = |piece: &Piece<C>| composite.apply(piece.map().a * last + piece.map().b, 0.0).0;
            let Some(piece) = pieces.iter().find(|piece| x <= end(piece)).or(pieces.last()) else { break };
            composite = expanded(&composite, piece.map());
        }
        let Some(middle) = pieces.get(pieces.len() / 2) else { return f64::NAN };
        composite.apply(middle.x()[0], middle.y()[0]).1
    }
}

/// The composite `outer ∘ inner`, eq. 24–28 with binomials.
fn expanded<const C: usize>(outer: &Map<C>, inner: &Map<C>) -> Map<C> {
    let mut q = [0.0; C];
    let mut binomials = [0.0; C];
    let mut powers = [[1.0; C]; 2];
    for (power, factor) in powers.iter_mut().zip([inner.a, inner.b]) {
        let mut product = 1.0;
        for power in power.iter_mut().skip(1) {
            product *= factor;
            *power = product;
        }
    }
    for (m, &coefficient) in outer.q.iter().enumerate() {
        // The next row of Pascal's triangle.
        for k in (1..=m).rev() {
            binomials[k] += binomials[k - 1];
        }
        if let Some(first) = binomials.first_mut() {
            *first = 1.0;
        }
        for k in 0..=m {
            q[m - k] += coefficient * binomials[k] * powers[0][m - k] * powers[1][k];
        }
    }
    for (sum, part) in q.iter_mut().zip(inner.q) {
        *sum += outer.alpha * part;
    }
    Map { a: outer.a * inner.a, b: outer.a * inner.b + outer.b, alpha: outer.alpha * inner.alpha, q }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cochran_2000;
    use approx::assert_abs_diff_eq;

    #[test]
    fn expanded_equals_compose() {
        let w = Map { a: 0.3, b: 0.7, alpha: -0.6, q: [0.1, -2.0, 0.5, 1.1] };
        let v = Map { a: 0.25, b: -1.5, alpha: 0.9, q: [-0.4, 0.2, 1.5, -0.3] };
        let (got, want) = (expanded(&w, &v), w.compose(&v));
        for (got, want) in got.q.iter().zip(want.q) {
            assert_abs_diff_eq!(*got, want, epsilon = 1e-14);
        }
    }

    #[test]
    fn algorithm_two_has_the_documented_errors() {
        let (f, g) = (cochran_2000::f().unwrap(), cochran_2000::g().unwrap());
        // Maximum errors over these 4000 points: f 8.1e-3 and 1.4e-5, g 0.30 and 0.066.
        for (epsilon, of_f, of_g) in [(1e-3, 8e-3..9e-3, 0.29..0.31), (1e-6, 1.3e-5..1.4e-5, 0.06..0.07)] {
            let (mut worst_f, mut worst_g) = (0.0_f64, 0.0_f64);
            for k in 0..4000 {
                let x = (f64::from(k) + 0.381_966) / 2000.0;
                worst_f = worst_f.max((f.algorithm_two(x, epsilon) - f.evaluate(x, 1e-9).value).abs());
                worst_g = worst_g.max((g.algorithm_two(x, epsilon) - g.evaluate(x, 1e-9).value).abs());
            }
            assert!(of_f.contains(&worst_f) && of_g.contains(&worst_g), "{epsilon}: {worst_f:e}, {worst_g}");
        }
    }

    #[test]
    fn algorithm_two_accepts_every_input() {
        let g = cochran_2000::g().unwrap();
        assert!(g.algorithm_two(f64::NAN, 1e-3).is_nan());
        for (x, epsilon) in [(0.3, 0.0), (0.3, -1.0), (0.3, f64::NAN), (f64::INFINITY, 1e-3), (-7.0, 1e-3)] {
            assert!(g.algorithm_two(x, epsilon).is_finite(), "{x}, {epsilon}");
        }
    }
}
