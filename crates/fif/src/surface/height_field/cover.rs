//! Bounds of the function along an axis over any interval, from the bounds of its cells.

use asperity_core::Interval;

use crate::surface::height_field::curve::{Below, Cell, Curve};
use crate::surface::height_field::function::Function;

/// Width of the cells down to which the ends of the interval are followed, relative to its width.
const FINER: f64 = 1.0 / 64.0;

/// Maximum number of splits of the domain.
const LEVELS: u32 = 96;

/// A cell and its position.
struct CellPosition<B> {
    cell: Cell<B>,
    left: f64,
    width: f64,
}

/// Enclosures of the values and slopes over the part of an interval inside the domain.
///
/// An interval outside the domain returns the enclosures over the whole domain.
pub(crate) fn covered<F: Function>(axis: &Curve<F>, over: Interval) -> [Interval; 2] {
    let domain = axis.domain();
    let cut = over.intersection(domain);
    let mut position = CellPosition { cell: axis.root(), left: domain.lo, width: domain.width() };
    let pad = 16.0 * f64::EPSILON * (domain.magnitude() + domain.width());
    let over = Interval::new(cut.lo - pad, cut.hi + pad);
    if cut.lo > cut.hi || cut.lo.is_nan() || cut.hi.is_nan() {
        return axis.bounds(&position.cell);
    }
    for _ in 0..LEVELS {
        let mut meeting = (0..axis.count()).filter(|&j| meets(&child(axis, &position, j), over));
        let (Some(j), None) = (meeting.next(), meeting.next()) else { break };
        position = child(axis, &position, j);
    }
    let mut all = [Interval::EMPTY; 2];
    gather(axis, &position, over, LEVELS, &mut all);
    all
}

/// At most `levels` deep.
fn gather<F: Function>(
    axis: &Curve<F>,
    position: &CellPosition<Below<F>>,
    over: Interval,
    levels: u32,
    all: &mut [Interval; 2],
) {
    let inside = over.lo <= position.left && position.left + position.width <= over.hi;
    if inside || levels == 0 || position.width <= FINER * over.width() {
        let bounds = axis.bounds(&position.cell);
        *all = [0, 1].map(|k| all[k].hull(bounds[k]));
        return;
    }
    for j in 0..axis.count() {
        let part = child(axis, position, j);
        if meets(&part, over) {
            gather(axis, &part, over, levels - 1, all);
        }
    }
}

fn child<F: Function>(
    axis: &Curve<F>,
    position: &CellPosition<Below<F>>,
    j: usize,
) -> CellPosition<Below<F>> {
    let [s0, s1] = axis.part(j);
    let cell = axis.child(&position.cell, j);
    CellPosition { cell, left: position.left + position.width * s0, width: position.width * (s1 - s0) }
}

fn meets<B>(position: &CellPosition<B>, over: Interval) -> bool {
    position.left <= over.hi && over.lo <= position.left + position.width
}
