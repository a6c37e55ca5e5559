//! Sums of octaves, values and gradients, against an `f64` sum of the reference's octaves and its
//! differences.

use std::cell::RefCell;

use asperity_noise::{
    Fbm, FbmSpectrum, Field, GaussianFbm, GaussianNoise, Normalization, Point, Rotation, Sample,
    glam::{Vec2, Vec3, Vec4},
};
use asperity_tests::{
    in_every_dimension,
    noise_any::{AnyNoise, At, Coordinates, at, kinds},
    noise_reference::{Kind, difference},
    random::Random,
};

/// A noise that returns 0 and records position and seed of every octave evaluation.
struct Notes<'a, const N: usize>(&'a RefCell<Vec<(u32, [f32; N])>>, u32);

impl<const N: usize> Field<Coordinates<N>> for Notes<'_, N> {
    fn sample(&self, Coordinates(p): Coordinates<N>) -> Sample<Coordinates<N>> {
        self.0.borrow_mut().push((self.1, p));
        Sample::default()
    }

    fn with_octave_seed(&self, seed: u32) -> Option<Self> {
        Some(Self(self.0, seed))
    }
}

/// An octave's seed and map into its lattice, determined from outside.
struct Octave<const N: usize> {
    seed: u32,
    matrix: [[f64; N]; N],
    offset: [f64; N],
}

/// Returns the octaves of a sum, with exact matrices.
fn octaves<const N: usize>(
    spectrum: FbmSpectrum,
    rotation: Rotation,
    seed: u32,
    count: usize,
) -> Vec<Octave<N>> {
    let notes = RefCell::new(Vec::new());
    let sum = Fbm::new(Notes(&notes, 0), spectrum)
        .with_seed(seed)
        .with_normalization(Normalization::UnitRange)
        .with_rotation(rotation);
    noted_octaves(count, &|p| {
        notes.borrow_mut().clear();
        let _ = sum.value_with_octaves(Coordinates(p), count as f32);
        notes.take()
    })
}

/// Returns octaves from the recorded seeds and positions for a point.
fn noted_octaves<const N: usize>(
    count: usize,
    noted: &dyn Fn([f32; N]) -> Vec<(u32, [f32; N])>,
) -> Vec<Octave<N>> {
    let along = |axis: usize, x: f32| {
        let mut p = [0.0; N];
        p[axis] = x;
        noted(p)
    };
    let zero = noted([0.0; N]);
    assert_eq!(zero.len(), count);
    let entry = |octave: usize, row: usize, column: usize| {
        let offset = zero[octave].1[row];
        let near = along(column, 1.0)[octave].1[row] - offset;
        if near == 0.0 {
            return 0.0;
        }
        // At 2²⁴ and above floats are even, and the offset, which is below 1, is rounded away.
        let scale = (24.0 - f64::from(near.abs()).log2().floor()).exp2();
        f64::from(along(column, scale as f32)[octave].1[row]) / scale
    };
    (0..count)
        .map(|octave| Octave {
            seed: zero[octave].0,
            matrix: std::array::from_fn(|row| std::array::from_fn(|column| entry(octave, row, column))),
            offset: zero[octave].1.map(f64::from),
        })
        .collect()
}

/// Returns amplitudes including the weight of the last octave, and the divisor of their sum.
fn amplitudes(
    spectrum: &FbmSpectrum,
    count: f32,
    normalisation: Normalization,
    sigma: f64,
) -> (Vec<f64>, f64) {
    let amplitudes: Vec<f64> = (0..count.ceil() as u32)
        .map(|i| f64::from(spectrum.amplitude(i)) * f64::from(spectrum.weight(count, i)))
        .collect();
    let norm = match normalisation {
        Normalization::UnitRange => amplitudes.iter().sum::<f64>(),
        Normalization::UnitVariance => sigma * amplitudes.iter().map(|a| a * a).sum::<f64>().sqrt(),
    };
    (amplitudes, norm)
}

/// Returns the maximum errors of value and gradient of a sum. Gradients are relative to the
/// maximum.
fn errors<const N: usize>(
    octaves: &[Octave<N>],
    (amplitudes, norm): &(Vec<f64>, f64),
    kind: Kind,
    sample: &dyn Fn([f32; N]) -> At<N>,
) -> [f64; 2] {
    let value = |p: [f64; N]| {
        let terms = octaves.iter().zip(amplitudes).map(|(octave, amplitude)| {
            let q: [f64; N] = std::array::from_fn(|row| {
                octave.offset[row] + octave.matrix[row].iter().zip(p).map(|(m, x)| m * x).sum::<f64>()
            });
            amplitude * kind.scales()[N - 1] * kind.value(q, octave.seed)
        });
        terms.sum::<f64>() / norm
    };
    let mut random = Random(N as u64);
    let (mut worst, mut largest) = ([0.0_f64; 2], 0.0_f64);
    for _ in 0..400 {
        let p: [f32; N] = std::array::from_fn(|_| ((random.uniform() - 0.5) * 4.0) as f32);
        let (wide, sample) = (p.map(f64::from), sample(p));
        worst[0] = worst[0].max((f64::from(sample.value) - value(wide)).abs());
        for (axis, got) in sample.gradient.into_iter().enumerate() {
            let expected = difference(1e-6, |step| {
                let mut q = wide;
                q[axis] += step;
                value(q)
            });
            largest = largest.max(expected.abs());
            worst[1] = worst[1].max((f64::from(got) - expected).abs());
        }
    }
    [worst[0], worst[1] / largest]
}

