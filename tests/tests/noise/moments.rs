//! Variance and excess kurtosis of octave sums against exact moments.

use asperity_noise::FbmSpectrum;
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::reference::{read, rows};

#[test]
fn moments_of_blended_sums_match_the_reference() {
    let mut compared = 0;
    for row in rows(&read("ndf/fbm_moments.json")["rows"]) {
        let [gain, octaves, weight, variance, kurtosis] = row[..] else { panic!("{row:?}") };
        let spectrum = FbmSpectrum::new(2.0, gain as f32, octaves as u32).unwrap();
        let count = (octaves - 1.0 + weight) as f32;
        let deviation = f64::from(spectrum.root_sum_of_squares(count));
        // The weight is recovered from octaves − 1 + weight with the rounding of a number below 8:
        // 2.4e-7.
        assert_abs_diff_eq!(deviation * deviation / variance, 1.0, epsilon = 4e-6, "{row:?}: {deviation}");
        assert_abs_diff_eq!(
            f64::from(spectrum.kurtosis_ratio(count)) / kurtosis,
            1.0,
            epsilon = 4e-6,
            "{row:?}"
        );
        compared += 1;
    }
    assert_eq!(compared, 48);
}
