//! Gaussian noise is N(0, 1): over space for every count of octaves, at every place of the cell, in both channels.

use asperity_noise::{
    Gaussian, GaussianOctaves, Point, Spectrum,
    glam::{Vec2, Vec3},
};
use asperity_tests::random::Random;
use rayon::prelude::*;
use statrs::function::erf::erf;

fn coordinate(random: &mut Random) -> f32 {
    ((random.uniform() - 0.5) * 256.0) as f32
}

fn point3(random: &mut Random) -> Vec3 {
    Vec3::new(coordinate(random), coordinate(random), coordinate(random))
}

fn point2(random: &mut Random) -> Vec2 {
    Vec2::new(coordinate(random), coordinate(random))
}

/// Bins of the distribution; KS is read at their edges.
const BINS: usize = 8192;
const REACH: f64 = 6.0;

/// The KS distance of a histogram over ±6 to N(0, 1).
fn ks(histogram: &[u64]) -> f64 {
    let total: u64 = histogram.iter().sum();
    let phi = |edge: usize| {
        0.5 + 0.5 * erf(REACH * (2.0 * edge as f64 / BINS as f64 - 1.0) * std::f64::consts::FRAC_1_SQRT_2)
    };
    let mut below = vec![0.0];
    for count in histogram {
        below.push(below[below.len() - 1] + *count as f64 / total as f64);
    }
    (0..=BINS).map(|edge| (below[edge] - phi(edge)).abs()).fold(0.0, f64::max)
}

fn histogram<V: Point<N>, const N: usize>(octaves: f32, seeds: u32, point: fn(&mut Random) -> V) -> Vec<u64> {
    const POINTS: u32 = 128;
    (0..seeds)
        .into_par_iter()
        .fold(
            || vec![0; BINS],
            |mut bins, seed| {
                let mut random = Random(u64::from(seed) << 32 | 7);
                let noise = GaussianOctaves::<N>::new(Spectrum::default(), seed);
                for _ in 0..POINTS {
                    for channel in noise.pair(point(&mut random), octaves) {
                        let bin = (f64::from(channel.value) / REACH + 1.0) * 0.5 * BINS as f64;
                        bins[(bin as usize).min(BINS - 1)] += 1;
                    }
                }
                bins
            },
        )
        .reduce(|| vec![0; BINS], |a, b| a.iter().zip(&b).map(|(a, b)| a + b).collect())
}

#[test]
fn every_count_of_octaves_and_every_blend_is_gaussian() {
    // 6.1 million values a case: at significance 0.001/13 the floor is 2.26/√n = 0.00091 for the plain distance.
    const SEEDS: u32 = 24_000;
    for octaves in [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 1.1, 1.25, 2.5, 2.75] {
        let distance = ks(&histogram(octaves, SEEDS, point3));
        println!("{octaves} octaves: KS {distance:.5}");
        assert!(distance <= 0.001, "{octaves} octaves: {distance}");
    }
    let distance = ks(&histogram(1.5, SEEDS, point2));
    assert!(distance <= 0.001, "2-D: {distance}");
}

/// Mean, variance, mean fourth power, and the channels' correlation and correlation of squares.
fn moments<V: Point<N> + Sync + Send, const N: usize>(place: V) -> [f64; 5] {
    const SEEDS: u32 = 400_000;
    let sums = (0..SEEDS / 1000)
        .into_par_iter()
        .map(|block| {
            let mut sums = [0.0; 5];
            for seed in block * 1000..(block + 1) * 1000 {
                let [a, b] = Gaussian::default().pair(place, seed).map(|channel| f64::from(channel.value));
                let terms =
                    [a + b, a * a + b * b, a.powi(4) + b.powi(4), 2.0 * a * b, (a * a - 1.0) * (b * b - 1.0)];
                for (sum, term) in sums.iter_mut().zip(terms) {
                    *sum += term / f64::from(2 * SEEDS);
                }
            }
            sums
        })
        .collect::<Vec<_>>();
    sums.iter().fold([0.0; 5], |total, sums| std::array::from_fn(|k| total[k] + sums[k]))
}

fn assert_standard(name: &str, [mean, variance, fourth, product, squares]: [f64; 5]) {
    // n = 800 000 values, 400 000 pairs; 4.2 standard errors for significance 0.001/40.
    let n = 800_000_f64;
    assert!(mean.abs() < 4.2 / n.sqrt(), "{name}: mean {mean}");
    assert!((variance - 1.0).abs() < 4.2 * (2.0 / n).sqrt(), "{name}: variance {variance}");
    assert!((fourth - 3.0).abs() < 4.2 * (96.0 / n).sqrt(), "{name}: fourth moment {fourth}");
    assert!(product.abs() < 4.2 * (2.0 / n).sqrt(), "{name}: correlation of the channels {product}");
    // Half the correlation of squares: the variances are 2.
    assert!(squares.abs() < 4.2 * (2.0 / n).sqrt(), "{name}: correlation of squares {squares}");
}

