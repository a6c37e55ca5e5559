//! The same bits at every SIMD level: batches against single points, for every kind, dimension and sum.

use asperity_lanes::{
    compare::{ORIGIN, Random, coordinate, cut, far_cases, grid, grids, lengths, near_cases, points},
    noise_kinds::{Testable, Visit, every_kind},
};
use asperity_noise::{
    GaussianOctaves, Grid, IntegerHash, Kernel, Normalisation, Octaves, Perlin2002, PermutationTable, Point,
    Rotation, Seeded, Simplex, Sparse, Spectrum, Tiled, TiledSimplex, ValueCatmullRom,
    glam::{Vec2, Vec3, Vec4},
};

struct Near;
struct Far;
struct Lengths;
struct Points;

impl Visit for Near {
    fn visit<V: Point<N> + 'static, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        grids(name, &Seeded(noise, 7), &|p: V| noise.sample(p, 7), &near_cases());
    }
}

impl Visit for Far {
    fn visit<V: Point<N> + 'static, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        grids(name, &Seeded(noise, 7), &|p: V| noise.sample(p, 7), &far_cases());
    }
}

impl Visit for Lengths {
    fn visit<V: Point<N> + 'static, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        lengths(name, &Seeded(noise, u32::MAX), &|p: V| noise.sample(p, u32::MAX));
    }
}

impl Visit for Points {
    fn visit<V: Point<N> + 'static, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        let (field, sample) = (Seeded(noise, 7), |p: V| noise.sample(p, 7));
        points(name, &field, &sample, 4001);
        for count in 0..20 {
            points(name, &field, &sample, count);
        }
        // The value alone is the sample's.
        let mut random = Random(5);
        for _ in 0..1000 {
            let p = V::from_coordinates([(); N].map(|()| coordinate(&mut random)));
            let [alone, value] = [noise.value(p, 7), noise.sample(p, 7).value].map(f32::to_bits);
            assert_eq!(alone, value, "{name} at {p:?}");
        }
    }
}

#[test]
fn near_grids_have_the_scalar_bits() {
    every_kind(&mut Near);
}

#[test]
fn far_grids_have_the_scalar_bits() {
    every_kind(&mut Far);
}

#[test]
fn rows_of_any_length_have_the_scalar_bits() {
    every_kind(&mut Lengths);
}

/// Lattices share all code but the hash, whose look-ups no register does.
#[test]
fn other_lattices_have_the_scalar_bits() {
    let table = PermutationTable::new(1);
    Near.visit::<Vec2, _, 2>("Perlin 2002 by permutation 2-D", Perlin2002(table));
    Points.visit::<Vec3, _, 3>("simplex by permutation 3-D", Simplex::WIDE.with_lattice(table));
    let tiled = Tiled::new(IntegerHash, [5, 3]).expect("periods in range");
    Near.visit::<Vec2, _, 2>("Perlin 2002 tiled 2-D", Perlin2002(tiled));
    Near.visit::<Vec2, _, 2>("Catmull-Rom tiled 2-D", ValueCatmullRom(tiled));
    Near.visit::<Vec2, _, 2>("sparse tiled 2-D", Sparse::default().with_lattice(tiled));
    let tiled = TiledSimplex::new(Simplex::CONTINUOUS, [3, 9, 6]).expect("multiples of three");
    Near.visit::<Vec3, _, 3>("simplex tiled 3-D", tiled);
    Points.visit::<Vec3, _, 3>("simplex tiled 3-D", tiled);
}

#[test]
fn points_have_the_scalar_bits() {
    every_kind(&mut Points);
}

fn sum<V: Point<N>, K: Kernel<N> + Copy, const N: usize>(name: &str, noise: K) {
    for rotation in [Rotation::Random, Rotation::Aligned] {
        for normalisation in [Normalisation::Range, Normalisation::Variance] {
            let octaves = Octaves::<K, N>::new(noise, Spectrum::default(), normalisation, 3);
            let octaves = octaves.with_rotation(rotation);
            let name = format!("{name} {N}-D {rotation:?} {normalisation:?}");
            for count in [3.4, 1.0, 0.0] {
                let (field, sample) = (octaves.first(count), |p: V| octaves.sample(p, count));
                grids(&name, &field, &sample, &near_cases()[..4]);
                points(&name, &field, &sample, 501);
            }
            let (field, sample) = (octaves.first(2.5), |p: V| octaves.sample(p, 2.5));
            grids(&name, &field, &sample, &far_cases());
            let step = V::from_coordinates(cut([-0.01, 0.3, 0.2, 0.1]));
            let mut size = [1; N];
            size[0] = 700;
            grid(&name, &field, &sample, &Grid { origin: V::from_coordinates(cut(ORIGIN)), step, size });
            let p = V::from_coordinates(cut(ORIGIN));
            assert_eq!(octaves.value(p, 3.4).to_bits(), octaves.sample(p, 3.4).value.to_bits(), "{name}");
        }
    }
}

fn sums<K: Kernel<1> + Kernel<2> + Kernel<3> + Kernel<4> + Copy>(name: &str, noise: K) {
    sum::<f32, K, 1>(name, noise);
    sum::<Vec2, K, 2>(name, noise);
    sum::<Vec3, K, 3>(name, noise);
    sum::<Vec4, K, 4>(name, noise);
}

#[test]
fn sums_have_the_scalar_bits() {
    sums("Perlin 2002", Perlin2002::default());
    sum::<Vec3, _, 3>("simplex", Simplex::CONTINUOUS);
}

fn gaussian_sum<V: Point<N>, const N: usize>() {
    let octaves = GaussianOctaves::<N>::new(Spectrum::default(), 3);
    for count in [3.4, 1.0, 0.0] {
        let (field, sample) = (octaves.first(count), |p: V| octaves.sample(p, count));
        grids("Gaussian octaves", &field, &sample, &near_cases()[..4]);
        grids("Gaussian octaves", &field, &sample, &far_cases());
        points("Gaussian octaves", &field, &sample, 501);
    }
}

#[test]
fn gaussian_sums_have_the_scalar_bits() {
    gaussian_sum::<f32, 1>();
    gaussian_sum::<Vec2, 2>();
    gaussian_sum::<Vec3, 3>();
    gaussian_sum::<Vec4, 4>();
}
