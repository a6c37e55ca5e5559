//! Values and analytic gradients against a plain `f64` evaluation and its central differences; ranges.

use asperity_noise::{
    Gaussian, Kernel, Noise, Perlin1985, Perlin2002, Point, Sample, Simplex,
    glam::{Vec2, Vec3, Vec4},
};
use asperity_tests::{noise_reference::Kind, random::Random};

const POINTS: u32 = 3000;

/// A coordinate in ±4096 with twelve bits of fraction, so that `f32` holds it and moves no point off a face.
fn coordinate(random: &mut Random) -> f32 {
    ((random.uniform() - 0.5) * 8192.0 * 4096.0).round() as f32 / 4096.0
}

fn far_point<V: Point<N>, const N: usize>(random: &mut Random) -> V {
    V::from_coordinates([(); N].map(|()| coordinate(random)))
}

fn near_point<V: Point<N>, const N: usize>(random: &mut Random) -> V {
    V::from_coordinates([(); N].map(|()| coordinate(random) / 64.0))
}

/// Nearer still, for simplex noise, whose corners are rounded by |p|·2⁻²².
fn nearest_point<V: Point<N>, const N: usize>(random: &mut Random) -> V {
    V::from_coordinates([(); N].map(|()| coordinate(random) / 1024.0))
}

/// The worst errors of value and gradient.
fn errors<V: Point<N>, const N: usize>(
    kind: Kind,
    scale: f64,
    point: fn(&mut Random) -> V,
    noise: impl Fn(V, u32) -> Sample<V>,
) -> [f64; 2] {
    let mut random = Random(2);
    let mut worst = [0.0_f64; 2];
    let mut compared = 0;
    for seed in 0..POINTS {
        let p = point(&mut random);
        let wide = p.coordinates().map(f64::from);
        let sample = noise(p, seed);
        worst[0] = worst[0].max((f64::from(sample.value) - scale * kind.value(wide, seed)).abs());
        if let Some(gradient) = kind.gradient(wide, seed) {
            compared += 1;
            for (got, expected) in sample.gradient.coordinates().into_iter().zip(gradient) {
                worst[1] = worst[1].max((f64::from(got) - scale * expected).abs());
            }
        }
    }
    assert!(compared > POINTS * 9 / 10, "{compared} gradients");
    worst
}

/// Where the four dimensions of a kind are evaluated.
type Places =
    (fn(&mut Random) -> f32, fn(&mut Random) -> Vec2, fn(&mut Random) -> Vec3, fn(&mut Random) -> Vec4);

const NEAR: Places = (near_point, near_point, near_point, near_point);
const NEAREST: Places = (nearest_point, nearest_point, nearest_point, nearest_point);

/// The errors of a kind that is given in every dimension, asserted.
fn close<K>(name: &str, noise: K, kind: Kind, scales: [f64; 4], places: Places, tolerances: [[f64; 2]; 4])
where
    K: Kernel<1> + Kernel<2> + Kernel<3> + Kernel<4> + Copy,
{
    let worst = [
        errors::<f32, 1>(kind, scales[0], places.0, |p, seed| noise.sample(p, seed)),
        errors::<Vec2, 2>(kind, scales[1], places.1, |p, seed| noise.sample(p, seed)),
        errors::<Vec3, 3>(kind, scales[2], places.2, |p, seed| noise.sample(p, seed)),
        errors::<Vec4, 4>(kind, scales[3], places.3, |p, seed| noise.sample(p, seed)),
    ];
    for (dimension, ([v, g], [value, gradient])) in (1..).zip(worst.into_iter().zip(tolerances)) {
        assert!(v < value && g < gradient, "{name} {dimension}-D: {v:e}, {g:e}");
    }
}

/// The greatest value that a kind can reach, by search from the best points of a grid.
fn greatest<const D: usize>(kind: Kind) -> f64 {
    let steps: usize = [2000, 160, 36, 14][D - 1];
    // The grid covers every shape of simplex: they hang over the unit cube by a third.
    let coordinate = |index: usize, k: u32| (index / steps.pow(k) % steps) as f64 * 1.5 / steps as f64 - 0.4;
    let mut grid: Vec<(f64, [f64; D])> = (0..steps.pow(D as u32))
        .map(|index| std::array::from_fn(|k| coordinate(index, k as u32)))
        .map(|p| (kind.greatest(p), p))
        .collect();
    grid.sort_by(|a, b| b.0.total_cmp(&a.0));
    let climb = |(mut value, mut p): (f64, [f64; D])| {
        let mut step = 1.5 / steps as f64;
        while step > 1e-8 {
            let mut moved = false;
            for direction in 0..3_usize.pow(D as u32) {
                let q: [f64; D] = std::array::from_fn(|k| {
                    p[k] + step * ((direction / 3_usize.pow(k as u32) % 3) as f64 - 1.0)
                });
                let there = kind.greatest(q);
                if there > value + 1e-12 {
                    (value, p, moved) = (there, q, true);
                }
            }
            if !moved {
                step *= 0.5;
            }
        }
        value
    };
    grid.into_iter().take(24).map(climb).fold(0.0, f64::max)
}

