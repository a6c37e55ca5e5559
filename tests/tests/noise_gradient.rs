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

/// The errors of a kind that is given in every dimension, asserted.
fn close<K>(name: &str, noise: K, kind: Kind, scales: [f64; 4], [value, gradient]: [f64; 2])
where
    K: Kernel<1> + Kernel<2> + Kernel<3> + Kernel<4>,
{
    let worst = [
        errors::<f32, 1>(kind, scales[0], near_point, |p, seed| noise.sample(p, seed)),
        errors::<Vec2, 2>(kind, scales[1], near_point, |p, seed| noise.sample(p, seed)),
        errors::<Vec3, 3>(kind, scales[2], near_point, |p, seed| noise.sample(p, seed)),
        errors::<Vec4, 4>(kind, scales[3], near_point, |p, seed| noise.sample(p, seed)),
    ];
    for (dimension, [v, g]) in (1..).zip(worst) {
        println!("{name} {dimension}-D: value {v:.2e}, gradient {g:.2e}");
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

#[test]
fn gradient_noises_equal_the_reference_scaled_to_their_range() {
    let kind = Kind::Perlin1985;
    // Worst errors seen: 0 and 0.
    close("Perlin 1985", Perlin1985::default(), kind, scales(kind), [6e-6, 1.5e-5]);
    let kind = Kind::Perlin2002;
    close("Perlin 2002", Perlin2002::default(), kind, scales(kind), [6e-6, 1.5e-5]);
}

#[test]
fn simplex_noises_equal_the_reference_scaled_to_their_range() {
    let kind = Kind::Simplex(0.5);
    close("simplex", Simplex::CONTINUOUS, kind, scales(kind), [6e-6, 1.5e-5]);
    let kind = Kind::Simplex(f64::from(0.6_f32));
    close("wide simplex", Simplex::WIDE, kind, scales(kind), [6e-6, 1.5e-5]);
}

#[test]
fn both_channels_of_gaussian_noise_equal_the_reference() {
    close("Gaussian", Gaussian::default(), Kind::Gaussian(0), [1.0; 4], [6e-6, 1.5e-5]);
    let (noise, second) = (Gaussian::default(), Kind::Gaussian(1));
    for worst in [
        errors::<f32, 1>(second, 1.0, near_point, |p, seed| noise.pair(p, seed)[1]),
        errors::<Vec2, 2>(second, 1.0, near_point, |p, seed| noise.pair(p, seed)[1]),
        errors::<Vec3, 3>(second, 1.0, near_point, |p, seed| noise.pair(p, seed)[1]),
        errors::<Vec4, 4>(second, 1.0, near_point, |p, seed| noise.pair(p, seed)[1]),
    ] {
        assert!(worst[0] < 6e-6 && worst[1] < 1.5e-5, "second channel: {worst:?}");
    }
}

#[test]
fn far_from_the_origin_noises_equal_the_reference_still() {
    let gaussian = Kind::Gaussian(0);
    let simplex = Kind::Simplex(0.5);
    let scale = (1.0 - 2e-6) / 0.013_007_157_182_859_35;
    for worst in [
        errors::<Vec3, 3>(gaussian, 1.0, far_point, |p, seed| Gaussian::default().sample(p, seed)),
        errors::<Vec3, 3>(simplex, scale, far_point, |p, seed| Simplex::CONTINUOUS.sample(p, seed)),
    ] {
        assert!(worst[0] < 6e-6 && worst[1] < 1.5e-5, "{worst:?}");
    }
}
