//! Every error of a constructor or batch contains the parameter, its rule and the invalid value.

use asperity_noise::{
    Cellular, FbmSpectrum, Field, NoiseError, Perlin, RidgedMultifractal, Simplex, SparseConvolution,
    ValueGradient, Warp, glam::Vec2, lattice::PermutationTable,
};
use std::error::Error;

/// Returns the error message.
fn says<T, E: Error>(result: Result<T, E>) -> String {
    result.map(|_| ()).expect_err("a refusal").to_string()
}

#[test]
fn errors_contain_parameter_and_value() {
    let noise = Perlin::new(1);
    let spectrum = |lacunarity, gain, octaves| says(FbmSpectrum::new(lacunarity, gain, octaves));
    let mut entries: [u8; 256] = std::array::from_fn(|i| i as u8);
    entries[9] = 3;
    let cases = [
        (spectrum(1.0, 0.5, 8), "`lacunarity` is invalid: 1 (must be finite and above 1)"),
        (spectrum(2.0, -1.5, 8), "`gain` is invalid: -1.5 (must be finite and above 0)"),
        (spectrum(2.0, 0.5, 17), "`max_octaves` is out of range: 17 (allowed: 1 to 16)"),
        (spectrum(1e4, 0.5, 16), "`lacunarity` is invalid: 10000 (the highest frequency must be finite)"),
        (spectrum(2.0, 1e3, 8), "`gain` is invalid: 1000 (fourth powers of amplitudes must be finite)"),
        (says(SparseConvolution::new(0).with_impulses(5)), "`impulses` is out of range: 5 (allowed: 1 to 4)"),
        (says(Cellular::new(0).with_jitter(1.5)), "`jitter` is out of range: 1.5 (allowed: 0 to 1)"),
        (says(ValueGradient::new(0).with_weight(-0.5)), "`weight` is out of range: -0.5 (allowed: 0 to 1)"),
        (says(Warp::new(noise, [noise; 2], f32::INFINITY)), "`strength` is invalid: inf (must be finite)"),
        (
            says(PermutationTable::from_entries(entries)),
            "`entries[9]` is a duplicate: 3 (must be a permutation of 0 to 255)",
        ),
        (says(noise.tiled([8, 0])), "`periods[1]` is out of range: 0 (allowed: 1 to 2097152)"),
        (says(Simplex::new(0).tiled([3, 6, 4])), "`periods[2]` is invalid: 4 (must be a multiple of 3)"),
        (
            NoiseError::OctavePeriod { axis: 1, period: 5, lacunarity: 2.5, octave: 3 }.to_string(),
            "the period of octave 3 is invalid: `periods[1]` 5 · `lacunarity` 2.5^3 (must be an integer up to 2097152)",
        ),
        (
            says(RidgedMultifractal::<_, Vec2>::new(noise, FbmSpectrum::CLOUD, -1.0)),
            "`feedback` is invalid: -1 (must be finite and at least 0)",
        ),
        (
            says(Field::<Vec2>::values(&noise, &[Vec2::ZERO; 2], &mut [0.0])),
            "`values` must have 2 elements, got 1",
        ),
    ];
    for (said, sentence) in cases {
        assert_eq!(said, sentence);
    }
}
