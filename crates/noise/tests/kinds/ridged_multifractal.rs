//! The ridged multifractal: settings, and sums with known values.

use approx::assert_abs_diff_eq;
use asperity_noise::{
    Fbm, FbmSpectrum, Field, NoiseError, Normalization, Perlin, Ridged, RidgedMultifractal,
    glam::{Vec2, Vec3},
};

#[test]
fn ridged_multifractal_rejects_invalid_feedback() {
    let new = |feedback| RidgedMultifractal::<_, Vec2>::new(Perlin::new(1), FbmSpectrum::default(), feedback);
    for feedback in [-1.0, f32::INFINITY] {
        let error =
            NoiseError::Invalid { parameter: "feedback", value: feedback, rule: "finite and at least 0" };
        assert_eq!(new(feedback), Err(error));
    }
    assert!(new(f32::NAN).is_err() && new(0.0).is_ok());
}

#[test]
fn ridged_multifractal_of_one_octave_is_ridged() {
    let ridges = RidgedMultifractal::new(Perlin::new(1), FbmSpectrum::default(), 1.0).unwrap();
    let octaves =
        Fbm::new(Perlin::new(1), FbmSpectrum::default()).with_normalization(Normalization::UnitRange);
    let octaves = octaves.with_shape(Ridged);
    let p = Vec3::new(0.2, 7.1, -3.4);
    assert_eq!(ridges.with_octaves(1.0).sample(p), octaves.with_octaves(1.0).sample(p));
    assert_ne!(ridges.with_octaves(2.0).sample(p), octaves.with_octaves(2.0).sample(p));
    assert_eq!(ridges.with_octaves(5.0).value(p), ridges.with_octaves(5.0).sample(p).value);
}

#[test]
fn ridged_multifractal_without_feedback_is_its_first_octave() {
    let ridges = RidgedMultifractal::new(Perlin::new(1), FbmSpectrum::default(), 0.0).unwrap();
    let p = Vec3::new(0.2, 7.1, -3.4);
    let [one, three] = [1.0, 3.0].map(|octaves| ridges.with_octaves(octaves).value(p));
    assert_abs_diff_eq!(three * 1.75, one, epsilon = 1e-6);
}
