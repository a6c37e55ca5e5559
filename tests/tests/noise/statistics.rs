//! The tabulated statistics of each noise against a new measurement, sums normalized by them, and
//! tightness of ranges.

use asperity_noise::{
    Fbm, FbmSpectrum, Field, GaussianNoise, IntegerHash, Lattice, Noise, Normalization, Perlin,
    PerlinClassic, Point, Rotation, Simplex, ValueCatmullRom, ValueGradient, ValueNoise, WhiteNoise,
    glam::{Vec2, Vec3, Vec4},
};
use asperity_tests::{
    assert_abs_diff_eq, in_every_dimension,
    noise_any::{AnyLattice, AnyNoise, kinds, thinning, variants},
    noise_reference::Kind,
    random::Random,
};
use rayon::prelude::*;
use statrs::function::erf::erf;

const SEEDS: u32 = 3072;
const POINTS: u32 = 32;

/// A field at coordinates.
type Values<'a, const N: usize> = Box<dyn Fn([f32; N]) -> f32 + 'a>;

/// Returns values at random points of a box of 128 cells per side, one list per seed.
fn values<'a, const N: usize>(
    seeds: u32,
    field: &(dyn Fn(u32) -> Values<'a, N> + Sync + 'a),
) -> Vec<Vec<f64>> {
    lists(seeds, &|seed| {
        let (field, mut random) = (field(seed), Random(u64::from(seed) << 32 | 5));
        let mut point = || [(); N].map(|()| ((random.uniform() - 0.5) * 128.0) as f32);
        (0..POINTS).map(|_| field(point()).into()).collect()
    })
}

fn lists(seeds: u32, list: &(dyn Fn(u32) -> Vec<f64> + Sync)) -> Vec<Vec<f64>> {
    (0..seeds).into_par_iter().map(list).collect()
}

/// 5 standard errors: significance 0.001 over about 400 cases, with a margin for skewed means over
/// seeds.
const ERRORS: f64 = 5.0;

/// Asserts the mean of a function of the values. Points of one seed share cells; seeds are
/// independent.
fn assert_mean(name: &str, values: &[Vec<f64>], f: &dyn Fn(f64) -> f64, expected: f64) {
    let n = values.len() as f64;
    let mean = |list: &[f64]| list.iter().map(|&x| f(x)).sum::<f64>() / list.len() as f64;
    let means: Vec<f64> = values.iter().map(|list| mean(list)).collect();
    let average = mean_of(&means);
    let spread = means.iter().map(|x| (x - average).powi(2)).sum::<f64>() / n;
    let error = (spread / n).sqrt();
    assert_abs_diff_eq!(average, expected, epsilon = ERRORS * error, "{name}");
}

fn mean_of(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len() as f64
}

/// Asserts that the moments of a noise over these seeds are as stated, and that the range holds.
fn assert_stated<const N: usize>(name: &str, noise: &dyn AnyNoise<N>, seeds: u32) -> Vec<Vec<f64>> {
    let values = values(seeds, &|seed| Box::new(move |p| noise.value(p, seed)));
    assert_mean(&format!("{name}: mean"), &values, &|x| x, 0.0);
    let variance = f64::from(noise.standard_deviation()).powi(2);
    assert_mean(&format!("{name}: variance"), &values, &|x| x * x, variance);
    for (power, expected) in (1..).zip(noise.absolute_moments()) {
        let what = format!("{name}: absolute moment {power}");
        assert_mean(&what, &values, &|x| x.abs().powi(power), expected.into());
    }
    let largest = values.iter().flatten().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    assert!(largest <= f64::from(noise.statistics().range), "{name}: {largest}");
    values
}

/// Asserts that the first, second and fourth moment match σ and κ.
fn assert_moments(name: &str, values: &[Vec<f64>], sigma: f32, excess: f32) {
    let (sigma, excess) = (f64::from(sigma), f64::from(excess));
    assert_mean(&format!("{name}: mean"), values, &|x| x, 0.0);
    assert_mean(&format!("{name}: variance"), values, &|x| x * x, sigma * sigma);
    assert_mean(&format!("{name}: fourth moment"), values, &|x| x.powi(4), (excess + 3.0) * sigma.powi(4));
}

