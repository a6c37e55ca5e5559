//! Noise on lattices other than the default, tables and those that repeat, against the reference on the same words.

use asperity_noise::{
    Field, Gaussian, IntegerHash, Lattice, Noise, Perlin1985, Perlin2002, Simplex, Sparse, Tiled,
    TiledSimplex, Value, ValueCatmullRom, ValueGradient, White,
    glam::{Vec2, Vec3, Vec4},
    lattice::{ChainedTable, PermutationTable},
};
use asperity_tests::{noise_errors::errors_on, noise_reference::Kind};

/// The integer hash of cells modulo a period along each axis.
struct Wrapped([i32; 4]);

impl Lattice for Wrapped {
    fn word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
        let wrapped = std::array::from_fn::<i32, N, _>(|axis| cell[axis].rem_euclid(self.0[axis]));
        IntegerHash.word(wrapped, seed)
    }
}

/// The integer hash of the corners of simplices in space, told by six times their coordinates modulo six periods.
struct WrappedCorners([i32; 3]);

impl Lattice for WrappedCorners {
    fn word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
        let sum: i32 = cell.iter().sum();
        let corner =
            std::array::from_fn::<i32, N, _>(|axis| (6 * cell[axis] - sum).rem_euclid(6 * self.0[axis]));
        IntegerHash.word(corner, seed)
    }
}

/// Points are in ±16, several periods.
const DIVISOR: f32 = 256.0;
/// Of value and gradient, about twice the worst seen: 2.9e-6 and 6.6e-6 for Gaussian noise, 1.1e-6 and 2.4e-6 for others.
const TOLERANCE: [f64; 2] = [6e-6, 1.5e-5];
/// Corners of simplices are rounded by up to 28·2⁻²² = 7e-6 there; second derivatives reach 30. Worst seen 2.8e-6 and 2.1e-5.
const TOLERANCE_SIMPLEX: [f64; 2] = [6e-6, 5e-5];
const MARGIN: f64 = 1.0 - 2e-6;

fn assert_close(name: &str, dimension: usize, [value, gradient]: [f64; 2]) {
    let tolerance = if name.starts_with("simplex") { TOLERANCE_SIMPLEX } else { TOLERANCE };
    assert!(value < tolerance[0] && gradient < tolerance[1], "{name} {dimension}-D: {value:e}, {gradient:e}");
}

/// The errors of a kind in every dimension, asserted.
fn close<K>(name: &str, noise: &K, lattice: &impl Lattice, kind: Kind, scales: [f64; 4])
where
    K: Noise<f32> + Noise<Vec2> + Noise<Vec3> + Noise<Vec4> + Copy,
{
    let [line, plane, space, hyper] = scales;
    let errors = [
        errors_on(lattice, kind, line, DIVISOR, |p: f32, seed| {
            Noise::<f32>::with_seed(*noise, seed).sample(p)
        }),
        errors_on(lattice, kind, plane, DIVISOR, |p: Vec2, seed| {
            Noise::<Vec2>::with_seed(*noise, seed).sample(p)
        }),
        errors_on(lattice, kind, space, DIVISOR, |p: Vec3, seed| {
            Noise::<Vec3>::with_seed(*noise, seed).sample(p)
        }),
        errors_on(lattice, kind, hyper, DIVISOR, |p: Vec4, seed| {
            Noise::<Vec4>::with_seed(*noise, seed).sample(p)
        }),
    ];
    errors.into_iter().enumerate().for_each(|(i, errors)| assert_close(name, i + 1, errors));
}

/// Every kind that is blended on the integer lattice, on one lattice for the noise and one for the reference.
fn every_kind<L: Lattice + Copy>(name: &str, lattice: L, reference: &impl Lattice) {
    let all = |scale: f64| [scale; 4];
    let named = |kind: &str| format!("{kind} {name}");
    close(&named("white"), &White::default().with_lattice(lattice), reference, Kind::White, all(1.0));
    close(&named("value"), &Value::default().with_lattice(lattice), reference, Kind::Value, all(MARGIN));
    let spline = [0.8, 0.64, 0.512, 0.4096].map(|scale| scale * MARGIN);
    close(
        &named("Catmull-Rom"),
        &ValueCatmullRom::default().with_lattice(lattice),
        reference,
        Kind::CatmullRom,
        spline,
    );
    let noise = ValueGradient::default().with_lattice(lattice);
    close(&named("value-gradient"), &noise, reference, Kind::ValueGradient(0.5), all(MARGIN));
    let unit = [1.0, 2.0, 3.0, 4.0].map(|n: f64| MARGIN * 2.0 / n.sqrt());
    close(
        &named("Perlin 1985"),
        &Perlin1985::default().with_lattice(lattice),
        reference,
        Kind::Perlin1985,
        unit,
    );
    let edge = [0.5, 1.0, 1.036_353_8, 1.536_582_3].map(|greatest| MARGIN / greatest);
    close(
        &named("Perlin 2002"),
        &Perlin2002::default().with_lattice(lattice),
        reference,
        Kind::Perlin2002,
        edge,
    );
    let noise = Sparse::default().with_lattice(lattice);
    close(&named("sparse"), &noise, reference, Kind::Sparse(1), all(1.0));
    close(
        &named("Gaussian"),
        &Gaussian::default().with_lattice(lattice),
        reference,
        Kind::Gaussian(0),
        all(1.0),
    );
}

#[test]
fn every_kind_tiles_with_the_words_of_the_first_tile() {
    let lattice = Tiled::new(IntegerHash, [5, 3, 7, 2]).unwrap();
    every_kind("tiled", lattice, &Wrapped([5, 3, 7, 2]));
}

#[test]
fn simplex_noise_tiles_on_the_line_and_in_space() {
    for (noise, radius_squared, greatest) in [
        (Simplex::new(0), 0.5, [0.009_196_735, 0.013_007_157]),
        (Simplex::wide(0), f64::from(0.6_f32), [0.020_895_276, 0.030_584_887]),
    ] {
        let kind = Kind::Simplex(radius_squared);
        let [line, space] = greatest.map(|greatest| MARGIN / greatest);
        let tiled = noise.with_lattice(Tiled::new(IntegerHash, [5]).unwrap());
        let errors =
            errors_on(&Wrapped([5; 4]), kind, line, DIVISOR, |p: f32, seed| tiled.with_seed(seed).sample(p));
        assert_close("simplex", 1, errors);
        let (tiled, periods) = (TiledSimplex::new(noise, [3, 9, 6]).unwrap(), WrappedCorners([3, 9, 6]));
        let errors =
            errors_on(&periods, kind, space, DIVISOR, |p: Vec3, seed| tiled.with_seed(seed).sample(p));
        assert_close("simplex", 3, errors);
    }
}

#[test]
fn tables_take_the_place_of_the_hash() {
    let table = PermutationTable::new(1);
    every_kind("by permutation", table, &table);
    let chained = ChainedTable(table);
    let unit = [1.0, 2.0, 3.0, 4.0].map(|n: f64| MARGIN * 2.0 / n.sqrt());
    close(
        "Perlin 1985, chained",
        &Perlin1985::default().with_lattice(chained),
        &chained,
        Kind::Perlin1985,
        unit,
    );
}
