//! Rows of kinds with their own column code, compared with single points.

use asperity_noise::{
    Field, Grid, SparseConvolution, ValueCatmullRom,
    glam::Vec2,
    simd::{Batch, Level},
};

const COUNT: usize = 131;

/// Starts and steps: ascending and descending, across more columns than are kept at once, and
/// without any.
const ROWS: [(f32, f32); 8] =
    [(-3.3, 0.07), (2.9, -0.21), (-7.0, 0.5), (-7.0, 0.9), (7.5, -0.7), (7.5, -0.9), (0.4, 1.3), (1e6, 0.25)];

/// Rows have the bits of their points, at every level of the machine.
fn check(noise: &impl Field<Vec2>) {
    for level in Level::available() {
        for (x, step) in ROWS {
            // Two rows, so that there are enough points for rows to reuse work.
            let grid = Grid { origin: Vec2::new(x, 0.7), step: Vec2::new(step, 0.45), size: [COUNT, 2] };
            let mut values = [f32::NAN; 2 * COUNT];
            let mut gradients = [[f32::NAN; 2 * COUNT]; 2];
            let slopes = gradients.each_mut().map(|g| &mut g[..]);
            Batch::with_level(level).grid_samples(noise, &grid, &mut values, slopes).expect("one length");
            for i in 0..2 * COUNT {
                let expected = noise.sample(grid.point([i % COUNT, i / COUNT]));
                let got = (values[i], gradients.map(|g| g[i]));
                assert_eq!(
                    got,
                    (expected.value, expected.gradient.to_array()),
                    "{level}: {x} + {i} · {step}"
                );
            }
        }
    }
}

#[test]
fn rows_match_points() {
    for impulses in [1, 3] {
        check(&SparseConvolution::new(5).with_impulses(impulses).unwrap());
    }
    check(&ValueCatmullRom::new(5));
}
