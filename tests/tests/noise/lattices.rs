//! Noise on nondefault lattices, tables and periodic lattices, against the reference on the same
//! words.

use asperity_noise::{
    Field, GaussianNoise, IntegerHash, Lattice, Noise, Perlin, PerlinClassic, Simplex, SparseConvolution,
    ValueCatmullRom, ValueGradient, ValueNoise, WhiteNoise,
    glam::{Vec2, Vec3, Vec4},
    lattice::{ChainedTable, PermutationTable},
};
use asperity_tests::{
    noise_any::{AnyLattice, at},
    noise_errors::{errors_by_dimension, errors_on},
    noise_reference::Kind,
};

/// The integer hash of cells modulo a period along each axis.
struct Wrapped([i32; 4]);

impl Wrapped {
    fn wrapped<const N: usize>(&self, cell: [i32; N]) -> [i32; N] {
        std::array::from_fn(|axis| cell[axis].rem_euclid(self.0[axis]))
    }
}

impl Lattice for Wrapped {
    fn word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
        IntegerHash.word(self.wrapped(cell), seed)
    }

    fn upper_word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
        IntegerHash.upper_word(self.wrapped(cell), seed)
    }
}

/// The integer hash of the corners of simplices in space, identified by six times their coordinates
/// modulo six periods.
struct WrappedCorners([i32; 3]);

impl WrappedCorners {
    fn wrapped<const N: usize>(&self, cell: [i32; N]) -> [i32; N] {
        let sum: i32 = cell.iter().sum();
        std::array::from_fn(|axis| (6 * cell[axis] - sum).rem_euclid(6 * self.0[axis]))
    }
}

impl Lattice for WrappedCorners {
    fn word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
        IntegerHash.word(self.wrapped(cell), seed)
    }

    fn upper_word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
        IntegerHash.upper_word(self.wrapped(cell), seed)
    }
}

/// Points are within ±16, several periods.
const DIVISOR: f32 = 256.0;
/// For value and gradient, about twice the maximum seen: 2.9e-6 and 6.6e-6 for Gaussian noise,
/// 1.1e-6 and 2.4e-6 for others.
const TOLERANCE: [f64; 2] = [6e-6, 1.5e-5];
/// Corners of simplices are rounded by up to 28·2⁻²² = 7e-6 there; second derivatives reach 30.
/// Maximum seen 2.8e-6 and 2.1e-5.
const TOLERANCE_SIMPLEX: [f64; 2] = [6e-6, 5e-5];

fn assert_close(name: &str, dimension: usize, [value, gradient]: [f64; 2]) {
    let tolerance = if name.starts_with("simplex") { TOLERANCE_SIMPLEX } else { TOLERANCE };
    assert!(value < tolerance[0] && gradient < tolerance[1], "{name} {dimension}-D: {value:e}, {gradient:e}");
}

/// Asserts the errors of a noise in every dimension.
fn close<K>(name: &str, noise: K, lattice: &impl Lattice, kind: Kind)
where
    K: Noise + Field<f32> + Field<Vec2> + Field<Vec3> + Field<Vec4> + Copy,
{
    let errors = errors_by_dimension(noise, lattice, kind, DIVISOR);
    (1..).zip(errors).for_each(|(dimension, errors)| assert_close(name, dimension, errors));
}

/// Asserts every noise on the integer lattice, on one lattice for the noise and one for the
/// reference.
fn every_kind(name: &str, lattice: AnyLattice<'_>, reference: &impl Lattice) {
    let named = |kind: &str| format!("{kind} {name}");
    close(&named("white"), WhiteNoise::default().with_lattice(lattice), reference, Kind::White);
    close(&named("value"), ValueNoise::default().with_lattice(lattice), reference, Kind::Value);
    let noise = ValueCatmullRom::default().with_lattice(lattice);
    close(&named("Catmull-Rom"), noise, reference, Kind::CatmullRom);
    let noise = ValueGradient::default().with_lattice(lattice);
    close(&named("value-gradient"), noise, reference, Kind::ValueGradient(0.5));
    close(
        &named("Perlin 1985"),
        PerlinClassic::default().with_lattice(lattice),
        reference,
        Kind::PerlinClassic,
    );
    close(&named("Perlin 2002"), Perlin::default().with_lattice(lattice), reference, Kind::Perlin);
    close(&named("sparse"), SparseConvolution::default().with_lattice(lattice), reference, Kind::Sparse(1));
    close(&named("Gaussian"), GaussianNoise::default().with_lattice(lattice), reference, Kind::Gaussian(0));
}

#[test]
fn noises_tile_with_the_words_of_the_first_tile() {
    const PERIODS: [u32; 4] = [5, 3, 7, 2];
    let reference = Wrapped([5, 3, 7, 2]);
    // One for each way to use cells: alone, at corners (like value, Perlin and Gaussian noise), at
    // 4ⁿ neighbors, at 3ⁿ.
    close("white, tiled", WhiteNoise::default().tiled(PERIODS).unwrap(), &reference, Kind::White);
    close(
        "Perlin 1985, tiled",
        PerlinClassic::default().tiled(PERIODS).unwrap(),
        &reference,
        Kind::PerlinClassic,
    );
    let noise = ValueCatmullRom::default().tiled(PERIODS).unwrap();
    close("Catmull-Rom, tiled", noise, &reference, Kind::CatmullRom);
    close("sparse, tiled", SparseConvolution::default().tiled(PERIODS).unwrap(), &reference, Kind::Sparse(1));
}

#[test]
fn simplex_noise_tiles_in_1d_and_3d() {
    for noise in [Simplex::new(0), Simplex::new(0).with_classic_radius()] {
        let kind = Kind::Simplex(noise.radius_squared().into());
        let tiled = noise.tiled([5]).unwrap();
        let words = |cell: [i32; 1], seed| Wrapped([5; 4]).upper_word(cell, seed);
        let line = |[x]: [f32; 1], seed| at(tiled.with_seed(seed).sample(x));
        assert_close("simplex", 1, errors_on(&words, kind, DIVISOR, &line));
        let tiled = noise.tiled([3, 9, 6]).unwrap();
        let words = |cell: [i32; 3], seed| WrappedCorners([3, 9, 6]).upper_word(cell, seed);
        let space = |p, seed| at(tiled.with_seed(seed).sample(Vec3::from(p)));
        assert_close("simplex", 3, errors_on(&words, kind, DIVISOR, &space));
    }
}

/// Returns the word of a cell with 1 to 4 coordinates.
fn word(lattice: &impl Lattice, cell: &[i32], seed: u32) -> u32 {
    match *cell {
        [x] => lattice.word([x], seed),
        [x, y] => lattice.word([x, y], seed),
        [x, y, z] => lattice.word([x, y, z], seed),
        [x, y, z, w] => lattice.word([x, y, z, w], seed),
        _ => panic!("a cell of {} coordinates", cell.len()),
    }
}

#[test]
fn tables_replace_the_hash() {
    let table = PermutationTable::new(1);
    let words = |cell: &[i32], seed| word(&table, cell, seed);
    every_kind("by permutation", AnyLattice(&words), &table);
    let chained = ChainedTable(table);
    let words = |cell: &[i32], seed| word(&chained, cell, seed);
    let noise = PerlinClassic::default().with_lattice(AnyLattice(&words));
    close("Perlin 1985, chained", noise, &chained, Kind::PerlinClassic);
}
