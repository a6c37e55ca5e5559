//! The deviation of a function from its chord, again a fractal interpolation function, but zero at
//! both ends.

use crate::numeric::polynomial::{UNIT, magnitude};
use crate::system::fif::{Spacing, System};
use crate::system::map::Piece;

/// The line through both ends of the graph, over the domain scaled to `[0, 1]`.
///
/// It is constant if `C < 2`, so that the polynomials of the deviation need no more coefficients
/// than those of `f`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chord {
    pub(crate) start: f64,
    pub(crate) rise: f64,
}

impl Chord {
    #[inline(always)]
    pub(crate) fn at(&self, t: f64) -> f64 {
        self.start + self.rise * t
    }
}

/// One map of `v = f − chord` over `[0, 1]`:
///
/// ```text
/// v(s + a u) = α v(u) + p(u)        p(u) = q(u) + α chord(u) − chord(s + a u)
/// ```
///
/// `v(0) = 0`, so the rest of a sum at a knot is exactly zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Deviation<const C: usize> {
    pub(crate) alpha: f64,
    pub(crate) s: f64,
    pub(crate) a: f64,
    pub(crate) p: [f64; C],
    /// Bound of the error of `p` over `[0, 1]`.
    pub(crate) slack: f64,
}

impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    pub(crate) fn chord(&self) -> Chord {
        let [start, end] = self.end_values();
        Chord { start, rise: if C < 2 { 0.0 } else { end - start } }
    }

    pub(crate) fn deviation(&self, piece: &Piece<C>) -> Deviation<C> {
        let chord = self.chord();
        let (s, alpha) = (piece.s[0], piece.map().alpha);
        let a = match self.spacing() {
            Spacing::Uniform => 1.0 / self.pieces().len() as f64,
            Spacing::Nonuniform => piece.s[1] - s,
        };
        let mut p = piece.local;
        if let Some(linear) = p.get_mut(1) {
            *linear += alpha * chord.rise - chord.rise * a;
        }
        // The left knot itself, which the polynomial matches within the defect of the join-up.
        let left = piece.y()[0];
        if let Some(constant) = p.first_mut() {
            *constant = left - chord.at(s);
        }
        let scale = magnitude(&piece.local, 1.0) + 2.0 * (chord.start.abs() + chord.rise.abs()) + left.abs();
        Deviation { alpha, s, a, p, slack: 2.0 * piece.slack + 16.0 * UNIT * scale }
    }
}
