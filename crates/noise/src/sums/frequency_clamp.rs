//! Frequency clamping: octaves that a pixel cannot resolve are replaced by their mean.

use crate::point::Point;

/// Returns the fraction of an octave that a footprint removes.
///
/// It is 0 up to a fifth of a period and 1 from three fifths on.
///
/// ```text
/// k = smoothstep(0.2, 0.6, footprint · frequency),   smoothstep(a, b, x) = t² (3 − 2t),   t = clamp((x − a)/(b − a), 0, 1)
/// ```
///
/// - **Domain:** any. Negative and NaN arguments are taken as 0 and remove nothing.
/// - **Range:** [0, 1].
///
/// Nilsson 2008, section 4.1.6, `fadeout` with the item size 1/frequency.
///
/// ```
/// use asperity_noise::filtered_fraction;
///
/// assert_eq!([0.2, 0.6].map(|footprint| filtered_fraction(footprint, 1.0)), [0.0, 1.0]);
/// assert!((filtered_fraction(0.1, 4.0) - 0.5).abs() < 1e-6);
/// ```
#[must_use]
pub fn filtered_fraction(footprint: f32, frequency: f32) -> f32 {
    const LOW: f32 = 0.2;
    const HIGH: f32 = 0.6;
    let x = footprint * frequency;
    if x >= HIGH {
        1.0
    } else if x > LOW {
        let t = (x - LOW) / (HIGH - LOW);
        t * t * (3.0 - 2.0 * t)
    } else {
        0.0
    }
}

/// Returns the footprint of a pixel: the largest change of a coordinate to the next pixel in x or
/// y.
///
/// ```text
/// footprint = max over i of max(|∂pᵢ/∂x|, |∂pᵢ/∂y|)
/// ```
///
/// `ddx` and `ddy` are the changes of the noise's input from one pixel to the next. NaN components
/// are ignored.
///
/// - **Range:** [0, ∞].
///
/// Nilsson 2008, section 4.1.6.
///
/// ```
/// use asperity_noise::{glam::Vec2, pixel_footprint};
///
/// assert_eq!(pixel_footprint(Vec2::new(0.1, -0.5), Vec2::new(0.25, 0.0)), 0.5);
/// ```
#[must_use]
pub fn pixel_footprint<V: Point>(ddx: V, ddy: V) -> f32 {
    let (dx, dy) = (ddx.coordinates(), ddy.coordinates());
    dx.as_ref().iter().chain(dy.as_ref()).fold(0.0, |largest: f32, x| largest.max(x.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn filtered_fraction_rises_from_0_to_1() {
        let fractions = core::array::from_fn::<f32, 101, _>(|i| filtered_fraction(i as f32 / 100.0, 1.0));
        assert!(fractions.windows(2).all(|pair| pair[0] <= pair[1] && pair[1] - pair[0] < 0.04));
        assert_eq!((fractions[20], fractions[60], fractions[100]), (0.0, 1.0, 1.0));
        assert_eq!(filtered_fraction(0.05, 8.0), filtered_fraction(0.4, 1.0));
    }

    #[test]
    fn filtered_fraction_is_0_for_invalid_footprints() {
        for footprint in [0.0, -0.0, -3.0, f32::NEG_INFINITY, f32::NAN] {
            assert_eq!(filtered_fraction(footprint, 2.0), 0.0, "{footprint}");
        }
        assert_eq!(filtered_fraction(f32::INFINITY, 2.0), 1.0);
        assert_eq!(pixel_footprint(Vec3::NAN, Vec3::new(0.0, -2.0, 1.0)), 2.0);
        assert_eq!(pixel_footprint(0.25_f32, -0.5_f32), 0.5);
    }
}
