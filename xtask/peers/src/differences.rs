//! Gradients from a library that fills whole arrays of values: one more pass per axis, then differences.

use std::hint::black_box;

use crate::inputs::DIFFERENCE;

/// Values and their differences along N axes.
pub(crate) struct Differences<const N: usize> {
    values: Vec<f32>,
    slopes: [Vec<f32>; N],
}

impl<const N: usize> Differences<N> {
    pub(crate) fn new(samples: usize) -> Self {
        Self { values: vec![0.0; samples], slopes: std::array::from_fn(|_| vec![0.0; samples]) }
    }

    /// `fill` writes the values; with an axis, those one difference further along it.
    pub(crate) fn pass(&mut self, mut fill: impl FnMut(Option<usize>, &mut Vec<f32>)) {
        fill(None, &mut self.values);
        for (axis, slope) in self.slopes.iter_mut().enumerate() {
            fill(Some(axis), slope);
            for (slope, value) in slope.iter_mut().zip(&self.values) {
                *slope = (*slope - value) * (1.0 / DIFFERENCE);
            }
        }
        black_box(self);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_has_its_own_slopes() {
        let mut differences = Differences::<2>::new(3);
        differences.pass(|axis, values| {
            for (i, value) in values.iter_mut().enumerate() {
                let step = |of| if axis == Some(of) { DIFFERENCE } else { 0.0 };
                *value = i as f32 + 2.0 * step(0) - 3.0 * step(1);
            }
        });
        assert_eq!(differences.values, [0.0, 1.0, 2.0]);
        assert_eq!(differences.slopes, [[2.0; 3], [-3.0; 3]]);
    }
}
