//! Gaussian noise is N(0, 1): over space for every number of octaves, at every position of the
//! cell, in both channels.

use asperity_noise::{
    FbmSpectrum, Field, GaussianFbm, GaussianNoise, Point,
    glam::{Vec2, Vec3, Vec4},
};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::histogram::Histogram;
use asperity_tests::random::Random;
use rayon::prelude::*;

/// Returns a multiple of 1/8 within ±2¹⁶, nearly always in a different cell.
fn coordinate(random: &mut Random) -> f32 {
    (random.bits() >> 44) as f32 / 8.0 - 65_536.0
}

fn point3(random: &mut Random) -> Vec3 {
    Vec3::new(coordinate(random), coordinate(random), coordinate(random)) / 512.0
}

/// Points per seed.
const POINTS: usize = 2048;

/// Returns a histogram for each number of octaves, from sums at 4.2 million points with 2048 seeds.
fn histograms<V: Point<Coordinates = [f32; N]>, const N: usize>(counts: &[f32]) -> Vec<Histogram> {
    let empty = || vec![Histogram::new(); counts.len()];
    (0..2048_u32)
        .into_par_iter()
        .fold(empty, |mut histograms, seed| {
            let noise = GaussianFbm::<V>::new(GaussianNoise::new(seed), FbmSpectrum::default());
            let mut random = Random(u64::from(seed) << 32 | 7);
            let lists: [Vec<f32>; N] =
                std::array::from_fn(|_| (0..POINTS).map(|_| coordinate(&mut random) / 100.0).collect());
            let points: Vec<V> = (0..POINTS).map(|i| V::from_axes(|axis| lists[axis][i])).collect();
            for (histogram, &count) in histograms.iter_mut().zip(counts) {
                let sum = noise.with_octaves(count);
                points.iter().for_each(|&p| histogram.add(sum.value(p)));
            }
            histograms
        })
        .reduce(empty, |a, b| a.into_iter().zip(&b).map(|(a, b)| a.join(b)).collect())
}

/// Asserts the distance of sums with these numbers of octaves. At n = 4.2 million its floor is
/// 2.3/√n = 0.0011 at significance 0.001/7.
fn assert_gaussian<V: Point<Coordinates = [f32; N]>, const N: usize>(counts: &[f32]) {
    for (octaves, histogram) in counts.iter().zip(histograms::<V, N>(counts)) {
        let distance = histogram.distance();
        assert!(distance <= 0.001, "{N}-D, {octaves} octaves: {distance}");
    }
}

#[test]
fn gaussian_for_every_number_of_octaves() {
    assert_gaussian::<f32, 1>(&[1.1]);
    assert_gaussian::<Vec2, 2>(&[2.5, 8.0]);
    assert_gaussian::<Vec3, 3>(&[1.0, 1.5, 2.75]);
    assert_gaussian::<Vec4, 4>(&[1.25]);
}

#[test]
fn second_channel_is_gaussian() {
    let histogram = (0..2048_u32)
        .into_par_iter()
        .fold(Histogram::new, |mut histogram, seed| {
            let (noise, mut random) = (GaussianNoise::default(), Random(u64::from(seed) << 32 | 8));
            for _ in 0..POINTS {
                let p = Vec2::new(coordinate(&mut random), coordinate(&mut random)) / 512.0;
                histogram.add(noise.with_seed(seed).pair(p)[1].value);
            }
            histogram
        })
        .reduce(Histogram::new, |a, b| a.join(&b));
    let distance = histogram.distance();
    assert!(distance <= 0.001, "{distance}");
}

