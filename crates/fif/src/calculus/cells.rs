//! An interval as a union of cells, each of which is a small copy of the whole.

use asperity_core::Interval;

use crate::evaluate::address::{Distance, LongFraction, LongPosition, Orbit, Step};
use crate::evaluate::value::MAX_DEPTH;
use crate::numeric::polynomial::{LEAST, UNIT};
use crate::system::cell::Cell;
use crate::system::fif::{FifRef, Spacing};
use crate::system::map::Piece;

/// A cell of the tiling; lengths are in units of the domain.
#[derive(Clone, Copy)]
pub(crate) struct Tile<const C: usize> {
    pub(crate) cell: Cell<C>,
    pub(crate) left: f64,
    pub(crate) width: f64,
}

impl<const C: usize> Tile<C> {
    fn child(&self, piece: &Piece<C>) -> Self {
        let left = self.left + self.width * piece.s[0];
        Self { cell: self.cell.child(piece), left, width: self.width * piece.map().a }
    }
}

/// An end of the interval: a border of the cell, or a point inside with the local position of the
/// last step.
#[derive(Clone, Copy)]
enum Cut<O> {
    Border,
    Inside { orbit: O, s: f64 },
}

impl<O> Cut<O> {
    /// The position of the point or of the border.
    fn or(&self, border: f64) -> f64 {
        match self {
            Self::Border => border,
            Self::Inside { s, .. } => *s,
        }
    }

    fn orbit(&self) -> Option<&O> {
        match self {
            Self::Border => None,
            Self::Inside { orbit, .. } => Some(orbit),
        }
    }
}

/// Rounding of the ends and of the tiling, in units of the domain.
pub(crate) struct Tiling {
    /// Distance by which the ends may have moved.
    pub(crate) drift: f64,
    /// Maximum number of maps of one cell.
    pub(crate) steps: f64,
}

impl<const C: usize> FifRef<'_, C> {
    /// Passes the cells that make up `[l, r]` to `visit`, where `x_0 ≤ l < r ≤ x_N`.
    ///
    /// The descent follows both ends together while one cell contains them, so short intervals are
    /// as accurate as long ones. Then each end splits off the cells between it and the middle. When
    /// the function varies by less than the rounding error, the rest becomes a single cell with a
    /// constant fractal part.
    pub(crate) fn tile(self, l: f64, r: f64, visit: &mut dyn FnMut(&Tile<C>)) -> Tiling {
        let domain = self.domain();
        match self.spacing() {
            Spacing::Uniform => {
                let cut = |x: f64| {
                    let t = LongPosition::new(x, domain).place();
                    (LongFraction::of(t), t.hi)
                };
                // No rounding occurs if the domain begins at 0 and its width is a power of two.
                let exact =
                    domain.lo == 0.0 && domain.hi.to_bits().trailing_zeros() >= f64::MANTISSA_DIGITS - 1;
                self.tile_with([l, r], cut, if exact { 0.0 } else { LongPosition::ROUNDING }, 0.0, visit)
            }
            Spacing::Nonuniform => {
                let cut = |x: f64| {
                    let point = LongPosition::new(x, domain);
                    (point, point.place().hi)
                };
                self.tile_with([l, r], cut, 0.0, LongPosition::ROUNDING, visit)
            }
        }
    }

    /// The rounding of the ends is relative to their distances from the left end; the rounding of a
    /// step is relative to the cell.
    fn tile_with<O: Orbit + Distance + Copy>(
        self,
        ends: [f64; 2],
        cut: impl Fn(f64) -> (O, f64),
        of_ends: f64,
        of_step: f64,
        visit: &mut dyn FnMut(&Tile<C>),
    ) -> Tiling {
        let domain = self.domain();
        let mut drift = 0.0;
        let [lower, upper] = ends.map(|x| {
            if x <= domain.lo || x >= domain.hi {
                return Cut::Border;
            }
            let (orbit, s) = cut(x);
            // Numbers below 2⁻⁹⁰⁰ of the domain have no low part.
            drift += of_ends * s + if of_ends + of_step > 0.0 { 16.0 * LEAST } else { 0.0 };
            Cut::Inside { orbit, s }
        });
        let root = Tile { cell: Cell::root(), left: 0.0, width: 1.0 };
        let mut walk = Walk { fif: self, visit, tiling: Tiling { drift, steps: 0.0 }, of_step, least: 0.0 };
        walk.run(root, lower, upper, 0.0);
        walk.tiling
    }
}

