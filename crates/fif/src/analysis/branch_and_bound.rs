//! Branch and bound over the cells of a function, for the maximum of `±f` over an interval.
//!
//! A pass has a target, a fraction of the gap between the best value and the bound. It ends when no
//! cell can exceed the value by more than the target. Over the whole domain the result of a pass
//! bounds `f` inside every cell of the next pass. Each pass therefore descends only as deep as a
//! product of scalings needs to reach the target fraction, however small the gap has become.

use asperity_core::Interval;
use asperity_core::math::sqrt_f64;

use crate::numeric::polynomial::UNIT;
use crate::system::cell::Cell;
use crate::system::fif::FifRef;
use crate::system::map::Piece;

/// Maximum number of cells that one search visits, or [`PER_MAP`] for each map if that is more.
const BUDGET: usize = 1 << 16;

/// Maximum number of cells that one pass visits, likewise.
const PASS: usize = 1 << 12;

/// See [`BUDGET`] and [`PASS`]; every map has to be visited.
const PER_MAP: usize = 4;

/// The target fraction of the gap in the first pass, and the largest worthwhile fraction.
const PARTS: [f64; 2] = [1.0 / 16.0, 0.99];

/// Maximum number of maps that a search composes: the length of its stack.
const DEPTH: usize = 200;

/// Maximum number of cells that each of the two searches for the outermost points visits.
const POSITIONS: usize = 1 << 12;

/// Cells this narrow, in units of the domain, are not split to locate a point.
const NARROW: f64 = 1.0 / 1_073_741_824.0;

/// Interval and accuracy of a search.
pub(crate) struct Goal {
    over: Interval,
    domain: Interval,
    /// More than the rounding of the ends of the domain and of the interval.
    margin: f64,
    width: f64,
}

impl Goal {
    /// The extremum over `over`, a part of `domain`, in a bracket of `width`.
    pub(crate) fn new(over: Interval, domain: Interval, width: f64) -> Self {
        Self { over, domain, margin: 8.0 * f64::EPSILON * domain.magnitude(), width }
    }

    fn meets<const C: usize>(&self, position: &CellPosition<C>) -> bool {
        let margin = self.margin + position.slip;
        position.left - margin <= self.over.hi && position.left + position.width + margin >= self.over.lo
    }

    /// Whether a point within `slip` of `x` is certainly inside, or at an end of the domain in the
    /// interval.
    fn surely(&self, x: f64, slip: f64) -> bool {
        let margin = self.margin + slip;
        let left = self.over.lo == self.domain.lo || self.over.lo + margin <= x;
        let right = self.over.hi == self.domain.hi || x <= self.over.hi - margin;
        left && right
    }

    /// Part of the interval within the margins of a cell.
    fn part<const C: usize>(&self, position: &CellPosition<C>) -> Interval {
        let margin = self.margin + position.slip;
        Interval::new(position.left - margin, position.left + position.width + margin).intersection(self.over)
    }

    /// A border of the interval within a cell that is narrower than the rounding of its position.
    fn lost<const C: usize>(&self, position: &CellPosition<C>) -> bool {
        let ends = [position.left, position.left + position.width];
        position.width < 0.25 * (self.margin + position.slip)
            && !ends.into_iter().all(|x| self.surely(x, position.slip))
    }
}

/// A cell and its position.
#[derive(Clone, Copy)]
struct CellPosition<const C: usize> {
    cell: Cell<C>,
    left: f64,
    width: f64,
    /// Bound of the rounding errors of the two.
    slip: f64,
}

impl<const C: usize> CellPosition<C> {
    fn root(domain: Interval) -> Self {
        Self { cell: Cell::root(), left: domain.lo, width: domain.width(), slip: 0.0 }
    }

    fn child(&self, piece: &Piece<C>) -> Self {
        let left = self.left + self.width * piece.s[0];
        let width = self.width * (piece.s[1] - piece.s[0]);
        // One unit of the sum, three of the knot; five of each width above, once in the width and
        // once in the shift.
        let slip = self.slip + UNIT * (left.abs() + 16.0 * self.width);
        Self { cell: self.cell.child(piece), left, width, slip }
    }
}