fn shipped<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    let seeds = SEEDS / thinning::<N>(name);
    let statistics = noise.statistics();
    let single = assert_stated(name, noise, seeds);
    let (sigma, excess) = (statistics.standard_deviation, statistics.excess_kurtosis);
    assert_moments(name, &single, sigma, excess);
    assert_abs_diff_eq!(sigma, noise.standard_deviation(), epsilon = 1e-7, "{name}");

    let cdf = statistics.cdf;
    assert!(cdf.len() % 2 == 1 && cdf[cdf.len() / 2] == 0.5, "{name}");
    assert!(cdf.windows(2).all(|knots| knots[0] <= knots[1]), "{name}");
    for (low, high) in cdf.iter().zip(cdf.iter().rev()) {
        assert_abs_diff_eq!(low + high, 1.0, epsilon = 1e-7, "{name}");
    }
    let mut sums: Vec<f64> = values(seeds, &|seed| {
        let sum = noise.octaves(Normalization::UnitVariance, Rotation::Random, seed);
        Box::new(move |p| sum.value(p, 8.0))
    })
    .concat();
    sums.sort_by(f64::total_cmp);
    let worst = cdf
        .iter()
        .enumerate()
        .map(|(k, &g)| {
            let knot = 8.0 * k as f64 / (cdf.len() - 1) as f64 - 4.0;
            let below = sums.partition_point(|&r| r < knot) as f64 / sums.len() as f64;
            (below - f64::from(g)).abs()
        })
        .fold(0.0, f64::max);
    // KS at significance 0.001/40 is 2.4/√n, 0.0077 for most, if points are independent. The
    // table's own error is 0.0004.
    let floor = 2.4 / (sums.len() as f64).sqrt() + 4e-4;
    assert!(worst < floor, "{name}: KS {worst}");
}

#[test]
fn tabulated_statistics_match_the_noise() {
    in_every_dimension!(kinds(), shipped);
}

fn follows_parameters<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    assert_stated(name, noise, SEEDS / 4 / thinning::<N>(name));
}

#[test]
fn deviations_and_ranges_follow_the_parameters() {
    in_every_dimension!(variants(), follows_parameters);
}

fn gaussian_table<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    if !name.starts_with("Gaussian") {
        return;
    }
    let cdf = noise.statistics().cdf;
    for (k, &g) in cdf.iter().enumerate() {
        let x = 8.0 * k as f64 / (cdf.len() - 1) as f64 - 4.0;
        let phi = 0.5 + 0.5 * erf(x * std::f64::consts::FRAC_1_SQRT_2);
        assert_abs_diff_eq!(f64::from(g), phi, epsilon = 1e-7, "{name}, knot {k}");
    }
}

#[test]
fn gaussian_table_is_phi() {
    in_every_dimension!(kinds(), gaussian_table);
}

#[test]
fn sums_have_the_stated_deviation_and_kurtosis() {
    for count in [0.4, 1.0, 1.25, 2.5, 8.0] {
        for normalisation in [Normalization::UnitRange, Normalization::UnitVariance] {
            let build = |seed| {
                Fbm::<_, Vec3>::new(Perlin::new(seed), FbmSpectrum::default())
                    .with_normalization(normalisation)
            };
            let sums = values(SEEDS, &|seed| {
                let sum = build(seed);
                Box::new(move |p: [f32; 3]| sum.value_with_octaves(Vec3::from_array(p), count))
            });
            let (name, sum) = (format!("{count} octaves, {normalisation:?}"), build(0).with_octaves(count));
            assert_moments(&name, &sums, sum.standard_deviation(), sum.excess_kurtosis());
        }
    }
}

/// A lattice with the words that maximize the noise at one position.
struct Best(Vec<(Vec<i32>, u32)>);

impl Best {
    fn new<const D: usize>(kind: Kind, place: [f64; D], words: &[u32]) -> Self {
        let best = |w: f64, d: [f64; D]| {
            let part = |word: &&u32| kind.part(**word, w, d);
            words.iter().max_by(|a, b| part(a).total_cmp(&part(b))).copied().unwrap_or(0)
        };
        Self(kind.parts(place).into_iter().map(|(cell, w, d)| (cell.to_vec(), best(w, d))).collect())
    }

    fn word(&self, cell: &[i32]) -> u32 {
        self.0.iter().find(|(at, _)| at == cell).map_or(0, |(_, word)| *word)
    }
}

