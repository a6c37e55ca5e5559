//! Sums with anchors far from the origin: the same noise, accurate to a thousandth of a cell at
//! 10¹².

use asperity_noise::{
    Anchor, Fbm, FbmSpectrum, Field, GaussianNoise, IntegerHash, Lattice, Perlin, Point, Sample, Simplex,
    SparseConvolution, ValueNoise,
    glam::{DVec2, DVec3, Vec2, Vec3, Vec4},
};
use asperity_tests::{assert_abs_diff_eq, noise_reference::Kind, random::Random};

const FAR: [f64; 4] = [1e12 + 0.123_046_875, -7.3e11 - 0.5, 3.2e10 + 0.312_5, -9.9e11 + 0.062_5];

fn far<const N: usize>() -> [f64; N] {
    std::array::from_fn(|axis| FAR[axis])
}

fn point<const N: usize>(random: &mut Random) -> [f32; N] {
    std::array::from_fn(|_| (random.uniform() * 4.0 - 2.0) as f32)
}

/// Compares a noise's anchored sum with the unanchored sum, with other anchors, and its gradient
/// with differences.
fn check<K, V, const N: usize>(name: &str, noise: K)
where
    K: Field<V> + Anchor<N> + Copy,
    K::Shifted: Field<V>,
    V: Point<Coordinates = [f32; N]>,
{
    let sum = Fbm::<K, V>::new(noise, FbmSpectrum::default()).with_octaves(10.0);
    let mut random = Random(1);
    let at = |p: [f32; N]| V::from_coordinates(p);
    let origin = sum.anchored([0.0; N]);
    let near: [f64; N] = std::array::from_fn(|axis| [70.25, -33.5, 12.125, -58.0][axis]);
    let beside = sum.anchored(near);
    let here = sum.anchored(far::<N>());
    let step: [f64; N] = std::array::from_fn(|axis| [1.0, -1.0, 0.5, 0.25][axis]);
    let there = sum.anchored(std::array::from_fn::<f64, N, _>(|axis| FAR[axis] + step[axis]));
    let mut moved = 0;
    for _ in 0..300 {
        let p: [f32; N] = point(&mut random);
        assert_eq!(origin.sample(at(p)), sum.sample(at(p)), "{name}");
        let q = std::array::from_fn::<f32, N, _>(|axis| p[axis] + near[axis] as f32);
        // Octave i is evaluated at 100 · 2.17ⁱ, rounded to a relative 2⁻²⁴, and has amplitude 2⁻ⁱ.
        // Slopes are up to 4.
        assert_abs_diff_eq!(beside.value(at(p)), sum.value(at(q)), epsilon = 0.01, "{name}");
        // The finest octave has frequency 1060: the `f32` rounding of p is a thousandth of its
        // cells.
        let q = std::array::from_fn::<f32, N, _>(|axis| p[axis] + step[axis] as f32);
        assert_abs_diff_eq!(here.value(at(q)), there.value(at(p)), epsilon = 0.002, "{name}");
        // A thousandth of a cell of the first octave further on.
        let mut q = p;
        q[N - 1] += 1.0 / 1024.0;
        moved += u32::from(here.value(at(p)) != here.value(at(q)));
    }
    assert!(moved >= 299, "{name}: {moved}");
    let first = sum.with_octaves(1.0).anchored(far::<N>());
    for _ in 0..100 {
        let p: [f32; N] = point(&mut random);
        let (mut q, h) = (p, 1.0 / 512.0);
        q[0] += h;
        let difference = (first.value(at(q)) - first.value(at(p))) / (q[0] - p[0]);
        let slope = |p: [f32; N]| first.sample(at(p)).gradient.coordinates()[0];
        let mean = 0.5 * (slope(p) + slope(q));
        assert_abs_diff_eq!(difference, mean, epsilon = 2e-3 * (1.0 + mean.abs()), "{name} at {p:?}");
    }
}

#[test]
fn anchored_sum_equals_the_sum() {
    check::<_, f32, 1>("Perlin, line", Perlin::new(3));
    check::<_, Vec2, 2>("Perlin, plane", Perlin::new(3));
    check::<_, Vec3, 3>("Gaussian, space", GaussianNoise::new(3));
    check::<_, Vec4, 4>("value, 4-D", ValueNoise::new(3));
    check::<_, Vec2, 2>("sparse, plane", SparseConvolution::new(3));
    check::<_, f32, 1>("simplex, line", Simplex::new(3));
    check::<_, Vec2, 2>("simplex, plane", Simplex::new(3));
    check::<_, Vec3, 3>("simplex, space", Simplex::new(3));
    check::<_, Vec4, 4>("simplex, 4-D", Simplex::new(3));
}

#[test]
fn anchored_sum_at_1e12_matches_the_reference() {
    let cells = [1_000_000_000_000_i64, -999_999_999_999, 2_147_483_648 + 17];
    let mut random = Random(5);
    let noise = Fbm::single(GaussianNoise::new(11));
    for i in 0..200 {
        // Positions in eighths of a thousandth, which f64 represents to 1.2e-4 there.
        let place: [f64; 3] = std::array::from_fn(|_| (random.uniform() * 8192.0).floor() / 8192.0);
        let anchor = DVec3::from(std::array::from_fn::<f64, 3, _>(|axis| cells[axis] as f64 + place[axis]));
        let step = Vec3::new(1e-3, -2e-3, 1e-3) * (i % 3) as f32;
        let value = noise.anchored(anchor).value(step);
        let p = std::array::from_fn(|axis| place[axis] + f64::from(step[axis]));
        let around = |cell: [i32; 3], seed: u32| {
            let far: [i32; 3] = std::array::from_fn(|axis| (cells[axis] + i64::from(cell[axis])) as i32);
            IntegerHash.word(far, seed)
        };
        let expected = Kind::Gaussian(0).value_on(&around, p, 11);
        // As near the origin, plus the rounding of the position.
        assert_abs_diff_eq!(f64::from(value), expected, epsilon = 6e-6, "{anchor}");
    }
    // The plain path returns the same value within a whole cell there.
    let far = Vec2::splat(1e12);
    assert_eq!(Perlin::new(1).value(far), Perlin::new(1).value(far + Vec2::new(0.5, 0.25)));
}

#[test]
fn anchored_batches_have_the_bits_of_single_points() {
    let sum =
        Fbm::new(Simplex::new(2), FbmSpectrum::CLOUD).with_octaves(3.5).anchored(DVec2::new(FAR[0], FAR[1]));
    let grid = asperity_noise::Grid { origin: Vec2::splat(-1.7), step: Vec2::splat(0.13), size: [40, 20] };
    let mut values = [0.0; 800];
    sum.grid_values(&grid, &mut values).expect("one number per point");
    for (i, value) in values.into_iter().enumerate() {
        assert_eq!(value, sum.value(grid.point([i % 40, i / 40])), "{i}");
    }
}

#[test]
fn invalid_anchors_remove_the_octaves() {
    fn nothing(sum: &impl Field<Vec2>) {
        assert_eq!(sum.sample(Vec2::new(0.3, 0.4)), Sample::default());
    }
    let sum = Fbm::new(Perlin::new(2), FbmSpectrum::default());
    for x in [f64::NAN, f64::INFINITY, -1e300] {
        nothing(&sum.anchored(DVec2::new(x, 0.0)));
    }
    // Octaves within the domain are unaffected by the others.
    assert_ne!(sum.anchored(DVec2::new(1e17, 0.0)).value(Vec2::new(0.3, 0.4)), 0.0);
}
