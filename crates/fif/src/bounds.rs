//! Rigorous extrema over the domain and over any interval, by branch and bound.

use crate::cell::Cell;
use crate::interval::Interval;
use crate::map::Piece;
use crate::system::Fif;

/// Brackets of the two extrema of a function over an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extrema {
    /// The least value lies in here.
    pub minimum: Interval,
    /// The greatest value lies in here.
    pub maximum: Interval,
}

impl Extrema {
    /// `[minimum.lo, maximum.hi]`: every value lies in here.
    #[inline]
    #[must_use]
    pub fn enclosure(&self) -> Interval {
        Interval::new(self.minimum.lo, self.maximum.hi)
    }
}

/// Cells that one search visits at most.
const BUDGET: u32 = 1 << 16;

/// Maps that one search composes at most.
const DEPTH: u32 = 200;

impl<S: AsRef<[Piece<C>]>, const C: usize> Fif<S, C> {
    /// Brackets of the extrema over the domain, each at most `width` wide where `f64` and 2¹⁶ cells allow that.
    ///
    /// The brackets are rigorous whatever their width: an upper end bounds `f`, a lower end of the maximum is a value at
    /// a knot of some level. A chaos game (Algorithm 1 of the source) with 10⁴ points misses up to 27 % of the range, so
    /// no inflation of it is safe.
    ///
    /// ```
    /// let f = asperity_fif::paper::f()?;
    /// let extrema = f.extrema(1e-9);
    /// assert!(extrema.maximum.contains(4.0 / 3.0) && extrema.maximum.width() <= 1e-9);
    /// assert!(extrema.minimum.contains(0.0));
    /// # Ok::<(), asperity_fif::SystemError>(())
    /// ```
    #[must_use]
    pub fn extrema(&self, width: f64) -> Extrema {
        self.search(self.domain(), width)
    }

    /// Brackets of the extrema over `[l, r]`, clipped to the domain, as [`Fif::extrema`].
    ///
    /// The interval is widened by the rounding of the ends of cells, eight units in the last place of the domain. Over
    /// one that holds no knot of any visited level, a bracket is the whole enclosure. `None` when the
    /// interval misses the domain, is empty or has NaN ends.
    ///
    /// ```
    /// let f = asperity_fif::paper::f()?;
    /// let rise = f.extrema_over(0.0, 0.5, 1e-6).unwrap();
    /// assert!(rise.maximum.contains(13.0 / 12.0)); // f(5/12), over f(1/2) = 1
    /// assert!(f.extrema_over(3.0, 4.0, 1e-6).is_none());
    /// # Ok::<(), asperity_fif::SystemError>(())
    /// ```
    #[must_use]
    pub fn extrema_over(&self, l: f64, r: f64, width: f64) -> Option<Extrema> {
        let over = Interval::new(l, r).intersection(self.domain());
        let whole = l <= r && over.lo <= over.hi;
        whole.then(|| self.search(over, width))
    }

    fn search(&self, over: Interval, width: f64) -> Extrema {
        let domain = self.domain();
        // A bracket under the rounding errors of the two bounds cannot be had.
        let least = 64.0 * (self.noise * self.gain).max(f64::EPSILON * self.range().magnitude());
        let goal = Goal {
            over,
            margin: 8.0 * f64::EPSILON * domain.magnitude(),
            width: if width > least { width } else { least },
        };
        let root = Place { cell: Cell::root(), left: domain.lo, width: domain.width() };
        let [maximum, negated] = [1.0, -1.0].map(|sign| {
            let mut found = Found {
                sign,
                best: f64::NEG_INFINITY,
                top: f64::INFINITY,
                left: BUDGET,
                width: self.range().width(),
            };
            found.note(self, &root, &goal);
            self.roll_out(root, &goal, &mut found);
            // Ever narrower searches: when the last one runs out of cells, the one before stands.
            let mut bound = found.upper(self, &root);
            while found.width > goal.width && found.left > 0 {
                found.width = goal.width.max(found.width / 16.0);
                found.top = found.best;
                self.branch(&root, &goal, &mut found, DEPTH);
                bound = if found.top < bound { found.top } else { bound };
            }
            Interval::new(found.best, bound)
        });
        let maximum =
            Interval::new(if maximum.lo.is_finite() { maximum.lo } else { -negated.hi }, maximum.hi);
        let minimum =
            Interval::new(-negated.hi, if negated.lo.is_finite() { -negated.lo } else { maximum.hi });
        Extrema { minimum, maximum }
    }

    /// Follows the most promising child, to have a good value before the search begins.
    fn roll_out(&self, root: Place<C>, goal: &Goal, found: &mut Found) {
        let mut place = root;
        for _ in 0..DEPTH {
            let mut next = None;
            let mut most = f64::NEG_INFINITY;
            for piece in self.pieces() {
                let child = place.child(piece);
                if !goal.meets(&child) {
                    continue;
                }
                found.note(self, &child, goal);
                // Upper bounds tie often, so the middle counts too.
                let promise =
                    found.upper(self, &child) + found.sign * child.cell.range(self.range()).middle();
                if promise > most {
                    (most, next) = (promise, Some(child));
                }
            }
            match next {
                Some(child) if found.upper(self, &child) > found.best + 0.125 * goal.width => place = child,
                _ => break,
            }
        }
    }