/// Returns the position of a noise's possible maximum, by search.
fn greatest_place<const D: usize>(kind: Kind) -> [f64; D] {
    let mut random = Random(D as u64);
    let mut best = (0.0, [0.5; D]);
    for _ in 0..8000 {
        let p: [f64; D] = std::array::from_fn(|_| random.uniform() * 1.5 - 0.4);
        let value = kind.largest(p);
        if value > best.0 {
            best = (value, p);
        }
    }
    let mut reach = 0.2;
    for _ in 0..4000 {
        let p = best.1.map(|x| x + reach * (random.uniform() - 0.5));
        let value = kind.largest(p);
        if value > best.0 {
            best = (value, p);
        } else {
            reach = (reach * 0.997_f64).max(1e-5);
        }
    }
    best.1
}

/// Returns a noise divided by its range.
fn share<V: Point>(noise: &(impl Noise + Field<V>), p: V) -> f32 {
    noise.value(p) / noise.statistics(p.coordinates().as_ref().len()).range
}

/// Returns the value of a noise at its maximum position, for the best words of the lattice.
fn reached<const D: usize>(kind: Kind, words: u32, noise: &dyn Fn(AnyLattice<'_>, [f32; D]) -> f32) -> f32 {
    let place = greatest_place::<D>(kind).map(|x| f64::from(x as f32));
    let words: Vec<u32> = (0..words as i32).map(|i| IntegerHash.word([i], 1)).collect();
    let best = Best::new(kind, place, &words);
    noise(AnyLattice(&|cell, _| best.word(cell)), place.map(|x| x as f32))
}

macro_rules! assert_reached {
    ($name:literal, $kind:expr, $noise:expr, $words:literal) => {
        let reached = [
            reached($kind, $words, &|best, [x]| share(&$noise.with_lattice(best), x)),
            reached($kind, $words, &|best, p| share(&$noise.with_lattice(best), Vec2::from_array(p))),
            reached($kind, $words, &|best, p| share(&$noise.with_lattice(best), Vec3::from_array(p))),
            reached($kind, $words, &|best, p| share(&$noise.with_lattice(best), Vec4::from_array(p))),
        ];
        assert!(reached.iter().all(|x| (0.99..=1.0).contains(x)), "{}: {reached:?}", $name);
    };
}

#[test]
fn ranges_are_attained() {
    assert_reached!("white", Kind::White, WhiteNoise::new(0), 20_000);
    assert_reached!("value", Kind::Value, ValueNoise::new(0), 20_000);
    assert_reached!("value, Catmull-Rom", Kind::CatmullRom, ValueCatmullRom::new(0), 20_000);
    assert_reached!("Perlin 1985", Kind::PerlinClassic, PerlinClassic::new(0), 20_000);
    assert_reached!("Perlin 2002", Kind::Perlin, Perlin::new(0), 20_000);
    let even = ValueGradient::default();
    // Few words have both the maximum number and the best gradient.
    assert_reached!("value-gradient", Kind::ValueGradient(0.5), even, 400_000);
    let gradients = ValueGradient::default().with_weight(1.0).unwrap();
    assert_reached!("gradient part", Kind::ValueGradient(1.0), gradients, 20_000);
    assert_reached!("simplex", Kind::Simplex(0.5), Simplex::new(0), 20_000);
    let kind = Kind::Simplex(f64::from(0.6_f32));
    assert_reached!("wide simplex", kind, Simplex::new(0).with_classic_radius(), 20_000);
}

#[test]
fn gaussian_range_is_from_the_outermost_variates() {
    fn bound<const N: usize>() -> (f64, f64) {
        // In the cell's center every weight is 2⁻ⁿ and every distance ½ per axis. Values nearby are
        // not greater.
        let corners = f64::from(1_u32 << N);
        let (largest, outermost) = (6.230_2, 3.776_028);
        let sum = largest + outermost * N as f64;
        let variance = (1.0 + N as f64) / corners;
        (sum / variance.sqrt(), f64::from(GaussianNoise::default().statistics(N).range))
    }
    for (centre, range) in [bound::<1>(), bound::<2>(), bound::<3>(), bound::<4>()] {
        assert!(centre <= range && centre > 0.99 * range, "{centre} in the centre, range {range}");
    }
}