/// A cell whose children are being visited.
#[derive(Clone, Copy)]
struct Frame<const C: usize> {
    position: CellPosition<C>,
    upper: f64,
    next: usize,
}

/// State of a search.
pub(crate) struct Search<'a, const C: usize> {
    pieces: &'a [Piece<C>],
    range: Interval,
    end_values: [f64; 2],
    goal: &'a Goal,
    sign: f64,
    /// An attained value, rounded down; −∞ while no knot is certainly inside.
    pub(crate) best: f64,
    /// Position of the best value.
    pub(crate) at: Interval,
    /// An upper bound.
    pub(crate) bound: f64,
    /// The target fraction of the gap in the next pass.
    part: f64,
    /// An upper bound over the finished cells of this pass.
    top: f64,
    /// Maximum accepted difference of `top` and `best`.
    width: f64,
    /// Remaining cells of this pass, and of all passes.
    left: usize,
    budget: usize,
}

impl<'a, const C: usize> Search<'a, C> {
    /// Creates a search for the maximum of `sign · f`.
    pub(crate) fn new(fif: FifRef<'a, C>, goal: &'a Goal, sign: f64) -> Self {
        let pieces = fif.maps();
        let mut search = Self {
            pieces,
            range: fif.range(),
            end_values: fif.end_values(),
            goal,
            sign,
            best: f64::NEG_INFINITY,
            at: goal.over,
            bound: if sign > 0.0 { fif.range().hi } else { -fif.range().lo },
            part: PARTS[0],
            top: f64::INFINITY,
            width: f64::INFINITY,
            left: 0,
            budget: BUDGET.max(pieces.len().saturating_mul(2 * PER_MAP)),
        };
        let root = CellPosition::root(goal.domain);
        search.note(&root);
        search.roll_out(root);
        search
    }

    /// One pass, where `range` contains all values over the domain; returns whether another one may
    /// help.
    pub(crate) fn narrow(&mut self, range: Interval) -> bool {
        let reached = self.bound - self.best <= self.goal.width;
        if reached || self.budget == 0 || self.part > PARTS[1] {
            return false;
        }
        self.range = range;
        self.left = PASS.max(self.pieces.len().saturating_mul(PER_MAP)).min(self.budget);
        let given = self.left;
        self.width = self.goal.width.max(self.part * (self.bound - self.best));
        self.pass();
        let blind = !self.best.is_finite();
        let done = self.left > 0;
        self.budget -= given - self.left;
        let gained = self.top < self.bound;
        self.bound = if gained { self.top } else { self.bound };
        if !done {
            self.part = sqrt_f64(self.part);
        }
        // Without an attained value every pass is the same; so is a pass that ended in cells that
        // cannot be split.
        let stuck = done && !gained && self.top > self.best + self.width;
        !(blind || stuck)
    }

    /// Sets the range for the search of positions.
    pub(crate) fn assume(&mut self, range: Interval) {
        self.range = range;
    }

    /// The hull of the cells that may have a value of `best` or more: from the left, then from the
    /// right.
    pub(crate) fn positions(&self) -> Interval {
        if !self.best.is_finite() {
            return self.goal.over;
        }
        let leftmost = self.outermost(|next| next, |part, within| part.lo >= within.lo);
        let last = self.pieces.len().saturating_sub(1);
        leftmost.hull(self.outermost(|next| last.wrapping_sub(next), |part, within| part.hi <= within.hi))
    }

