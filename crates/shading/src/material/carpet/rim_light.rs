//! Rim light of soft surfaces, independent of the light.

use glam::Vec3;

use crate::material::fbm::smoothstep;

/// The fraction of the rim light at a point.
///
/// ```text
/// rim = smoothstep(1 − width, 1, 1 − |n·v|)
/// ```
///
/// - **Domain:** the unit normal `n` *without* bumps, which would be lit all over the surface; unit
///   view vector `v`; `width` in `[0, 1]`. A width of 0 or less lights only the silhouette itself,
///   where the formula is 0/0. NaN lights nothing.
/// - **Range:** [0, 1]; 1 on the silhouette.
///
/// Nilsson 2008, §4.2.6, after Kesson 2005.
pub(super) fn rim_light(normal: Vec3, view: Vec3, width: f32) -> f32 {
    smoothstep(1.0 - width, 1.0, 1.0 - normal.dot(view).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rim_light_of_zero_width_lights_only_the_silhouette() {
        let nearly = Vec3::new(1.0, 0.0, 1e-3);
        assert_eq!([Vec3::X, nearly, Vec3::Z].map(|v| rim_light(Vec3::Z, v, 0.0)), [1.0, 0.0, 0.0]);
    }

    #[test]
    fn rim_light_of_invalid_input_is_in_range() {
        let odd =
            [f32::NAN, f32::NEG_INFINITY, -1e30, -1.0, -1e-30, 0.0, 1e-30, 0.3, 1.0, 1e30, f32::INFINITY];
        for x in odd {
            for y in odd {
                for width in odd {
                    let rim = rim_light(Vec3::new(0.6, 0.0, 0.8), Vec3::new(x, 0.1, y), width);
                    assert!((0.0..=1.0).contains(&rim), "{x}, {y}, {width}: {rim}");
                }
            }
        }
    }
}
