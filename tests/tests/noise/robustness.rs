//! Every noise and sum is defined everywhere: huge points, points beyond all cells, non-finite
//! points.

use asperity_noise::{
    Fbm, FbmSpectrum, GaussianFbm, GaussianNoise, Normalization, Perlin, Point, Rotation, Sample, Simplex,
    glam::{Vec2, Vec3, Vec4},
    lattice::PermutationTable,
};
use asperity_tests::{
    assert_abs_diff_eq, in_every_dimension,
    noise_any::{AnyNoise, dimensions, kinds, variants},
    random::Random,
};

/// Points with a non-finite coordinate.
fn not_finite<const N: usize>() -> impl Iterator<Item = [f32; N]> {
    (0..4 * N).map(|i| {
        let mut p = [0.3; N];
        p[i / 4] = [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY][i % 4];
        p
    })
}

fn zero_where_not_finite<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    let sum = noise.octaves(Normalization::UnitVariance, Rotation::Random, 1);
    let zero = Sample { value: 0.0, gradient: [0.0; N] };
    for p in not_finite() {
        assert_eq!(noise.sample(p, 1), zero, "{name} at {p:?}");
        assert_eq!(noise.value(p, 1), 0.0, "{name} at {p:?}");
        assert_eq!(sum.sample(p, 3.5), zero, "octaves of {name} at {p:?}");
    }
}

#[test]
fn non_finite_points_return_zero() {
    in_every_dimension!(kinds(), zero_where_not_finite);
    in_every_dimension!(variants(), zero_where_not_finite);
    let permuted = Perlin::default().with_lattice(PermutationTable::new(1));
    in_every_dimension!(dimensions("Perlin 2002 by permutation", permuted), zero_where_not_finite);
}

const HUGE: [f32; 16] = [
    8_388_607.5,
    -8_388_607.5,
    16_777_216.0,
    -16_777_218.0,
    1_073_741_824.0,
    2_147_483_520.0,
    2_147_483_648.0,
    -2_147_483_648.0,
    -2_147_483_904.0,
    4_294_967_296.0,
    9_223_372_036_854_775_808.0,
    -9_223_372_036_854_775_808.0,
    1e19,
    -1e30,
    f32::MAX,
    f32::MIN,
];

fn huge_point<const N: usize>(random: &mut Random) -> [f32; N] {
    std::array::from_fn(|_| match random.bits() % 24 {
        k @ 0..=15 => HUGE[k as usize],
        _ => random.uniform() as f32,
    })
}

fn huge<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    let range = noise.statistics().range;
    let sum = noise.octaves(Normalization::UnitRange, Rotation::Random, 1);
    let mut random = Random(3);
    for seed in 0..200 {
        let p = huge_point(&mut random);
        let sample = noise.sample(p, seed);
        assert_abs_diff_eq!(sample.value, 0.0, epsilon = range, "{name} at {p:?}: {sample:?}");
        // The steepest is Gaussian noise with all variates at their maximum: 6 times its range.
        let steep = |x: f32| x.is_finite() && x.abs() < 8.0 * range;
        assert!(sample.gradient.into_iter().all(steep), "{name} at {p:?}: {sample:?}");
        let sample = sum.sample(p, 10.0);
        assert_abs_diff_eq!(sample.value, 0.0, epsilon = range, "octaves of {name} at {p:?}: {sample:?}");
    }
}

#[test]
fn huge_points_return_finite_samples_in_range() {
    in_every_dimension!(kinds(), huge);
    in_every_dimension!(variants(), huge);
    let permuted = Perlin::default().with_lattice(PermutationTable::new(1));
    in_every_dimension!(dimensions("Perlin 2002 by permutation", permuted), huge);
}

