//! Gaussian variates and directions from the bits of a lattice word, without logarithm or trigonometry.

use glam::{Vec2, Vec3};

use crate::{gaussian_levels::POSITIVE_LEVELS, math};

/// 4096 equally likely levels with the moments of N(0, 1) up to the fifth.
static LEVELS: [f32; 4096] = signed(&POSITIVE_LEVELS);

const fn signed(positive: &[f32; 2048]) -> [f32; 4096] {
    let mut levels = [0.0; 4096];
    let mut k = 0;
    while k < 2048 {
        levels[2047 - k] = -positive[k];
        levels[2048 + k] = positive[k];
        k += 1;
    }
    levels
}

/// The level of the twelve bits of `word` from `shift` on.
#[inline(always)]
fn level(word: u64, shift: u32) -> f32 {
    LEVELS[((word >> shift) & 0xfff) as usize]
}

/// The Gaussian value and gradient of a planar lattice point, [s, gₓ, g_y], independent N(0, 1).
///
/// ```text
/// s = (T[bits 4…15] + T[bits 16…27])/√2,   gₓ = T[bits 28…39],   g_y = T[bits 40…51]
/// ```
///
/// T holds 4096 equally likely levels: medians of equal slices of N(0, 1), scaled, and the outermost moved to ±3.78, so
/// that second and fourth moment are 1 and 3. The value has 2²³ levels because it stands alone at lattice points; the gradient's parts never do.
///
/// - **Range:** |s| ≤ 5.35, |g| ≤ 3.78.
/// - **Accuracy:** KS distance to N(0, 1) under 1.3e-4 for T; excess kurtosis 0 to `f32` rounding.
#[must_use]
#[inline(always)]
pub fn gaussian_variates_2(word: u64) -> [f32; 3] {
    [value(word), level(word, 28), level(word, 40)]
}

/// The Gaussian value and gradient of a lattice point in space, [s, gₓ, g_y, g_z], independent N(0, 1).
///
/// As [`gaussian_variates_2`], with g_z = T[bits 52…63].
#[must_use]
#[inline(always)]
pub fn gaussian_variates_3(word: u64) -> [f32; 4] {
    [value(word), level(word, 28), level(word, 40), level(word, 52)]
}

#[inline(always)]
fn value(word: u64) -> f32 {
    (level(word, 4) + level(word, 16)) * core::f32::consts::FRAC_1_SQRT_2
}

/// A direction uniform on the circle: two Gaussian variates of the word, normalised.
///
/// - **Accuracy:** unit length within 1.8e-7.
#[must_use]
#[inline]
pub fn unit_direction_2(word: u64) -> Vec2 {
    let [_, x, y] = gaussian_variates_2(word);
    let inverse = 1.0 / math::sqrt(x * x + y * y);
    Vec2::new(x * inverse, y * inverse)
}

/// A direction uniform on the sphere: three Gaussian variates of the word, normalised.
///
/// Ebert (ed.) 1994 draws z = 1 − 2u and an angle 2πv instead: the same distribution, but its sine and cosine would round
/// differently from platform to platform.
///
/// - **Accuracy:** unit length within 1.8e-7.
#[must_use]
#[inline]
pub fn unit_direction_3(word: u64) -> Vec3 {
    let [_, x, y, z] = gaussian_variates_3(word);
    let inverse = 1.0 / math::sqrt(x * x + y * y + z * z);
    Vec3::new(x * inverse, y * inverse, z * inverse)
}

/// One of the eight directions (±√2, 0), (0, ±√2), (±1, ±1), equally likely, by the word's top three bits.
#[must_use]
#[inline]
pub fn edge_direction_2(word: u64) -> Vec2 {
    const R: f32 = core::f32::consts::SQRT_2;
    const DIRECTIONS: [[f32; 2]; 8] =
        [[R, 0.0], [1.0, 1.0], [0.0, R], [-1.0, 1.0], [-R, 0.0], [-1.0, -1.0], [0.0, -R], [1.0, -1.0]];
    Vec2::from_array(DIRECTIONS[(word >> 61) as usize])
}

/// One of the twelve directions to the edges of a cube, (±1, ±1, 0) and its rotations, equally likely within 3e-9.
///
/// Perlin 2002, "Improving Noise", without the four that he doubled to fill sixteen.
#[must_use]
#[inline]
pub fn edge_direction_3(word: u64) -> Vec3 {
    const DIRECTIONS: [[f32; 3]; 16] = [
        [1.0, 1.0, 0.0],
        [-1.0, 1.0, 0.0],
        [1.0, -1.0, 0.0],
        [-1.0, -1.0, 0.0],
        [1.0, 0.0, 1.0],
        [-1.0, 0.0, 1.0],
        [1.0, 0.0, -1.0],
        [-1.0, 0.0, -1.0],
        [0.0, 1.0, 1.0],
        [0.0, -1.0, 1.0],
        [0.0, 1.0, -1.0],
        [0.0, -1.0, -1.0],
        // Never drawn; sixteen entries spare the bounds check.
        [0.0; 3],
        [0.0; 3],
        [0.0; 3],
        [0.0; 3],
    ];
    Vec3::from_array(DIRECTIONS[(((word >> 32) * 12) >> 32) as usize & 15])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integer_hash::mix;

    #[test]
    fn levels_have_the_moments_of_the_normal_distribution() {
        let mean = |power: i32| {
            let sum: f64 =
                LEVELS.iter().map(|&x| (0..power).fold(1.0, |product, _| product * f64::from(x))).sum();
            sum / 4096.0
        };
        // Levels rounded to `f32` miss by 1e-9.
        for (power, moment) in [(1, 0.0), (2, 1.0), (3, 0.0), (4, 3.0)] {
            assert!((mean(power) - moment).abs() < 1e-7, "moment {power}: {}", mean(power));
        }
        assert!(LEVELS.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(LEVELS[4095] < 3.78 && LEVELS[4095] * core::f32::consts::SQRT_2 < 5.35);
    }

    #[test]
    fn directions_have_their_lengths() {
        for counter in 0..10_000 {
            let word = mix(counter);
            let (u2, u3) = (unit_direction_2(word), unit_direction_3(word));
            let square = |x: f32| f64::from(x) * f64::from(x);
            assert!((square(u2.x) + square(u2.y) - 1.0).abs() < 3.6e-7, "{u2}");
            assert!((square(u3.x) + square(u3.y) + square(u3.z) - 1.0).abs() < 3.6e-7, "{u3}");
            let (e2, e3) = (edge_direction_2(word), edge_direction_3(word));
            assert!((e2.x * e2.x + e2.y * e2.y - 2.0).abs() < 3e-7, "{e2}");
            assert_eq!(e3.x * e3.x + e3.y * e3.y + e3.z * e3.z, 2.0, "{e3}");
        }
    }

    #[test]
    fn the_extreme_words_draw_the_last_direction() {
        assert_eq!(edge_direction_3(u64::MAX), Vec3::new(0.0, -1.0, -1.0));
        assert_eq!(edge_direction_2(u64::MAX), Vec2::new(1.0, -1.0));
    }
}
