//! Diffuse light on resolved bumps.

use asperity_ndf_sampling::gaussian_cdf;
use core::f32::consts::FRAC_1_SQRT_2;
use glam::{Vec2, Vec3};

use crate::level_of_detail::ResolvedBumps;
use crate::math::{exp, sqrt};

/// The irradiance of a point of the resolved bumps over its mean over the surface.
///
/// ```text
/// max(0, 1 + X) / E[max(0, 1 + X)],     X = √(s/2) (α_x z_x ωi_x + α_y z_y ωi_y)/ωi_z ∼ N(0, σ²)
/// E[max(0, 1 + X)] = Φ(1/σ) + σ φ(1/σ)
/// ```
///
/// The slopes √(s/2) α z are those of Beckmann facets of the same α. `1 + X` is the cosine with the
/// normal over the cosine with the flat normal, times the area of the bump. The mean over the
/// surface is 1 for every direction of the light.
pub(super) fn relief(alpha: Vec2, wi: Vec3, bumps: ResolvedBumps) -> f32 {
    if !bumps.are_resolved() {
        return 1.0;
    }
    let along = alpha * wi.truncate() * (sqrt(bumps.variance.min(1.0)) * FRAC_1_SQRT_2 / wi.z);
    let deviation = along.length();
    // Beyond 5 standard deviations E is 1 to rounding.
    let mean = if deviation > 0.2 { positive_mean(deviation) } else { 1.0 };
    let lit = 1.0 + along.dot(bumps.z);
    // At the horizon both are infinite.
    if lit > 0.0 && mean.is_finite() { lit / mean } else { 0.0 }
}

/// `E[max(0, 1 + X)]` of a Gaussian X with mean 0.
fn positive_mean(deviation: f32) -> f32 {
    const FRAC_1_SQRT_2PI: f32 = 0.398_942_3;
    let z = 1.0 / deviation;
    gaussian_cdf(f64::from(z)) as f32 + deviation * FRAC_1_SQRT_2PI * exp(-0.5 * z * z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn relief_has_a_mean_of_one_over_gaussian_bumps() {
        for (alpha, variance) in [(0.1, 0.75), (0.5, 0.3), (1.0, 1.0)] {
            for cosine in [1.0_f32, 0.5, 0.1, 1e-3] {
                let wi = Vec3::new(
                    (1.0 - cosine * cosine).sqrt() * 0.6,
                    (1.0 - cosine * cosine).sqrt() * 0.8,
                    cosine,
                );
                let (mut sum, mut total) = (0.0, 0.0);
                for i in -80..=80_i8 {
                    for k in -80..=80_i8 {
                        let z = Vec2::new(f32::from(i), f32::from(k)) / 13.0;
                        let weight = f64::from((-0.5 * z.length_squared()).exp());
                        let bumps = ResolvedBumps { z, variance, blend: 1.0 };
                        sum += weight * f64::from(relief(Vec2::splat(alpha), wi, bumps));
                        total += weight;
                    }
                }
                // The kink at the terminator costs the sum h²/12 of its slope.
                assert_abs_diff_eq!(sum / total, 1.0, epsilon = 2e-3, "{alpha} {variance} {cosine}");
            }
        }
    }
}
