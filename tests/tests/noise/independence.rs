//! Fields that should be independent: other seeds, swapped axes, mirror images, other octaves.

use asperity_noise::{FbmSpectrum, Normalization, Rotation};
use asperity_tests::{
    assert_abs_diff_eq, in_every_dimension,
    noise_any::{AnyNoise, kinds, thinning},
    random::Random,
};

/// Returns points mostly in different cells, and therefore independent.
fn points<const N: usize>(name: &str) -> Vec<[f32; N]> {
    let mut random = Random(11);
    let mut point = || [(); N].map(|()| ((random.uniform() - 0.5) * 200_000.0) as f32);
    (0..20_000 / thinning::<N>(name)).map(|_| point()).collect()
}

/// Returns the values of a field at points.
fn values<const N: usize>(points: &[[f32; N]], field: &dyn Fn([f32; N]) -> f32) -> Vec<f32> {
    points.iter().map(|&p| field(p)).collect()
}

/// Returns the correlation of two fields and of their squares from their values at the same points,
/// in standard errors.
fn correlations(a: &[f32], b: &[f32]) -> [f64; 2] {
    let count = a.len() as f64;
    let correlation = |f: fn(f64) -> f64| {
        let [a, b] = [a, b].map(|list| list.iter().map(|&x| f(x.into())).collect::<Vec<f64>>());
        let [ma, mb] = [&a, &b].map(|list| list.iter().sum::<f64>() / count);
        let covariance = a.iter().zip(&b).map(|(x, y)| (x - ma) * (y - mb)).sum::<f64>() / count;
        let [va, vb] = [(&a, ma), (&b, mb)]
            .map(|(list, mean)| list.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / count);
        covariance / (va * vb).sqrt() * count.sqrt()
    };
    [correlation(|x| x), correlation(|x| x * x)]
}

/// Asserts that a correlation is 0 within 4.9 standard errors: significance 0.001 over about 400
/// cases.
fn assert_uncorrelated(correlation: f64, case: &str) {
    assert_abs_diff_eq!(correlation, 0.0, epsilon = 4.9, "{case}, in standard errors");
}

fn others<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    type Other<const N: usize> = (&'static str, fn([f32; N]) -> [f32; N], u32);
    let others: [Other<N>; 6] = [
        ("the next seed", |p| p, 6),
        ("seed and high bit", |p| p, 5 | 1 << 31),
        ("the complement of the seed", |p| p, !5),
        ("the mirror image", |p| p.map(|x| -x), 5),
        (
            "swapped axes",
            |mut p| {
                p.swap(0, N.min(2) - 1);
                p
            },
            5,
        ),
        (
            "rotated axes",
            |mut p| {
                p.rotate_left(1);
                p
            },
            5,
        ),
    ];
    let points = points::<N>(name);
    let first = values(&points, &|p| noise.value(p, 5));
    let with = |map: &dyn Fn([f32; N]) -> [f32; N], seed| {
        correlations(&first, &values(&points, &|p| noise.value(map(p), seed)))
    };
    for (how, map, seed) in others {
        // In 1-D there is one axis.
        if N == 1 && how.ends_with("axes") {
            continue;
        }
        let [plain, squares] = with(&map, seed);
        assert_uncorrelated(plain, &format!("{name} and {how}"));
        // For other noises the variance depends on the position in the cell.
        if ["white", "sparse", "Gaussian"].iter().any(|kind| name.starts_with(kind)) {
            assert_uncorrelated(squares, &format!("squares of {name} and {how}"));
        }
    }
    // Exactly two reflected axes, and an offset so large that no lattice point is shared; splines
    // use four lattice points along an axis.
    if N > 2 {
        let reflected = |mut p: [f32; N]| {
            (p[0], p[N - 1]) = (-p[0], -p[N - 1]);
            p
        };
        let [plain, _] = with(&reflected, 5);
        assert_uncorrelated(plain, &format!("{name} and two reflected axes"));
    }
    for axis in [0, N - 1] {
        for distance in if name.contains("Catmull-Rom") { [4.0, -5.0] } else { [2.0, -3.0] } {
            let moved = |mut p: [f32; N]| {
                p[axis] += distance;
                p
            };
            let [plain, _] = with(&moved, 5);
            assert_uncorrelated(plain, &format!("{name}, {distance} cells along axis {axis}"));
        }
    }
}

#[test]
fn seeds_axes_and_mirror_images_are_uncorrelated() {
    in_every_dimension!(kinds(), others);
}

fn octaves_apart<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    let spectrum = FbmSpectrum::default();
    let points = points::<N>(name);
    for rotation in [Rotation::Random, Rotation::Aligned] {
        let sum = noise.octaves(Normalization::UnitRange, rotation, 9);
        let wholes = [0.0, 1.0, 2.0, 3.0]
            .map(|k| values(&points, &|p| sum.value(p, k) * spectrum.sum_of_amplitudes(k)));
        // Octave k is the difference between consecutive sums.
        let octave = |k: usize| -> Vec<f32> {
            wholes[k].iter().zip(&wholes[k - 1]).map(|(whole, before)| whole - before).collect()
        };
        for (first, second) in [(1, 2), (2, 3), (1, 3)] {
            let [plain, squares] = correlations(&octave(first), &octave(second));
            let case = format!("{name} {rotation:?}, octaves {first} and {second}");
            assert_uncorrelated(plain, &case);
            // With different lattices, even the position-dependent variances are uncorrelated.
            if rotation == Rotation::Random && N > 1 {
                assert_uncorrelated(squares, &format!("squares of {case}"));
            }
        }
    }
}

#[test]
fn octaves_are_uncorrelated() {
    in_every_dimension!(kinds(), octaves_apart);
}

fn sums_apart<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    let sums = [1, 2].map(|seed| noise.octaves(Normalization::UnitVariance, Rotation::Random, seed));
    let points = points::<N>(name);
    let [a, b] = sums.each_ref().map(|sum| values(&points, &|p| sum.value(p, 2.5)));
    let [plain, squares] = correlations(&a, &b);
    assert_uncorrelated(plain, name);
    if name.starts_with("Gaussian") {
        assert_uncorrelated(squares, &format!("squares of {name}"));
    }
}

#[test]
fn sums_of_other_seeds_are_uncorrelated() {
    in_every_dimension!(kinds(), sums_apart);
}
