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

/// Evaluates a field at the points of a grid whose index along the last axis is in a range.
///
/// The points have the bits of the whole grid.
pub fn slabs<const N: usize>(
    field: &dyn Jet<N>,
    grid: &Grid<At<N>>,
    slabs: std::ops::Range<usize>,
    output: Output<'_>,
) {
    let Output { mut values, mut gradients, mut hessians } = output;
    let Some(last) = N.checked_sub(1) else { return };
    if N == 1 {
        let points: Vec<At<N>> = slabs.map(|i| grid.point([i; N])).collect();
        return list(field, &points, Output { values, gradients, hessians });
    }
    let mut slab = *grid;
    let length = grid.size[..last].iter().product::<usize>();
    let whole = slabs == (0..grid.size[last]);
    let (count, height) = if whole { (1, grid.size[last]) } else { (slabs.len(), 1) };
    let length = length * height;
    slab.size[last] = height;
    for index in slabs.take(count) {
        let mut at = [0; N];
        at[last] = index;
        slab.origin.0[last] = if whole { grid.origin.0[last] } else { grid.point(at).0[last] };
        let (value, rest) = values.split_at_mut(length.min(values.len()));
        values = rest;
        if gradients.is_empty() {
            let _ = field.grid_values(&slab, value);
            continue;
        }
        let (gradient, rest) = gradients.split_at_mut(length * N);
        gradients = rest;
        if hessians.is_empty() {
            let mut lists: [Vec<f32>; N] = std::array::from_fn(|_| vec![0.0; length]);
            let _ = field.grid_samples(&slab, value, lists.each_mut().map(|list| &mut list[..]));
            for (i, gradient) in gradient.as_chunks_mut::<N>().0.iter_mut().enumerate() {
                *gradient = std::array::from_fn(|axis| lists[axis][i]);
            }
            continue;
        }
        let (hessian, rest) = hessians.split_at_mut(length * N * N);
        hessians = rest;
        let points: Vec<At<N>> = (0..length)
            .map(|mut i| {
                slab.point(std::array::from_fn(|axis| {
                    let n = slab.size[axis].max(1);
                    let index = i % n;
                    i /= n;
                    index
                }))
            })
            .collect();
        list(field, &points, Output { values: value, gradients: gradient, hessians: hessian });
    }
}
