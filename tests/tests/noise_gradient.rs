//! Values and analytic gradients against a plain `f64` evaluation and its central differences; ranges.

use asperity_noise::{
    Gaussian, Noise, Perlin1985, Perlin2002, Sample, Simplex,
    glam::{Vec2, Vec3},
    second_word,
};
use asperity_tests::{noise_reference::Kind, random::Random};

const POINTS: u32 = 3000;

/// Worst errors seen: 8.7e-7 for the kinds of range 1, 3.0e-6 for Gaussian noise, whose values reach 5.
const VALUE_TOLERANCE: f64 = 6e-6;
/// Worst errors seen: 2.8e-6, and 7e-6 for Gaussian noise.
const GRADIENT_TOLERANCE: f64 = 1.5e-5;

/// A coordinate in ±4096 with twelve bits of fraction, so that `f32` holds it and moves no point off a face.
fn coordinate(random: &mut Random) -> f32 {
    ((random.uniform() - 0.5) * 8192.0 * 4096.0).round() as f32 / 4096.0
}

fn near(random: &mut Random) -> f32 {
    coordinate(random) / 64.0
}

fn close2(name: &str, kind: Kind, scale: f64, noise: impl Fn(Vec2, u32) -> Sample<Vec2>) {
    let mut random = Random(2);
    let mut worst = [0.0_f64; 2];
    for seed in 0..POINTS {
        let p = Vec2::new(near(&mut random), near(&mut random));
        let wide = [f64::from(p.x), f64::from(p.y)];
        let sample = noise(p, seed);
        worst[0] = worst[0].max((f64::from(sample.value) - scale * kind.value(wide, seed)).abs());
        if let Some(gradient) = kind.gradient(wide, seed) {
            for (got, expected) in sample.gradient.to_array().into_iter().zip(gradient) {
                worst[1] = worst[1].max((f64::from(got) - scale * expected).abs());
            }
        }
    }
    assert!(worst[0] < VALUE_TOLERANCE && worst[1] < GRADIENT_TOLERANCE, "{name} 2-D: {worst:?}");
}

fn close3(name: &str, kind: Kind, scale: f64, noise: impl Fn(Vec3, u32) -> Sample<Vec3>) {
    let mut random = Random(3);
    let mut worst = [0.0_f64; 2];
    for seed in 0..POINTS {
        let p = Vec3::new(near(&mut random), near(&mut random), near(&mut random));
        let wide = [f64::from(p.x), f64::from(p.y), f64::from(p.z)];
        let sample = noise(p, seed);
        worst[0] = worst[0].max((f64::from(sample.value) - scale * kind.value(wide, seed)).abs());
        if let Some(gradient) = kind.gradient(wide, seed) {
            for (got, expected) in sample.gradient.to_array().into_iter().zip(gradient) {
                worst[1] = worst[1].max((f64::from(got) - scale * expected).abs());
            }
        }
    }
    assert!(worst[0] < VALUE_TOLERANCE && worst[1] < GRADIENT_TOLERANCE, "{name} 3-D: {worst:?}");
}

/// The greatest value that a kind can reach, by search from the best points of a grid.
fn greatest<const D: usize>(kind: Kind) -> f64 {
    let steps: usize = if D == 2 { 160 } else { 36 };
    // The grid covers every shape of simplex: they hang over the unit cube by a third.
    let coordinate = |index: usize, k: u32| (index / steps.pow(k) % steps) as f64 * 1.5 / steps as f64 - 0.4;
    let mut grid: Vec<(f64, [f64; D])> = (0..steps.pow(D as u32))
        .map(|index| std::array::from_fn(|k| coordinate(index, k as u32)))
        .map(|p| (kind.greatest(p), p))
        .collect();
    grid.sort_by(|a, b| b.0.total_cmp(&a.0));
    let climb = |(mut value, mut p): (f64, [f64; D])| {
        let mut step = 1.5 / steps as f64;
        while step > 1e-9 {
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

fn kinds() -> [(&'static str, Kind); 4] {
    [
        ("Perlin 1985", Kind::Perlin1985),
        ("Perlin 2002", Kind::Perlin2002),
        ("simplex 0.5", Kind::Simplex(0.5)),
        ("simplex 0.6", Kind::Simplex(f64::from(0.6_f32))),
    ]
}

#[test]
fn lattice_noises_equal_the_reference_scaled_to_their_range() {
    // The scale is derived here anew from the greatest value, so this proves the bound |n| ≤ 1 and that it is tight.
    for (name, kind) in kinds() {
        let margin = 1.0 - 1e-6;
        let (scale2, scale3) = (margin / greatest::<2>(kind), margin / greatest::<3>(kind));
        match name {
            "Perlin 1985" => {
                close2(name, kind, scale2, |p, seed| Perlin1985::default().sample(p, seed));
                close3(name, kind, scale3, |p, seed| Perlin1985::default().sample(p, seed));
            }
            "Perlin 2002" => {
                close2(name, kind, scale2, |p, seed| Perlin2002::default().sample(p, seed));
                close3(name, kind, scale3, |p, seed| Perlin2002::default().sample(p, seed));
            }
            "simplex 0.5" => {
                close2(name, kind, scale2, |p, seed| Simplex::CONTINUOUS.sample(p, seed));
                close3(name, kind, scale3, |p, seed| Simplex::CONTINUOUS.sample(p, seed));
            }
            _ => {
                close2(name, kind, scale2, |p, seed| Simplex::WIDE.sample(p, seed));
                close3(name, kind, scale3, |p, seed| Simplex::WIDE.sample(p, seed));
            }
        }
    }
}

#[test]
fn both_channels_of_gaussian_noise_equal_the_reference() {
    let noise = Gaussian::default();
    let first = Kind::Gaussian(|word| word);
    let second = Kind::Gaussian(second_word);
    close2("Gaussian", first, 1.0, |p, seed| noise.sample(p, seed));
    close3("Gaussian", first, 1.0, |p, seed| noise.sample(p, seed));
    close2("second channel", second, 1.0, |p, seed| noise.pair(p, seed)[1]);
    close3("second channel", second, 1.0, |p, seed| noise.pair(p, seed)[1]);
}

#[test]
fn far_from_the_origin_noises_equal_the_reference_still() {
    let mut random = Random(4);
    for seed in 0..POINTS {
        let p = Vec3::new(coordinate(&mut random), coordinate(&mut random), coordinate(&mut random));
        let wide = [f64::from(p.x), f64::from(p.y), f64::from(p.z)];
        let gaussian =
            f64::from(Gaussian::default().value(p, seed)) - Kind::Gaussian(|word| word).value(wide, seed);
        assert!(gaussian.abs() < VALUE_TOLERANCE, "Gaussian at {p}: {gaussian}");
        let simplex = f64::from(Simplex::CONTINUOUS.value(p, seed))
            - (1.0 - 1e-6) / 0.013_007_157_182_859_35 * Kind::Simplex(0.5).value(wide, seed);
        assert!(simplex.abs() < VALUE_TOLERANCE, "simplex at {p}: {simplex}");
    }
}
