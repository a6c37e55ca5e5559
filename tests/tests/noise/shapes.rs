//! Turbulence and other shapes: against their octaves, differences, measured means, and clamping.

use asperity_noise::{
    Billow, Fbm, FbmSpectrum, Field, Normalization, Perlin, Plasma, Point, Ridged, RidgedMultifractal,
    Rotation, Sample, Shape, Signed, Simplex, Turbulence,
    glam::{Vec2, Vec3},
    ops::Power,
};
use asperity_tests::{
    assert_abs_diff_eq, in_every_dimension,
    noise_any::{AnyField, AnyNoise, Coordinates, kinds, thinning},
    random::Random,
};

/// Returns coordinates within ±8 with twelve fractional bits.
fn point<V: Point<Coordinates = [f32; N]>, const N: usize>(random: &mut Random) -> V {
    V::from_coordinates([(); N].map(|()| ((random.uniform() - 0.5) * 65_536.0).round() as f32 / 4096.0))
}

/// An independent implementation of φ and φ′.
type Phi = fn(f64) -> [f64; 2];

/// Returns value and gradient of octave i at a point, from the signed sums of i and i + 1 octaves.
fn octave<V: Point<Coordinates = [f32; N]>, K: Field<V>, const N: usize>(
    signed: &Fbm<K, V>,
    p: V,
    i: u8,
) -> (f64, [f64; N]) {
    let spectrum = signed.spectrum();
    let sum = |count: u8| {
        let sample = signed.sample_with_octaves(p, f32::from(count));
        let norm = f64::from(spectrum.sum_of_amplitudes(f32::from(count)));
        let g = sample.gradient.coordinates().map(|g| norm * f64::from(g));
        (norm * f64::from(sample.value), g)
    };
    let (below, above) = (sum(i), sum(i + 1));
    let amplitude = f64::from(spectrum.amplitude(u32::from(i)));
    let slope = |axis: usize| (above.1[axis] - below.1[axis]) / amplitude;
    ((above.0 - below.0) / amplitude, std::array::from_fn(slope))
}

/// Signed octaves, or octaves of a shape.
type Signs<'a, const N: usize> = Fbm<AnyField<'a, N>, Coordinates<N>>;

/// Asserts that sums of four octaves of a shape, the last at half weight, are φ of their octaves.
fn follows<T: Shape, const N: usize>(name: &str, noise: &dyn AnyNoise<N>, shape: T, phi: Phi) {
    follows_phi(&format!("{shape:?} {name}"), noise, phi, &|signed, p| {
        signed.with_shape(shape).sample_with_octaves(p, 3.5)
    });
}

fn follows_phi<const N: usize>(
    name: &str,
    noise: &dyn AnyNoise<N>,
    phi: Phi,
    shaped: &dyn Fn(Signs<'_, N>, Coordinates<N>) -> Sample<Coordinates<N>>,
) {
    let spectrum = FbmSpectrum::default();
    let mut random = Random(11);
    // Octaves are differences of sums: a few roundings of values below twice the range and of
    // gradients below 30.
    let range = f64::from(noise.statistics().range).max(1.0);
    for rotation in [Rotation::Random, Rotation::Aligned] {
        for seed in 0..40 / thinning::<N>(name) {
            let signed = Fbm::new(AnyField(noise, 0), spectrum)
                .with_seed(seed)
                .with_normalization(Normalization::UnitRange);
            let signed = signed.with_rotation(rotation);
            let p: Coordinates<N> = point(&mut random);
            let octaves: Vec<_> = (0..4).map(|i| octave(&signed, p, i)).collect();
            if octaves.iter().any(|(n, _)| n.abs() < 1e-5) {
                continue;
            }
            let (mut value, mut gradient, mut norm) = (0.0, [0.0; N], 0.0);
            for (i, (n, g)) in octaves.into_iter().enumerate() {
                let [f, slope] = phi(n);
                let amplitude = 0.5_f64.powi(i as i32) * if i == 3 { 0.5 } else { 1.0 };
                value += amplitude * f;
                norm += amplitude;
                for axis in 0..N {
                    gradient[axis] += amplitude * slope * g[axis];
                }
            }
            let sample = shaped(signed, p);
            let error = (f64::from(sample.value) - value / norm).abs();
            assert!(error < 4e-6 * range, "{name} at {p:?}: {error:e}");
            for (got, slope) in sample.gradient.coordinates().into_iter().zip(gradient) {
                let (got, slope) = (f64::from(got), slope / norm);
                assert_abs_diff_eq!(got, slope, epsilon = 1e-4 * range, "{name} at {p:?}");
            }
        }
    }
}

fn every_shape_follows<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    follows(name, noise, Signed, |n| [n, 1.0]);
    follows(name, noise, Turbulence, |n| [n.abs(), n.signum()]);
    follows(name, noise, Plasma, |n| [1.0 - n.abs(), -n.signum()]);
    follows(name, noise, Billow, |n| [2.0 * n.abs() - 1.0, 2.0 * n.signum()]);
    follows(name, noise, Ridged, |n| [(1.0 - n.abs()).powi(2), -2.0 * (1.0 - n.abs()) * n.signum()]);
}

