//! Packed maps: density, samples and edge cases, compared with the map.

use asperity_ndf_sampling::{Ggx, Ndf, NdfMap, PackedMapRef, Reconstruction};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;
use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::exact_map::ExactMap;

const KINDS: [Reconstruction; 2] = [Reconstruction::Constant, Reconstruction::Bilinear];

fn image(
    width: usize,
    height: usize,
    kind: Reconstruction,
    value: impl Fn(usize, usize) -> f32,
) -> (ExactMap, NdfMap) {
    let texels: Vec<f32> = (0..width * height).map(|k| value(k % width, k / width)).collect();
    ExactMap::both(width, height, &texels, kind)
}

/// Returns the normal at the center of a texel of 256².
fn middle(i: usize, j: usize) -> Vec3 {
    let [x, y] = [i, j].map(|k| (k as f32 + 0.5) / 128.0 - 1.0);
    Vec3::new(x, y, (1.0 - x * x - y * y).max(1e-6).sqrt())
}

fn maps() -> Vec<(String, (ExactMap, NdfMap))> {
    let ggx = Ggx::new(0.2, 0.4).expect("valid");
    let of = |kind: Reconstruction| {
        vec![
            ("GGX", image(256, 256, kind, |i, j| ggx.d(middle(i, j)))),
            ("1×1", image(1, 1, kind, |_, _| 3.0)),
            ("2×2, one texel", image(2, 2, kind, |i, j| f32::from(i == 1 && j == 0))),
            ("one hot texel", image(64, 64, kind, |i, j| if (i, j) == (40, 20) { 1e-30 } else { 0.0 })),
            ("hot texel at the rim", image(8, 8, kind, |i, j| f32::from(i == 0 && j == 2))),
            ("binary mask", image(33, 33, kind, |i, j| f32::from((i * 7 + j * 5) % 11 < 3))),
            ("two far islands", image(64, 64, kind, |i, j| f32::from((i == 1 || i == 62) && j / 2 == 16))),
            ("islands in a column", image(64, 64, kind, |i, j| f32::from(i / 4 == 8 && (j == 5 || j == 60)))),
            ("ring", image(64, 64, kind, |i, j| f32::from((i as f32 - 31.5).hypot(j as f32 - 31.5) > 24.0))),
            ("not square", image(24, 5, kind, |i, j| ((i * 5 + j * 3) % 7) as f32)),
            ("tall", image(3, 500, kind, |i, j| ((i * 5 + j * 3) % 7) as f32)),
            ("random", image(100, 100, kind, |i, j| Random((i * 100 + j) as u64).uniform() as f32)),
        ]
    };
    KINDS
        .into_iter()
        .flat_map(|kind| of(kind).into_iter().map(move |(name, map)| (format!("{name}, {kind:?}"), map)))
        .collect()
}

/// Returns uniform numbers, including the ends of the range.
fn uniforms(count: usize) -> Vec<Vec2> {
    let mut random = Random(4);
    let edges = [0.0, f32::MIN_POSITIVE, 1e-7, 0.5, 1.0 - f32::EPSILON, 1.0 - f32::EPSILON / 2.0];
    let mut all: Vec<Vec2> = edges.iter().flat_map(|&x| edges.map(|y| Vec2::new(x, y))).collect();
    all.extend((0..count).map(|_| Vec2::new(random.uniform() as f32, random.uniform() as f32)));
    all
}

