//! Tone curves, the sRGB transfer curve, and the color map of a density.

use glam::Vec3;

/// Soft shoulder: the identity up to 0.7, then an exponential approach to 1 with matching slope.
///
/// ```text
/// x ≤ k: x        x > k: k + (1 − k)(1 − exp(−(x − k)/(1 − k))),  k = 0.7
/// ```
pub fn shoulder(x: f32) -> f32 {
    const KNEE: f32 = 0.7;
    if x <= KNEE { x.max(0.0) } else { KNEE - (1.0 - KNEE) * (-(x - KNEE) / (1.0 - KNEE)).exp_m1() }
}

/// Film-like curve with toe and shoulder: darker shadows, highlights rolled off toward 1.
///
/// ```text
/// x (a x + b)/(x (c x + d) + e),   a = 2.51, b = 0.03, c = 2.43, d = 0.59, e = 0.14,   of 0.6 times the radiance
/// ```
///
/// Narkowicz 2016, "ACES Filmic Tone Mapping Curve".
pub fn filmic(radiance: f32) -> f32 {
    let x = (0.6 * radiance).clamp(0.0, 1e6);
    (x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)).min(1.0)
}

/// Converts linear `[0, 1]` to sRGB, IEC 61966-2-1.
pub fn srgb(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// The inverse of [`srgb`].
pub fn linear(srgb: f32) -> f32 {
    if srgb <= 0.040_45 { srgb / 12.92 } else { ((srgb + 0.055) / 1.055).powf(2.4) }
}

/// Returns the linear color of an sRGB hexadecimal, `0xRRGGBB`.
pub fn hex(rgb: u32) -> Vec3 {
    let [_, r, g, b] = rgb.to_be_bytes();
    Vec3::from([r, g, b].map(|byte| linear(f32::from(byte) / 255.0)))
}

/// Color map of a density, from zero to its peak: night, violet, ember, straw.
pub fn ember(t: f32) -> Vec3 {
    const STOPS: [u32; 6] = [0x1a_1b22, 0x3b_2557, 0x83_2f5e, 0xcc_5540, 0xf1_9b50, 0xfd_ebb8];
    let place = t.clamp(0.0, 1.0) * (STOPS.len() - 1) as f32;
    let k = (place as usize).min(STOPS.len() - 2);
    // Perceptually uniform between the stops: in square roots of the linear values.
    let root = |rgb: u32| hex(rgb).map(f32::sqrt);
    let mixed = root(STOPS[k]).lerp(root(STOPS[k + 1]), place - k as f32);
    mixed * mixed
}

pub(super) fn srgb_byte(value: f32) -> u8 {
    let clamped = if value > 0.0 { value.min(1.0) } else { 0.0 };
    (srgb(clamped) * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn curves_increase_from_black_to_white() {
        assert_eq!([filmic(0.0), filmic(-1.0), filmic(f32::INFINITY)], [0.0, 0.0, 1.0]);
        for (name, curve, top) in [("shoulder", shoulder as fn(f32) -> f32, 2.0), ("filmic", filmic, 7.0)] {
            let values: Vec<f32> = (0..100).map(|i| curve(i as f32 * 0.01 * top)).collect();
            assert!(values.windows(2).all(|pair| pair[0] < pair[1] && pair[1] < 1.0), "{name}: {values:?}");
        }
        // Photographic middle gray stays approximately constant.
        assert_abs_diff_eq!(filmic(0.18), 0.18, epsilon = 0.05);
        assert_abs_diff_eq!(shoulder(0.700_01) - shoulder(0.699_99), 0.000_02, epsilon = 1e-6);
    }

    #[test]
    fn ember_increases_in_lightness() {
        let lightness = |i: u8| ember(f32::from(i) / 50.0).dot(Vec3::new(0.2126, 0.7152, 0.0722));
        assert!((0..50).all(|i| lightness(i) < lightness(i + 1)));
        assert_eq!(ember(2.0), ember(1.0));
    }

    #[test]
    fn srgb_round_trip_of_every_byte() {
        for byte in 0..=255_u8 {
            assert_eq!(srgb_byte(linear(f32::from(byte) / 255.0)), byte);
        }
    }
}
