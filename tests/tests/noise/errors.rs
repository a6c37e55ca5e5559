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
        (spectrum(1.0, 0.5, 8), "`lacunarity` must be finite and above 1, got 1"),
        (spectrum(2.0, -1.5, 8), "`gain` must be finite and above 0, got -1.5"),
        (spectrum(2.0, 0.5, 17), "`max_octaves` must be between 1 and 16, got 17"),
        (
            spectrum(1e4, 0.5, 16),
            "`lacunarity` must be small enough for a finite highest frequency, got 10000",
        ),
        (
            spectrum(2.0, 1e3, 8),
            "`gain` must be small enough for finite fourth powers of amplitudes, got 1000",
        ),
        (says(SparseConvolution::new(0).with_impulses(5)), "`impulses` must be between 1 and 4, got 5"),
        (says(Cellular::new(0).with_jitter(1.5)), "`jitter` must be between 0 and 1, got 1.5"),
        (says(ValueGradient::new(0).with_weight(-0.5)), "`weight` must be between 0 and 1, got -0.5"),
        (says(Warp::new(noise, [noise; 2], f32::INFINITY)), "`strength` must be finite, got inf"),
        (
            says(PermutationTable::from_entries(entries)),
            "`entries` must be a permutation of 0 to 255, got 3 again at index 9",
        ),
        (says(noise.tiled([8, 0])), "`periods[1]` must be between 1 and 2097152, got 0"),
        (says(Simplex::new(0).tiled([3, 6, 4])), "`periods[2]` must be a multiple of 3, got 4"),
        (
            NoiseError::OctavePeriod { axis: 1, period: 5, lacunarity: 2.5, octave: 3 }.to_string(),
            "`periods[1]` · `lacunarity`^3 must be an integer up to 2097152, got 5 · 2.5^3",
        ),
        (
            says(RidgedMultifractal::<_, Vec2>::new(noise, FbmSpectrum::CLOUD, -1.0)),
            "`feedback` must be finite and at least 0, got -1",
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
