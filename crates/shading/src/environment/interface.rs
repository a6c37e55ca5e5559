//! The `Environment` trait: light from infinitely far away.

use core::f32::consts::{FRAC_1_PI, TAU};

use glam::{Vec2, Vec3};

use crate::math::{clamp_to, cos, sin, sqrt};

/// Light from infinitely far away: radiance by direction, and importance sampling.
///
/// ```text
/// L_o(ωo) = ∫ f_r(ωi, ωo) L(ωi) cos θ_i dω_i
/// ```
///
/// Directions are in the world frame, whose z axis is up, and point towards the light. Their length
/// is ignored. Colors are linear RGB. The trait is dyn-compatible.
///
/// Every implementation in this crate accepts every input. An invalid direction (zero, NaN,
/// infinite) is dark and has pdf 0. A color is a uniform environment.
///
/// ```
/// use asperity_shading::{Environment, glam::{Vec2, Vec3}};
///
/// let fog = Vec3::splat(0.5);
/// let wi = fog.sample(Vec2::new(0.3, 0.8));
/// assert_eq!(fog.radiance(wi), fog);
/// // The mean of radiance/pdf is the integral over the sphere, 4π L, here for every sample.
/// assert!((fog.radiance(wi) / fog.pdf(wi) / (4.0 * core::f32::consts::PI) - fog).length() < 1e-6);
/// ```
pub trait Environment {
    /// The radiance that arrives from `direction`, at least 0 in each channel.
    #[must_use]
    fn radiance(&self, direction: Vec3) -> Vec3;

    /// Samples a unit direction with [`pdf`](Environment::pdf), from a uniform `u`.
    ///
    /// The default is uniform on the sphere. Numbers are clamped to `[0, 1)`, NaN is read as 0.
    #[must_use]
    fn sample(&self, u: Vec2) -> Vec3 {
        uniform_sphere(u)
    }

    /// The density of [`sample`](Environment::sample) over solid angle, in sr⁻¹.
    #[must_use]
    fn pdf(&self, direction: Vec3) -> f32 {
        if is_direction(direction) { 0.25 * FRAC_1_PI } else { 0.0 }
    }
}

impl<E: Environment + ?Sized> Environment for &E {
    fn radiance(&self, direction: Vec3) -> Vec3 {
        (**self).radiance(direction)
    }

    fn sample(&self, u: Vec2) -> Vec3 {
        (**self).sample(u)
    }

    fn pdf(&self, direction: Vec3) -> f32 {
        (**self).pdf(direction)
    }
}

/// Constant radiance from everywhere; negative numbers and NaN are read as 0, infinity as
/// `f32::MAX`.
impl Environment for Vec3 {
    fn radiance(&self, direction: Vec3) -> Vec3 {
        if is_direction(direction) {
            Self::from_array(self.to_array().map(|c| clamp_to(c, f32::MAX)))
        } else {
            Self::ZERO
        }
    }
}

/// Whether a vector has a direction.
#[inline]
pub(crate) fn is_direction(v: Vec3) -> bool {
    v.is_finite() && v != Vec3::ZERO
}

/// A direction with pdf `1/4π`: by Archimedes, uniform in z and in longitude.
#[inline]
pub(crate) fn uniform_sphere(u: Vec2) -> Vec3 {
    let (down, turn) = (clamp_to(u.y, 1.0), clamp_to(u.x, 1.0));
    let rho = 2.0 * sqrt(down * (1.0 - down));
    Vec3::new(rho * cos(TAU * turn), rho * sin(TAU * turn), 1.0 - 2.0 * down)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn default_samples_are_unit() {
        let fog: &dyn Environment = &Vec3::ONE;
        for x in [f32::NAN, f32::NEG_INFINITY, 0.0, 0.3, 1.0, 7.0] {
            for y in [f32::NAN, 0.0, 0.25, 1.0, f32::INFINITY] {
                let wi = fog.sample(Vec2::new(x, y));
                assert_abs_diff_eq!(wi.length(), 1.0, epsilon = 1e-6, "{x}, {y}");
                assert_eq!(fog.pdf(wi), 0.25 * FRAC_1_PI);
            }
        }
    }

    #[test]
    fn radiance_of_invalid_directions_is_zero() {
        for bad in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY, Vec3::new(0.0, f32::NAN, 1.0)] {
            assert_eq!((Vec3::ONE.radiance(bad), Vec3::ONE.pdf(bad)), (Vec3::ZERO, 0.0), "{bad}");
        }
        assert_eq!(Vec3::new(-1.0, f32::NAN, 2.0).radiance(Vec3::Z), Vec3::new(0.0, 0.0, 2.0));
    }
}
