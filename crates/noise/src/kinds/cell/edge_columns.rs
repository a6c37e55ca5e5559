//! Columns of corners whose gradients are edge directions, without multiplications by components.
//!
//! Each component is a sign or 0.

use crate::{
    kinds::cell::column::Column, kinds::cell::corners::CORNERS, lanes::Lanes, lattice::edges::Edge,
    lattice::fade::Along,
};

/// The blend, in 3-D or 4-D, of the corners at one end of the first two axes.
///
/// Their gradients are edge directions times `length`.
///
/// ```text
/// c = Σ_k (g_k·d_k) u_k,   a, b = Σ_k (g_k)ₓ u_k, Σ_k (g_k)_y u_k,   u = length Π w or 1 − w
/// ```
///
/// All four columns of a cell use the same products of offsets and weights.
#[inline(always)]
pub(crate) fn edge_column<S: Lanes, const N: usize>(
    s: S,
    along: &[Along<S>; N],
    words: &[S::U; 4],
    length: f32,
) -> Column<S, N> {
    let mut column = Column::empty(s);
    for k in 0..CORNERS[N] {
        let edge = Edge::<S, N>::new(s, words[k]);
        let u = weight(s, along, k, length, N);
        let plane = &mut column.plane;
        for slope in 0..2 {
            plane.slopes[slope] = added(plane.slopes[slope], edge.times(s, slope, u), k);
        }
        for axis in 2..N {
            let part = edge.times(s, axis, offset(s, along, k, axis) * u);
            plane.value = added(plane.value, part, k + axis - 2);
        }
        for derived in 2..N {
            let du = weight(s, along, k, length, derived);
            let derivative = &mut column.derivatives[derived];
            for slope in 0..2 {
                derivative.slopes[slope] = added(derivative.slopes[slope], edge.times(s, slope, du), k);
            }
            for axis in 2..N {
                let rise = offset(s, along, k, axis) * du;
                let part = edge.times(s, axis, if axis == derived { u + rise } else { rise });
                derivative.value = added(derivative.value, part, k + axis - 2);
            }
        }
    }
    column
}

/// Adds a term to a sum; term 0 starts the sum.
#[inline(always)]
fn added<F: core::ops::Add<Output = F>>(sum: F, part: F, number: usize) -> F {
    if number == 0 { part } else { sum + part }
}

/// The offset from corner k along an axis.
#[inline(always)]
fn offset<S: Lanes, const N: usize>(s: S, along: &[Along<S>; N], k: usize, axis: usize) -> S::F {
    let t = along[axis].position;
    if k >> (axis - 2) & 1 == 0 { t } else { t - s.float(1.0) }
}

/// `length` times the product of the weights of corner k, differentiated along `axis` if it exists.
#[inline(always)]
fn weight<S: Lanes, const N: usize>(
    s: S,
    along: &[Along<S>; N],
    k: usize,
    length: f32,
    derived: usize,
) -> S::F {
    let mut product = s.float(length);
    for axis in 2..N {
        let end = &along[axis];
        let high = k >> (axis - 2) & 1 == 1;
        product = product
            * match (axis == derived, high) {
                (false, false) => s.float(1.0) - end.weight,
                (false, true) => end.weight,
                (true, false) => -end.slope,
                (true, true) => end.slope,
            };
    }
    product
}