#[test]
fn shaped_sums_are_sums_of_shaped_octaves() {
    in_every_dimension!(kinds(), every_shape_follows);
}

/// Returns the maximum difference between a field's gradient and central differences, over points
/// away from creases.
fn by_differences<V: Point<Coordinates = [f32; N]>, F: Field<V>, const N: usize>(field: &F) -> f64 {
    const H: f32 = 1.0 / 512.0;
    let mut random = Random(5);
    let mut errors = Vec::new();
    for _ in 0..300 {
        let p: V = point(&mut random);
        let sample = field.sample(p);
        for axis in 0..N {
            let at = |steps: f32| {
                let mut q = p.coordinates();
                q[axis] += steps * H;
                f64::from(field.value(V::from_coordinates(q)))
            };
            let [ahead, here, behind] = [1.0, 0.0, -1.0].map(at);
            let [rise, fall] = [ahead - here, here - behind].map(|x| x / f64::from(H));
            // A crease between the points shows as different slopes on its sides.
            if (rise - fall).abs() < 0.4 {
                let got = f64::from(sample.gradient.coordinates()[axis]);
                errors.push((got - 0.5 * (rise + fall)).abs());
            }
        }
    }
    assert!(errors.len() > 150 * N, "{} slopes of {}", errors.len(), 300 * N);
    errors.sort_by(f64::total_cmp);
    // Some creases are slight enough to pass. Nine of ten points have none.
    errors[errors.len() * 9 / 10]
}

#[test]
fn gradients_are_limits_of_differences() {
    // Rounding of values, 4e-7, over H = 1/512, plus H²/6 times third derivatives, which reach 3000
    // for the third octave. Maximum seen 1.6e-3, for ridged simplex noise.
    fn check<V: Point<Coordinates = [f32; N]>, F: Field<V>, const N: usize>(name: &str, field: &F) {
        let error = by_differences::<V, F, N>(field);
        println!("{name}: {error:.1e}");
        assert!(error < 3e-3, "{name}: {error:e}");
    }
    let spectrum = FbmSpectrum::CLOUD;
    let octaves = Fbm::<_, Vec2>::new(Simplex::new(1), spectrum).with_normalization(Normalization::UnitRange);
    check::<Vec2, _, 2>("turbulence", &octaves.with_shape(Turbulence).with_octaves(2.5));
    check::<Vec2, _, 2>(
        "clamped turbulence",
        &octaves.with_shape(Turbulence).with_octaves(2.5).band_limited(0.2),
    );
    check::<Vec2, _, 2>("ridged", &octaves.with_shape(Ridged).with_octaves(2.5));
    let octaves = Fbm::<_, Vec3>::new(Perlin::new(1), spectrum).with_normalization(Normalization::UnitRange);
    check::<Vec3, _, 3>("plasma", &octaves.with_shape(Plasma).with_octaves(2.5));
    check::<Vec3, _, 3>("billow", &octaves.with_shape(Billow).with_octaves(2.5));
    check::<Vec3, _, 3>("threads", &Power(octaves.with_shape(Plasma).with_octaves(2.5), 7));
    let ridges = RidgedMultifractal::<_, Vec3>::new(Perlin::new(1), spectrum, 0.8).unwrap();
    check::<Vec3, _, 3>("ridged multifractal", &ridges.with_octaves(2.5));
}

/// Asserts that mean and deviation of a sum of three octaves are as stated, clamped or not.
fn has_moments<T: Shape, const N: usize>(name: &str, noise: &dyn AnyNoise<N>, shape: T) {
    has_stated_moments(&format!("{shape:?} {name}"), &|normalisation, seed| {
        let sum = Fbm::new(AnyField(noise, 0), FbmSpectrum::THREADS).with_seed(seed);
        let whole = sum.with_normalization(normalisation).with_shape(shape).with_octaves(3.0);
        let part = whole.band_limited(0.15);
        let values = move |p: Coordinates<N>| [whole.value(p), part.value(p)];
        ([whole.mean(), whole.standard_deviation()], Box::new(values))
    });
}

/// The stated mean and deviation of a sum, and its value at a point, unclamped and clamped.
type Stated<'a, const N: usize> = ([f32; 2], Box<dyn Fn(Coordinates<N>) -> [f32; 2] + 'a>);