    /// Depth first, at most [`DEPTH`] deep and [`BUDGET`] cells in all.
    fn branch(&self, place: &Place<C>, goal: &Goal, found: &mut Found, depth: u32) {
        let domain = self.domain();
        for piece in self.pieces() {
            let child = place.child(piece);
            if !goal.meets(&child) {
                continue;
            }
            found.left = found.left.saturating_sub(1);
            found.note(self, &child, goal);
            let upper = found.upper(self, &child);
            // At a border, a cell under the rounding of its place cannot be told from its neighbours.
            let lost = child.width < 0.25 * goal.margin && !goal.holds(&child, domain);
            let done = depth == 0 || found.left == 0 || lost;
            if done || upper <= found.best + found.width {
                found.top = if upper > found.top { upper } else { found.top };
            } else {
                self.branch(&child, goal, found, depth - 1);
            }
        }
    }
}

/// A cell and where it lies.
#[derive(Clone, Copy)]
struct Place<const C: usize> {
    cell: Cell<C>,
    left: f64,
    width: f64,
}

impl<const C: usize> Place<C> {
    fn child(&self, piece: &Piece<C>) -> Self {
        Self {
            cell: self.cell.child(piece),
            left: self.left + self.width * piece.s[0],
            width: self.width * (piece.s[1] - piece.s[0]),
        }
    }
}

/// What is searched, and how well.
struct Goal {
    over: Interval,
    /// More than the rounding of a cell's place.
    margin: f64,
    width: f64,
}

impl Goal {
    fn meets<const C: usize>(&self, place: &Place<C>) -> bool {
        place.left - self.margin <= self.over.hi && place.left + place.width + self.margin >= self.over.lo
    }

    /// Whether `x` is surely inside, or at an end of the domain that belongs to the interval.
    fn surely(&self, x: f64, domain: Interval) -> bool {
        let left = self.over.lo == domain.lo || self.over.lo + self.margin <= x;
        let right = self.over.hi == domain.hi || x <= self.over.hi - self.margin;
        left && right
    }

    fn holds<const C: usize>(&self, place: &Place<C>, domain: Interval) -> bool {
        self.surely(place.left, domain) && self.surely(place.left + place.width, domain)
    }
}

/// The state of one search, for the maximum of `sign · f`.
struct Found {
    sign: f64,
    /// A value that is attained, rounded down.
    best: f64,
    /// An upper bound over the cells that this search is done with.
    top: f64,
    /// How much that may be above `best`.
    width: f64,
    left: u32,
}

impl Found {
    fn upper<S: AsRef<[Piece<C>]>, const C: usize>(&self, fif: &Fif<S, C>, place: &Place<C>) -> f64 {
        let range = place.cell.range(fif.range());
        if self.sign > 0.0 { range.hi } else { -range.lo }
    }

    fn note<S: AsRef<[Piece<C>]>, const C: usize>(&mut self, fif: &Fif<S, C>, place: &Place<C>, goal: &Goal) {
        let ends = place.cell.ends(fif.end_values());
        for (value, x) in ends.into_iter().zip([place.left, place.left + place.width]) {
            if goal.surely(x, fif.domain()) {
                let attained = if self.sign > 0.0 { value.lo } else { -value.hi };
                self.best = if attained > self.best { attained } else { self.best };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::paper;

    #[test]
    fn the_takagi_function_has_maximum_four_thirds() {
        for width in [1e-2, 1e-6, 1e-11] {
            let e = paper::f().unwrap().extrema(width);
            assert!(e.maximum.contains(4.0 / 3.0) && e.maximum.width() <= width, "{e:?}");
            assert!(e.minimum.contains(0.0) && e.minimum.width() <= width, "{e:?}");
        }
    }

    #[test]
    fn an_impossible_width_still_gives_brackets() {
        for width in [0.0, -1.0, f64::NAN, 1e-300] {
            let e = paper::g().unwrap().extrema(width);
            assert!(e.maximum.width() < 1e-10 && e.maximum.contains(41_969.0 / 21_609.0), "{width}: {e:?}");
        }
    }

    #[test]
    fn empty_and_unordered_intervals_have_no_extrema() {
        let f = paper::f().unwrap();
        for (l, r) in [(1.0, 0.5), (f64::NAN, 1.0), (0.0, f64::NAN), (-2.0, -1.0)] {
            assert!(f.extrema_over(l, r, 1e-6).is_none(), "[{l}, {r}]");
        }
        let whole = f.extrema_over(f64::NEG_INFINITY, f64::INFINITY, 1e-6).unwrap();
        assert_eq!(whole, f.extrema(1e-6));
        let point = f.extrema_over(2.0 / 3.0, 2.0 / 3.0, 1e-6).unwrap();
        assert!(point.enclosure().contains(4.0 / 3.0) && point.enclosure().width() < 1e-5, "{point:?}");
    }
}
