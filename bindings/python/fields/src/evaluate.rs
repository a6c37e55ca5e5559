//! Arrays of values, gradients and Hessians.

use asperity_noise::{Grid, Sample};

use crate::jet::Jet;
use crate::point::At;

/// The number of points whose samples are buffered at once.
const BLOCK: usize = 256;

/// Where results go: values, and gradients and Hessians if wanted.
///
/// Gradients are N numbers and Hessians N² numbers a point, point by point.
#[derive(Debug, Default)]
pub struct Output<'a> {
    /// One value per point.
    pub values: &'a mut [f32],
    /// N numbers per point, or nothing.
    pub gradients: &'a mut [f32],
    /// N² numbers per point, or nothing.
    pub hessians: &'a mut [f32],
}

/// Evaluates a field at a list of points.
pub fn list<const N: usize>(field: &dyn Jet<N>, points: &[At<N>], output: Output<'_>) {
    let Output { values, gradients, hessians } = output;
    if !hessians.is_empty() {
        let gradients = gradients.as_chunks_mut::<N>().0;
        let hessians = hessians.chunks_exact_mut(N * N);
        for (((p, value), gradient), hessian) in points.iter().zip(values).zip(gradients).zip(hessians) {
            let jet = field.jet(*p);
            (*value, *gradient) = (jet.value, jet.gradient.0);
            hessian.copy_from_slice(jet.hessian.as_flattened());
        }
    } else if gradients.is_empty() {
        // The lengths agree.
        let _ = field.values(points, values);
    } else {
        let mut buffer = [Sample::<At<N>>::default(); BLOCK];
        let gradients = gradients.as_chunks_mut::<N>().0;
        for ((points, values), gradients) in
            points.chunks(BLOCK).zip(values.chunks_mut(BLOCK)).zip(gradients.chunks_mut(BLOCK))
        {
            let samples = &mut buffer[..points.len()];
            let _ = field.samples(points, samples);
            for ((sample, value), gradient) in samples.iter().zip(values).zip(gradients) {
                (*value, *gradient) = (sample.value, sample.gradient.0);
            }
        }
    }
}

/// Returns the parts of a grid that can be evaluated alone, and the number of points of each: rows, or
/// points in one dimension.
#[must_use]
pub fn parts<const N: usize>(grid: &Grid<At<N>>) -> (usize, usize) {
    if N == 1 { (grid.len(), 1) } else { (grid.rows(), grid.size[0]) }
}

/// Evaluates a field on some of the [`parts`] of a grid, with the bits of the whole grid.
pub fn grid<const N: usize>(
    field: &dyn Jet<N>,
    grid: &Grid<At<N>>,
    range: std::ops::Range<usize>,
    output: Output<'_>,
) {
    let Output { values, gradients, hessians } = output;
    if N == 1 || !hessians.is_empty() {
        let (_, each) = parts(grid);
        let points = (range.start * each..range.end * each).map(|mut i| {
            grid.point(std::array::from_fn(|axis| {
                let n = grid.size[axis].max(1);
                let index = i % n;
                i /= n;
                index
            }))
        });
        return list(field, &points.collect::<Vec<_>>(), Output { values, gradients, hessians });
    }
    // The lengths agree.
    if gradients.is_empty() {
        let _ = field.grid_row_values(grid, range, values);
        return;
    }
    let mut lists: [Vec<f32>; N] = std::array::from_fn(|_| vec![0.0; values.len()]);
    let _ = field.grid_row_samples(grid, range, values, lists.each_mut().map(|list| &mut list[..]));
    for (i, gradient) in gradients.as_chunks_mut::<N>().0.iter_mut().enumerate() {
        *gradient = std::array::from_fn(|axis| lists[axis][i]);
    }
}
