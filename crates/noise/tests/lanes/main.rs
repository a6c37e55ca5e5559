//! The same bits at every SIMD level, for the ways that a batch can take; `tests/lanes` has every kind and dimension.

#[expect(unreachable_pub, reason = "the package that has every kind exports it")]
mod compare;
mod shapes;

use asperity_noise::{
    Batch, Field, Grid, Level, Noise, Normalisation, Octaves, Perlin2002, Rotation, Seeded, Simplex,
    Spectrum, Value,
    glam::{Vec2, Vec3},
};
use compare::{far_cases, grid, grids, lengths, near_cases, points};

#[test]
fn grids_of_gradient_noise_have_the_scalar_bits() {
    let noise = Perlin2002::default();
    let (field, sample) = (Seeded(noise, 7), |p: Vec2| noise.sample(p, 7));
    grids("Perlin 2002 2-D", &field, &sample, &near_cases());
    grids("Perlin 2002 2-D", &field, &sample, &far_cases());
    lengths("Perlin 2002 2-D", &field, &sample);
}

#[test]
fn grids_of_simplex_noise_have_the_scalar_bits() {
    let noise = Simplex::CONTINUOUS;
    let (field, sample) = (Seeded(noise, 7), |p: Vec2| noise.sample(p, 7));
    grids("simplex 2-D", &field, &sample, &near_cases());
    grids("simplex 2-D", &field, &sample, &far_cases());
    lengths("simplex 2-D", &field, &sample);
}

/// Where a kernel ends between two points, rounding is all that tells which of them it reaches.
#[test]
fn fine_rows_across_the_end_of_a_kernel_have_the_scalar_bits() {
    for seed in 0..40 {
        let field = Seeded(Simplex::CONTINUOUS, seed);
        let (origin, step) = (Vec2::new(-0.004_261_506_7, -2.063_24), Vec2::new(5.195_842e-9, 1e-8));
        grid("simplex 2-D", &field, &|p: Vec2| field.sample(p), &Grid { origin, step, size: [300, 1] });
    }
}

#[test]
fn grids_in_space_have_the_scalar_bits() {
    let noise = Value::default();
    grids("value 3-D", &Seeded(noise, 7), &|p: Vec3| noise.sample(p, 7), &near_cases());
}

#[test]
fn points_of_simplex_noise_have_the_scalar_bits() {
    let noise = Simplex::CONTINUOUS;
    for count in (0..20).chain([4001]) {
        points("simplex 3-D", &Seeded(noise, 7), &|p: Vec3| noise.sample(p, 7), count);
    }
}

#[test]
fn aligned_sums_have_the_scalar_bits() {
    let sum = Octaves::<_, 2>::new(Perlin2002::default(), Spectrum::default(), Normalisation::Range, 3);
    let sum = sum.with_rotation(Rotation::Aligned);
    let (field, sample) = (sum.first(3.4), |p: Vec2| sum.sample(p, 3.4));
    grids("octaves 2-D", &field, &sample, &near_cases()[..4]);
    grids("octaves 2-D", &field, &sample, &far_cases());
}

#[test]
fn a_row_is_that_of_a_grid() {
    let field = Seeded(Perlin2002::default(), 7);
    for level in Level::available() {
        let (mut row, mut values) = ([0.0; 300], [0.0; 300]);
        let (origin, step) = (Vec2::new(-3.0, 0.7), Vec2::new(0.13, 1.0));
        Batch::with_level(level).fill_row(&field, origin, step.x, &mut row);
        Batch::with_level(level)
            .fill_grid(&field, &Grid { origin, step, size: [300, 1] }, &mut values)
            .unwrap();
        assert_eq!(row, values, "{level}");
    }
}

#[test]
fn an_unavailable_level_falls_back_to_the_same_bits() {
    let (noise, p) = (Perlin2002::default(), [0.3, 1.7, -2.4]);
    for level in [Level::Scalar, Level::Sse2, Level::Avx512, Level::Neon, Level::Wasm128] {
        let mut values = [0.0; 3];
        Batch::with_level(level).fill_points(&Seeded(noise, 1), [&p], &mut values).unwrap();
        let expected = p.map(|x| noise.value(x, 1));
        assert_eq!(values, expected, "{level}");
    }
}
