//! The shipped statistics of each kind against a fresh measurement, the sums normalised by them, and how tight ranges are.

use asperity_noise::{
    Batch, Field, Gaussian, IntegerHash, Lattice, Noise, Normalisation, Octaves, Perlin1985, Perlin2002,
    Point, Seeded, Simplex, Spectrum, edge_gradient, glam::Vec3, unit_gradient,
};
use asperity_tests::{
    noise_kinds::{Testable, Visit, every_kind},
    noise_reference::Kind,
    random::Random,
};
use rayon::prelude::*;
use statrs::function::erf::erf;

const SEEDS: u32 = 512;
const POINTS: usize = 256;

/// Values at random points of a box of 128 cells a side, of all seeds in order.
fn values<F: Field<N>, const N: usize>(field: impl Fn(u32) -> F + Sync) -> Vec<f64> {
    (0..SEEDS)
        .into_par_iter()
        .flat_map_iter(|seed| {
            let mut random = Random(u64::from(seed) << 32 | 5);
            let points: [Vec<f32>; N] = std::array::from_fn(|_| {
                (0..POINTS).map(|_| ((random.uniform() - 0.5) * 128.0) as f32).collect()
            });
            let mut values = vec![0.0; POINTS];
            Batch::new()
                .fill_points(&field(seed), points.each_ref().map(Vec::as_slice), &mut values)
                .expect("lists of one length");
            values.into_iter().map(f64::from).collect::<Vec<_>>()
        })
        .collect()
}

/// 4.4 standard errors for significance 0.001/100.
const ERRORS: f64 = 4.4;

fn mean(values: &[f64], power: i32) -> f64 {
    values.iter().map(|x| x.powi(power)).sum::<f64>() / values.len() as f64
}

/// Second and fourth moment are those of σ and κ, up to errors by the sample's own fourth and eighth moment.
fn assert_moments(name: &str, values: &[f64], sigma: f32, excess: f32) {
    let n = values.len() as f64;
    let (sigma, excess) = (f64::from(sigma), f64::from(excess));
    let [variance, fourth, eighth] = [2, 4, 8].map(|power| mean(values, power));
    let average = mean(values, 1);
    // Points of one seed share cells, four points to a cell in 1-D: the mean's error is a little larger than √(variance/n).
    assert!(average.abs() < 1.6 * ERRORS * (variance / n).sqrt(), "{name}: mean {average}");
    let error = 1.2 * ERRORS * ((fourth - variance * variance) / n).sqrt();
    assert!((variance - sigma * sigma).abs() < error, "{name}: variance {variance}, σ {sigma}");
    let error = 1.2 * ERRORS * ((eighth - fourth * fourth) / n).sqrt();
    let expected = (excess + 3.0) * sigma.powi(4);
    assert!((fourth - expected).abs() < error, "{name}: fourth moment {fourth}, expected {expected}");
}

struct Shipped;

impl Visit for Shipped {
    fn visit<V: Point<N> + Sync, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        let statistics = Noise::<V>::statistics(&noise);
        let single = values::<_, N>(|seed| Seeded(noise, seed));
        assert_moments(name, &single, statistics.standard_deviation, statistics.excess_kurtosis);
        let greatest = single.iter().fold(0.0, |greatest: f64, x| greatest.max(x.abs()));
        assert!(greatest <= f64::from(statistics.range), "{name}: {greatest}");

        let cdf = statistics.cdf;
        assert!(cdf.len() % 2 == 1 && cdf[cdf.len() / 2] == 0.5, "{name}");
        assert!(cdf.windows(2).all(|knots| knots[0] <= knots[1]), "{name}");
        assert!(
            cdf.iter().zip(cdf.iter().rev()).all(|(low, high)| (low + high - 1.0).abs() < 1e-7),
            "{name}"
        );
        let mut sums: Vec<f64> = (0..SEEDS)
            .into_par_iter()
            .flat_map_iter(|seed| {
                let sum = Octaves::<K, N>::new(noise, Spectrum::default(), Normalisation::Variance, seed);
                let mut random = Random(u64::from(seed) << 32 | 6);
                let points: [Vec<f32>; N] = std::array::from_fn(|_| {
                    (0..POINTS).map(|_| ((random.uniform() - 0.5) * 128.0) as f32).collect()
                });
                let mut values = vec![0.0; POINTS];
                let lists = points.each_ref().map(Vec::as_slice);
                Batch::new().fill_points(&sum.first(8.0), lists, &mut values).expect("lists of one length");
                values.into_iter().map(f64::from).collect::<Vec<_>>()
            })
            .collect();
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
        // KS at significance 0.001/20 is 2.3/√n = 0.0064 for independent points, the table's own error 0.0004 beside it.
        let floor = 2.3 / (sums.len() as f64).sqrt() + 4e-4;
        assert!(worst < floor, "{name}: KS {worst}");
    }
}

#[test]
fn shipped_statistics_are_those_of_the_noise() {
    every_kind(&mut Shipped);
}

struct GaussianTable;

impl Visit for GaussianTable {
    fn visit<V: Point<N> + Sync, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        if !name.starts_with("Gaussian") {
            return;
        }
        let cdf = Noise::<V>::statistics(&noise).cdf;
        for (k, &g) in cdf.iter().enumerate() {
            let x = 8.0 * k as f64 / (cdf.len() - 1) as f64 - 4.0;
            let phi = 0.5 + 0.5 * erf(x * std::f64::consts::FRAC_1_SQRT_2);
            assert!((f64::from(g) - phi).abs() < 1e-7, "{name}, knot {k}: {g} and {phi}");
        }
    }
}

#[test]
fn the_gaussian_table_is_phi() {
    every_kind(&mut GaussianTable);
}

