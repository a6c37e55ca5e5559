//! The record of a piece of the marginal in a packed map: one cache line.

use crate::numeric::bernstein::{inverse_fraction, kept_away};
#[cfg(feature = "alloc")]
use crate::{
    map::{marginal::Marginal, piece::Piece},
    numeric::bernstein::{Cubic, cubic, fraction},
};

/// Two halves of eight numbers.
///
/// They are the position of the piece and its inversion, then its marginal and the part below the
/// middle.
///
/// ```text
/// M₀, 1/(M₁ − M₀), begin, width, c₀, c₁, c₂, c₃;      m₀, 3m₁, 3m₂, m₃, b₀, 3b₁, 3b₂, b₃
/// s = r + r (1 − r) (c₀ + c₁ r + c₂ r² + c₃ r³),   r = (u − M₀)/(M₁ − M₀),   x = begin + |width| s
/// ```
///
/// `x` is in columns from the middle of the map. The coefficients are non-negative Bernstein
/// coefficients, so their sums do not cancel. A negative width means that `s` needs one Newton
/// step. [`MANY_STEPS`] for `c₀` means that it needs Newton steps until convergence.
pub(crate) type Leaf = [[f32; 8]; 2];

/// Indices in the first half of a leaf: `M₀`, its beginning, and `c₀`.
pub(crate) const WEIGHT: usize = 0;
pub(crate) const BEGIN: usize = 2;
pub(crate) const C0: usize = 4;
/// `c₀` of a leaf that iterates until convergence.
pub(crate) const MANY_STEPS: f32 = f32::MAX;

/// Four numbers for the inverse.
///
/// They are `M₀`, the weight over the sum of the coefficients of the marginal, the beginning, and
/// one over the width.
pub(crate) type Head = [f32; 4];

/// Weight that a sample leaves on either side where the chord shrinks to a point, as the exact map
/// does.
const LEAST_MASS: f64 = 1e-7;

/// Largest error, in u, of the inverse of the weight of a piece.
#[cfg(feature = "alloc")]
const INVERSE: f64 = 3e-8;

/// The position in a leaf at which the weight `u` is reached, iterated until convergence.
#[cold]
pub(crate) fn many_steps([[from, per, ..], [m0, m1, m2, m3, ..]]: Leaf, u: f32) -> f32 {
    let third = 1.0 / 3.0;
    let marginal = [f64::from(m0), f64::from(m1) * third, f64::from(m2) * third, f64::from(m3)];
    let fraction = ((f64::from(u) - f64::from(from)) * f64::from(per)).clamp(0.0, 1.0);
    inverse_fraction(marginal, kept_away(marginal, fraction, LEAST_MASS * f64::from(per))) as f32
}

/// Head of a leaf.
#[cfg(feature = "alloc")]
pub(crate) fn head(&[[from, per, begin, wide, ..], [m0, m1, m2, m3, ..]]: &Leaf) -> Head {
    let sum = f64::from(m0) + (f64::from(m1) + f64::from(m2)) / 3.0 + f64::from(m3);
    let inverse = |x: f64| if x > 0.0 { (1.0 / x).min(f64::from(f32::MAX)) as f32 } else { 0.0 };
    [from, inverse(sum * f64::from(per)), begin, inverse(f64::from(wide.abs()))]
}

/// The leaf of a piece between two weights; at least `margin` columns from the grid lines.
#[cfg(feature = "alloc")]
pub(crate) fn leaf(of: &Marginal, piece: &Piece, weights: [f64; 2], margin: f64) -> Leaf {
    let [from, to] = [weights[0] as f32, weights[1] as f32];
    let per = (1.0 / (f64::from(to) - f64::from(from))).min(f64::from(f32::MAX)) as f32;
    let width = of.columns.width as f64;
    let middle = 0.5 * width + of.columns.kind.offset();
    let (mut begin, mut end) = ((piece.x[0] - 0.5) * width, (piece.x[1] - 0.5) * width);
    if margin > 0.0 {
        let line = f64::from(piece.column) - middle;
        let inside = [line + margin, line + 1.0 - margin];
        (begin, end) = (begin.clamp(inside[0], inside[1]), end.clamp(inside[0], inside[1]));
    }
    let (c, needs_steps) = inverse(piece.marginal, weights[1] - weights[0]);
    let wide = (end - begin) as f32;
    let [m0, m1, m2, m3] = piece.marginal;
    let [b0, b1, b2, b3] = piece.below;
    let scaled = |b: f64| (b * of.scale) as f32;
    [
        [from, per, begin as f32, if needs_steps { -wide } else { wide }, c[0], c[1], c[2], c[3]],
        [
            scaled(m0),
            scaled(3.0 * m1),
            scaled(3.0 * m2),
            scaled(m3),
            scaled(b0),
            scaled(3.0 * b1),
            scaled(3.0 * b2),
            scaled(b3),
        ],
    ]
}