/// Asserts that a sample is inside the disk and maps back to its uniform numbers, exactly and in
/// `f32`. Returns the errors relative to the tolerance.
pub(crate) fn check_sample(name: &str, exact: &ExactMap, map: PackedMapRef<'_>, u: Vec2) -> [f64; 2] {
    let n = map.inverse(u);
    assert!(n.length_squared() <= 1.0, "{name} {u}: {n} is not inside");
    let [x, y] = n.to_array().map(f64::from);
    let (expected, back) = (exact.forward(x, y), map.forward(n).to_array());
    // The last bit of a coordinate, 6e-8, times the slope of the distribution function.
    let (marginal, peak) = (2.0 * exact.marginal(x).max(1e-300), 2.0 * exact.peak(x));
    // Along x the ends of the chord move, faster for shorter chords.
    let steep = peak.max(1.0) / (0.25 * (1.0 - x * x)).sqrt().max(1e-9);
    let slack = [marginal, peak + steep].map(|slope| 1e-6 + 2.4e-7 * slope);
    // The rim of the map is a polygon, at most 1.43e-6 of the radius inside the circle.
    let rim = [1.91e-6 * marginal, 7.2e-7 * steep];
    let mut worst = [0.0_f64; 2];
    for k in 0..2 {
        let u = f64::from(u.to_array()[k]);
        // At the very ends of u₁ the support of the conditional may be a point.
        let at_end = k == 1 && !(1e-5..1.0 - 1e-5).contains(&expected[0]);
        for (found, slack) in [(f64::from(back[k]), slack[k]), (expected[k], slack[k] + rim[k])] {
            let error = (found - u).abs();
            worst[k] = worst[k].max(error / slack);
            assert!(
                error < slack || at_end,
                "{name} {u}: u{} is off by {error:e}, {slack:e} allowed, {n} {expected:?} {back:?}",
                k + 1
            );
        }
    }
    let m = map.sample(u);
    assert_abs_diff_eq!(m.length(), 1.0, epsilon = 1e-6, "{name} {u}: {m}");
    assert!(m.z > 0.0, "{name} {u}: {m}");
    worst
}

#[test]
fn samples_match_the_exact_distribution() {
    maps().par_iter().for_each(|(name, (exact, map))| {
        let mut worst = [0.0_f64; 2];
        for u in uniforms(4000) {
            let errors = check_sample(name, exact, map.view(), u);
            worst = [worst[0].max(errors[0]), worst[1].max(errors[1])];
            // Where it touches zeros the density may vanish at a sample. A constant density does
            // not.
            assert!(map.d(map.sample(u)) > 0.0 || name.contains("Bilinear"), "{name} {u}: no density");
        }
        println!("{name}: worst errors of u over what is allowed {worst:?}");
    });
}

#[test]
fn samples_are_ordered_like_their_uniform_numbers() {
    for (name, (_, map)) in maps() {
        let packed = map.view();
        let steps: Vec<f32> = (0..1 << 14).map(|k| (k as f32 + 0.5) / 16384.0).collect();
        for (axis, other) in [0, 1].into_iter().flat_map(|axis| [0.03, 0.4, 0.77].map(|other| (axis, other)))
        {
            let fixed = vec![other; steps.len()];
            let u: [&[f32]; 2] = if axis == 0 { [&steps, &fixed] } else { [&fixed, &steps] };
            let mut n = [(); 2].map(|()| vec![0.0; steps.len()]);
            let [x, y] = &mut n;
            packed.inverse_batch(u, [x, y]).unwrap();
            for (k, pair) in n[axis].windows(2).enumerate() {
                // Root and quotient of a row may round in opposite directions.
                assert!(pair[0] <= pair[1] + 1.2e-7, "{name}, axis {axis}, {other}: {pair:?} at {k}");
            }
        }
    }
}

#[test]
fn densities_match_the_exact_map() {
    for (name, (exact, map)) in maps() {
        let packed = map.view();
        for u in uniforms(3000) {
            let n = (u * 2.0 - 1.0) * 0.999;
            // Rounding of the position may cross a texel border.
            let near = [-2e-6, 0.0, 2e-6].map(|d| {
                if n.length() < 1.0 {
                    exact.density(f64::from(n.x) + 2.0 * d, f64::from(n.y) + 2.0 * d)
                } else {
                    0.0
                }
            });
            let density = f64::from(packed.d(n.extend((1.0 - n.length_squared()).max(0.0).sqrt().max(1e-3))));
            let (low, high) =
                (near.iter().copied().fold(f64::MAX, f64::min), near.iter().copied().fold(0.0, f64::max));
            let outside = (n.length() - 1.0).abs() < 1e-5;
            let within =
                low * (1.0 - 1e-5) - 1e-6 * high <= density && density <= high * (1.0 + 1e-5) + 1e-30;
            assert!(within || outside, "{name} {n}: {density} is not {near:?}");
        }
    }
}

