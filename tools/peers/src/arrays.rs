//! Evaluation forms for libraries that fill whole arrays.

use std::hint::black_box;

use crate::{
    inputs::{DIFFERENCE, samples},
    measure::Contender,
    row::Row,
};

/// Returns a library at a SIMD level. `fill` writes the values at the samples, shifted by a vector.
/// For gradients it is called once more per axis, for finite differences.
pub(crate) fn contender<const N: usize>(
    library: &'static str,
    level: &'static str,
    row: Row,
    mut fill: impl FnMut([f32; N], &mut Vec<f32>) + 'static,
) -> Contender {
    let samples = samples::<N>(row.order);
    let mut arrays = vec![vec![0.0; samples]; if row.gradients { N + 1 } else { 1 }];
    let pass = Box::new(move || {
        differences(&mut arrays, &mut fill);
        black_box(&mut arrays);
    });
    Contender { library, level, samples, pass }
}

/// Computes the values, then their differences along each axis with an array.
fn differences<const N: usize>(arrays: &mut [Vec<f32>], fill: &mut impl FnMut([f32; N], &mut Vec<f32>)) {
    let Some((values, slopes)) = arrays.split_first_mut() else { return };
    fill([0.0; N], values);
    for (axis, slope) in slopes.iter_mut().enumerate() {
        fill(std::array::from_fn(|of| if of == axis { DIFFERENCE } else { 0.0 }), slope);
        for (slope, value) in slope.iter_mut().zip(&*values) {
            *slope = (*slope - value) * (1.0 / DIFFERENCE);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradient_of_a_plane() {
        let mut arrays = vec![vec![0.0; 3]; 3];
        differences(&mut arrays, &mut |[x, y], values| {
            for (i, value) in values.iter_mut().enumerate() {
                *value = i as f32 + 2.0 * x - 3.0 * y;
            }
        });
        assert_eq!(arrays, [[0.0, 1.0, 2.0], [2.0; 3], [-3.0; 3]]);
    }
}
