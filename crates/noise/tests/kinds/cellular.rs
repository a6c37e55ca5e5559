//! Cellular noise: settings, points that are not finite, gradients, ranges and moments.

use approx::assert_abs_diff_eq;
use asperity_core::SplitMix64;
use asperity_noise::{
    Cellular, CellularOutput, Fbm, FbmSpectrum, Field, Metric, NoiseError, Point,
    glam::{Vec2, Vec3, Vec4},
    ops::Unit,
};

const BASES: [CellularOutput; 4] =
    [CellularOutput::F1, CellularOutput::F2, CellularOutput::F2MinusF1, CellularOutput::Cell];
const METRICS: [Metric; 3] = [Metric::Euclidean, Metric::Manhattan, Metric::Chebyshev];

fn every_noise() -> impl Iterator<Item = Cellular> {
    let noises = BASES.into_iter().flat_map(|basis| METRICS.map(|metric| (basis, metric)));
    noises.map(|(basis, metric)| Cellular::default().with_output(basis).with_metric(metric))
}

#[test]
fn cellular_rejects_invalid_jitter() {
    for jitter in [0.0, -0.0, 0.5, 1.0] {
        assert_abs_diff_eq!(Cellular::default().with_jitter(jitter).unwrap().jitter(), jitter);
    }
    for jitter in [-1e-9, 1.000_001, f32::INFINITY, f32::NEG_INFINITY] {
        let error = NoiseError::OutOfRange { parameter: "jitter", value: jitter, min: 0.0, max: 1.0 };
        assert_eq!(Cellular::default().with_jitter(jitter), Err(error));
    }
    assert!(Cellular::default().with_jitter(f32::NAN).is_err());
}

#[test]
fn cellular_at_far_and_nonfinite_points() {
    for noise in every_noise() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let sample = noise.sample(Vec3::new(0.5, bad, 0.0));
            assert_eq!((sample.value, sample.gradient), (0.0, Vec3::ZERO), "{noise:?}");
        }
        let [low, high] = Field::<Vec4>::range(&noise);
        for far in [1e7, -3e9, 1e30, f32::MAX, 1e-30, -1e-40] {
            let sample = noise.sample(Vec4::new(far, -far, 0.3, far));
            assert!(
                (low..=high).contains(&sample.value) && sample.gradient.is_finite(),
                "{noise:?} at {far}"
            );
        }
    }
}

#[test]
fn cellular_gradient_has_length_1_in_the_dual_norm() {
    for i in 0..200_u8 {
        let p = Vec4::new(0.37, -0.91, 0.53, 0.29) * f32::from(i);
        let noise = Cellular::new(u32::from(i));
        let slopes = |metric| noise.with_metric(metric).sample(p).gradient;
        assert_abs_diff_eq!(slopes(Metric::Euclidean).length(), 1.0, epsilon = 1e-6);
        assert_eq!(slopes(Metric::Manhattan).abs(), Vec4::ONE);
        assert_eq!(slopes(Metric::Chebyshev).abs().element_sum(), 1.0);
    }
}

#[test]
fn cellular_at_feature_points() {
    let squares = Cellular::new(3).with_jitter(0.0).unwrap();
    for metric in METRICS {
        let sample = squares.with_metric(metric).sample(Vec3::new(2.5, -0.5, 0.5));
        assert_eq!((sample.value, sample.gradient), (0.0, Vec3::ZERO));
    }
    // Of two equally near feature points on a border the lower cell is used.
    assert_eq!(squares.sample(Vec2::new(3.0, 0.5)).gradient, Vec2::X);
    let diagonal = squares.with_metric(Metric::Chebyshev).sample(Vec2::new(0.75, 0.25));
    assert_eq!(diagonal.gradient, Vec2::X);
}

