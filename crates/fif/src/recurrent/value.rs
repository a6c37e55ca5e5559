//! Values and integrals of a recurrent system.

use crate::evaluate::value::MAX_DEPTH;
use crate::numeric::estimate::Bounded;
use crate::numeric::polynomial::{UNIT, horner};
use crate::recurrent::recurrent::{Link, Means, RecurrentFif, primitive};

/// Maximum number of maps that one integral composes.
const DEPTH: usize = 1024;

impl<const C: usize> RecurrentFif<C> {
    /// `f(x)` with an error bound, which is at most `tolerance` if `f64` permits.
    ///
    /// Like [`System::evaluate`](crate::System::evaluate), where the inverse of each map ends in
    /// its source; at most 4096 steps.
    ///
    /// - **Domain:** points outside the domain are clamped to it; NaN returns NaN. A tolerance that
    ///   is zero, negative, NaN or below the rounding error means the rounding error.
    /// - **Accuracy:** knots are exact, with bound 0. Otherwise `value ± bound` contains `f(x′)`
    ///   for an `x′` within four units in the last place of the larger end of the domain and
    ///   `2⁻⁵⁰/(1 − max a_j)` of its width.
    pub fn evaluate(&self, x: f64, tolerance: f64) -> Bounded {
        if x.is_nan() {
            return Bounded::NAN;
        }
        let (domain, range) = (self.domain(), self.range());
        let x = domain.nearest(x);
        let mut index = self.links.partition_point(|link| link.piece.x()[0] <= x).saturating_sub(1);
        let Some(first) = self.links.get(index) else { return Bounded::NAN };
        for (knot, value) in first.piece.x().into_iter().zip(first.piece.y()) {
            if knot == x {
                return Bounded { value, bound: 0.0 };
            }
        }
        let mut s = ((x - first.piece.x()[0]) / first.image()).clamp(0.0, 1.0);
        let scale = range.magnitude();
        // Truncation below the rounding error is not worth a step. Written so that NaN requests the
        // maximum.
        let floor = self.noise + 2.0 * UNIT * scale;
        let enough = if tolerance > floor { 0.5 * tolerance } else { floor };
        let (mut sum, mut product, mut tail, mut radius) =
            (0.0, 1.0_f64, range.middle(), 0.5 * range.width());
        let mut steps = 0;
        while steps < MAX_DEPTH && product.abs() * radius > enough {
            let Some(link) = self.links.get(index) else { break };
            steps += 1;
            sum += product * horner(&link.piece.local, s);
            product *= link.piece.map().alpha;
            (index, s) = self.descend(link, s);
            let Some(inner) = self.links.get(index) else { break };
            (tail, radius) = match s {
                0.0 => (inner.piece.y()[0], 0.0),
                1.0 => (inner.piece.y()[1], 0.0),
                _ => (inner.range.middle(), 0.5 * inner.range.width()),
            };
        }
        let steps = steps as f64;
        let truncation = product.abs() * radius * (1.0 + 2.0 * steps * UNIT);
        let weight = if steps < self.gain { steps } else { self.gain };
        let rounding =
            weight * self.noise + UNIT * (steps + 4.0) * 2.0 * scale + 4.0 * UNIT * weight * weight * scale;
        Bounded { value: sum + product * tail, bound: 1.0001 * (truncation + rounding) }
    }

    /// The image that contains a position in a source, and the position in the image.
    pub(crate) fn descend(&self, link: &Link<C>, s: f64) -> (usize, f64) {
        let offset = s * link.width;
        let within = self.links.get(link.from..link.to).unwrap_or_default();
        let right = within.partition_point(|inner| inner.piece.x()[0] - link.start <= offset);
        let index = right.saturating_sub(1);
        let Some(inner) = within.get(index) else { return (link.from, 0.0) };
        let place = (offset - (inner.piece.x()[0] - link.start)) / inner.image();
        (link.from + index, place.clamp(0.0, 1.0))
    }

    /// `∫ f` from `x_0` to `x`, with an error bound.
    ///
    /// ```text
    /// ∫ over [x_{j−1}, x] of f = a_j (α_j ∫ over [x_from, u] of f + ∫ over [x_from, u] of q_j),   x = a_j u + b_j
    /// ```
    ///
    /// The integrals up to the knots solve a linear system, which the constructor has solved by
    /// repeated substitution. Points outside the domain are clamped to it; NaN returns NaN.
    pub fn integral(&self, x: f64) -> Bounded {
        let domain = self.domain();
        if x.is_nan() {
            return Bounded::NAN;
        }
        let x = domain.nearest(x);
        let (scale, width) = (self.range().magnitude(), domain.width());
        let at = |knot: usize| self.means.integrals.get(knot).copied().unwrap_or(0.0);
        let mut index = self.links.partition_point(|link| link.piece.x()[0] <= x).saturating_sub(1);
        let Some(first) = self.links.get(index) else { return Bounded::NAN };
        let (before, image) = (at(index), first.image());
        let mut s = ((x - first.piece.x()[0]) / image).clamp(0.0, 1.0);
        let (mut sum, mut weight, mut weights) = (0.0, 1.0_f64, 0.0);
        for _ in 0..DEPTH {
            let Some(link) = self.links.get(index) else { break };
            let alpha = link.piece.map().alpha;
            let (inner, place) = self.descend(link, s);
            sum +=
                weight * (primitive(&link.piece.local, s) + alpha * (at(inner) - at(link.from)) / link.width);
            weights += weight.abs();
            weight *= alpha * self.links.get(inner).map_or(0.0, Link::image) / link.width;
            (index, s) = (inner, place);
            if weight.abs() <= UNIT * UNIT {
                break;
            }
        }
        // Each term errs by the error of a mean, twice, the error of a polynomial, and roundings;
        // the orbit by a few units of x.
        let Means { error, spread, .. } = self.means;
        let maps = self.links.len() as f64;
        let terms = 2.0 * error + self.noise + 16.0 * UNIT * scale * maps * (1.0 + spread);
        let knots = width * (error + UNIT * maps * scale);
        let places = 8.0 * UNIT * scale * (domain.magnitude() + width * self.reach);
        let value = before + image * sum;
        let rest = image * weight.abs() * scale;
        let bound = 1.01 * (knots + image * weights * terms + places + rest) + 4.0 * UNIT * value.abs();
        Bounded { value, bound }
    }
}
