//! Batches of normals: equal to single calls, which use one lane, bit for bit.

use asperity_ndf_sampling::{Beckmann, ClosedForm, Ggx, Microfacet};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;
use glam::{Vec2, Vec3};

/// One more than a multiple of the register width, so that the last register is partially filled.
const LEN: usize = 4097;
const ALPHAS: [[f32; 2]; 5] = [[1e-4, 1e-4], [0.02, 0.2], [0.3, 0.3], [1.0, 0.1], [1.0, 1.0]];

/// `[I]` arrays of one batch.
type Arrays<const I: usize> = [Vec<f32>; I];

fn empty<const I: usize>() -> Arrays<I> {
    std::array::from_fn(|_| vec![0.0; LEN])
}

fn slices<const I: usize>(arrays: &Arrays<I>) -> [&[f32]; I] {
    std::array::from_fn(|k| arrays[k].as_slice())
}

fn mutable<const I: usize>(arrays: &mut Arrays<I>) -> [&mut [f32]; I] {
    arrays.each_mut().map(Vec::as_mut_slice)
}

/// Gaussian coordinates, uniform numbers and views.
struct Inputs {
    z: Arrays<2>,
    u: Arrays<2>,
    v: Arrays<3>,
}

fn inputs() -> Inputs {
    let mut random = Random(31);
    let (mut z, mut u, mut v) = (empty(), empty(), empty());
    for k in 0..LEN {
        let [z1, z2] = random.gaussians();
        // Some far from the origin and some near it.
        let scale = [1.0, 3.0, 1e-4][k % 3];
        (z[0][k], z[1][k]) = (z1 as f32 * scale, z2 as f32 * scale);
        (u[0][k], u[1][k]) = (random.uniform() as f32, random.uniform() as f32);
        // Some views from the zenith and some from the horizon.
        let up = [random.uniform() as f32, 1.0, 1e-3][k % 3];
        let (sin, cos) = (z1 as f32).sin_cos();
        let across = (1.0 - up * up).sqrt();
        (v[0][k], v[1][k], v[2][k]) = (across * cos, across * sin, up);
    }
    Inputs { z, u, v }
}

fn at<const I: usize>(arrays: &Arrays<I>, k: usize) -> [f32; I] {
    std::array::from_fn(|i| arrays[i][k])
}

/// Fills arrays and compares them with single calls, bit for bit. For visible normals the maximum
/// difference is returned, in units of u.
fn compare<N: ClosedForm + Microfacet>(ndf: &N, alpha: [f32; 2], Inputs { z, u, v }: &Inputs) -> f32 {
    let (mut normals, mut coordinates, mut densities) = (empty(), empty(), empty::<1>());
    let (mut samples, mut visible) = (empty(), empty());
    ndf.warp_gaussian_batch(slices(z), mutable(&mut normals)).expect("one length");
    ndf.invert_batch(slices(&normals), mutable(&mut coordinates)).expect("one length");
    ndf.d_batch(slices(&normals), &mut densities[0]).expect("one length");
    ndf.sample_batch(slices(u), mutable(&mut samples)).expect("one length");
    ndf.sample_visible_batch(slices(v), slices(u), mutable(&mut visible)).expect("one length");
    let bits3 = |m: Vec3| m.to_array().map(f32::to_bits);
    let mut worst = 0.0_f32;
    for k in 0..LEN {
        let (z, u, v) = (Vec2::from(at(z, k)), Vec2::from(at(u, k)), Vec3::from(at(v, k)));
        let [m, drawn, seen] = [&normals, &samples, &visible].map(|arrays| Vec3::from(at(arrays, k)));
        for m in [m, drawn, seen] {
            assert_abs_diff_eq!(m.length(), 1.0, epsilon = 1e-6, "{alpha:?}, {k}: {m}");
            assert!(m.z > 0.0, "{alpha:?}, {k}: {m}");
        }
        assert_eq!(bits3(m), bits3(ndf.warp_gaussian(z)), "{alpha:?}: T({z})");
        assert_eq!(bits3(drawn), bits3(ndf.sample(u)), "{alpha:?}: sample of {u}");
        let filled = [coordinates[0][k], coordinates[1][k], densities[0][k]];
        let called = ndf.invert(m).extend(ndf.d(m));
        assert_eq!(filled.map(f32::to_bits), bits3(called), "{alpha:?}: T⁻¹ and D of {m}");
        // In the space with roughness 1, times the square root of u, because the distribution
        // starts like a square there.
        let called = ndf.sample_visible(v, u);
        let slope = |m: Vec3| m.truncate() / m.z / Vec2::from(alpha);
        let edge = u.x.min(1.0 - u.x).min(u.y).min(1.0 - u.y);
        let error = (slope(seen) - slope(called)).length() / (1.0 + slope(called).length_squared()) * edge;
        worst = worst.max(if seen == called { 0.0 } else { error });
    }
    worst
}

#[test]
fn batches_equal_single_calls() {
    let inputs = inputs();
    for alpha in ALPHAS {
        let ggx = compare(&Ggx::new(alpha[0], alpha[1]).expect("valid"), alpha, &inputs);
        assert_eq!(ggx, 0.0, "{alpha:?}: visible normals of GGX");
        // Single calls invert in f64.
        let beckmann = compare(&Beckmann::new(alpha[0], alpha[1]).expect("valid"), alpha, &inputs);
        assert!(beckmann < 1e-6, "{alpha:?}: visible normals of Beckmann differ by {beckmann:e}");
    }
}

#[test]
fn batches_accept_every_input() {
    let mut inputs = inputs();
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1e-40, 1e38, -1.0, 1.0];
    for (k, (x, y)) in bad.into_iter().flat_map(|x| bad.map(|y| (x, y))).enumerate() {
        let Inputs { z, u, v } = &mut inputs;
        (z[0][k], z[1][k], u[0][k], u[1][k]) = (x, y, y, x);
        (v[0][k], v[1][k], v[2][k]) = (x, y, bad[k % bad.len()]);
    }
    for alpha in ALPHAS {
        assert_eq!(compare(&Ggx::new(alpha[0], alpha[1]).expect("valid"), alpha, &inputs), 0.0, "{alpha:?}");
        compare(&Beckmann::new(alpha[0], alpha[1]).expect("valid"), alpha, &inputs);
    }
}