/// The largest distances, for feature points in the corners of their cells.
#[test]
fn cellular_range_is_the_supremum() {
    let range = |metric, basis, jitter| {
        let noise = Cellular::default().with_metric(metric).with_output(basis).with_jitter(jitter).unwrap();
        [
            Field::<f32>::range(&noise)[1],
            Field::<Vec2>::range(&noise)[1],
            Field::<Vec3>::range(&noise)[1],
            Field::<Vec4>::range(&noise)[1],
        ]
    };
    let close = |got: [f32; 4], expected: [f32; 4]| {
        for (got, expected) in got.into_iter().zip(expected) {
            assert_abs_diff_eq!(got, expected, epsilon = 2e-5);
        }
    };
    let root = f32::sqrt;
    close(range(Metric::Euclidean, CellularOutput::F1, 1.0), [1.0, root(2.0), root(3.0), 2.0]);
    close(range(Metric::Manhattan, CellularOutput::F1, 1.0), [1.0, 2.0, 3.0, 4.0]);
    close(range(Metric::Chebyshev, CellularOutput::F1, 1.0), [1.0; 4]);
    close(range(Metric::Euclidean, CellularOutput::F2, 1.0), [1.5, root(2.5), root(3.0), 2.0]);
    close(range(Metric::Manhattan, CellularOutput::F2MinusF1, 1.0), [1.5, 2.0, 3.0, 4.0]);
    close(range(Metric::Chebyshev, CellularOutput::F2, 1.0), [1.5; 4]);
    close(range(Metric::Euclidean, CellularOutput::F1, 0.0), [0.5, root(0.5), root(0.75), 1.0]);
    close(range(Metric::Chebyshev, CellularOutput::F2, 0.0), [1.0; 4]);
}

/// Mean, deviation and higher moments over `COUNT` points, one seed each.
fn measure<V: Point<Coordinates = [f32; N]>, const N: usize>(noise: &Cellular) -> [f64; 4] {
    const COUNT: u32 = 20_000;
    let mut sums = [0.0; 4];
    let mut counter = 0;
    for seed in 0..COUNT {
        let p = V::from_axes(|_| {
            counter += 1;
            (SplitMix64::nth(counter) >> 40) as f32 / 131_072.0 - 64.0
        });
        let value = f64::from(noise.with_seed(seed).value(p));
        let powers = [value, value * value, value * value * value, value * value * value * value];
        for (sum, power) in sums.iter_mut().zip(powers) {
            *sum += power;
        }
    }
    let [mean, square, third, fourth] = sums.map(|sum| sum / f64::from(COUNT));
    [mean, (square - mean * mean).sqrt(), third, fourth]
}

#[test]
fn cellular_moments_at_any_jitter() {
    fn compare<V: Point<Coordinates = [f32; N]>, const N: usize>(noise: &Cellular) {
        let measured = measure::<V, N>(noise);
        let moments = Field::<V>::moments(noise).unwrap();
        let [_, _, third, fourth] = moments.absolute;
        let shipped = [moments.mean, moments.standard_deviation, third, fourth];
        // Standard errors over 20,000 points are at most 0.007 σ, 0.7 % of σ, and 1.2 and 2 % of
        // the higher moments; five of them for 108 comparisons.
        let sigma = measured[1];
        let tolerances = [0.036 * sigma, 0.036 * sigma, 0.06 * measured[2], 0.1 * measured[3]];
        for (k, tolerance) in tolerances.into_iter().enumerate() {
            let (shipped, measured) = (f64::from(shipped[k]), measured[k]);
            let apart = (shipped - measured).abs();
            assert!(apart < tolerance, "{noise:?} {N}-D, {k}: {shipped}, {measured}");
        }
    }
    for (i, noise) in every_noise().take(9).enumerate() {
        let noise = noise.with_jitter([1.0, 0.875, 0.4][i % 3]).unwrap();
        compare::<f32, 1>(&noise);
        compare::<Vec2, 2>(&noise);
        compare::<Vec3, 3>(&noise);
    }
}

#[test]
fn cellular_octaves_and_unit() {
    let noise = Cellular::new(1).with_metric(Metric::Manhattan);
    let (mut sum, mut square) = (0.0, 0.0);
    for seed in 0..4000_u16 {
        let octaves = Fbm::<_, Vec2>::new(noise.with_seed(u32::from(seed)), FbmSpectrum::default());
        let value = octaves.value(Vec2::new(0.3, -0.7) * f32::from(seed % 89));
        sum += value;
        square += value * value;
    }
    // Standard errors 0.016 and, as the kurtosis is about 3.2, 0.023.
    assert_abs_diff_eq!(sum / 4000.0, 0.0, epsilon = 0.08);
    assert_abs_diff_eq!(square / 4000.0, 1.0, epsilon = 0.12);
    let p = Vec2::new(0.3, 4.1);
    assert_abs_diff_eq!(Unit(noise).value(p), 0.5 * noise.value(p), epsilon = 1e-5);
}
