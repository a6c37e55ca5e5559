//! Every kind and sum is defined everywhere: huge points, points beyond all cells, points that are not finite.

use asperity_noise::{
    Gaussian, GaussianOctaves, Noise, Normalisation, Octaves, Perlin2002, Point, Sample, Simplex, Spectrum,
    glam::Vec3,
};
use asperity_tests::{
    noise_kinds::{Testable, Visit, every_kind, every_kind_by_permutation},
    random::Random,
};

const NOT_FINITE: [f32; 4] = [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

struct NotFinite;

impl Visit for NotFinite {
    fn visit<V: Point<N> + Sync, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        let octaves = GaussianOctaves::<N>::new(Spectrum::default(), 1);
        let sum = Octaves::<K, N>::new(noise, Spectrum::default(), Normalisation::Variance, 1);
        for bad in NOT_FINITE {
            for axis in 0..N {
                let mut p = [0.3; N];
                p[axis] = bad;
                let p = V::from_coordinates(p);
                let zero = Sample { value: 0.0, gradient: V::default() };
                assert_eq!(noise.sample(p, 1), zero, "{name} at {p:?}");
                assert_eq!(noise.value(p, 1), 0.0, "{name} at {p:?}");
                assert_eq!(sum.sample(p, 3.5), zero, "octaves of {name} at {p:?}");
                assert_eq!(octaves.pair(p, 3.5), [zero; 2], "Gaussian octaves at {p:?}");
                assert_eq!(Gaussian::default().pair(p, 1), [zero; 2], "both channels at {p:?}");
            }
        }
    }
}

#[test]
fn points_that_are_not_finite_give_zero() {
    every_kind(&mut NotFinite);
    every_kind_by_permutation(&mut NotFinite);
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

struct Huge;

impl Visit for Huge {
    fn visit<V: Point<N> + Sync, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        // Far out all five corners of a simplex can coincide, so that they add up.
        let times = if name.contains("simplex") { 5.0 } else { 1.0 };
        let range = times * Noise::<V>::statistics(&noise).range;
        let sum = Octaves::<K, N>::new(noise, Spectrum::default(), Normalisation::Range, 1);
        let octaves = GaussianOctaves::<N>::new(Spectrum::default(), 1);
        let mut random = Random(3);
        for seed in 0..200 {
            let p: [f32; N] = std::array::from_fn(|_| match random.bits() % 24 {
                k @ 0..=15 => HUGE[k as usize],
                _ => random.uniform() as f32,
            });
            let p = V::from_coordinates(p);
            let sample = noise.sample(p, seed);
            assert!(sample.value.abs() <= range, "{name} at {p:?}: {sample:?}");
            // The steepest is Gaussian noise with all variates at their greatest: 6 times its range.
            let steep = |x: f32| x.is_finite() && x.abs() < 8.0 * range;
            assert!(sample.gradient.coordinates().into_iter().all(steep), "{name} at {p:?}: {sample:?}");
            let sample = sum.sample(p, 10.0);
            assert!(sample.value.abs() <= range, "octaves of {name} at {p:?}: {sample:?}");
            for sample in octaves.pair(p, 10.0) {
                let finite = sample.gradient.coordinates().into_iter().all(f32::is_finite);
                assert!(sample.value.is_finite() && finite, "Gaussian octaves at {p:?}: {sample:?}");
            }
        }
    }
}

#[test]
fn huge_points_give_finite_samples_in_range() {
    every_kind(&mut Huge);
    every_kind_by_permutation(&mut Huge);
}

struct Wraps;

impl Visit for Wraps {
    fn visit<V: Point<N> + Sync, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        for axis in 0..N {
            let at = |x: f32, seed| {
                let mut p = [0.25; N];
                p[axis] = x;
                noise.sample(V::from_coordinates(p), seed)
            };
            let mut other = 0;
            for seed in 0..64 {
                // 2³² + 1024 is the cell 1024 again, and 2³¹ the cell −2³¹.
                assert_eq!(at(1024.0, seed), at(4_294_968_320.0, seed), "{name}, axis {axis}");
                assert_eq!(at(2_147_483_648.0, seed), at(-2_147_483_648.0, seed), "{name}, axis {axis}");
                assert_eq!(at(2_147_483_904.0, seed), at(-2_147_483_392.0, seed), "{name}, axis {axis}");
                other += u32::from(at(2_147_483_648.0, seed) != at(2_147_483_904.0, seed));
            }
            // The cells beside one another there have words of their own; simplices have corners there no longer.
            assert!(
                other > 20 || name.contains("simplex") && N > 1,
                "{name}, axis {axis}: {other} of 64 differ"
            );
        }
    }
}