fn has_stated_moments<'a, const N: usize>(name: &str, sum: &dyn Fn(Normalization, u32) -> Stated<'a, N>) {
    const SEEDS: u32 = 600;
    const POINTS: usize = 48;
    let mut random = Random(3);
    for normalisation in [Normalization::UnitRange, Normalization::UnitVariance] {
        let (mut means, mut squares, mut clamped) = (Vec::new(), Vec::new(), Vec::new());
        let mut stated = [0.0; 2];
        for seed in 0..SEEDS {
            let (moments, values) = sum(normalisation, seed);
            stated = moments.map(f64::from);
            let (mut mean, mut square, mut mean_clamped) = (0.0, 0.0, 0.0);
            for _ in 0..POINTS {
                let p: Coordinates<N> = point(&mut random);
                let [value, part] = values(p).map(f64::from);
                mean += value / POINTS as f64;
                square += (value - stated[0]).powi(2) / POINTS as f64;
                mean_clamped += part / POINTS as f64;
            }
            means.push(mean);
            squares.push(square);
            clamped.push(mean_clamped);
        }
        // 4 noises and dimensions, 5 shapes, 2 normalizations, 3 numbers: 5 standard errors
        // correspond to 7e-5 for all of them together. The stated moments have errors of a sixth of
        // these.
        let agrees = |what: &str, samples: &[f64], expected: f64| {
            let count = samples.len() as f64;
            let mean = samples.iter().sum::<f64>() / count;
            let variance = samples.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0);
            let error = (variance / count).sqrt();
            assert_abs_diff_eq!(mean, expected, epsilon = 5.0 * error, "{what} of {name}");
        };
        agrees("mean", &means, stated[0]);
        agrees("variance", &squares, stated[1] * stated[1]);
        agrees("clamped mean", &clamped, stated[0]);
    }
}

fn moments<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    let some = ["Perlin 1985 2-D", "wide simplex 3-D", "Perlin 2002 3-D", "Gaussian 1-D"];
    if some.contains(&name) {
        has_moments(name, noise, Signed);
        has_moments(name, noise, Turbulence);
        has_moments(name, noise, Plasma);
        has_moments(name, noise, Billow);
        has_moments(name, noise, Ridged);
    } else if N == 2 {
        has_moments(name, noise, Turbulence);
        has_moments(name, noise, Ridged);
    }
}

#[test]
fn sums_have_their_means_and_deviations() {
    in_every_dimension!(kinds(), moments);
}

#[test]
fn clamping_removes_the_finest_octaves_first() {
    let octaves =
        Fbm::<_, Vec2>::new(Perlin::new(2), FbmSpectrum::CLOUD).with_normalization(Normalization::UnitRange);
    let sum = octaves.with_shape(Turbulence);
    let p = Vec2::new(0.3, 5.25);
    // Frequencies 1, 2, 4: at 0.15 the third is removed entirely, the second by smoothstep(0.3) =
    // 0.15625, the first not at all.
    let parts: Vec<f64> = (0..3).map(|i| octave(&octaves, p, i).0.abs()).collect();
    let mean = f64::from(sum.with_octaves(3.0).mean());
    let expected = (parts[0] + 0.5 * (parts[1] + 0.15625 * (mean - parts[1])) + 0.25 * mean) / 1.75;
    let clamped = sum.with_octaves(3.0).band_limited(0.15).sample(p);
    assert_abs_diff_eq!(f64::from(clamped.value), expected, epsilon = 1e-6);
    // A zero footprint changes no bit. With an infinite footprint the mean remains.
    for footprint in [0.0, -1.0, f32::NAN] {
        assert_eq!(
            sum.with_octaves(3.0).band_limited(footprint).sample(p),
            sum.sample_with_octaves(p, 3.0),
            "{footprint}"
        );
    }
    let far = sum.with_octaves(3.0).band_limited(f32::INFINITY).sample(p);
    assert_abs_diff_eq!(f64::from(far.value), mean, epsilon = 1e-7);
    assert!(far.gradient == Vec2::ZERO);
    assert_eq!(octaves.with_octaves(3.0).band_limited(f32::INFINITY).value(p), 0.0);
}

#[test]
fn ranges_hold_for_every_gain() {
    let mut random = Random(9);
    for (gain, lacunarity) in [(0.5, 2.0), (1.0, 2.0), (2.7, 2.4)] {
        let spectrum = FbmSpectrum::new(lacunarity, gain, 6).unwrap();
        for seed in 0..200 {
            let sum =
                Fbm::<_, Vec2>::new(Perlin::new(seed), spectrum).with_normalization(Normalization::UnitRange);
            let p: Vec2 = point(&mut random);
            assert_abs_diff_eq!(sum.value_with_octaves(p, 5.5), 0.0, epsilon = 1.0);
            for value in [
                sum.with_shape(Turbulence).value_with_octaves(p, 5.5),
                sum.with_shape(Ridged).value_with_octaves(p, 5.5),
            ] {
                assert!((-1e-6..=1.0 + 1e-6).contains(&value), "gain {gain}: {value}");
            }
            let threads = Power(sum.with_shape(Plasma).with_octaves(4.0), 7).value(p);
            assert!((-1e-6..=1.0 + 1e-6).contains(&threads), "gain {gain}: {threads}");
        }
    }
}