/// Coordinates of the fifth octave have errors of 1e-6, i.e. 2⁻²⁴ of 22·2. The slope of a term
/// there is at most 0.6, and the slope of its gradient 30, where gradients reach 4. Maximum seen
/// 6e-6 and 1e-5.
const TOLERANCE: [f64; 2] = [2e-5, 4e-5];

fn assert_close(name: &str, [value, gradient]: [f64; 2]) {
    // The corners of simplices are also rounded, by |p|·2⁻²².
    let times = if name.starts_with("simplex") { 8.0 } else { 1.0 };
    assert!(
        value < times * TOLERANCE[0] && gradient < times * TOLERANCE[1],
        "{name}: {value:e}, {gradient:e}"
    );
}

/// Checks the sums of a noise with one of these names, and counts them.
fn sums<const N: usize>(
    name: &str,
    noise: &dyn AnyNoise<N>,
    (named, compared): (&[(&str, Kind)], &mut usize),
) {
    let Some(&(_, kind)) = named.iter().find(|(kind, _)| name == format!("{kind} {N}-D")) else { return };
    let spectrum = FbmSpectrum::default();
    let sigma = f64::from(noise.statistics().standard_deviation);
    for rotation in [Rotation::Random, Rotation::Aligned] {
        for normalisation in [Normalization::UnitRange, Normalization::UnitVariance] {
            for (seed, count) in [(3, 4.5), (4, 1.0)] {
                let sum = noise.octaves(normalisation, rotation, seed);
                let octaves = octaves::<N>(spectrum, rotation, seed, f32::ceil(count) as usize);
                let amplitudes = amplitudes(&spectrum, count, normalisation, sigma);
                let worst = errors(&octaves, &amplitudes, kind, &|p| sum.sample(p, count));
                assert_close(&format!("{name} {rotation:?} {normalisation:?}"), worst);
                *compared += 1;
            }
        }
    }
}

/// Checks the sums of noises in 1 to 4 dimensions, with two rotations, normalizations and seeds
/// each.
fn assert_sums(named: &[(&str, Kind)]) {
    let mut compared = 0;
    in_every_dimension!(kinds(), sums, (named, &mut compared));
    assert_eq!(compared, named.len() * 4 * 8);
}

#[test]
fn sums_of_gradient_noise_match_the_reference() {
    assert_sums(&[("Perlin 1985", Kind::PerlinClassic), ("Perlin 2002", Kind::Perlin)]);
}

#[test]
fn sums_of_simplex_and_gaussian_noise_match_the_reference() {
    assert_sums(&[("simplex", Kind::Simplex(0.5)), ("Gaussian", Kind::Gaussian(0))]);
}

fn gaussian_sum<V: Point<Coordinates = [f32; N]>, const N: usize>() {
    let spectrum = FbmSpectrum::default();
    for (seed, count) in [(3, 4.5), (4, 1.0), (5, 2.25)] {
        let sum = GaussianFbm::<V>::new(GaussianNoise::new(seed), spectrum);
        let octaves = octaves::<N>(spectrum, Rotation::Random, seed, f32::ceil(count) as usize);
        let amplitudes = amplitudes(&spectrum, count, Normalization::UnitVariance, 1.0);
        let worst = errors(&octaves, &amplitudes, Kind::Gaussian(0), &|p| {
            at(sum.sample_with_octaves(V::from_coordinates(p), count))
        });
        assert_close(&format!("Gaussian octaves {N}-D"), worst);
        let worst = errors(&octaves, &amplitudes, Kind::Gaussian(1), &|p| {
            at(sum.pair_with_octaves(V::from_coordinates(p), count)[1])
        });
        assert_close(&format!("Gaussian octaves {N}-D, second channel"), worst);
    }
}

#[test]
fn both_channels_of_gaussian_sums_match_the_reference() {
    gaussian_sum::<f32, 1>();
    gaussian_sum::<Vec2, 2>();
    gaussian_sum::<Vec3, 3>();
    gaussian_sum::<Vec4, 4>();
}
