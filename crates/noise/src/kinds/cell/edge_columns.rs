//! Columns of corners whose gradients are edge directions: no component is multiplied with, each is a sign or nothing.

use crate::{
    kinds::cell::blend::Column, kinds::cell::corners::CORNERS, kinds::cell::corners::Place,
    lanes::lanes::Lanes, lattice::edges::Edge,
};

/// The blend in space or in 4-D of the corners at one end of the first two axes, their gradients edge directions times `length`.
///
/// ```text
/// c = Σ_k (g_k·d_k) u_k,   a, b = Σ_k (g_k)ₓ u_k, Σ_k (g_k)_y u_k,   u = length Π w or 1 − w
/// ```
///
/// The products of ways and weights are those of all four columns of a cell.
#[inline(always)]
pub(crate) fn edge_column<S: Lanes, const N: usize>(
    s: S,
    place: &Place<S, N>,
    words: &[S::U; 4],
    length: f32,
) -> Column<S, N> {
    let mut column = Column::empty(s);
    for k in 0..CORNERS[N] {
        let edge = Edge::<S, N>::new(s, words[k]);
        let u = weight(s, place, k, length, N);
        let plane = &mut column.plane;
        for slope in 0..2 {
            plane.slopes[slope] = added(plane.slopes[slope], edge.times(s, slope, u), k);
        }
        for axis in 2..N {
            let part = edge.times(s, axis, way(s, place, k, axis) * u);
            plane.value = added(plane.value, part, k + axis - 2);
        }
        for along in 2..N {
            let du = weight(s, place, k, length, along);
            let derivative = &mut column.derivatives[along];
            for slope in 0..2 {
                derivative.slopes[slope] = added(derivative.slopes[slope], edge.times(s, slope, du), k);
            }
            for axis in 2..N {
                let rise = way(s, place, k, axis) * du;
                let part = edge.times(s, axis, if axis == along { u + rise } else { rise });
                derivative.value = added(derivative.value, part, k + axis - 2);
            }
        }
    }
    column
}

/// A sum and its next part, the first of which is number 0.
#[inline(always)]
fn added<F: core::ops::Add<Output = F>>(sum: F, part: F, number: usize) -> F {
    if number == 0 { part } else { sum + part }
}

/// The way from corner k along an axis.
#[inline(always)]
fn way<S: Lanes, const N: usize>(s: S, place: &Place<S, N>, k: usize, axis: usize) -> S::F {
    let t = place.along[axis].place;
    if k >> (axis - 2) & 1 == 0 { t } else { t - s.float(1.0) }
}

/// `length` times the product of the weights of corner k, derived along one axis, or along none where there is no such axis.
#[inline(always)]
fn weight<S: Lanes, const N: usize>(
    s: S,
    place: &Place<S, N>,
    k: usize,
    length: f32,
    derived: usize,
) -> S::F {
    let mut product = s.float(length);
    for axis in 2..N {
        let along = &place.along[axis];
        let high = k >> (axis - 2) & 1 == 1;
        product = product
            * match (axis == derived, high) {
                (false, false) => s.float(1.0) - along.weight,
                (false, true) => along.weight,
                (true, false) => -along.slope,
                (true, true) => along.slope,
            };
    }
    product
}