#[test]
fn batches_equal_single_results() {
    for (name, (_, map)) in maps() {
        let packed = map.view();
        // Not a multiple of a block.
        let u = uniforms(1001);
        let [u1, u2]: [Vec<f32>; 2] = [u.iter().map(|u| u.x).collect(), u.iter().map(|u| u.y).collect()];
        let [mut x, mut y, mut v1, mut v2, mut d] = [(); 5].map(|()| vec![0.0_f32; u.len()]);
        packed.inverse_batch([&u1, &u2], [&mut x, &mut y]).unwrap();
        packed.forward_batch([&x, &y], [&mut v1, &mut v2]).unwrap();
        packed.d_batch([&x, &y], &mut d).unwrap();
        for (k, &u) in u.iter().enumerate() {
            let n = packed.inverse(u);
            assert_eq!((x[k], y[k]), (n.x, n.y), "{name} {u}");
            let v = packed.forward(n);
            assert_eq!((v1[k], v2[k]), (v.x, v.y), "{name} {n}");
            assert_eq!(d[k], packed.d(n.extend(0.5)), "{name} {n}");
        }
        assert!(packed.inverse_batch([&u1, &u2], [&mut x[1..], &mut y]).is_err());
    }
}

#[test]
fn total_on_every_input() {
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -1.0, 2.0, 1e38, 1e-40];
    for (name, (_, map)) in maps() {
        let packed = map.view();
        for (x, y) in bad.into_iter().flat_map(|x| bad.map(|y| (x, y))) {
            let m = packed.sample(Vec2::new(x, y));
            assert_abs_diff_eq!(m.length(), 1.0, epsilon = 1e-6, "{name} {x} {y}: {m}");
            assert!(m.z > 0.0, "{name} {x} {y}: {m}");
            assert!(packed.warp_gaussian(Vec2::new(x, y)).z > 0.0, "{name} {x} {y}");
            let u = packed.forward(Vec2::new(x, y));
            assert!((0.0..=1.0).contains(&u.x) && (0.0..=1.0).contains(&u.y), "{name} {x} {y}: {u}");
            for z in bad {
                let m = Vec3::new(x, y, z);
                assert!(packed.d(m) >= 0.0 && packed.invert(m).is_finite(), "{name} {m}");
            }
        }
    }
}

#[test]
fn invalid_storage_is_an_error() {
    let (_, map) = image(8, 4, Reconstruction::Bilinear, |i, j| (i + j) as f32);
    let array = map.into_array();
    let refused = |array: &[f32]| PackedMapRef::new(array).unwrap_err().to_string();
    assert_eq!(refused(&[]), "`array` must have 16 elements, got 0");
    assert_eq!(refused(&[1.0; 100]), "not a packed map: bad magic number 1");
    assert!(refused(&array[..array.len() - 1]).contains(&(array.len() - 1).to_string()));
    for index in 1..7 {
        let mut other = array.clone();
        for bits in [0, u32::MAX, 1 << 28, 3] {
            other[index] = f32::from_bits(bits);
            if other[index].to_bits() != array[index].to_bits() && (index, bits) != (1, 0) {
                assert!(PackedMapRef::new(&other).is_err(), "{index} {bits}");
            }
        }
    }
    // Modified numbers after a valid header give other normals, and nothing worse.
    let mut random = Random(1);
    for _ in 0..300 {
        let mut other = array.clone();
        for number in &mut other[16..] {
            if random.uniform() < 0.3 {
                *number = f32::from_bits(random.bits() as u32);
            }
        }
        let packed = PackedMapRef::new(&other).expect("the header is sound");
        for u in uniforms(20) {
            let n = packed.inverse(u);
            let _ = (packed.forward(n), packed.d(n.extend(0.5)), packed.forward(u * 2.0 - 1.0));
        }
    }
}
