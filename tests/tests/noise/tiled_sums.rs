//! Periodic octave sums of every noise: edges, interior, and SIMD grids.

use asperity_noise::{
    Cellular, Fbm, FbmSpectrum, Field, GaussianNoise, NoiseError, Perlin, PerlinClassic, RidgedMultifractal,
    Sample, Simplex, SparseConvolution, Turbulence, ValueCatmullRom, ValueGradient, ValueNoise, WhiteNoise,
    glam::{Vec2, Vec3},
    simd::{Batch, Level},
};
use asperity_tests::assert_abs_diff_eq;
use rayon::prelude::*;

fn spectrum(octaves: u32) -> FbmSpectrum {
    // All octaves are as strong as the first. With a gain of 0.7 the few edges of coarse
    // white-noise cells count as much as the many edges of fine cells.
    FbmSpectrum::new(2.0, 1.0, octaves).expect("in range")
}

/// Returns the autocorrelation of periodic samples at a shift along the axis with this stride and
/// number of points.
fn correlation(samples: &[f32], stride: usize, size: usize, shift: usize) -> f64 {
    let (mut product, mut square) = (0.0, 0.0);
    for (i, &sample) in samples.iter().enumerate() {
        let along = i / stride % size;
        let other = samples[i - along * stride + (along + shift) % size * stride];
        product += f64::from(sample) * f64::from(other);
        square += f64::from(sample).powi(2);
    }
    product / square
}

/// Asserts that details finer than two steps do not repeat at an eighth, a quarter and half of the
/// tile, along each axis.
fn assert_no_repeats(name: &str, samples: &[f32], axes: u32, size: usize) {
    // The second differences along all axes, with mean 0.
    let strides: Vec<usize> = (0..axes).map(|axis| size.pow(axis)).collect();
    let at = |i: usize, stride: usize, step: usize| {
        let along = i / stride % size;
        samples[i - along * stride + (along + step) % size * stride]
    };
    let high: Vec<f32> = (0..samples.len())
        .map(|i| {
            strides.iter().map(|&stride| at(i, stride, 1) + at(i, stride, size - 1) - 2.0 * samples[i]).sum()
        })
        .collect();
    for stride in strides {
        for share in [8, 4, 2] {
            let correlation = correlation(&high, stride, size, size / share);
            // The finest octave has about 16 000 cells: 6 standard errors. With one period for all
            // octaves it was 0.98.
            assert_abs_diff_eq!(correlation, 0.0, epsilon = 0.05, "{name}, 1/{share} of the tile");
        }
    }
}

const PERIOD: f32 = 8.0;

/// Asserts a sum's tile in the plane: bit-identical edges, and no repetition inside.
fn plane(name: &str, sum: &(impl Field<Vec2> + Sync)) {
    const SIZE: usize = 384;
    let step = PERIOD / SIZE as f32;
    let samples: Vec<f32> = (0..SIZE * SIZE)
        .into_par_iter()
        .map(|i| sum.value(Vec2::new((i % SIZE) as f32 + 0.4, (i / SIZE) as f32 + 0.3) * step))
        .collect();
    assert_no_repeats(name, &samples, 2, SIZE);
    for i in 0..100_u8 {
        let t = 0.079 * f32::from(i);
        for (low, axis) in [(Vec2::new(0.0, t), Vec2::X), (Vec2::new(t, 0.0), Vec2::Y)] {
            let [here, there]: [Sample<Vec2>; 2] = [low, low + PERIOD * axis].map(|p| sum.sample(p));
            assert_eq!(here, there, "{name} at {low}");
        }
        // Also inside, where both points are exact.
        let p = Vec2::new(f32::from(i) / 16.0, 2.5 - f32::from(i) / 32.0);
        assert_eq!(sum.sample(p), sum.sample(p + Vec2::new(-3.0 * PERIOD, 1000.0 * PERIOD)), "{name} at {p}");
    }
}

#[test]
fn tiled_sums_in_2d_are_periodic_without_inner_repeats() {
    macro_rules! plane {
        ($name:literal, $noise:expr) => {
            let sum = Fbm::new($noise, spectrum(5)).tiled([8, 8]);
            plane($name, &sum.expect("periods that lacunarity keeps"));
        };
    }
    plane!("white", WhiteNoise::new(3));
    plane!("value", ValueNoise::new(3));
    plane!("Catmull-Rom", ValueCatmullRom::new(3));
    plane!("Perlin 1985", PerlinClassic::new(3));
    plane!("Perlin 2002", Perlin::new(3));
    plane!("value-gradient", ValueGradient::new(3));
    plane!("sparse", SparseConvolution::new(3));
    plane!("Gaussian", GaussianNoise::new(3));
    plane!("cellular", Cellular::new(3));
}

