//! Fields that should have nothing to do with one another: other seeds, swapped axes, mirror images, other octaves.

use asperity_noise::{Normalisation, Rotation, Spectrum};
use asperity_tests::{
    assert_abs_diff_eq,
    noise_any::{AnyNoise, VisitAny, any_kind, thinning},
    random::Random,
};

/// Mostly in cells of their own, so that the points are independent.
fn point<const N: usize>(random: &mut Random) -> [f32; N] {
    [(); N].map(|()| ((random.uniform() - 0.5) * 200_000.0) as f32)
}

/// The correlation of two fields and of their squares over random points, in standard errors.
fn correlations<const N: usize>(name: &str, pair: impl Fn([f32; N]) -> [f32; 2]) -> [f64; 2] {
    let count = 20_000 / thinning::<N>(name);
    let mut random = Random(11);
    let values: Vec<[f64; 2]> = (0..count).map(|_| pair(point(&mut random)).map(f64::from)).collect();
    let correlation = |f: fn(f64) -> f64| {
        let mean = |g: &dyn Fn(&[f64; 2]) -> f64| values.iter().map(g).sum::<f64>() / f64::from(count);
        let (ma, mb) = (mean(&|v| f(v[0])), mean(&|v| f(v[1])));
        let covariance = mean(&|v| (f(v[0]) - ma) * (f(v[1]) - mb));
        let (va, vb) = (mean(&|v| (f(v[0]) - ma).powi(2)), mean(&|v| (f(v[1]) - mb).powi(2)));
        covariance / (va * vb).sqrt() * f64::from(count).sqrt()
    };
    [correlation(|x| x), correlation(|x| x * x)]
}

/// Whether a correlation is 0, within 4.9 standard errors: significance 0.001 over some 400 cases.
fn assert_uncorrelated(correlation: f64, case: &str) {
    assert_abs_diff_eq!(correlation, 0.0, epsilon = 4.9, "{case}, in standard errors");
}

struct Others;

impl VisitAny for Others {
    fn visit<const N: usize>(&mut self, name: &str, noise: &dyn AnyNoise<N>) {
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
        let value = |p: [f32; N], seed| noise.value(p, seed);
        for (how, map, seed) in others {
            // A line has one axis.
            if N == 1 && how.ends_with("axes") {
                continue;
            }
            let [values, squares] = correlations(name, |p| [value(p, 5), value(map(p), seed)]);
            assert_uncorrelated(values, &format!("{name} and {how}"));
            // Other kinds have a variance that depends on the place in the cell.
            if ["white", "sparse", "Gaussian"].iter().any(|kind| name.starts_with(kind)) {
                assert_uncorrelated(squares, &format!("squares of {name} and {how}"));
            }
        }
        // Two reflected axes and no others; and so many cells apart that no lattice point is shared, of which splines take
        // four along an axis.
        if N > 2 {
            let [values, _] = correlations(name, |p| {
                let mut q = p;
                (q[0], q[N - 1]) = (-p[0], -p[N - 1]);
                [value(p, 5), value(q, 5)]
            });
            assert_uncorrelated(values, &format!("{name} and two reflected axes"));
        }
        for axis in [0, N - 1] {
            for distance in if name.contains("Catmull-Rom") { [4.0, -5.0] } else { [2.0, -3.0] } {
                let [values, _] = correlations(name, |p| {
                    let mut q = p;
                    q[axis] += distance;
                    [value(p, 5), value(q, 5)]
                });
                assert_uncorrelated(values, &format!("{name}, {distance} cells along axis {axis}"));
            }
        }
    }
}

#[test]
fn seeds_axes_and_mirror_images_are_decorrelated() {
    any_kind(&mut Others);
}

struct OctavesApart;

impl VisitAny for OctavesApart {
    fn visit<const N: usize>(&mut self, name: &str, noise: &dyn AnyNoise<N>) {
        let spectrum = Spectrum::default();
        for rotation in [Rotation::Random, Rotation::Aligned] {
            let sum = noise.octaves(Normalisation::Range, rotation, 9);
            // Octave k is what it adds to the sum of those before it.
            let whole = |p: [f32; N], k: f32| sum.value(p, k) * spectrum.sum_of_amplitudes(k);
            let octave = |p: [f32; N], k: f32| whole(p, k) - whole(p, k - 1.0);
            for (first, second) in [(1.0, 2.0), (2.0, 3.0), (1.0, 3.0)] {
                let [values, squares] = correlations(name, |p| [octave(p, first), octave(p, second)]);
                let case = format!("{name} {rotation:?}, octaves {first} and {second}");
                assert_uncorrelated(values, &case);
                // Lattices apart, even the variances that depend on the place do.
                if rotation == Rotation::Random && N > 1 {
                    assert_uncorrelated(squares, &format!("squares of {case}"));
                }
            }
        }
    }
}

#[test]
fn octaves_are_decorrelated() {
    any_kind(&mut OctavesApart);
}

struct SumsApart;

impl VisitAny for SumsApart {
    fn visit<const N: usize>(&mut self, name: &str, noise: &dyn AnyNoise<N>) {
        let sums = [1, 2].map(|seed| noise.octaves(Normalisation::Variance, Rotation::Random, seed));
        let [values, squares] = correlations(name, |p| sums.each_ref().map(|sum| sum.value(p, 2.5)));
        assert_uncorrelated(values, name);
        if name.starts_with("Gaussian") {
            assert_uncorrelated(squares, &format!("squares of {name}"));
        }
    }
}

#[test]
fn sums_of_other_seeds_are_decorrelated() {
    any_kind(&mut SumsApart);
}
