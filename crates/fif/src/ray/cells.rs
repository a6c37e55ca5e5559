//! Cells of an axis under a ray, and the times at which it goes through them.

use crate::numeric::double::Double;
use crate::numeric::interval::Interval;
use crate::surface::height_field::curve::{Below, Cell, Curve};
use crate::surface::height_field::function::Function;

/// Cells of one axis that a box is split into, one within the other, at most.
const LEVELS: u32 = 192;

/// Width of the cells, in parts of the domain, down to which a ray's place is known: 2⁻⁹⁶.
pub(crate) const FINEST: f64 = f64::EPSILON * f64::EPSILON / 256.0;

/// A curve under a ray: how its places become times.
pub(crate) struct Axis<'a, F: Function> {
    curve: &'a Curve<F>,
    origin: f64,
    direction: f64,
    /// Whether places are kept as times at which the ray is there; else, where these overflow, as themselves.
    timed: bool,
    /// Share of a child in its cell, where all have the same.
    share: Option<Double>,
    /// Width of the cells that are not split any more; none for a ray along the axis, whose cells need no place of their own.
    finest: f64,
}

/// A cell of one axis: where it lies and what bounds the function there.
#[derive(Clone)]
pub(crate) struct Level<F: Function> {
    cell: Cell<Below<F>>,
    /// The left end and the width, as places or as times; the latter also as a length, rounded.
    pub(crate) left: Double,
    pub(crate) width: Double,
    pub(crate) size: f64,
    pub(crate) value: Interval,
    pub(crate) slope: Interval,
    pub(crate) depth: u32,
}

impl<'a, F: Function> Axis<'a, F> {
    pub(crate) fn new(curve: &'a Curve<F>, [origin, direction]: [f64; 2], other: f64) -> Self {
        let count = curve.count();
        let even = curve.function().is_even().then(|| Double::ratio(1.0, count as f64));
        let domain = curve.domain();
        let farthest = (domain.magnitude() + origin.abs()) / direction.abs();
        let finest = if other == 0.0 { 0.0 } else { FINEST * domain.width() };
        Self { curve, origin, direction, timed: farthest < 0.125 * f64::MAX, share: even, finest }
    }

    /// The domain, or the one place that the ray keeps to.
    pub(crate) fn root(&self) -> Level<F> {
        let domain = self.curve.domain();
        let [lo, hi] = [domain.lo, domain.hi].map(Double::from);
        let [mut left, mut width] = [lo, hi.minus(lo)];
        if self.timed {
            (left, width) = (self.time_of(left), width.over(self.direction));
        }
        let root = self.level(self.curve.root(), [left, width], domain.width(), 0);
        if self.direction == 0.0 {
            return Level { value: self.curve.near(self.origin).interval(), depth: LEVELS, ..root };
        }
        root
    }

    /// Whether a cell is not split any more.
    #[inline]
    pub(crate) fn ends(&self, level: &Level<F>) -> bool {
        level.depth >= LEVELS || level.size <= self.finest
    }

    #[inline]
    fn level(&self, cell: Cell<Below<F>>, [left, width]: [Double; 2], size: f64, depth: u32) -> Level<F> {
        let [value, slope] = self.curve.bounds(&cell);
        Level { cell, left, width, size, value, slope, depth }
    }

    fn time_of(&self, place: Double) -> Double {
        place.minus(Double::from(self.origin)).over(self.direction)
    }

    #[inline]
    pub(crate) fn time(&self, place: Double) -> Double {
        if self.timed { place } else { self.time_of(place) }
    }

    /// Knot `j` of a cell, whose children have the width `part`, where all have the same.
    #[inline]
    fn knot(&self, level: &Level<F>, part: Double, j: usize) -> Double {
        match (self.share, j) {
            (_, 0) => level.left,
            (Some(_), 1) => level.left.plus(part),
            (Some(_), _) => level.left.plus(part.times(Double::from(j as f64))),
            (None, _) => level.left.plus(level.width.times(self.curve.function().knot(j))),
        }
    }

    /// The children that a stretch of the ray goes through, in its order, each made when it is asked for, and the part
    /// of the stretch over each.
    #[inline]
    pub(crate) fn children<'b>(
        &'b self,
        level: &'b Level<F>,
        [mut lo, hi]: [Double; 2],
    ) -> impl Iterator<Item = (impl Fn() -> Level<F> + 'b, [Double; 2])> + 'b {
        let (count, mut done) = (self.curve.count(), false);
        let part = match self.share {
            // Powers of two are exact.
            Some(Double { hi: share, lo: 0.0 }) => level.width.scaled(share),
            Some(share) => level.width.times(share),
            None => level.width,
        };
        (0..count).filter_map(move |k| {
            let (j, far) = if self.direction < 0.0 { (count - 1 - k, count - 1 - k) } else { (k, k + 1) };
            let end = || self.time(self.knot(level, part, far));
            let end = if k + 1 == count { hi } else { end() };
            // A stretch that only ends where the next child begins belongs to that.
            if done || (end <= lo && k + 1 < count) {
                return None;
            }
            let span = [lo, end.min(hi).max(lo)];
            (lo, done) = (span[1], end >= hi);
            let child = move || {
                let left = self.knot(level, part, j);
                let [from, to] = self.curve.part(j);
                let width =
                    if self.share.is_some() { part } else { self.knot(level, part, j + 1).minus(left) };
                let cell = self.curve.child(&level.cell, j);
                self.level(cell, [left, width], level.size * (to - from), level.depth + 1)
            };
            Some((child, span))
        })
    }
}
