//! A box that contains the graph, proved by an inclusion.

use asperity_core::Interval;

use crate::system::cell::Cell;
use crate::system::map::Piece;

/// A box that contains every image `α_j B + q_j(X)`, or `None` if none can be proved in `f64`.
pub(crate) fn box_of_range<const C: usize>(pieces: &[Piece<C>]) -> Option<Interval> {
    const STEPS: usize = 32;
    let image = |b: Interval, piece: &Piece<C>| Cell::root().child(piece).range(b);
    let cover = |b: Interval| pieces.iter().fold(Interval::EMPTY, |hull, piece| hull.hull(image(b, piece)));
    // Start from the symmetric box |f| ≤ max|q|/(1 − max|α|).
    let steepest = pieces.iter().fold(0.0_f64, |m, p| m.max(p.map().alpha.abs()));
    let offset = cover(Interval::new(0.0, 0.0));
    let radius = offset.magnitude() / (1.0 - steepest);
    // Policy iteration: fix the maps of the top and the bottom, solve the two linear equations,
    // choose again.
    let mut guess = offset;
    for _ in 0..STEPS {
        let (mut top, mut bottom) = ((f64::NEG_INFINITY, 0.0, 0.0), (f64::INFINITY, 0.0, 0.0));
        for piece in pieces {
            let (now, q) = (image(guess, piece), image(Interval::new(0.0, 0.0), piece));
            let alpha = piece.map().alpha;
            top = if now.hi > top.0 { (now.hi, alpha, q.hi) } else { top };
            bottom = if now.lo < bottom.0 { (now.lo, alpha, q.lo) } else { bottom };
        }
        let next = solve(top.1, top.2, bottom.1, bottom.2);
        if next == guess {
            break;
        }
        guess = next;
    }
    let scale = radius.max(f64::MIN_POSITIVE);
    // The inclusion is the proof. Inflation by δ leaves a margin of (1 − |α|) δ for the rounding of
    // the check itself.
    for candidate in [guess, Interval::new(-radius, radius)] {
        let mut margin = 16.0 * C as f64 * f64::EPSILON * scale;
        for _ in 0..STEPS {
            let b = candidate.inflated(margin);
            let c = cover(b);
            if b.lo <= c.lo && c.hi <= b.hi && b.lo.is_finite() && b.hi.is_finite() {
                return Some(c);
            }
            margin *= 4.0;
        }
    }
    None
}

/// Solves `hi = q_top + α_top · (hi or lo)`, `lo = q_bottom + α_bottom · (lo or hi)`.
fn solve(alpha_top: f64, q_top: f64, alpha_bottom: f64, q_bottom: f64) -> Interval {
    match (alpha_top >= 0.0, alpha_bottom >= 0.0) {
        (true, true) => Interval::new(q_bottom / (1.0 - alpha_bottom), q_top / (1.0 - alpha_top)),
        (true, false) => {
            let hi = q_top / (1.0 - alpha_top);
            Interval::new(q_bottom + alpha_bottom * hi, hi)
        }
        (false, true) => {
            let lo = q_bottom / (1.0 - alpha_bottom);
            Interval::new(lo, q_top + alpha_top * lo)
        }
        (false, false) => {
            let hi = (q_top + alpha_top * q_bottom) / (1.0 - alpha_top * alpha_bottom);
            Interval::new(q_bottom + alpha_bottom * hi, hi)
        }
    }
}
