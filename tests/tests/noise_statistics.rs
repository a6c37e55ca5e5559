//! The shipped statistics of each kind against a coarse measurement, and the sums normalised by them.

use asperity_noise::{Gaussian, Noise, Normalisation, Octaves, Perlin2002, Point, Spectrum, glam::Vec3};
use asperity_tests::{
    noise_kinds::{Testable, Visit, every_kind},
    random::Random,
};
use rayon::prelude::*;
use statrs::function::erf::erf;

const SEEDS: u32 = 512;
const POINTS: u32 = 256;

fn coordinate(random: &mut Random) -> f32 {
    ((random.uniform() - 0.5) * 128.0) as f32
}

fn point<V: Point<N>, const N: usize>(random: &mut Random) -> V {
    V::from_coordinates([(); N].map(|()| coordinate(random)))
}

/// Values at random points, of all seeds in order.
fn values<V: Point<N>, const N: usize>(field: impl Fn(V, u32) -> f32 + Sync) -> Vec<f64> {
    (0..SEEDS)
        .into_par_iter()
        .flat_map_iter(|seed| {
            let mut random = Random(u64::from(seed) << 32 | 5);
            (0..POINTS).map(|_| f64::from(field(point::<V, N>(&mut random), seed))).collect::<Vec<_>>()
        })
        .collect()
}

fn agree<V: Point<N>, K: Testable<V, N>, const N: usize>(name: &str, noise: K) {
    let statistics = Noise::<V>::statistics(&noise);
    let single = values(|p: V, seed| noise.value(p, seed));
    let n = single.len() as f64;
    let moment = |power: i32| single.iter().map(|x| x.powi(power)).sum::<f64>() / n;
    let (variance, fourth) = (moment(2), moment(4));
    let (sigma, excess) = (f64::from(statistics.standard_deviation), f64::from(statistics.excess_kurtosis));
    // 4.2 standard errors for significance 0.001/40, from the sample's own fourth and eighth moment.
    let variance_error = 4.2 * ((fourth - variance * variance) / n).sqrt();
    assert!((variance - sigma * sigma).abs() < variance_error, "{name}: variance {variance}, σ {sigma}");
    let fourth_error = 4.2 * ((moment(8) - fourth * fourth) / n).sqrt();
    let expected = (excess + 3.0) * sigma.powi(4);
    assert!((fourth - expected).abs() < fourth_error, "{name}: fourth moment {fourth}, expected {expected}");
    let greatest = single.iter().fold(0.0, |greatest: f64, x| greatest.max(x.abs()));
    assert!(greatest <= f64::from(statistics.range), "{name}: {greatest}");

    let cdf = statistics.cdf;
    assert!(cdf.len() % 2 == 1 && cdf[cdf.len() / 2] == 0.5, "{name}");
    assert!(cdf.windows(2).all(|knots| knots[0] <= knots[1]), "{name}");
    assert!(cdf.iter().zip(cdf.iter().rev()).all(|(low, high)| (low + high - 1.0).abs() < 1e-7), "{name}");
    let sums = values(|p: V, seed| {
        Octaves::<K, N>::new(noise, Spectrum::default(), Normalisation::Variance, seed).sample(p, 8.0).value
    });
    let worst = cdf
        .iter()
        .enumerate()
        .map(|(k, &g)| {
            let knot = 8.0 * k as f64 / (cdf.len() - 1) as f64 - 4.0;
            let below = sums.iter().filter(|&&r| r < knot).count() as f64 / n;
            (below - f64::from(g)).abs()
        })
        .fold(0.0, f64::max);
    // KS at significance 0.001/10 is 2.23/√n = 0.0062.
    assert!(worst < 2.23 / n.sqrt(), "{name}: KS {worst}");
}

struct Agree;

impl Visit for Agree {
    fn visit<V: Point<N> + Sync, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        agree::<V, K, N>(name, noise);
    }
}

#[test]
fn shipped_statistics_are_those_of_the_noise() {
    every_kind(&mut Agree);
}

#[test]
fn the_gaussian_table_is_phi() {
    let cdf = Noise::<Vec3>::statistics(&Gaussian::default()).cdf;
    for (k, &g) in cdf.iter().enumerate() {
        let x = 8.0 * k as f64 / (cdf.len() - 1) as f64 - 4.0;
        let phi = 0.5 + 0.5 * erf(x * std::f64::consts::FRAC_1_SQRT_2);
        assert!((f64::from(g) - phi).abs() < 1e-7, "knot {k}: {g} and {phi}");
    }
}

#[test]
fn sums_have_the_stated_deviation_and_kurtosis() {
    for octaves in [0.4, 1.0, 1.25, 2.5, 8.0] {
        for normalisation in [Normalisation::Range, Normalisation::Variance] {
            let build =
                |seed| Octaves::<_, 3>::new(Perlin2002::default(), Spectrum::default(), normalisation, seed);
            let sums = values(|p: Vec3, seed| build(seed).sample(p, octaves).value);
            let n = sums.len() as f64;
            let moment = |power: i32| sums.iter().map(|x| x.powi(power)).sum::<f64>() / n;
            let (variance, fourth) = (moment(2), moment(4));
            let (sigma, excess) = (
                f64::from(build(0).standard_deviation(octaves)),
                f64::from(build(0).excess_kurtosis(octaves)),
            );
            // 4.1 standard errors for significance 0.001/20.
            let error = 4.1 * ((fourth - variance * variance) / n).sqrt();
            assert!((variance - sigma * sigma).abs() < error, "{octaves} octaves: {variance}, σ {sigma}");
            let error = 4.1 * ((moment(8) - fourth * fourth) / n).sqrt();
            let expected = (excess + 3.0) * sigma.powi(4);
            assert!((fourth - expected).abs() < error, "{octaves} octaves: {fourth}, expected {expected}");
        }
    }
}
