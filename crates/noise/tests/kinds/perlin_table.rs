//! Perlin's reference implementation of 2002 compared with `PerlinTable`.

use approx::assert_abs_diff_eq;
use asperity_noise::{Field, Grid, Perlin, glam::Vec3, lattice::PerlinTable, ops::ScaleBias};

/// The reference implementation in `f64`.
fn reference(p: [f64; 3]) -> f64 {
    let cell = p.map(f64::floor);
    let mut sum = 0.0;
    for corner in 0..8 {
        let ends = [corner & 1, corner >> 1 & 1, corner >> 2];
        let table = |i: i32| i32::from(PerlinTable.index([i]));
        let [x, y, z] = core::array::from_fn(|axis| cell[axis] as i32 + ends[axis]);
        let h = table(table(table(x) + y) + z) & 15;
        let d: [f64; 3] = core::array::from_fn(|axis| p[axis] - cell[axis] - f64::from(ends[axis]));
        let weight: f64 =
            d.iter().map(|d| 1.0 - d.abs()).map(|t| t * t * t * (t * (t * 6.0 - 15.0) + 10.0)).product();
        let u = if h < 8 { d[0] } else { d[1] };
        let v = if h < 4 {
            d[1]
        } else if h == 12 || h == 14 {
            d[0]
        } else {
            d[2]
        };
        sum += weight * (if h & 1 == 0 { u } else { -u } + if h & 2 == 0 { v } else { -v });
    }
    sum
}

#[test]
#[expect(clippy::approx_constant, reason = "the point of a published value of the reference noise")]
fn perlin_table_matches_reference() {
    assert_abs_diff_eq!(reference([3.14, 42.0, 7.0]), 0.136_919_958_784, epsilon = 1e-9);
    let noise = ScaleBias(Perlin::new(0).with_lattice(PerlinTable), PerlinTable::SCALE, 0.0);
    let classic = Vec3::new(3.14, 42.0, 7.0);
    let step = Vec3::new(0.04, 0.75, 0.5);
    let grid = Grid { origin: classic - step * Vec3::new(11.0, 2.0, 3.0), step, size: [32, 4, 5] };
    let (mut values, mut points) = ([0.0; 640], [Vec3::ZERO; 640]);
    for (i, p) in points.iter_mut().enumerate() {
        *p = grid.point([i % 32, i / 32 % 4, i / 128]);
    }
    points[7] = classic;
    noise.grid_values(&grid, &mut values).unwrap();
    assert_abs_diff_eq!(values[11 + 32 * (2 + 4 * 3)], 0.136_920, epsilon = 5e-6);
    let mut listed = [0.0; 640];
    noise.values(&points, &mut listed).unwrap();
    assert_abs_diff_eq!(listed[7], 0.136_919_96, epsilon = 3e-7);
    for (i, p) in points.into_iter().enumerate() {
        let expected = reference(p.to_array().map(f64::from)) as f32;
        assert_abs_diff_eq!(listed[i], expected, epsilon = 4e-7);
        assert_eq!(noise.value(p), listed[i]);
        assert_eq!(noise.sample(p).value, listed[i]);
        if i != 7 {
            assert_eq!(values[i], listed[i]);
        }
    }
    // Another seed is a translation.
    let moved = ScaleBias(Perlin::new(5).with_lattice(PerlinTable), PerlinTable::SCALE, 0.0);
    assert_abs_diff_eq!(moved.value(classic - Vec3::X * 5.0), 0.136_92, epsilon = 1e-6);
}
