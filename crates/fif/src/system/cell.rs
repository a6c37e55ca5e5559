//! A cell of the domain, the image of a composite of maps, with bounds of `f` over it.

use asperity_core::Interval;

use crate::numeric::polynomial::{UNIT, hull, restrict, restriction_error};
use crate::system::map::Piece;

/// Over the image of `L_i ∘ L_j ∘ …`, scaled to `[0, 1]`: `f = A f(·) + p(·)`, within `error`.
///
/// Children are computed from the outside in, `p_child = p|_j + A q_j` and `A_child = A α_j` (eq.
/// 26, 27 in Bernstein form).
#[derive(Clone, Copy, Debug)]
pub struct Cell<const C: usize> {
    /// Product of the vertical scalings.
    pub(crate) product: f64,
    pub(super) polynomial: [f64; C],
    pub(super) error: f64,
    /// Roundings in `product`.
    pub(super) steps: f64,
}

impl<const C: usize> Cell<C> {
    /// The whole domain.
    #[inline]
    pub(crate) fn root() -> Self {
        Self { product: 1.0, polynomial: [0.0; C], error: 0.0, steps: 0.0 }
    }

    /// The part of the cell to which `piece` maps.
    #[inline]
    pub(crate) fn child(&self, piece: &Piece<C>) -> Self {
        let mut polynomial = restrict(&self.polynomial, piece.s[0], piece.s[1]);
        let (mut old, mut new) = (0.0_f64, 0.0_f64);
        for ((p, q), before) in polynomial.iter_mut().zip(piece.bernstein).zip(self.polynomial) {
            let added = self.product * q;
            *p += added;
            old = if before.abs() > old { before.abs() } else { old };
            new = if added.abs() > new { added.abs() } else { new };
        }
        // Restriction, product (with the roundings in its factor) and sum.
        let rounding = piece.rounding * old + UNIT * (old + (self.steps + 2.0) * new);
        let error = self.error + self.product.abs() * piece.slack + rounding;
        Self { product: self.product * piece.map().alpha, polynomial, error, steps: self.steps + 1.0 }
    }

    /// An enclosure of `f` over the cell, from one over the domain.
    pub(crate) fn range(&self, domain: Interval) -> Interval {
        let p = self.polynomial_range();
        let f = domain.scaled(self.product);
        p.sum(f).inflated(1.01 * self.error + (self.steps + 4.0) * UNIT * f.magnitude())
    }

    /// The part `[from, to]` of the cell, in units of its width, with a constant fractal part.
    ///
    /// The constant is the middle of the range.
    pub(crate) fn levelled(&self, domain: Interval, from: f64, to: f64) -> Self {
        let middle = self.product * domain.middle();
        let radius = self.product.abs() * 0.5 * domain.width();
        let largest = self.polynomial_range().magnitude();
        let polynomial = restrict(&self.polynomial, from, to).map(|b| b + middle);
        let rounding = restriction_error::<C>(from, to) * largest
            + UNIT * (largest + (self.steps + 3.0) * (middle.abs() + radius));
        Self { product: 0.0, polynomial, error: self.error + 1.0001 * radius + rounding, steps: self.steps }
    }

    /// Bernstein coefficients of the polynomial.
    pub(crate) fn bernstein(&self) -> &[f64; C] {
        &self.polynomial
    }

    /// Bound of the relative error of `product`.
    pub(crate) fn product_error(&self) -> f64 {
        self.steps * UNIT
    }

    /// The range of the polynomial part, without its error.
    pub(crate) fn polynomial_range(&self) -> Interval {
        hull(&self.polynomial)
    }

    /// Values of `f` at the two ends of the cell, from those at the ends of the domain.
    pub(crate) fn ends(&self, domain: [f64; 2]) -> [Interval; 2] {
        let first = self.polynomial.first().copied().unwrap_or(0.0);
        let last = self.polynomial.last().copied().unwrap_or(0.0);
        [(first, domain[0]), (last, domain[1])].map(|(p, y)| {
            let value = p + self.product * y;
            Interval::new(value, value).inflated(
                1.01 * self.error + (self.steps + 4.0) * UNIT * (p.abs() + (self.product * y).abs()),
            )
        })
    }

    /// Bound of the rounding errors in the polynomial.
    pub(crate) fn error(&self) -> f64 {
        self.error
    }
}