/// The numbers of the inverse of a leaf, and whether a weight of `mass` needs Newton steps.
///
/// The polynomial has the value, slope and curvature of the inverse at both ends.
#[cfg(feature = "alloc")]
fn inverse(marginal: Cubic, mass: f64) -> ([f32; 4], bool) {
    let sum = marginal.iter().sum::<f64>();
    if sum <= 0.0 {
        return ([0.0; 4], false);
    }
    // Where the marginal vanishes, samples are kept away from the end, whatever its weight.
    if [0.0, 1.0] != [0.0, 1.0].map(|fraction| kept_away(marginal, fraction, 0.5)) {
        return ([MANY_STEPS, 0.0, 0.0, 0.0], true);
    }
    let [b0, b1, b2, b3] = marginal;
    let slopes = [0.25 * sum / b0, 0.25 * sum / b3];
    let curvatures =
        [3.0 * (1.0 - b1 / b0) * slopes[0] * slopes[0], 3.0 * (b2 / b3 - 1.0) * slopes[1] * slopes[1]];
    let (begin, end) = (slopes[0] - 1.0, 1.0 - slopes[1]);
    let (rise, fall) = (0.5 * curvatures[0] + begin, -0.5 * curvatures[1] - end);
    let c = [begin, rise, 3.0 * (end - begin) - 2.0 * rise - fall, 2.0 * (begin - end) + rise + fall];
    let place = |r: f64| (r + r * (1.0 - r) * (c[0] + r * (c[1] + r * (c[2] + r * c[3])))).clamp(0.0, 1.0);
    let allowed = INVERSE / mass;
    if [0.25, 0.5, 0.75].iter().all(|&r| (fraction(marginal, place(r)) - r).abs() <= allowed) {
        return (c.map(|c| c as f32), false);
    }
    let near_by_a_step = |k: u8| {
        let r = f64::from(k) / 16.0;
        let s = place(r);
        let s = s - (fraction(marginal, s) - r) * 0.25 * sum / cubic(marginal, s);
        (fraction(marginal, s.clamp(0.0, 1.0)) - r).abs() <= allowed
    };
    if (1..16).all(near_by_a_step) {
        (c.map(|c| c as f32), true)
    } else {
        ([MANY_STEPS, 0.0, 0.0, 0.0], true)
    }
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn inverse_reports_newton_steps() {
        let (c, needs_steps) = inverse([1.0, 1.03, 1.05, 1.06], 0.01);
        assert!(!needs_steps);
        for k in 0..=20 {
            let r = f64::from(k) / 20.0;
            let [c0, c1, c2, c3] = c.map(f64::from);
            let s = r + r * (1.0 - r) * (c0 + r * (c1 + r * (c2 + r * c3)));
            assert_abs_diff_eq!(fraction([1.0, 1.03, 1.05, 1.06], s), r, epsilon = 3e-6);
        }
        let (c, needs_steps) = inverse([1.0, 1.1, 1.3, 1.2], 0.1);
        assert!(needs_steps && c[0] != MANY_STEPS);
        assert_eq!(inverse([0.0, 1.0, 1.0, 1.0], 0.1), ([MANY_STEPS, 0.0, 0.0, 0.0], true));
        assert_eq!(inverse([0.0; 4], 0.0), ([0.0; 4], false));
    }
}
