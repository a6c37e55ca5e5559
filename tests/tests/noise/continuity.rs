//! Values and gradients are continuous across cell borders and simplex faces, on both sides of the
//! origin.

use asperity_noise::{
    Field, Simplex,
    glam::{Vec2, Vec3},
};
use asperity_tests::{
    in_every_dimension,
    noise_any::{AnyNoise, kinds, variants},
    noise_reference::Kind,
    random::Random,
};

const STEP: f32 = 1.0 / 1024.0;
/// Maximum deviation of a step of length 1.37/1024 from the mean of the two gradients: h²/4 times
/// the jump of the second derivative (at most 24), plus rounding. Maximum seen 5.5e-6 for Gaussian
/// noise, and 1.6e-6 for the others.
const LEAP: f32 = 1.1e-5;

/// Whether a noise is discontinuous by definition: white noise at cell borders, wide simplex noise
/// at simplex faces.
fn leaps<const N: usize>(name: &str) -> bool {
    name.starts_with("white") || name.starts_with("wide") && N > 1
}

fn walk<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    if leaps::<N>(name) {
        return;
    }
    let mut worst = 0.0_f32;
    for seed in 0..4 {
        let at = |i: i16| -> [f32; N] {
            let t = f32::from(i) * STEP;
            let line = [t, t * 0.5 + 0.3, 0.1 - t * 0.75, 0.7 + t * 0.25];
            std::array::from_fn(|axis| line[axis])
        };
        let sample = |i: i16| {
            let sample = noise.sample(at(i), seed);
            (sample.value, sample.gradient)
        };
        let mut before = sample(-6000);
        for i in -6000..6000_i16 {
            let after = sample(i + 1);
            let (p, q) = (at(i), at(i + 1));
            let slopes = (0..N).map(|k| 0.5 * (before.1[k] + after.1[k]) * (q[k] - p[k]));
            worst = worst.max((after.0 - before.0 - slopes.sum::<f32>()).abs());
            before = after;
        }
    }
    assert!(worst < LEAP, "{name}: {worst}");
}

#[test]
fn fields_follow_their_gradients_across_cells() {
    in_every_dimension!(kinds(), walk);
    in_every_dimension!(variants(), walk);
}

/// Half the step across a border, where floats are at most 2⁻²² apart.
const HALF: f64 = 1.0 / 262_144.0;

/// Returns a random point within ±4 on a border of a cell or simplex, and a direction across it.
fn border<const N: usize>(simplicial: bool, random: &mut Random) -> ([f64; N], [f64; N]) {
    let mut p = [(); N].map(|()| ((random.uniform() - 0.5) * 8.0 * 4096.0).round() / 4096.0);
    let mut across = [0.0; N];
    let axis = random.bits() as usize % N;
    if !simplicial || N == 1 {
        p[axis] = p[axis].round();
        across[axis] = 1.0;
    } else if random.bits().is_multiple_of(2) {
        // Where two skewed coordinates have the same position in their cells: they differ by an
        // integer, skewed or not.
        let other = (axis + 1) % N;
        p[axis] = p[other] + (p[axis] - p[other]).round();
        (across[axis], across[other]) = (0.5, -0.5);
    } else {
        // Where a skewed coordinate is an integer: x + skew Σ = m.
        let skew = ((N as f64 + 1.0).sqrt() - 1.0) / N as f64;
        let sum: f64 = p.iter().sum();
        let skewed = p[axis] + skew * sum;
        p[axis] += (skewed.round() - skewed) / (1.0 + skew);
        across = [skew / 2.0; N];
        across[axis] += 0.5;
    }
    (p, across)
}