#[test]
fn tiled_simplex_sums_in_1d() {
    const LINE: usize = 1 << 16;
    let sum = Fbm::<_, f32>::new(Simplex::new(3), spectrum(5)).tiled([1024]).expect("a period");
    let samples: Vec<f32> = (0..LINE).map(|i| sum.value((i as f32 + 0.4) / 64.0)).collect();
    assert_no_repeats("simplex, line", &samples, 1, LINE);
    assert_eq!(sum.sample(0.0), sum.sample(1024.0));
}

#[test]
fn tiled_simplex_sums_in_3d() {
    const SIZE: usize = 96;
    let sum = Fbm::new(Simplex::new(3), spectrum(3)).tiled([6; 3]).expect("multiples of three");
    let place = |i: usize| Vec3::new((i % SIZE) as f32, (i / SIZE % SIZE) as f32, (i / SIZE / SIZE) as f32);
    let samples: Vec<f32> = (0..SIZE.pow(3)).into_par_iter().map(|i| sum.value(place(i) / 16.0)).collect();
    assert_no_repeats("simplex, space", &samples, 3, SIZE);
    for i in 0..100_u8 {
        let p = Vec3::new(0.0, 0.059 * f32::from(i), 0.031 * f32::from(i));
        assert_eq!(sum.sample(p), sum.sample(p + 6.0 * Vec3::X), "{p}");
    }
}

/// Asserts that grids and lists have the bits of single points, across tiles and at every SIMD
/// level.
fn assert_same_bits(name: &str, field: &dyn Field<Vec2>) {
    const WIDTH: usize = 61;
    let grid =
        asperity_noise::Grid { origin: Vec2::new(-9.3, 6.7), step: Vec2::new(0.37, 0.21), size: [WIDTH, 20] };
    let points: Vec<Vec2> = (0..grid.len()).map(|i| grid.point([i % WIDTH, i / WIDTH])).collect();
    let single: Vec<Sample<Vec2>> = points.iter().map(|&p| field.sample(p)).collect();
    for level in Level::available() {
        let batch = Batch::with_level(level);
        let [mut values, mut dx, mut dy] = [(); 3].map(|()| vec![0.0; grid.len()]);
        batch.grid_samples(field, &grid, &mut values, [&mut dx, &mut dy]).expect("one number per point");
        let mut listed = vec![Sample::default(); grid.len()];
        batch.samples(field, &points, &mut listed).expect("one sample per point");
        for (i, sample) in single.iter().enumerate() {
            let of_grid = Sample { value: values[i], gradient: Vec2::new(dx[i], dy[i]) };
            assert_eq!([*sample; 2], [of_grid, listed[i]], "{name} at {}, {level}", points[i]);
            assert_eq!(field.value(points[i]), sample.value, "{name}");
        }
    }
}

#[test]
fn grids_of_tiled_sums_have_the_bits_of_single_points() {
    let sum = Fbm::new(Perlin::new(5), spectrum(4)).tiled([8, 3]).expect("periods");
    assert_same_bits("signed", &sum);
    assert_same_bits("turbulence", &sum.with_shape(Turbulence).with_octaves(2.5));
    assert_same_bits("ridged", &RidgedMultifractal::from_fbm(sum, 2.0).expect("a feedback"));
}

#[test]
fn fractional_periods_are_an_error() {
    let sum = |period, lacunarity, octaves| {
        let spectrum = FbmSpectrum::new(lacunarity, 0.5, octaves).expect("in range");
        Fbm::<_, Vec2>::new(Perlin::new(5), spectrum).tiled([period; 2]).map(|_| ())
    };
    assert_eq!(sum(7, 2.0, 10), Ok(()));
    assert_eq!(sum(7, 3.0, 10), Ok(()));
    assert_eq!(sum(8, 1.5, 4), Ok(()));
    let refused = NoiseError::OctavePeriod { axis: 0, period: 8, lacunarity: 1.5, octave: 4 };
    assert_eq!(sum(8, 1.5, 5), Err(refused));
    assert_eq!(
        refused.to_string(),
        "`periods[0]` · `lacunarity`^4 must be an integer up to 2097152, got 8 · 1.5^4"
    );
    assert!(matches!(sum(1 << 21, 2.0, 2), Err(NoiseError::OctavePeriod { octave: 1, .. })));
}