#[test]
fn both_channels_are_defined_everywhere() {
    fn defined<V: Point<Coordinates = [f32; N]>, const N: usize>() {
        let noise = GaussianNoise::new(1);
        let octaves = GaussianFbm::<V>::new(noise, FbmSpectrum::default());
        for p in not_finite().map(V::from_coordinates) {
            let zero = Sample { value: 0.0, gradient: V::default() };
            assert_eq!([octaves.pair_with_octaves(p, 3.5), noise.pair(p)], [[zero; 2]; 2], "{p:?}");
        }
        let mut random = Random(4);
        for _ in 0..200 {
            let p = V::from_coordinates(huge_point(&mut random));
            for sample in octaves.pair_with_octaves(p, 10.0) {
                let finite = sample.gradient.coordinates().into_iter().all(f32::is_finite);
                assert!(sample.value.is_finite() && finite, "{p:?}: {sample:?}");
            }
        }
    }
    defined::<f32, 1>();
    defined::<Vec2, 2>();
    defined::<Vec3, 3>();
    defined::<Vec4, 4>();
}

fn wraps<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    if name.contains("simplex") {
        return;
    }
    for axis in 0..N {
        let at = |x: f32, seed| {
            let mut p = [0.25; N];
            p[axis] = x;
            noise.sample(p, seed)
        };
        let mut other = 0;
        for seed in 0..64 {
            // 2³² + 1024 is cell 1024 again, and 2³¹ is cell −2³¹.
            assert_eq!(at(1024.0, seed), at(4_294_968_320.0, seed), "{name}, axis {axis}");
            assert_eq!(at(2_147_483_648.0, seed), at(-2_147_483_648.0, seed), "{name}, axis {axis}");
            assert_eq!(at(2_147_483_904.0, seed), at(-2_147_483_392.0, seed), "{name}, axis {axis}");
            other += u32::from(at(2_147_483_648.0, seed) != at(2_147_483_904.0, seed));
        }
        // Adjacent cells have different words there.
        assert!(other > 20, "{name}, axis {axis}: {other} of 64 differ");
    }
}

#[test]
fn cells_wrap_around_at_2_31() {
    in_every_dimension!(kinds(), wraps);
}

/// Simplex noise is in range up to Σ |xᵢ| = 2²² except for the rounding of its corners, and 0
/// beyond.
fn fades_out<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    if !name.contains("simplex") {
        return;
    }
    let mut random = Random(7);
    let mut not_zero = 0;
    for seed in 0..20_000 {
        // Up to 2²² in total, at every order of magnitude from 2¹⁶.
        let reach = 2.0_f64.powf(16.0 + 6.0 * random.uniform()) / N as f64;
        let near: [f32; N] = std::array::from_fn(|_| ((random.uniform() * 2.0 - 1.0) * reach * 0.999) as f32);
        let sample = noise.sample(near, seed);
        let range = 1.0 + near.iter().map(|x| x.abs()).sum::<f32>() / 4_194_304.0;
        assert_abs_diff_eq!(sample.value, 0.0, epsilon = range, "{name} at {near:?}: {sample:?}");
        not_zero += u32::from(sample.value != 0.0);
        let mut far = near;
        far[seed as usize % N] = 4_194_304.0;
        assert_eq!(noise.sample(far, seed).value, 0.0, "{name} at {far:?}");
        assert_eq!(noise.value(far, seed), 0.0, "{name} at {far:?}");
    }
    assert!(not_zero > 15_000, "{name}: {not_zero}");
}

#[test]
fn simplex_noise_is_in_range_until_it_ends() {
    in_every_dimension!(kinds(), fades_out);
}

/// Returns value and gradient as one vector.
fn vector<const N: usize>(noise: &dyn AnyNoise<N>, x: f32) -> [f64; 5] {
    let mut p = [3.0; N];
    p[0] = x;
    let sample = noise.sample(p, 3);
    let mut vector = [f64::from(sample.value), 0.0, 0.0, 0.0, 0.0];
    for (to, slope) in vector[1..].iter_mut().zip(sample.gradient) {
        *to = slope.into();
    }
    vector
}

