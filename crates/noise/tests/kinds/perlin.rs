//! Perlin noise of 2002 compared with the printed formula.

use approx::assert_abs_diff_eq;
use asperity_noise::{Field, IntegerHash, Lattice, Perlin, glam::Vec3, lattice::PerlinTable};

/// The formula as printed, over the eight corners of the cell; w(1 − t) = 1 − w(t).
fn improved_noise(p: Vec3, seed: u32) -> f32 {
    let w = |t: f32| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let sum = (0..8_u8).map(|c| {
        let corner = p.floor() + Vec3::from([c & 1, c >> 1 & 1, c >> 2].map(f32::from));
        let word = IntegerHash.upper_word(corner.to_array().map(|x| x as i32), seed);
        let (g, d) = (Vec3::from(Perlin::gradient::<3>(word)), p - corner);
        w(1.0 - d.x.abs()) * w(1.0 - d.y.abs()) * w(1.0 - d.z.abs()) * g.dot(d)
    });
    sum.sum::<f32>() / PerlinTable::SCALE
}

#[test]
fn perlin_2002_matches_printed_formula() {
    for i in 0..1000_u16 {
        let p = Vec3::new(0.37, -0.21, 0.83) * f32::from(i);
        // Twice the error that the crate page states.
        assert_abs_diff_eq!(Perlin::new(7).value(p), improved_noise(p, 7), epsilon = 3.4e-6);
    }
}
