//! Batches of normals: equal to the calls within rounding, and to one lane bit for bit.

use asperity_ndf_sampling::{Batch, Beckmann, Ggx, InLanes, Ndf};
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
}

impl All {
    fn of<N: InLanes>(batch: Batch, ndf: &N, z: &Arrays<2>, u: &Arrays<2>) -> Self {
        let (mut normals, mut coordinates, mut samples) = (empty(), empty(), empty());
        let mut densities = empty::<1>();
        batch.from_gaussian(ndf, slices(z), mutable(&mut normals)).expect("one length");
        batch.to_gaussian(ndf, slices(&normals), mutable(&mut coordinates)).expect("one length");
        batch.density(ndf, slices(&normals), &mut densities[0]).expect("one length");
        batch.sample(ndf, slices(u), mutable(&mut samples)).expect("one length");
        Self { normals, coordinates, densities, samples }
    }

    fn bits(&self) -> Vec<u32> {
        let arrays = self.normals.iter().chain(&self.coordinates).chain(&self.densities).chain(&self.samples);
        arrays.flatten().map(|x| x.to_bits()).collect()
    }
}

fn inputs() -> (Arrays<2>, Arrays<2>) {
    let mut random = Random(31);
    let (mut z, mut u) = (empty(), empty());
    for k in 0..LEN {
        let [z1, z2] = random.gaussians();
        // Some far from the origin and some next to it.
        let scale = [1.0, 3.0, 1e-4][k % 3];
        (z[0][k], z[1][k]) = (z1 as f32 * scale, z2 as f32 * scale);
        (u[0][k], u[1][k]) = (random.uniform() as f32, random.uniform() as f32);
    }
    (z, u)
}

fn at<const I: usize>(arrays: &Arrays<I>, k: usize) -> [f32; I] {
    std::array::from_fn(|i| arrays[i][k])
}

/// The largest differences from the calls: normals over the tilt's scale, coordinates, relative densities, samples.
fn worst<N: InLanes>(ndf: &N, alpha: [f32; 2]) -> [f32; 4] {
    let (z, u) = inputs();
    let all = All::of(Batch::new(), ndf, &z, &u);
    let least = alpha[0].min(alpha[1]);
    let mut worst = [0.0_f32; 4];
    for k in 0..LEN {
        let (got, call) = (Vec3::from(at(&all.normals, k)), ndf.from_gaussian(Vec2::from(at(&z, k))));
        let tilt = |m: Vec3| (m.truncate() / least.max(1e-30)).length().max(1e-3);
        worst[0] = worst[0].max(((got - call).truncate() / least).length() / tilt(call));
        worst[1] = worst[1].max((Vec2::from(at(&all.coordinates, k)) - ndf.to_gaussian(got)).length());
        worst[2] = worst[2].max((all.densities[0][k] / ndf.density(got) - 1.0).abs());
        let (got, call) = (Vec3::from(at(&all.samples, k)), ndf.sample(Vec2::from(at(&u, k))));
        worst[3] = worst[3].max(((got - call).truncate() / least).length() / tilt(call));
    }
    worst
}

#[test]
fn batches_agree_with_the_calls() {
    for alpha in ALPHAS {
        let [x, y] = alpha;
        let ggx = worst(&Ggx::new(x, y).expect("valid"), alpha);
        let beckmann = worst(&Beckmann::new(x, y).expect("valid"), alpha);
        println!("{alpha:?}: ggx {ggx:.1e?}, beckmann {beckmann:.1e?}");
        for [normal, coordinate, density, sample] in [ggx, beckmann] {
            assert!(normal < 1e-6 && coordinate < 4e-6 && sample < 1e-6, "{alpha:?}");
            // The exponential magnifies the rounding of its argument, at most 81 for |z| ≤ 13.
            assert!(density < 2e-5, "{alpha:?}: {density:e}");
        }
    }
}

#[test]
fn registers_have_the_bits_of_one_lane() {
    let (mut z, mut u) = inputs();
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1e-40, 1e38, -1.0, 1.0];
    for (k, (x, y)) in bad.into_iter().flat_map(|x| bad.map(|y| (x, y))).enumerate() {
        (z[0][k], z[1][k], u[0][k], u[1][k]) = (x, y, y, x);
    }
    for [x, y] in ALPHAS {
        let (ggx, beckmann) = (Ggx::new(x, y).expect("valid"), Beckmann::new(x, y).expect("valid"));
        let of = |batch| [All::of(batch, &ggx, &z, &u), All::of(batch, &beckmann, &z, &u)];
        for (wide, single) in of(Batch::new()).iter().zip(&of(Batch::scalar())) {
            assert_eq!(wide.bits(), single.bits(), "{x} {y}");
            for k in 0..LEN {
                for m in [at(&wide.normals, k), at(&wide.samples, k)].map(Vec3::from) {
                    assert!((m.length() - 1.0).abs() < 1e-6 && m.z > 0.0, "{x} {y}, {k}: {m}");
                }
                assert!(
                    wide.coordinates.iter().chain(&wide.densities).all(|c| c[k].is_finite()),
                    "{x} {y}, {k}"
                );
            }
        }
    }
}