/// Returns statistics of values and gradients around a position on the first axis: mean square, its
/// standard error, and correlation of neighbors in standard errors.
fn around<const N: usize>(noise: &dyn AnyNoise<N>, place: f32, step: f32) -> [f64; 3] {
    const COUNT: i16 = 20_000;
    let vectors: Vec<_> =
        (-COUNT / 2..COUNT / 2).map(|i| vector(noise, place + f32::from(i) * step)).collect();
    let dot = |a: &[f64; 5], b: &[f64; 5]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mean = |numbers: &mut dyn Iterator<Item = f64>| numbers.sum::<f64>() / f64::from(COUNT);
    let square = mean(&mut vectors.iter().map(|v| dot(v, v)));
    let spread = mean(&mut vectors.iter().map(|v| (dot(v, v) - square).powi(2)));
    let product = |pair: &[[f64; 5]]| dot(&pair[0], &pair[1]);
    let next = mean(&mut vectors.windows(2).map(product));
    let products = mean(&mut vectors.windows(2).map(|pair| product(pair).powi(2)));
    [square, (spread / f64::from(COUNT)).sqrt(), next / (products / f64::from(COUNT)).sqrt()]
}

fn seams<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    // At lattice points 256 apart, like floats at 2³¹; elsewhere 2²⁶. Integers are not the lattice
    // points of simplices, and far out simplex noise is 0, so there the neighbors are 3.3 apart and
    // share no corner.
    let (step, far, places) = match name.contains("simplex") {
        true => (3.3125, 131_072.0, &[0.0][..]),
        false => (256.0, 67_108_864.0, &[0.0, 2_147_483_648.0, -2_147_483_648.0][..]),
    };
    let [elsewhere, error, _] = around(noise, far, step);
    for &place in places {
        let [here, there, correlation] = around(noise, place, step);
        // 4.6 standard errors: significance 0.001 over about 200 cases.
        let error = 4.6 * error.hypot(there);
        assert_abs_diff_eq!(here, elsewhere, epsilon = error, "{name} around {place}");
        assert_abs_diff_eq!(correlation, 0.0, epsilon = 4.6, "neighbours of {name} around {place}");
    }
}

#[test]
fn origin_and_wraparound_are_inconspicuous() {
    in_every_dimension!(kinds(), seams);
}

#[test]
fn sums_accept_any_octave_count_and_stay_in_range() {
    let noise =
        Fbm::new(Simplex::new(1), FbmSpectrum::default()).with_normalization(Normalization::UnitRange);
    let mut random = Random(12);
    for i in 0..2000_u16 {
        let p = Vec3::from_array([(); 3].map(|()| ((random.uniform() - 0.5) * 50.0) as f32));
        let octaves = f32::from(i) / 180.0;
        assert_abs_diff_eq!(
            noise.sample_with_octaves(p, octaves).value,
            0.0,
            epsilon = 1.0,
            "{octaves} at {p}"
        );
        for nothing in [0.0, -1.0, f32::NAN, f32::NEG_INFINITY] {
            assert_eq!(noise.sample_with_octaves(p, nothing), Sample::default());
        }
        assert_eq!(noise.sample_with_octaves(p, f32::INFINITY), noise.sample_with_octaves(p, 10.0));
    }
}

#[test]
fn single_octave_is_independent_of_its_weight() {
    let p = Vec3::new(0.3, -1.7, 2.4);
    for normalisation in [Normalization::UnitRange, Normalization::UnitVariance] {
        let noise = Fbm::new(Perlin::new(3), FbmSpectrum::default()).with_normalization(normalisation);
        for octaves in [1e-45, 1e-40, 1e-39, 1e-30, 3e-23, 0.5] {
            assert_eq!(
                noise.sample_with_octaves(p, octaves),
                noise.sample_with_octaves(p, 1.0),
                "{normalisation:?} {octaves}"
            );
            let [lone, whole] = [octaves, 1.0].map(|o| noise.with_octaves(o).standard_deviation());
            assert_eq!(lone, whole, "{normalisation:?} {octaves}");
        }
    }
}