/// Returns mean, variance, mean fourth power, and the channels' correlation and correlation of
/// squares.
fn moments<V: Point<Coordinates = [f32; N]> + Sync + Send, const N: usize>(place: V) -> [f64; 5] {
    const SEEDS: u32 = 100_000;
    let sums = (0..SEEDS / 1000)
        .into_par_iter()
        .map(|block| {
            let mut sums = [0.0; 5];
            for seed in block * 1000..(block + 1) * 1000 {
                let [a, b] = GaussianNoise::new(seed).pair(place).map(|channel| f64::from(channel.value));
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
    // n = 200,000 values, 100,000 pairs; 4.3 standard errors for significance 0.001/80.
    let n = 200_000_f64;
    assert_abs_diff_eq!(mean, 0.0, epsilon = 4.3 / n.sqrt(), "{name}: mean");
    assert_abs_diff_eq!(variance, 1.0, epsilon = 4.3 * (2.0 / n).sqrt(), "{name}: variance");
    assert_abs_diff_eq!(fourth, 3.0, epsilon = 4.3 * (96.0 / n).sqrt(), "{name}: fourth moment");
    assert_abs_diff_eq!(product, 0.0, epsilon = 4.3 * (2.0 / n).sqrt(), "{name}: channels");
    // Half the correlation of squares: the variances are 2.
    assert_abs_diff_eq!(squares, 0.0, epsilon = 4.3 * (2.0 / n).sqrt(), "{name}: squares");
}

#[test]
fn moments_are_equal_at_every_position_and_channels_independent() {
    for x in [-3.0, -2.5, 0.125, 0.8] {
        assert_standard(&format!("1-D at {x}"), moments(x));
    }
    for p in [[-3.0, 5.0], [-2.5, 5.0], [-2.5, 5.5], [0.8, 0.3]].map(Vec2::from) {
        assert_standard(&format!("2-D at {p}"), moments(p));
    }
    for p in [[-3.0, 5.0, 0.0], [-2.5, 5.0, 0.0], [-2.5, 5.5, 0.0], [-2.5, 5.5, 0.5], [0.8, 0.3, -0.9]] {
        assert_standard(&format!("3-D at {p:?}"), moments(Vec3::from(p)));
    }
    for p in [[0.0; 4], [0.5; 4], [0.125, 0.25, 0.375, 0.5]].map(Vec4::from) {
        assert_standard(&format!("4-D at {p}"), moments(p));
    }
}

/// Returns the bin out of sixteen equally likely bins under N(0, 1).
fn sixteenth(value: f32) -> usize {
    const EDGES: [f32; 7] =
        [0.157_310_7, 0.318_639_36, 0.488_776_4, 0.674_489_76, 0.887_146_6, 1.150_349_4, 1.534_120_6];
    let outside = EDGES.iter().filter(|&&edge| value.abs() >= edge).count();
    if value < 0.0 { 7 - outside } else { 8 + outside }
}

/// Returns χ² per degree of freedom of 16 × 16 bins over a million pairs, a thousand from each
/// field, against independence.
fn chi_square<F: FnMut(u32) -> [f32; 2]>(field: impl Fn(u32) -> F + Sync) -> f64 {
    let table = (0..1000_u32)
        .into_par_iter()
        .fold(
            || [[0_u32; 16]; 16],
            |mut table, seed| {
                let mut pair = field(seed);
                for i in 0..1000 {
                    let [a, b] = pair(i);
                    table[sixteenth(a)][sixteenth(b)] += 1;
                }
                table
            },
        )
        .reduce(
            || [[0; 16]; 16],
            |mut a, b| {
                a.as_flattened_mut().iter_mut().zip(b.as_flattened()).for_each(|(a, b)| *a += b);
                a
            },
        );
    let rows = table.map(|row| f64::from(row.iter().sum::<u32>()));
    let columns: [f64; 16] = std::array::from_fn(|k| table.iter().map(|row| f64::from(row[k])).sum());
    let mut chi_square = 0.0;
    for (row, counts) in rows.iter().zip(&table) {
        for (column, &count) in columns.iter().zip(counts) {
            let expected = row * column / 1e6;
            chi_square += (f64::from(count) - expected).powi(2) / expected;
        }
    }
    chi_square / 225.0
}

#[test]
fn channels_are_independent_bin_by_bin() {
    let octaves = |count: f32| {
        chi_square(move |seed| {
            let noise = GaussianFbm::<Vec3>::new(GaussianNoise::new(seed), FbmSpectrum::default());
            let mut random = Random(u64::from(seed) << 32 | 10);
            move |_| noise.pair_with_octaves(point3(&mut random), count).map(|channel| channel.value)
        })
    };
    let (lattice_point, centre) = (Vec3::new(1.0, -2.0, 3.0), Vec2::new(0.5, -2.5));
    let noise = GaussianNoise::default();
    for (name, ratio) in [
        // Single words are visible there.
        (
            "at a lattice point",
            chi_square(|block| {
                move |i| noise.with_seed(block * 1000 + i).pair(lattice_point).map(|c| c.value)
            }),
        ),
        (
            "in the centre of a cell of the plane",
            chi_square(|block| move |i| noise.with_seed(block * 1000 + i).pair(centre).map(|c| c.value)),
        ),
        ("one octave", octaves(1.0)),
        ("three octaves", octaves(2.5)),
    ] {
        // The 0.999 quantile with 225 degrees of freedom is 1.31. All of these are below 1.2 for
        // their seeds.
        assert!(ratio <= 1.2, "{name}: {ratio}");
    }
}
