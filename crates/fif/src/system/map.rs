//! One map of an iterated function system, and the composition of two maps.

use crate::numeric::polynomial::{LEAST, bernstein, horner, magnitude, restriction_error, substitute};
use crate::system::error::{End, FifError};

/// Maximum accepted defect of the join-up, relative to the sum of the magnitudes of its terms.
///
/// ```text
/// |F_j(x, y) − y'| ≤ 2⁻⁴⁰ (|α_j y| + Σ_i |q_ji xⁱ| + |y'|)
/// ```
pub(crate) const JOIN_TOLERANCE: f64 = 1.0 / 1_099_511_627_776.0;

/// The map `w(x, y) = (a x + b, α y + q(x))` with a polynomial `q` of degree `C − 1`.
///
/// A plain struct without invariants; [`System`](crate::System) validates maps.
///
/// Cochran, Lewis, Hart 2000, eq. 3, 8, 9.
///
/// ```
/// use asperity_fif::cochran_2000;
/// let f = cochran_2000::f()?;
/// let [w1, w2] = [0, 1].map(|j| *f.pieces()[j].map());
/// let c = w1.compose(&w2);
/// let (x, y) = w2.apply(0.75, 0.5);
/// assert_eq!(c.apply(0.75, 0.5), w1.apply(x, y));
/// # Ok::<(), asperity_fif::FifError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Map<const C: usize> {
    /// Horizontal factor, the fraction of the domain covered by the image of the map.
    pub a: f64,
    /// Horizontal shift.
    pub b: f64,
    /// Vertical scaling `α`.
    pub alpha: f64,
    /// Coefficients of `q`, in ascending powers of `x` (not of a local variable).
    pub q: [f64; C],
}

impl<const C: usize> Map<C> {
    /// The identity, `(x, y) ↦ (x, y)`; neutral for [`Map::compose`].
    pub const IDENTITY: Self = Self { a: 1.0, b: 0.0, alpha: 1.0, q: [0.0; C] };

    /// `(a x + b, α y + q(x))`.
    #[must_use]
    pub fn apply(&self, x: f64, y: f64) -> (f64, f64) {
        (self.a * x + self.b, self.alpha * y + horner(&self.q, x))
    }

    /// The composite `self ∘ inner`: first `inner`, then `self`.
    ///
    /// ```text
    /// a_c = a_i a_j        b_c = a_i b_j + b_i
    /// α_c = α_i α_j        q_c(x) = α_i q_j(x) + q_i(a_j x + b_j)
    /// ```
    ///
    /// Cochran, Lewis, Hart 2000, eq. 24–28 (the binomial expansion by Horner's rule). Do not
    /// invert a deep composite: once `a_c` is below a unit in the last place of `b_c`, its inverse
    /// is noise. [`System::evaluate`](crate::System::evaluate) iterates the inverse maps instead.
    #[must_use]
    pub fn compose(&self, inner: &Self) -> Self {
        let mut q = substitute(&self.q, inner.a, inner.b);
        for (sum, part) in q.iter_mut().zip(inner.q) {
            *sum += self.alpha * part;
        }
        Self { a: self.a * inner.a, b: self.a * inner.b + self.b, alpha: self.alpha * inner.alpha, q }
    }
}

/// A validated map of a [`System`](crate::System) with derived data for evaluation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece<const C: usize> {
    map: Map<C>,
    x: [f64; 2],
    y: [f64; 2],
    /// `[s0, s1]`: the interval in units of the domain.
    pub(crate) s: [f64; 2],
    /// `1 / (s1 − s0)`.
    pub(crate) stretch: f64,
    /// `q` over the domain scaled to `[0, 1]`, ascending.
    pub(crate) local: [f64; C],
    /// `q` in Bernstein form.
    pub(crate) bernstein: [f64; C],
    /// Bound of `|q − local|` and `|q − bernstein|` over the domain, including the defect of the
    /// join-up.
    pub(crate) slack: f64,
    /// Relative error of restricting a polynomial to the interval.
    pub(crate) rounding: f64,
}

impl<const C: usize> Piece<C> {
    /// A placeholder piece for storage that a constructor is about to fill.
    pub const EMPTY: Self = Self {
        map: Map::IDENTITY,
        x: [0.0; 2],
        y: [0.0; 2],
        s: [0.0, 1.0],
        stretch: 1.0,
        local: [0.0; C],
        bernstein: [0.0; C],
        slack: 0.0,
        rounding: 0.0,
    };

    /// `domain` is `[x_0, x_N]`, and `s` is the interval of the piece in units of it.
    ///
    /// `a` is the width, for which the difference of the rounded ends would be too inaccurate for a
    /// narrow interval.
    pub(crate) fn new(
        alpha: f64,
        q: [f64; C],
        domain: [f64; 2],
        x: [f64; 2],
        y: [f64; 2],
        s: [f64; 2],
        a: f64,
    ) -> Self {
        let width = domain[1] - domain[0];
        let local = substitute(&q, width, domain[0]);
        // At most 2C roundings for each of the two changes of basis and of the width, on numbers of
        // this scale.
        let scale = magnitude(&q, domain[0].abs() + width);
        let slack = 8.0 * C as f64 * (f64::EPSILON * scale + LEAST);
        Self {
            map: Map { a, b: x[0] - a * domain[0], alpha, q },
            x,
            y,
            s,
            stretch: 1.0 / (s[1] - s[0]),
            local,
            bernstein: bernstein(&local),
            slack,
            rounding: restriction_error::<C>(s[0], s[1]),
        }
    }

    /// Checks that map number `map` sends both ends of its `source`, with ordinates `of`, to the
    /// ends of the piece.
    pub(crate) fn joined(mut self, map: usize, source: [f64; 2], of: [f64; 2]) -> Result<Self, FifError> {
        for (end, at) in [(End::Left, 0.0), (End::Right, 1.0)] {
            let (expected, of) = (self.y[end as usize], self.map.alpha * of[end as usize]);
            let found = of + horner(&self.local, at);
            let scale = of.abs() + magnitude(&self.map.q, source[end as usize]) + expected.abs();
            let defect = (found - expected).abs();
            if defect > JOIN_TOLERANCE * scale {
                return Err(FifError::JoinUp { map, end, expected, got: found });
            }
            self.slack += defect;
        }
        Ok(self)
    }

    /// The map `w_j`.
    #[must_use]
    pub const fn map(&self) -> &Map<C> {
        &self.map
    }

    /// The knots `x_{j−1}` and `x_j` at its ends.
    #[must_use]
    pub const fn x(&self) -> [f64; 2] {
        self.x
    }

    /// The ordinates `y_{j−1}` and `y_j` at its ends.
    #[must_use]
    pub const fn y(&self) -> [f64; 2] {
        self.y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn compose_applies_maps_in_sequence() {
        let w = Map { a: 0.3, b: 0.7, alpha: -0.6, q: [0.1, -2.0, 0.5] };
        let v = Map { a: 0.25, b: -1.5, alpha: 0.9, q: [-0.4, 0.2, 1.5] };
        for i in 0..20 {
            let (x, y) = (f64::from(i) * 0.37 - 3.0, f64::from(i) * 0.11);
            let (vx, vy) = v.apply(x, y);
            let (want, got) = (w.apply(vx, vy), w.compose(&v).apply(x, y));
            assert!(
                (want.0 - got.0).abs() < 1e-14 && (want.1 - got.1).abs() < 1e-13,
                "x = {x}: {got:?} != {want:?}"
            );
        }
        assert_eq!(w.compose(&Map::IDENTITY), w);
        assert_eq!(Map::IDENTITY.compose(&w), w);
    }
}
