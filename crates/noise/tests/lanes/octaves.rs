//! Octaves of a point in lanes compared with the same octaves one by one, bit by bit.

use asperity_noise::{
    Fbm, FbmSpectrum, Field, GaussianNoise, IntegerHash, Lattice, Perlin, Sample, Simplex, Turbulence,
    ValueNoise,
    glam::{Vec2, Vec3},
};

/// The default lattice as a lattice that octaves do not use in common, so that they are not
/// evaluated at once.
#[derive(Clone, Copy)]
struct OneByOne;

impl Lattice for OneByOne {
    const SHARED: bool = false;

    fn word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
        IntegerHash.word(cell, seed)
    }

    fn upper_word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
        IntegerHash.upper_word(cell, seed)
    }
}

const COUNTS: [f32; 10] = [0.0, 0.3, 1.0, 2.0, 3.0, 3.7, 4.0, 8.0, 9.5, 16.0];

/// Points near the origin, points where only fine octaves are beyond reach, and points that are not
/// finite.
fn space() -> impl Iterator<Item = Vec3> {
    let near = (0..40_u8).map(|i| Vec3::new(0.37, -1.21, 2.6) * f32::from(i) - 20.0);
    let far = [Vec3::new(4e3, -3e2, 0.5), Vec3::new(1e9, 0.3, -2e9), Vec3::splat(1e30)];
    let none = [Vec3::new(f32::NAN, 1.0, 2.0), Vec3::new(f32::INFINITY, 1.0, 2.0), Vec3::splat(-0.0)];
    near.chain(far).chain(none)
}

fn spectrum() -> FbmSpectrum {
    FbmSpectrum::new(2.17, 0.5, 16).expect("a spectrum in range")
}

fn bits(sample: &Sample<Vec3>) -> [u32; 4] {
    [sample.value, sample.gradient.x, sample.gradient.y, sample.gradient.z].map(f32::to_bits)
}

/// A sum's sample and value at a point. Not a `dyn Field`, which would compile its batches.
type At<'a> = &'a dyn Fn(Vec3) -> (Sample<Vec3>, f32);

fn same(name: &str, in_lanes: At<'_>, one_by_one: At<'_>) {
    for p in space() {
        let ((sample, value), (expected, _)) = (in_lanes(p), one_by_one(p));
        assert_eq!(bits(&sample), bits(&expected), "{name} at {p}");
        assert_eq!(value.to_bits(), expected.value.to_bits(), "{name}, value at {p}");
    }
}

#[test]
fn octaves_in_lanes_match_octaves_one_by_one() {
    macro_rules! kinds {
        ($($kind:expr),+) => {$(
            let in_lanes = Fbm::<_, Vec3>::new($kind, spectrum());
            let one_by_one = Fbm::<_, Vec3>::new($kind.with_lattice(OneByOne), spectrum());
            for count in COUNTS {
                let name = format!("{count} octaves of {:?}", $kind);
                let (sum, expected) = (in_lanes.with_octaves(count), one_by_one.with_octaves(count));
                same(&name, &|p| (sum.sample(p), sum.value(p)), &|p| (expected.sample(p), expected.value(p)));
                let sum = in_lanes.with_shape(Turbulence).with_octaves(count).band_limited(0.01);
                let expected = one_by_one.with_shape(Turbulence).with_octaves(count).band_limited(0.01);
                same(&name, &|p| (sum.sample(p), sum.value(p)), &|p| (expected.sample(p), expected.value(p)));
            }
        )+};
    }
    kinds!(GaussianNoise::new(7), Perlin::new(8), ValueNoise::new(9), Simplex::new(10));
}

#[test]
fn channels_in_lanes_match_octaves_one_by_one() {
    let in_lanes = Fbm::<_, Vec3>::new(GaussianNoise::new(7), spectrum());
    let one_by_one = Fbm::<_, Vec3>::new(GaussianNoise::new(7).with_lattice(OneByOne), spectrum());
    let flat = Fbm::<_, Vec2>::new(GaussianNoise::new(7), spectrum());
    let flat_one_by_one = Fbm::<_, Vec2>::new(GaussianNoise::new(7).with_lattice(OneByOne), spectrum());
    for count in COUNTS {
        for p in space() {
            let (pair, expected) =
                (in_lanes.pair_with_octaves(p, count), one_by_one.pair_with_octaves(p, count));
            assert_eq!(pair.each_ref().map(bits), expected.each_ref().map(bits), "{count} octaves at {p}");
            let q = Vec2::new(p.x, p.z);
            let (pair, expected) =
                (flat.pair_with_octaves(q, count), flat_one_by_one.pair_with_octaves(q, count));
            let bits = |sample: &Sample<Vec2>| {
                [sample.value, sample.gradient.x, sample.gradient.y].map(f32::to_bits)
            };
            assert_eq!(pair.each_ref().map(bits), expected.each_ref().map(bits), "{count} octaves at {q}");
        }
    }
}