#[test]
fn every_place_of_the_cell_has_the_same_moments_and_independent_channels() {
    for (name, [x, y]) in [
        ("lattice point", [-3.0, 5.0]),
        ("edge centre", [-2.5, 5.0]),
        ("cell centre", [-2.5, 5.5]),
        ("anywhere", [0.8, 0.3]),
    ] {
        assert_standard(&format!("2-D {name}"), moments(Vec2::new(x, y)));
    }
    for (name, [x, y, z]) in [
        ("lattice point", [-3.0, 5.0, 0.0]),
        ("edge centre", [-2.5, 5.0, 0.0]),
        ("face centre", [-2.5, 5.5, 0.0]),
        ("cell centre", [-2.5, 5.5, 0.5]),
        ("anywhere", [0.8, 0.3, -0.9]),
    ] {
        assert_standard(&format!("3-D {name}"), moments(Vec3::new(x, y, z)));
    }
}

#[test]
fn channels_are_independent_cell_by_cell() {
    // 16 × 16 equally likely cells of both channels' signs and sizes at lattice points, where single words show.
    const SEEDS: u32 = 200_000;
    let edges = [-1.534, -1.150, -0.887, -0.674, -0.489, -0.319, -0.157, 0.0];
    let bin = |value: f32| {
        let below = edges.iter().filter(|&&edge| value >= edge).count();
        below + edges.iter().take(7).filter(|&&edge| value >= -edge).count()
    };
    let mut table = vec![[0_u32; 16]; 16];
    for seed in 0..SEEDS {
        let [a, b] = Gaussian::default().pair(Vec3::new(1.0, -2.0, 3.0), seed);
        table[bin(a.value)][bin(b.value)] += 1;
    }
    let rows: Vec<f64> = table.iter().map(|row| f64::from(row.iter().sum::<u32>())).collect();
    let columns: Vec<f64> = (0..16).map(|k| table.iter().map(|row| f64::from(row[k])).sum::<f64>()).collect();
    let mut chi_square = 0.0;
    for (row, counts) in rows.iter().zip(&table) {
        for (column, &count) in columns.iter().zip(counts) {
            let expected = row * column / f64::from(SEEDS);
            chi_square += (f64::from(count) - expected).powi(2) / expected;
        }
    }
    // The 0.999 quantile with 225 degrees of freedom.
    assert!(chi_square < 295.6, "chi square {chi_square}");
}

#[test]
fn sums_of_other_seeds_are_independent() {
    const COUNT: u32 = 200_000;
    let (mut product, mut squares) = (0.0, 0.0);
    let noises = [1, 2].map(|seed| GaussianOctaves::<3>::new(Spectrum::default(), seed));
    let mut random = Random(9);
    for _ in 0..COUNT {
        let p = point3(&mut random);
        let [a, b] = [0, 1].map(|k| f64::from(noises[k].sample(p, 2.5).value));
        product += a * b / f64::from(COUNT);
        squares += (a * a - 1.0) * (b * b - 1.0) / 2.0 / f64::from(COUNT);
    }
    // 3.5 standard errors for significance 0.001/2.
    let tolerance = 3.5 / f64::from(COUNT).sqrt();
    assert!(product.abs() < tolerance && squares.abs() < tolerance, "{product}, {squares}");
}

#[test]
fn gradients_of_sums_equal_differences() {
    let noise = GaussianOctaves::<3>::new(Spectrum::default(), 3);
    let mut random = Random(10);
    for _ in 0..2000 {
        let p = point3(&mut random) / 32.0;
        let h = 1.0 / 1024.0;
        for channel in 0..2 {
            let at = |q: Vec3| f64::from(noise.pair(q, 3.25)[channel].value);
            let gradient = noise.pair(p, 3.25)[channel].gradient.to_array();
            for (axis, got) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().zip(gradient) {
                let difference = (at(p + axis * h) - at(p - axis * h)) / (2.0 * f64::from(h));
                // The difference errs by h² z‴/6 and by rounding, 1e-6/h; worst seen 0.009.
                assert!((f64::from(got) - difference).abs() < 0.03, "at {p}: {got} and {difference}");
            }
        }
    }
}

#[test]
fn the_first_octave_is_whole_and_its_share_fades() {
    let noise = GaussianOctaves::<3>::new(Spectrum::default(), 4);
    let p = Vec3::new(0.2, 0.7, -1.3);
    assert_eq!(noise.sample(p, 1e-40), noise.sample(p, 1.0));
    assert_eq!(noise.sample(p, 0.0).value, 0.0);
    assert_eq!([0.0, 0.5, 1.0, 1.5, 2.0].map(|o| noise.share(o)), [0.0, 0.1875, 0.75, 0.796_875, 0.9375]);
    assert!(noise.share(f32::INFINITY) < 1.0);
}
