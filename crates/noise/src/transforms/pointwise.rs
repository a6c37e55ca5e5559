//! Pointwise combinations of fields, the common part of sums, products, blends and maps.

use crate::{
    contract::field::Field,
    point::Point,
    row::points::{Buffer, Points, Target},
};

/// The number of points whose values are combined at once.
const BLOCK: usize = 2048;

/// A function of the values of a field and M other fields.
pub(crate) trait Combine<const M: usize> {
    /// f(x, y₁ … y_M).
    fn combined(&self, x: f32, others: [f32; M]) -> f32;
    /// The derivative of f along a direction in which the fields change by `dx` and `d_others`.
    fn slope(&self, x: f32, others: [f32; M], dx: f32, d_others: [f32; M]) -> f32;
}

/// Evaluates the combination at the points of a batch.
///
/// The first field is evaluated in the target, the others in buffers, a block of points at a time.
pub(crate) fn fill<V: Point, C: Combine<M>, const M: usize>(
    combine: &C,
    first: &dyn Field<V>,
    others: [&dyn Field<V>; M],
    points: &Points<'_, V>,
    mut target: Target<'_, V>,
) {
    let (instructions, wanted) = (target.instructions, target.gradients.is_some());
    let mut buffers: [Buffer<V, BLOCK>; M] = core::array::from_fn(|_| Buffer::empty());
    for block in points.blocks(if M == 0 { usize::MAX } else { BLOCK }) {
        let (points, width) = (points.part(&block), block.width());
        let mut target = target.part(&block);
        first.fill(&points, target.after(0));
        for (buffer, other) in buffers.iter_mut().zip(others) {
            other.fill(&points, buffer.target(instructions, width, wanted));
        }
        for row in 0..block.rows.len() {
            let part = row * width..(row + 1) * width;
            let (values, gradients) = target.row(row, width);
            let y: [&[f32]; M] = buffers.each_ref().map(|buffer| &buffer.values[part.clone()]);
            if let Some(mut gradients) = gradients {
                for (axis, gradient) in gradients.as_mut().iter_mut().enumerate() {
                    let dy: [&[f32]; M] =
                        buffers.each_ref().map(|buffer| &buffer.gradients.as_ref()[axis][part.clone()]);
                    for (i, (dx, &x)) in gradient.iter_mut().zip(values.iter()).enumerate() {
                        *dx = combine.slope(x, y.map(|y| y[i]), *dx, dy.map(|dy| dy[i]));
                    }
                }
            }
            for (i, x) in values.iter_mut().enumerate() {
                *x = combine.combined(*x, y.map(|y| y[i]));
            }
        }
    }
}
