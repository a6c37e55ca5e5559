//! The box dimension of a graph.

use asperity_core::Interval;
use asperity_core::math::pow_f64;

use crate::numeric::polynomial::horner;
use crate::system::fif::System;
use crate::system::map::Piece;

/// Minimum relative distance from a polynomial, far above any rounding.
const APART: f64 = 1.0 / 1_073_741_824.0;

impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    /// An enclosure of the box dimension of the graph of `f`.
    ///
    /// ```text
    /// D with Σ |α_j| a_j^{D−1} = 1   when Σ |α_j| > 1,   else 1
    /// ```
    ///
    /// `D` is the dimension unless `f` is itself a polynomial of degree at most `C − 1`. A divided
    /// difference over `C + 1` points of a polynomial is 0. Over the cell of a composite it is the
    /// product of the scalings times the difference over the domain. `f` moves by that much there,
    /// and counting boxes over cells of similar width yields `D`. The function checks whether one
    /// of these differences is nonzero. If all tested differences are below 10⁻⁹ of the values, `f`
    /// is numerically a polynomial, and the interval is `[1, D]`. For affine maps on collinear
    /// knots it is `[1, 1]`.
    ///
    /// **Accuracy:** within `[1, 2]`; about 10⁻¹⁵ wide, more if `Σ |α_j|` is near one or all `a_j`
    /// are. Powers are assumed to be accurate to eight units in the last place.
    ///
    /// Barnsley 1986, theorem 4, for affine maps; Hardin and Massopust, *The capacity for a class
    /// of fractal functions*, 1986.
    ///
    /// ```
    /// use asperity_fif::cochran_2000;
    /// assert!(cochran_2000::g()?.dimension().contains(1.0 + 1.7_f64.log2()));
    /// let f = cochran_2000::f()?.dimension(); // Takagi's function
    /// assert_eq!((f.lo, f.hi), (1.0, 1.0));
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    #[doc(alias = "hurst")]
    #[doc(alias = "minkowski")]
    pub fn dimension(&self) -> Interval {
        let slack = (self.pieces().len() as f64 + 16.0) * f64::EPSILON;
        let sum = |exponent: f64| -> f64 {
            let terms = self.pieces().iter().map(|piece| {
                let a = piece.s[1] - piece.s[0];
                piece.map().alpha.abs() * if exponent == 0.0 { 1.0 } else { pow_f64(a, exponent) }
            });
            terms.sum()
        };
        // The sum decreases with the exponent; at 1 it is below max|α|.
        let root = |target: f64| {
            let (mut lo, mut hi) = (0.0, 1.0);
            for _ in 0..64 {
                let middle = 0.5 * (lo + hi);
                if sum(middle) > target { lo = middle } else { hi = middle }
            }
            Interval::new(lo, hi)
        };
        let one = Interval::new(1.0, 1.0);
        // A sum of exact terms, such as 1/2 + 1/2, is accepted as exact.
        if sum(0.0) <= 1.0 || (C <= 2 && self.collinear()) {
            return one;
        }
        let hi = (1.0 + root(1.0 - slack).hi).next_up();
        let lo = if self.polynomial() { 1.0 } else { (1.0 + root(1.0 + slack).lo).next_down() };
        Interval::new(lo, hi).intersection(Interval::new(1.0, 2.0))
    }

    /// Whether all knots lie on one line, in `f64`.
    fn collinear(&self) -> bool {
        let (domain, [y0, y_end]) = (self.domain(), self.end_values());
        self.pieces()
            .iter()
            .all(|p| (p.y()[0] - y0) * domain.width() == (y_end - y0) * (p.x()[0] - domain.lo))
    }

    /// Whether every tested difference could be that of a polynomial of degree `C − 1`.
    fn polynomial(&self) -> bool {
        let maps = self.pieces().len();
        let mut depth = 1;
        while maps.saturating_pow(depth) < C {
            depth += 1;
        }
        (depth..depth + 4).all(|depth| {
            let cells = maps.saturating_pow(depth);
            // C + 1 knots of this level, at equal distances in number.
            let knot =
                |i: usize| self.knot_of_level((cells as u128 * i as u128 / C.max(1) as u128) as usize, depth);
            let (mut sum, mut scale) = (0.0_f64, 0.0_f64);
            for i in 0..=C {
                let (s, y) = knot(i);
                let weight: f64 = (0..=C).filter(|&k| k != i).map(|k| 1.0 / (s - knot(k).0)).product();
                let rise = y - self.end_values()[0];
                sum += weight * rise;
                scale += weight.abs() * (rise.abs() + 4.0 * self.noise * self.gain / APART);
            }
            // Also if points coincide in f64.
            sum.is_nan() || scale.is_nan() || sum.abs() <= APART * scale
        })
    }

    /// The position in units of the domain and the ordinate of the knot with this number.
    ///
    /// Knots are those of all composites of `depth` maps.
    fn knot_of_level(&self, number: usize, depth: u32) -> (f64, f64) {
        let maps = self.pieces().len().max(1);
        let [y0, y_end] = self.end_values();
        let at_end = number >= maps.saturating_pow(depth);
        let mut point = if at_end { (1.0, y_end) } else { (0.0, y0) };
        let mut rest = if at_end { 0 } else { number };
        for _ in 0..if at_end { 0 } else { depth } {
            if let Some(piece) = self.pieces().get(rest % maps) {
                let y = piece.map().alpha * point.1 + horner(&piece.local, point.0);
                point = (piece.s[0] + (piece.s[1] - piece.s[0]) * point.0, y);
            }
            rest /= maps;
        }
        point
    }
}

#[cfg(test)]
mod tests {
    use crate::{FixedFif, cochran_2000};

    #[test]
    fn dimension_of_lines_and_small_scalings_is_one() {
        let line = FixedFif::<2, 2>::affine(&[0.0, 1.0, 2.0], &[1.0, 2.0, 3.0], &[0.9, 0.9]).unwrap();
        assert_eq!(line.dimension().hi, 1.0);
        assert_eq!(cochran_2000::g_hat().unwrap().dimension().hi, 1.0);
    }

    #[test]
    fn dimension_of_a_hidden_polynomial_is_an_interval() {
        // f(x) = x² on halves with factor 0.9: x²/4 = 0.9 x² + q_1, (x + 1)²/4 = 0.9 x² + q_2.
        let q = [[0.0, 0.0, -0.65], [0.25, 0.5, -0.65]];
        let f = FixedFif::<2, 3>::new(&[0.0, 0.5, 1.0], &[0.9, 0.9], &q).unwrap();
        let d = f.dimension();
        assert!(d.lo == 1.0 && d.contains(1.0 + 1.8_f64.log2()), "{d:?}");
        // The same scalings and another polynomial.
        let q = [[0.0, 0.1, -0.75], [0.25, 0.5, -0.65]];
        let f = FixedFif::<2, 3>::new(&[0.0, 0.5, 1.0], &[0.9, 0.9], &q).unwrap();
        assert!(f.dimension().lo > 1.8, "{:?}", f.dimension());
    }
}
