//! Equal bits at every SIMD level, for each code path of a batch. The package `tests/lanes` tests
//! every kind and dimension.

#[expect(unreachable_pub, reason = "the package that tests every kind exports it")]
mod compare;
mod octaves;
mod shapes;

use asperity_noise::{
    Cellular, CellularOutput, Fbm, FbmSpectrum, Field, GaussianNoise, Grid, Metric, Normalization, Perlin,
    Rotation, Simplex,
    glam::{Vec2, Vec3},
    simd::{Batch, Level},
};
use compare::{far_cases, grid, grids, lengths, near_cases, points};

#[test]
fn grids_of_gradient_noise_match_scalar() {
    let field: &dyn Field<Vec2> = &GaussianNoise::new(7);
    grids("Gaussian 2-D", field, &near_cases());
    grids("Gaussian 2-D", field, &far_cases());
    lengths("Gaussian 2-D", field);
}

#[test]
fn grids_of_simplex_noise_match_scalar() {
    let field: &dyn Field<Vec2> = &Simplex::new(7);
    grids("simplex 2-D", field, &near_cases());
    grids("simplex 2-D", field, &far_cases());
    lengths("simplex 2-D", field);
}

/// A kernel that ends between two points, so that rounding alone decides which point it reaches.
#[test]
fn fine_rows_across_the_end_of_a_kernel_match_scalar() {
    for seed in 0..40 {
        let (origin, step) = (Vec2::new(-0.004_261_506_7, -2.063_24), Vec2::new(5.195_842e-9, 1e-8));
        grid("simplex 2-D", &Simplex::new(seed), &Grid { origin, step, size: [300, 1] });
    }
}

/// Rows so wide that the products of step and index are rounded by more than a step.
#[test]
fn end_of_a_wide_row_matches_scalar() {
    const WIDTH: usize = 40_000_000;
    let field: &dyn Field<Vec2> = &Simplex::new(7);
    let grid = Grid {
        origin: Vec2::new(-0.2 * (WIDTH as f32 - 10_000.0), 0.3),
        step: Vec2::new(0.2, 0.1),
        size: [WIDTH, 1],
    };
    let mut values = vec![0.0; WIDTH];
    Batch::with_level(Level::Scalar).grid_values(field, &grid, &mut values).unwrap();
    for (i, value) in values.iter().enumerate().skip(WIDTH - 20_000) {
        let p = grid.point([i, 0]);
        assert_eq!(value.to_bits(), field.value(p).to_bits(), "point {i}, {p}");
    }
}

#[test]
fn grids_in_3d_match_scalar() {
    grids("Perlin 2002 3-D", &Perlin::new(7) as &dyn Field<Vec3>, &near_cases());
}

#[test]
fn grids_of_cellular_noise_match_scalar() {
    for basis in [CellularOutput::F1, CellularOutput::F2MinusF1, CellularOutput::Cell] {
        for metric in [Metric::Euclidean, Metric::Manhattan, Metric::Chebyshev] {
            let noise = Cellular::new(7).with_output(basis).with_metric(metric);
            let name = format!("{basis:?} {metric:?} 2-D");
            grids(&name, &noise as &dyn Field<Vec2>, &near_cases()[..3]);
            // Four feature points are equally near everywhere on these grids.
            let squares = noise.with_jitter(0.0).unwrap();
            for step in [0.25, -0.25, 1.0] {
                let grid_here =
                    Grid { origin: Vec2::new(-3.0, -2.0), step: Vec2::new(step, 0.5), size: [300, 9] };
                grid(&name, &squares as &dyn Field<Vec2>, &grid_here);
            }
        }
    }
    let field: &dyn Field<Vec2> = &Cellular::new(7).with_output(CellularOutput::F2);
    grids("F2 2-D", field, &near_cases());
    grids("F2 2-D", field, &far_cases());
    lengths("F2 2-D", field);
    points("F2 2-D", field, 4001);
}

#[test]
fn points_of_simplex_noise_match_scalar() {
    for count in (0..20).chain([4001]) {
        points("simplex 2-D", &Simplex::new(7) as &dyn Field<Vec2>, count);
    }
}

#[test]
fn aligned_sums_match_scalar() {
    let sum = Fbm::<_, Vec2>::new(Simplex::new(3), FbmSpectrum::default()).with_octaves(3.4);
    let sum = sum.with_normalization(Normalization::UnitRange).with_rotation(Rotation::Aligned);
    let field: &dyn Field<Vec2> = &sum;
    grids("octaves 2-D", field, &near_cases()[..4]);
    grids("octaves 2-D", field, &far_cases());
}

#[test]
fn fields_use_the_best_level() {
    let field = Simplex::new(7);
    let grid = Grid { origin: Vec2::new(-3.0, 0.7), step: Vec2::new(0.13, 1.0), size: [300, 2] };
    let (mut values, mut forced) = (vec![0.0; 600], vec![0.0; 600]);
    field.grid_values(&grid, &mut values).unwrap();
    for level in Level::available() {
        Batch::with_level(level).grid_values(&field, &grid, &mut forced).unwrap();
        assert_eq!(values, forced, "{level}");
    }
    assert_eq!(Batch::default().level(), Level::best());
    let error = field.grid_values(&grid, &mut values[1..]).unwrap_err();
    assert_eq!(error.to_string(), "`values` must have 600 elements, got 599");
}

/// Parts of strips, rows and slices, and more rows than there are.
#[test]
fn rows_have_the_bits_of_the_grid() {
    let sum = Fbm::<_, Vec3>::new(Simplex::new(3), FbmSpectrum::default());
    let fields: [&dyn Field<Vec3>; 2] = [&sum, &Perlin::new(7)];
    let grid =
        Grid { origin: Vec3::new(-3.0, 0.7, 9.0), step: Vec3::new(0.03, -0.1, 0.2), size: [600, 5, 4] };
    let lists = |count| [(); 4].map(|()| vec![f32::NAN; count]);
    for field in fields {
        let [mut values, mut x, mut y, mut z] = lists(grid.len());
        field.grid_samples(&grid, &mut values, [&mut x, &mut y, &mut z]).unwrap();
        for rows in [0..20, 0..1, 3..11, 19..20, 7..7, 18..30, 25..30] {
            let part = 600 * rows.start.min(20)..600 * rows.end.min(20);
            let [mut alone, ..] = lists(part.len());
            field.grid_row_values(&grid, rows.clone(), &mut alone).unwrap();
            assert_eq!(alone, values[part.clone()]);
            let mut got = lists(part.len());
            let [v, gx, gy, gz] = &mut got;
            field.grid_row_samples(&grid, rows, v, [gx, gy, gz]).unwrap();
            assert_eq!(got, [&values, &x, &y, &z].map(|list| list[part.clone()].to_vec()));
        }
    }
    let error = fields[0].grid_row_values(&grid, 18..30, &mut [0.0; 600]).unwrap_err();
    assert_eq!(error.to_string(), "`values` must have 1200 elements, got 600");
}

#[test]
fn unavailable_level_has_the_same_bits() {
    let (noise, p) = (Simplex::new(1), [0.3, 1.7, -2.4].map(Vec2::splat));
    for level in [Level::Scalar, Level::Sse2, Level::Avx512, Level::Neon, Level::Wasm128] {
        let mut values = [0.0; 3];
        Batch::with_level(level).values(&noise, &p, &mut values).unwrap();
        assert_eq!(values, p.map(|x| noise.value(x)), "{level}");
    }
}