    /// Extends the position of `best` to one side, visiting the children of a cell from that side.
    ///
    /// The other side is known.
    fn outermost(
        &self,
        order: impl Fn(usize) -> usize,
        known: impl Fn(Interval, Interval) -> bool,
    ) -> Interval {
        let mut within = self.at;
        let mut left = POSITIONS.max(self.pieces.len().saturating_mul(2));
        let root = CellPosition::root(self.goal.domain);
        let mut stack = [Frame { position: root, upper: f64::INFINITY, next: 0 }; DEPTH];
        let mut height = 1_usize;
        while let Some(frame) = height.checked_sub(1).and_then(|last| stack.get_mut(last)) {
            let parent = frame.position;
            let Some(piece) = self.pieces.get(order(frame.next)).filter(|_| left > 0) else {
                if left == 0 {
                    within = within.hull(self.goal.part(&parent));
                }
                height -= 1;
                continue;
            };
            frame.next += 1;
            left -= 1;
            let child = parent.child(piece);
            let part = self.goal.part(&child);
            if part.lo > part.hi || known(part, within) || self.upper(&child) < self.best {
                continue;
            }
            match stack.get_mut(height) {
                Some(free) if child.width > NARROW * self.goal.domain.width() && !self.goal.lost(&child) => {
                    *free = Frame { position: child, upper: f64::INFINITY, next: 0 };
                    height += 1;
                }
                _ => within = within.hull(part),
            }
        }
        within
    }

    /// Follows the most promising child, to have a good value before the passes begin.
    fn roll_out(&mut self, root: CellPosition<C>) {
        let mut position = root;
        for _ in 0..DEPTH.min(BUDGET / self.pieces.len().max(1) + 1) {
            let mut next = None;
            let mut most = f64::NEG_INFINITY;
            for piece in self.pieces {
                let child = position.child(piece);
                if !self.goal.meets(&child) {
                    continue;
                }
                self.note(&child);
                // Upper bounds are often equal, so the middle is included.
                let promise = self.upper(&child) + self.sign * child.cell.range(self.range).middle();
                if promise > most {
                    (most, next) = (promise, Some(child));
                }
            }
            match next {
                Some(child) if self.upper(&child) > self.best + 0.125 * self.goal.width => position = child,
                _ => break,
            }
        }
    }

    /// Depth first: the stack contains the cells with unvisited children, from the domain inward.
    fn pass(&mut self) {
        let root = CellPosition::root(self.goal.domain);
        self.top = self.best;
        let start = Frame { position: root, upper: self.upper(&root), next: 0 };
        let mut stack = [start; DEPTH];
        let mut height = 1_usize;
        while let Some(frame) = height.checked_sub(1).and_then(|last| stack.get_mut(last)) {
            let (parent, upper) = (frame.position, frame.upper);
            if self.left == 0 {
                // The bound of this cell also holds for its unvisited children.
                self.close(upper);
                height -= 1;
                continue;
            }
            let Some(piece) = self.pieces.get(frame.next) else {
                height -= 1;
                continue;
            };
            frame.next += 1;
            let child = parent.child(piece);
            if !self.goal.meets(&child) {
                continue;
            }
            self.left -= 1;
            self.note(&child);
            let upper = self.upper(&child);
            if upper <= self.best + self.width || self.goal.lost(&child) {
                self.close(upper);
            } else if let Some(free) = stack.get_mut(height) {
                *free = Frame { position: child, upper, next: 0 };
                height += 1;
            } else {
                self.close(upper);
            }
        }
    }

    /// Finishes a cell.
    fn close(&mut self, upper: f64) {
        self.top = if upper > self.top { upper } else { self.top };
    }

    fn upper(&self, position: &CellPosition<C>) -> f64 {
        let range = position.cell.range(self.range);
        if self.sign > 0.0 { range.hi } else { -range.lo }
    }

    fn note(&mut self, position: &CellPosition<C>) {
        let ends = position.cell.ends(self.end_values);
        for (value, x) in ends.into_iter().zip([position.left, position.left + position.width]) {
            let attained = if self.sign > 0.0 { value.lo } else { -value.hi };
            if attained > self.best && self.goal.surely(x, position.slip) {
                self.best = attained;
                let margin = position.slip + 2.0 * UNIT * self.goal.domain.magnitude();
                self.at = Interval::new(x - margin, x + margin).intersection(self.goal.over);
            }
        }
    }
}
