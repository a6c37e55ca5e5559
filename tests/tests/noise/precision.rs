//! The table "Precision" of the crate page: maximum errors of value and gradient against an `f64`
//! evaluation.

use asperity_noise::{
    GaussianNoise, IntegerHash, Perlin, PerlinClassic, Simplex, SparseConvolution, ValueCatmullRom,
    ValueGradient, ValueNoise,
};
use asperity_tests::{
    in_every_dimension,
    noise_any::{AnyNoise, dimensions},
    noise_kinds::AnyKind,
    noise_reference::Kind,
    random::Random,
};

const PAGE: &str = include_str!("../../../crates/noise/src/lib.rs");

/// Points in each dimension.
const POINTS: u32 = 100_000;

/// Raises the errors to the maximum errors of a noise in N dimensions.
fn largest<const N: usize>(
    _: &str,
    noise: &dyn AnyNoise<N>,
    (kind, reach, errors): (Kind, f64, &mut [f64; 2]),
) {
    let (scale, mut random) = (kind.scales()[N - 1], Random(7));
    let words = |cell: [i32; N], seed| kind.word(&IntegerHash, cell, seed);
    // The reference evaluates 3ⁿ or 4ⁿ lattice points a dozen times for a gradient.
    let many = matches!(kind, Kind::CatmullRom | Kind::Sparse(_));
    let points = if many && N > 2 { POINTS / [3, 30][N - 3] } else { POINTS };
    for seed in 0..points {
        let p = [(); N].map(|()| ((2.0 * random.uniform() - 1.0) * reach) as f32);
        let (wide, sample) = (p.map(f64::from), noise.sample(p, seed));
        let value = scale * kind.value_on(&words, wide, seed);
        errors[0] = errors[0].max((f64::from(sample.value) - value).abs());
        let Some(gradient) = kind.gradient_on(&words, wide, seed) else { continue };
        for (got, expected) in sample.gradient.into_iter().zip(gradient) {
            errors[1] = errors[1].max((f64::from(got) - scale * expected).abs());
        }
    }
}

/// Returns the errors stated on the page for a noise.
fn stated(name: &str) -> Option<[f64; 2]> {
    let section = PAGE.split("//! # Accuracy").nth(1)?.split("//! # ").next()?;
    let row = section.lines().find_map(|line| line.strip_prefix(&format!("//! | {name} | ")))?;
    let mut cells = row.split(" | ").map(|cell| cell.trim_end_matches(" |").parse().ok());
    Some([cells.next()??, cells.next()??])
}

#[test]
fn precision_table_bounds_the_errors_of_every_noise() {
    fn measured<K: AnyKind>(noise: K, kind: Kind, reach: f64) -> [f64; 2] {
        let mut errors = [0.0; 2];
        in_every_dimension!(dimensions("", noise), largest, (kind, reach, &mut errors));
        errors
    }
    let rows = [
        ("Perlin 1985", measured(PerlinClassic::new(0), Kind::PerlinClassic, 64.0)),
        ("Perlin 2002", measured(Perlin::new(0), Kind::Perlin, 64.0)),
        ("value, quintic", measured(ValueNoise::new(0), Kind::Value, 64.0)),
        ("value, Catmull–Rom", measured(ValueCatmullRom::new(0), Kind::CatmullRom, 64.0)),
        ("value-gradient, equal weights", measured(ValueGradient::new(0), Kind::ValueGradient(0.5), 64.0)),
        ("simplex, r² = 0.5", measured(Simplex::new(0), Kind::Simplex(0.5), 4.0)),
        (
            "simplex, r² = 0.6",
            measured(Simplex::new(0).with_classic_radius(), Kind::Simplex(f64::from(0.6_f32)), 4.0),
        ),
        ("sparse, one impulse", measured(SparseConvolution::new(0), Kind::Sparse(1), 64.0)),
        ("Gaussian", measured(GaussianNoise::new(0), Kind::Gaussian(0), 64.0)),
    ];
    let mut wrong = Vec::new();
    for (name, errors) in rows {
        // Points, seeds and bits are fixed, so that an error is at most the stated error, which is
        // rounded up to two digits.
        let holds = |stated: [f64; 2]| {
            stated.into_iter().zip(errors).all(|(stated, error)| error <= stated && stated < 1.15 * error)
        };
        if !stated(name).is_some_and(holds) {
            wrong.push(format!("| {name} | {:e} | {:e} | and not {:?}", errors[0], errors[1], stated(name)));
        }
    }
    assert!(wrong.is_empty(), "measured:\n{}", wrong.join("\n"));
}