#[test]
fn sums_have_the_stated_deviation_and_kurtosis() {
    for count in [0.4, 1.0, 1.25, 2.5, 8.0] {
        for normalisation in [Normalisation::Range, Normalisation::Variance] {
            let build =
                |seed| Octaves::<_, 3>::new(Perlin2002::default(), Spectrum::default(), normalisation, seed);
            let sums: Vec<f64> = (0..SEEDS)
                .into_par_iter()
                .flat_map_iter(|seed| {
                    let (sum, mut random) = (build(seed), Random(u64::from(seed) << 32 | 7));
                    let mut at = || ((random.uniform() - 0.5) * 128.0) as f32;
                    (0..POINTS)
                        .map(|_| f64::from(sum.value(Vec3::new(at(), at(), at()), count)))
                        .collect::<Vec<_>>()
                })
                .collect();
            let name = format!("{count} octaves, {normalisation:?}");
            assert_moments(&name, &sums, build(0).standard_deviation(count), build(0).excess_kurtosis(count));
        }
    }
}

/// A lattice that gives each point the word that makes the noise greatest at one place.
struct Best<const D: usize> {
    place: [f64; D],
    simplicial: bool,
    gradients: Vec<(u32, [f64; D])>,
}

impl<const D: usize> Best<D> {
    fn new(kind: Kind, place: [f64; D]) -> Self {
        let draw = if kind == Kind::Perlin1985 { unit_gradient::<D> } else { edge_gradient::<D> };
        let words =
            (0..if kind == Kind::Perlin1985 { 20_000 } else { 400 }).map(|i| IntegerHash.word([i], 1));
        let gradients = words.map(|word| (word, draw(word).map(f64::from))).collect();
        Self { place, simplicial: matches!(kind, Kind::Simplex(_)), gradients }
    }
}

impl<const D: usize> Lattice for Best<D> {
    fn word<const N: usize>(&self, cell: [i32; N], _: u32) -> u32 {
        let n = N as f64;
        let unskew = if self.simplicial && N > 1 { (1.0 - 1.0 / (n + 1.0).sqrt()) / n } else { 0.0 };
        let back = cell.iter().map(|&c| f64::from(c)).sum::<f64>() * unskew;
        let rise = |gradient: &[f64; D]| -> f64 {
            (0..D).map(|k| gradient[k] * (self.place[k] - (f64::from(cell[k]) - back))).sum()
        };
        let greatest = self.gradients.iter().max_by(|a, b| rise(&a.1).total_cmp(&rise(&b.1)));
        greatest.map_or(0, |(word, _)| *word)
    }
}

/// The place where a kind can be greatest, by search.
fn greatest_place<const D: usize>(kind: Kind) -> [f64; D] {
    let mut random = Random(D as u64);
    let mut best = (0.0, [0.5; D]);
    for _ in 0..8000 {
        let p: [f64; D] = std::array::from_fn(|_| random.uniform() * 1.5 - 0.4);
        let value = kind.greatest(p);
        if value > best.0 {
            best = (value, p);
        }
    }
    let mut reach = 0.2;
    for _ in 0..4000 {
        let p = best.1.map(|x| x + reach * (random.uniform() - 0.5));
        let value = kind.greatest(p);
        if value > best.0 {
            best = (value, p);
        } else {
            reach = (reach * 0.997_f64).max(1e-5);
        }
    }
    best.1
}

/// The noise at its greatest place, if the words of the lattice happen to be the best ones.
fn reached<V: Point<D>, K: Noise<V>, const D: usize>(kind: Kind, noise: impl Fn(Best<D>) -> K) -> f32 {
    let place = greatest_place::<D>(kind).map(|x| f64::from(x as f32));
    noise(Best::new(kind, place)).value(V::from_coordinates(place.map(|x| x as f32)), 1)
}

#[test]
fn ranges_are_reached() {
    use asperity_noise::glam::{Vec2, Vec4};
    macro_rules! every {
        ($name:literal, $kind:expr, $noise:expr) => {
            let reached = [
                reached::<f32, _, 1>($kind, $noise),
                reached::<Vec2, _, 2>($kind, $noise),
                reached::<Vec3, _, 3>($kind, $noise),
                reached::<Vec4, _, 4>($kind, $noise),
            ];
            assert!(reached.iter().all(|x| (0.99..=1.0).contains(x)), "{}: {reached:?}", $name);
        };
    }
    every!("Perlin 1985", Kind::Perlin1985, Perlin1985);
    every!("Perlin 2002", Kind::Perlin2002, Perlin2002);
    every!("simplex", Kind::Simplex(0.5), |best| Simplex::CONTINUOUS.with_lattice(best));
    every!("wide simplex", Kind::Simplex(f64::from(0.6_f32)), |best| Simplex::WIDE.with_lattice(best));
}

#[test]
fn the_gaussian_range_is_that_of_the_outermost_variates() {
    fn bound<V: Point<N>, const N: usize>() -> (f64, f64)
    where
        Gaussian: Noise<V>,
    {
        // In the cell's centre every weight is 2⁻ⁿ and every distance ½ an axis; near it are no greater values.
        let corners = f64::from(1_u32 << N);
        let outermost = 3.776_028;
        let sum = outermost * (std::f64::consts::SQRT_2 + N as f64);
        let variance = (1.0 + N as f64) / corners;
        (sum / variance.sqrt(), f64::from(Noise::<V>::statistics(&Gaussian::default()).range))
    }
    use asperity_noise::glam::{Vec2, Vec4};
    for (centre, range) in [bound::<f32, 1>(), bound::<Vec2, 2>(), bound::<Vec3, 3>(), bound::<Vec4, 4>()] {
        assert!(centre <= range && centre > 0.99 * range, "{centre} in the centre, range {range}");
    }
}