/// The scale of a kind in every dimension, derived anew from the greatest value.
///
/// A noise that equals the reference at this scale has the bound |n| ≤ 1, and it is tight.
fn scales(kind: Kind) -> [f64; 4] {
    let margin = 1.0 - 2e-6;
    [greatest::<1>(kind), greatest::<2>(kind), greatest::<3>(kind), greatest::<4>(kind)].map(|g| margin / g)
}

// Tolerances of value and gradient are about twice the worst errors seen, which stand beside them. They are roundings of sums
// of 2ⁿ products: half a unit of 2⁻²³ for each of some ten operations on numbers of at most the noise's range, and
// on slopes of at most 4, for Gaussian noise 20.

#[test]
fn gradient_noises_equal_the_reference_scaled_to_their_range() {
    let kind = Kind::Perlin1985;
    // 2.0e-7, 2.9e-7, 2.4e-7, 1.4e-7; 5.7e-7, 6.5e-7, 4.9e-7, 3.5e-7.
    let tolerances = [[5e-7, 1.2e-6], [6e-7, 1.4e-6], [5e-7, 1.2e-6], [4e-7, 1e-6]];
    close("Perlin 1985", Perlin1985::default(), kind, scales(kind), NEAR, tolerances);
    let kind = Kind::Perlin2002;
    // 9.0e-7, 7.7e-7, 7.3e-7, 5.3e-7; 1.7e-6, 2.3e-6, 2.3e-6, 1.8e-6.
    let tolerances = [[2e-6, 4e-6], [2e-6, 5e-6], [2e-6, 5e-6], [1.2e-6, 4e-6]];
    close("Perlin 2002", Perlin2002::default(), kind, scales(kind), NEAR, tolerances);
}

#[test]
fn simplex_noises_equal_the_reference_scaled_to_their_range() {
    // Corners are rounded by up to 8·2⁻²² = 2e-6 there, and second derivatives reach 30.
    let tolerances = [[8e-6, 6e-5]; 4];
    let kind = Kind::Simplex(0.5);
    close("simplex", Simplex::CONTINUOUS, kind, scales(kind), NEAREST, tolerances);
    let kind = Kind::Simplex(f64::from(0.6_f32));
    close("wide simplex", Simplex::WIDE, kind, scales(kind), NEAREST, tolerances);
}

#[test]
fn both_channels_of_gaussian_noise_equal_the_reference() {
    // 2.2e-6, 2.0e-6, 2.4e-6, 2.7e-6; 2.4e-6, 5.1e-6, 9.0e-6, 7.8e-6.
    let tolerances = [[5e-6, 6e-6], [5e-6, 1.2e-5], [6e-6, 2e-5], [6e-6, 2e-5]];
    close("Gaussian", Gaussian::default(), Kind::Gaussian(0), [1.0; 4], NEAR, tolerances);
    let (noise, second) = (Gaussian::default(), Kind::Gaussian(1));
    for worst in [
        errors::<f32, 1>(second, 1.0, near_point, |p, seed| noise.pair(p, seed)[1]),
        errors::<Vec2, 2>(second, 1.0, near_point, |p, seed| noise.pair(p, seed)[1]),
        errors::<Vec3, 3>(second, 1.0, near_point, |p, seed| noise.pair(p, seed)[1]),
        errors::<Vec4, 4>(second, 1.0, near_point, |p, seed| noise.pair(p, seed)[1]),
    ] {
        assert!(worst[0] < 6e-6 && worst[1] < 2e-5, "second channel: {worst:?}");
    }
}

#[test]
fn far_from_the_origin_noises_equal_the_reference_still() {
    let (gaussian, simplex) = (Kind::Gaussian(0), Kind::Simplex(0.5));
    let worst = errors::<Vec3, 3>(gaussian, 1.0, far_point, |p, seed| Gaussian::default().sample(p, seed));
    assert!(worst[0] < 6e-6 && worst[1] < 2e-5, "Gaussian: {worst:?}");
    // Corners are rounded by up to 7100·2⁻²² = 0.0017 there, where slopes reach 4 and second derivatives 30.
    let scale = (1.0 - 2e-6) / 0.013_007_157_182_859_35;
    let worst = errors::<Vec3, 3>(simplex, scale, far_point, |p, seed| Simplex::CONTINUOUS.sample(p, seed));
    assert!(worst[0] < 0.007 && worst[1] < 0.05, "simplex: {worst:?}");
}