#[test]
fn cells_wrap_around_at_two_to_the_thirty_first() {
    every_kind(&mut Wraps);
}

/// Statistics of gradients around a place on the first axis: mean square, and correlation of neighbours, per component.
fn gradients_around<V: Point<N>, K: Testable<V, N>, const N: usize>(
    noise: K,
    place: f32,
    step: f32,
) -> [f64; 2] {
    const COUNT: i16 = 20_000;
    let gradients: Vec<[f64; N]> = (-COUNT / 2..COUNT / 2)
        .map(|i| {
            let mut p = [3.0; N];
            p[0] = place + f32::from(i) * step;
            noise.sample(V::from_coordinates(p), 3).gradient.coordinates().map(f64::from)
        })
        .collect();
    let dot = |a: &[f64; N], b: &[f64; N]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let square = gradients.iter().map(|g| dot(g, g)).sum::<f64>() / f64::from(COUNT);
    let next = gradients.windows(2).map(|pair| dot(&pair[0], &pair[1])).sum::<f64>() / f64::from(COUNT - 1);
    [square, next / square]
}

struct Seams;

impl Visit for Seams {
    fn visit<V: Point<N> + Sync, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        if name.contains("simplex") {
            // Integers are not the lattice points of simplices, and far out their corners coincide.
            return;
        }
        // At lattice points, 256 apart, as floats are at 2³¹.
        let [square, _] = gradients_around::<V, K, N>(noise, 256.0 * 4096.0, 256.0);
        for place in [0.0, 2_147_483_648.0, -2_147_483_648.0] {
            let [here, correlation] = gradients_around::<V, K, N>(noise, place, 256.0);
            // 20,000 gradients: 5 standard errors are 3.5 %, and at most 5 % where all components but one are alike.
            assert!((here / square - 1.0).abs() < 0.05, "{name} around {place}: {here}, elsewhere {square}");
            assert!(
                correlation.abs() < 0.036,
                "{name} around {place}: neighbours correlate by {correlation}"
            );
        }
    }
}

#[test]
fn nothing_shows_at_the_origin_or_where_cells_wrap() {
    every_kind(&mut Seams);
}

#[test]
fn octaves_take_any_count_and_stay_in_range() {
    let noise = Octaves::new(Simplex::CONTINUOUS, Spectrum::default(), Normalisation::Range, 1);
    let mut random = Random(12);
    for i in 0..2000_u16 {
        let p = Vec3::from_array([(); 3].map(|()| ((random.uniform() - 0.5) * 50.0) as f32));
        let octaves = f32::from(i) / 180.0;
        assert!(noise.sample(p, octaves).value.abs() <= 1.0, "{octaves} octaves at {p}");
        for nothing in [0.0, -1.0, f32::NAN, f32::NEG_INFINITY] {
            assert_eq!(noise.sample(p, nothing), Sample::default());
        }
        assert_eq!(noise.sample(p, f32::INFINITY), noise.sample(p, 10.0));
    }
}

#[test]
fn a_lone_octave_stays_as_it_is_however_small_its_weight() {
    let p = Vec3::new(0.3, -1.7, 2.4);
    for normalisation in [Normalisation::Range, Normalisation::Variance] {
        let noise = Octaves::new(Perlin2002::default(), Spectrum::default(), normalisation, 3);
        for octaves in [1e-45, 1e-40, 1e-39, 1e-30, 3e-23, 0.5] {
            assert_eq!(noise.sample(p, octaves), noise.sample(p, 1.0), "{normalisation:?} {octaves}");
            let [lone, whole] = [octaves, 1.0].map(|o| noise.standard_deviation(o));
            assert_eq!(lone, whole, "{normalisation:?} {octaves}");
        }
    }
}
