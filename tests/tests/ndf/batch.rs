//! Batches of normals: equal to the calls within rounding, and to one lane bit for bit.

use asperity_ndf_sampling::{
    Beckmann, Ggx, Microfacet,
    simd::{ClosedForm, Level},
};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;
use glam::{Vec2, Vec3};

/// One more than a whole number of registers, so that the last one is filled in part.
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

/// Everything a batch computes of a density at Gaussian coordinates `z` and uniform numbers `u`.
struct All {
    normals: Arrays<3>,
    coordinates: Arrays<2>,
    densities: Arrays<1>,
    samples: Arrays<3>,
    visible: Arrays<3>,
}

impl All {
    fn of<N: ClosedForm>(level: Level, ndf: &N, Inputs { z, u, v }: &Inputs) -> Self {
        let (mut normals, mut coordinates) = (empty(), empty());
        let (mut samples, mut visible) = (empty(), empty());
        let mut densities = empty::<1>();
        level.normals(ndf, slices(z), mutable(&mut normals)).expect("one length");
        level.coordinates(ndf, slices(&normals), mutable(&mut coordinates)).expect("one length");
        level.densities(ndf, slices(&normals), &mut densities[0]).expect("one length");
        level.samples(ndf, slices(u), mutable(&mut samples)).expect("one length");
        level.visible_samples(ndf, slices(v), slices(u), mutable(&mut visible)).expect("one length");
        Self { normals, coordinates, densities, samples, visible }
    }

    fn bits(&self) -> Vec<u32> {
        let numbers = self.coordinates.iter().chain(&self.densities);
        let normals = self.normals.iter().chain(&self.samples).chain(&self.visible);
        numbers.chain(normals).flatten().map(|x| x.to_bits()).collect()
    }
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
        // Some far from the origin and some next to it.
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

/// The largest differences from the calls: normals over the tilt's scale, coordinates, relative densities, samples, and
/// visible normals in units of u.
fn worst<N: ClosedForm + Microfacet>(ndf: &N, alpha: [f32; 2]) -> [f32; 5] {
    let inputs = inputs();
    let Inputs { z, u, v } = &inputs;
    let all = All::of(Level::best(), ndf, &inputs);
    let least = alpha[0].min(alpha[1]);
    let mut worst = [0.0_f32; 5];
    for k in 0..LEN {
        let (got, call) = (Vec3::from(at(&all.normals, k)), ndf.from_gaussian(Vec2::from(at(z, k))));
        let tilt = |m: Vec3| (m.truncate() / least.max(1e-30)).length().max(1e-3);
        worst[0] = worst[0].max(((got - call).truncate() / least).length() / tilt(call));
        worst[1] = worst[1].max((Vec2::from(at(&all.coordinates, k)) - ndf.to_gaussian(got)).length());
        worst[2] = worst[2].max((all.densities[0][k] / ndf.density(got) - 1.0).abs());
        let (got, call) = (Vec3::from(at(&all.samples, k)), ndf.sample(Vec2::from(at(u, k))));
        worst[3] = worst[3].max(((got - call).truncate() / least).length() / tilt(call));
        let u = Vec2::from(at(u, k));
        let (got, call) = (Vec3::from(at(&all.visible, k)), ndf.sample_visible(Vec3::from(at(v, k)), u));
        // In the space where the roughness is 1, times the root of u, for there the distribution starts like a square.
        let slope = |m: Vec3| m.truncate() / m.z / Vec2::from(alpha);
        let edge = u.x.min(1.0 - u.x).min(u.y).min(1.0 - u.y);
        worst[4] =
            worst[4].max((slope(got) - slope(call)).length() / (1.0 + slope(call).length_squared()) * edge);
    }
    worst
}

#[test]
fn batches_agree_with_the_calls() {
    for alpha in ALPHAS {
        let [x, y] = alpha;
        let ggx = worst(&Ggx::new(x, y).expect("valid"), alpha);
        let beckmann = worst(&Beckmann::new(x, y).expect("valid"), alpha);
        println!("{alpha:?}: ggx {ggx:?}, beckmann {beckmann:?}");
        for [normal, coordinate, density, sample, visible] in [ggx, beckmann] {
            assert!(normal < 1e-6 && coordinate < 3e-6 && sample < 1e-6, "{alpha:?}");
            assert!(visible < 1e-6, "{alpha:?}: {visible:e}");
            // The exponential magnifies the rounding of its argument, at most 81, by that: 2 · 81 · 1.2e-7. Measured 1.5e-5.
            assert!(density < 2e-5, "{alpha:?}: {density:e}");
        }
    }
}

#[test]
fn registers_have_the_bits_of_one_lane() {
    let mut inputs = inputs();
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1e-40, 1e38, -1.0, 1.0];
    for (k, (x, y)) in bad.into_iter().flat_map(|x| bad.map(|y| (x, y))).enumerate() {
        let Inputs { z, u, v } = &mut inputs;
        (z[0][k], z[1][k], u[0][k], u[1][k]) = (x, y, y, x);
        (v[0][k], v[1][k], v[2][k]) = (x, y, bad[k % bad.len()]);
    }
    for [x, y] in ALPHAS {
        let (ggx, beckmann) = (Ggx::new(x, y).expect("valid"), Beckmann::new(x, y).expect("valid"));
        let of = |level| [All::of(level, &ggx, &inputs), All::of(level, &beckmann, &inputs)];
        for (wide, single) in of(Level::best()).iter().zip(&of(Level::scalar())) {
            assert_eq!(wide.bits(), single.bits(), "{x} {y}");
            for k in 0..LEN {
                for m in [&wide.normals, &wide.samples, &wide.visible].map(|m| Vec3::from(at(m, k))) {
                    assert_abs_diff_eq!(m.length(), 1.0, epsilon = 1e-6, "{x} {y}, {k}: {m}");
                    assert!(m.z > 0.0, "{x} {y}, {k}: {m}");
                }
                assert!(
                    wide.coordinates.iter().chain(&wide.densities).all(|c| c[k].is_finite()),
                    "{x} {y}, {k}"
                );
            }
        }
    }
}