struct Walk<'a, const C: usize> {
    fif: FifRef<'a, C>,
    visit: &'a mut dyn FnMut(&Tile<C>),
    tiling: Tiling,
    /// Rounding of a step in units of the cell.
    of_step: f64,
    /// Width times variation of a cell that is not divided further; 0 until the ends have
    /// separated.
    least: f64,
}

impl<const C: usize> Walk<'_, C> {
    /// Recurses once, where the ends separate.
    fn run<O: Orbit + Distance + Copy>(
        &mut self,
        mut tile: Tile<C>,
        mut lower: Cut<O>,
        mut upper: Cut<O>,
        mut steps: f64,
    ) {
        let pieces = self.fif.maps();
        let radius = 0.5 * self.fif.range().width();
        while steps < MAX_DEPTH as f64 {
            let length = O::between(lower.orbit(), upper.orbit());
            let done = match (&lower, &upper) {
                (Cut::Border, Cut::Border) => true,
                (Cut::Inside { .. }, Cut::Inside { .. }) => length <= 0.0,
                // A position that has been rounded to the border is still on this side of it.
                _ => false,
            };
            if done {
                break;
            }
            if tile.width * tile.cell.product.abs() * radius <= self.least {
                break;
            }
            steps += 1.0;
            self.tiling.steps = if steps > self.tiling.steps { steps } else { self.tiling.steps };
            let (first, below) = next(&mut lower, pieces, 0);
            let (last, above) = next(&mut upper, pieces, pieces.len());
            // Each end rounds relative to its distance from the left knot of its child.
            let widest = [first, last].map(|j| pieces.get(j).map_or(0.0, |piece| piece.map().a));
            self.tiling.drift += self.of_step * tile.width * widest[0].max(widest[1]);
            if first == last {
                let (Some(piece), Cut::Inside { .. }) = (pieces.get(first), &above) else { return };
                (tile, lower, upper) = (tile.child(piece), below, above);
                continue;
            }
            if self.least == 0.0 {
                let scale = tile.cell.range(self.fif.range()).magnitude();
                self.least = 0.03125 * UNIT * tile.width * length * scale;
            }
            // The parts of the first and the last cell, and everything between.
            let start = match below {
                Cut::Border => first,
                Cut::Inside { .. } => first + 1,
            };
            for piece in pieces.iter().take(last).skip(start) {
                (self.visit)(&tile.child(piece));
            }
            let mut left = None;
            if let (Cut::Inside { .. }, Some(piece)) = (&below, pieces.get(first)) {
                left = Some(tile.child(piece));
            }
            match (left, &above, pieces.get(last)) {
                (Some(left), Cut::Inside { .. }, Some(piece)) => {
                    self.run(left, below, Cut::Border, steps);
                    (tile, lower, upper) = (tile.child(piece), Cut::Border, above);
                }
                (Some(left), _, _) => (tile, lower, upper) = (left, below, Cut::Border),
                (None, Cut::Inside { .. }, Some(piece)) => {
                    (tile, lower, upper) = (tile.child(piece), Cut::Border, above);
                }
                _ => return,
            }
        }
        self.rest(&tile, &lower, &upper);
    }

    fn rest<O: Distance>(&mut self, tile: &Tile<C>, lower: &Cut<O>, upper: &Cut<O>) {
        if let (Cut::Border, Cut::Border) = (lower, upper) {
            (self.visit)(tile);
            return;
        }
        let length = O::between(lower.orbit(), upper.orbit());
        if length > 0.0 {
            let from = lower.or(0.0);
            let to = upper.or(1.0).max(from);
            let cell = tile.cell.levelled(self.fif.range(), from, to);
            (self.visit)(&Tile { cell, left: tile.left + tile.width * from, width: tile.width * length });
        }
    }
}

/// The cell that contains an end, and the position in it; the border if it is the left knot of the
/// cell.
fn next<O: Orbit + Distance + Copy, const C: usize>(
    cut: &mut Cut<O>,
    pieces: &[Piece<C>],
    border: usize,
) -> (usize, Cut<O>) {
    match cut {
        Cut::Border => (border, Cut::Border),
        Cut::Inside { orbit, .. } => {
            let Step { index, s, at_knot } = orbit.step(pieces);
            (index, if at_knot { Cut::Border } else { Cut::Inside { orbit: *orbit, s } })
        }
    }
}

/// An interval clipped to the domain in ascending order, and the sign of its direction.
///
/// `None` for NaN.
pub(crate) fn directed(l: f64, r: f64, domain: Interval) -> Option<(f64, f64, f64)> {
    if l.is_nan() || r.is_nan() {
        return None;
    }
    let (l, r) = (domain.nearest(l), domain.nearest(r));
    Some(if l <= r { (l, r, 1.0) } else { (r, l, -1.0) })
}