/// A step of 2⁻¹⁷ changes a gradient by at most 90 times that, 7e-4, and a value only according to
/// the gradients, up to rounding. Maximum seen: 3.3e-4 and 1.3e-6, for sparse noise.
fn borders<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    let simplicial = name.contains("simplex");
    if leaps::<N>(name) {
        return;
    }
    let kind = if simplicial { Kind::Simplex(0.5) } else { Kind::Perlin };
    let mut random = Random(N as u64);
    let (mut leap, mut kink, mut crossed, mut negative) = (0.0_f64, 0.0_f64, 0, 0);
    for seed in 0..3000 {
        let (p, across) = border::<N>(simplicial, &mut random);
        let side = |sign: f64| -> [f32; N] {
            std::array::from_fn(|axis| (p[axis] + sign * HALF * across[axis]) as f32)
        };
        let ends = [side(-1.0), side(1.0)];
        let [here, there] = ends.map(|end| kind.lattice_points(end.map(f64::from)));
        if here == there {
            continue;
        }
        crossed += 1;
        negative += u32::from(p.iter().any(|&x| x < 0.0));
        let [a, b] = ends.map(|end| noise.sample(end, seed));
        let (low, high) = (a.gradient, b.gradient);
        let mut expected = 0.0;
        for axis in 0..N {
            let [low, high] = [low[axis], high[axis]].map(f64::from);
            kink = kink.max((high - low).abs());
            expected += 0.5 * (low + high) * (f64::from(ends[1][axis]) - f64::from(ends[0][axis]));
        }
        leap = leap.max((f64::from(b.value) - f64::from(a.value) - expected).abs());
    }
    assert!(crossed > 2900 && negative > 1000, "{name}: {crossed} borders, {negative} of them negative");
    assert!(leap < 3e-6 && kink < 7e-4, "{name}: leap {leap:e}, kink {kink:e}");
}

#[test]
fn values_and_gradients_match_at_borders() {
    in_every_dimension!(kinds(), borders);
    in_every_dimension!(variants(), borders);
}

/// White noise has one value and no gradient in a cell, and is discontinuous at every border.
fn cells<const N: usize>(name: &str, noise: &dyn AnyNoise<N>) {
    if !name.starts_with("white") {
        return;
    }
    let mut random = Random(N as u64);
    for seed in 0..1000 {
        let (p, across) = border::<N>(false, &mut random);
        let inside = p.map(|x| x.floor() + 0.5);
        let side = |sign: f64| std::array::from_fn(|axis| (inside[axis] + sign * across[axis]) as f32);
        let near = std::array::from_fn(|axis| (p[axis] - HALF * across[axis]) as f32);
        let [below, above, near] = [side(-1.0), side(0.0), near].map(|p| noise.sample(p, seed));
        assert_eq!(below, near, "{name} at {p:?}");
        assert!((above.value - below.value).abs() > 1e-7, "{name} at {p:?}");
        assert_eq!(above.gradient, [0.0; N], "{name} at {p:?}");
    }
}

#[test]
fn white_noise_is_constant_in_cells_and_jumps_at_borders() {
    in_every_dimension!(kinds(), cells);
}

/// Returns the largest jump of wide simplex noise beyond its gradient, over paths of many seeds.
fn greatest_leap(field: impl Fn(f32, u32) -> (f32, f32)) -> f32 {
    let mut largest = 0.0_f32;
    for seed in 0..400 {
        let at = |i: i16| f32::from(i) * STEP;
        let (mut a, mut slope_a) = field(at(-3000), seed);
        for i in -3000..3000_i16 {
            let (b, slope_b) = field(at(i + 1), seed);
            largest = largest.max((b - a - 0.5 * STEP * (slope_a + slope_b)).abs());
            (a, slope_a) = (b, slope_b);
        }
    }
    largest
}

#[test]
fn wide_simplex_noise_jumps_at_faces() {
    let planar = greatest_leap(|t, seed| {
        let direction = Vec2::new(0.8, 0.6);
        let sample = Simplex::new(seed).with_classic_radius().sample(direction * t);
        (sample.value, sample.gradient.dot(direction))
    });
    let spatial = greatest_leap(|t, seed| {
        let direction = Vec3::new(0.48, 0.6, -0.64);
        let sample = Simplex::new(seed).with_classic_radius().sample(direction * t);
        (sample.value, sample.gradient.dot(direction))
    });
    assert!(planar > 1e-3 && planar < 0.006, "2-D: {planar}");
    assert!(spatial > 1e-3 && spatial < 0.006, "3-D: {spatial}");
}
