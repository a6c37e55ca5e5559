//! Cosine-power lobes: Phong around the mirrored direction, Blinn–Phong around the half vector.

use asperity_ndf_sampling::{BlinnPhong, Frame, Ndf};
use core::f32::consts::{FRAC_1_PI, TAU};
use glam::{Vec2, Vec3};

use crate::direction::reflect;
use crate::error::ShadingError;
use crate::math::{clamp_to, cos, exp, exp2, ln_1p, pow, sin, sqrt};
use crate::parameter::{color, within};
use crate::reflectance::brdf::{Brdf, BsdfSample, are_above, finite, mirrored_pdf};

/// The normalized Phong lobe around the mirrored direction.
///
/// ```text
/// f_r = k_s (n + 2)/(2π) max(0, cos α)ⁿ,   α the angle between ωi and ωo mirrored in the normal
/// ```
///
/// - **Domain:** exponent n within `[0, 10⁶]`, specular color `k_s` within `[0, 1]³`.
/// - **Range:** at least 0; reciprocal, as cos α is the same from both sides.
/// - **Energy:** the albedo is at most `k_s`. It is `k_s` straight down and decreases towards the
///   horizon, below which a part of the lobe is lost.
/// - **Sampling:** `(n + 1)/(2π) cosⁿ α`; samples below the horizon contribute zero.
///
/// Phong 1975, *Illumination for Computer Generated Pictures*; the factor by Lafortune, Willems
/// 1994, *Using the modified Phong reflectance model for physically based rendering*, eq. 8.
///
/// ```
/// use asperity_shading::{Brdf, Phong, glam::Vec3};
///
/// let lacquer = Phong::new(Vec3::splat(0.3), 60.0)?;
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// assert!(lacquer.eval(wo, Vec3::new(-0.6, 0.0, 0.8)).x > 100.0 * lacquer.eval(wo, Vec3::Z).x);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong {
    specular: Vec3,
    exponent: f32,
}

/// The largest exponent; beyond it `f32` directions are coarser than the lobe.
const MAX_EXPONENT: f32 = 1e6;

impl Phong {
    /// Creates the lobe of this color and exponent.
    ///
    /// # Errors
    /// [`ShadingError`] unless every component is within `[0, 1]` and the exponent within `[0,
    /// 10⁶]`.
    pub fn new(specular: Vec3, exponent: f32) -> Result<Self, ShadingError> {
        let specular = color("specular", specular)?;
        Ok(Self { specular, exponent: within("exponent", exponent, [0.0, MAX_EXPONENT])? })
    }

    /// The exponent n.
    #[must_use]
    pub const fn exponent(&self) -> f32 {
        self.exponent
    }

    fn lobe(&self, wi: Vec3, wo: Vec3) -> f32 {
        // 1 − cos α from the chord, because the power magnifies the rounding of a cosine near 1.
        let chord = (wi - reflect(wo, Vec3::Z)).length_squared();
        if chord < 2.0 { exp(self.exponent * ln_1p(-0.5 * chord)) } else { 0.0 }
    }
}

impl Brdf for Phong {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if !are_above(wi, wo) {
            return Vec3::ZERO;
        }
        self.specular * ((self.exponent + 2.0) / TAU * self.lobe(wi, wo))
    }

    fn sample(&self, wo: Vec3, _: f32, u: Vec2) -> Option<BsdfSample> {
        let (u, turn) = (clamp_to(u.x, 1.0), TAU * clamp_to(u.y, 1.0));
        let z = pow(1.0 - u, 1.0 / (self.exponent + 1.0));
        let r = sqrt((1.0 - z * z).max(0.0));
        let lobe = Frame::from_normal(reflect(wo, Vec3::Z));
        BsdfSample::from_direction(self, wo, lobe.to_world(Vec3::new(r * cos(turn), r * sin(turn), z)))
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if are_above(wi, wo) { (self.exponent + 1.0) / TAU * self.lobe(wi, wo) } else { 0.0 }
    }
}

/// The factor of a [`BlinnPhongBrdf`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum BlinnPhongNormalization {
    /// `(n + 2)(n + 4) / (8π (2^(−n/2) + n))`: straight down, the albedo is exactly `k_s` (Giesen
    /// 2009).
    #[default]
    Albedo,
    /// `(n + 8) / (8π)`: the usual approximation, whose albedo straight down is up to 7.5 % larger
    /// (at n = 8).
    Approximate,
    /// `(n + 2) / (8π)`: a quarter of the NDF, the microfacet model without its cosines.
    Density,
}

/// The Blinn–Phong lobe around the half vector.
///
/// ```text
/// f_r = k_s c(n) (n·h)ⁿ
/// ```
///
/// - **Domain:** the exponents of the NDF [`BlinnPhong`], specular color within `[0, 1]³`.
/// - **Range:** at least 0; reciprocal.
/// - **Energy:** the albedo straight down is documented at [`BlinnPhongNormalization`], and
///   decreases towards the horizon.
/// - **Sampling:** `D(h) h_z` of the NDF, reflected.
/// - **Accuracy:** 3·10⁻⁶ relative to the formula, for exponents up to 1000.
///
/// Blinn 1977, *Models of Light Reflection for Computer Synthesized Pictures*.
///
/// ```
/// use asperity_shading::reflectance::{BlinnPhongNormalization, BlinnPhongBrdf};
/// use asperity_shading::{Brdf, glam::Vec3};
///
/// let gloss = BlinnPhongBrdf::new(Vec3::splat(0.5), 40.0, BlinnPhongNormalization::Albedo)?;
/// assert!(gloss.eval(Vec3::Z, Vec3::Z).x > gloss.eval(Vec3::Z, Vec3::new(0.6, 0.0, 0.8)).x);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlinnPhongBrdf {
    specular: Vec3,
    density: BlinnPhong,
    factor: f32,
}

impl BlinnPhongBrdf {
    /// Creates the lobe of this color and exponent, with this factor.
    ///
    /// # Errors
    /// [`ShadingError`] unless every component is within `[0, 1]`, and for an exponent that is
    /// invalid in [`BlinnPhong::new`].
    pub fn new(specular: Vec3, exponent: f32, factor: BlinnPhongNormalization) -> Result<Self, ShadingError> {
        let specular = color("specular", specular)?;
        let density = BlinnPhong::new(within("exponent", exponent, [0.0, MAX_EXPONENT])?)
            .map_err(|_| ShadingError::NotPositive { parameter: "exponent", value: exponent })?;
        let n = exponent;
        let factor = match factor {
            BlinnPhongNormalization::Albedo => (n + 2.0) * (n + 4.0) / (exp2(-0.5 * n) + n),
            BlinnPhongNormalization::Approximate => n + 8.0,
            BlinnPhongNormalization::Density => n + 2.0,
        } * (0.125 * FRAC_1_PI);
        Ok(Self { specular, density, factor })
    }
}

impl Brdf for BlinnPhongBrdf {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if !are_above(wi, wo) {
            return Vec3::ZERO;
        }
        // ln cos from the tangent, because the power magnifies the rounding of a cosine near 1.
        let (x, y) = ((wi.x + wo.x) / (wi.z + wo.z), (wi.y + wo.y) / (wi.z + wo.z));
        let lobe = exp(-0.5 * self.density.exponent() * ln_1p(x * x + y * y));
        self.specular * finite(self.factor * lobe)
    }

    fn sample(&self, wo: Vec3, _: f32, u: Vec2) -> Option<BsdfSample> {
        BsdfSample::from_direction(self, wo, reflect(wo, self.density.sample(u)))
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        mirrored_pdf(wo, wi, |h| self.density.pdf(h))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn phong_is_brightest_in_the_mirror() {
        let phong = Phong::new(Vec3::ONE, 30.0).unwrap();
        let wo = Vec3::new(0.48, 0.36, 0.8);
        let peak = phong.eval(wo, reflect(wo, Vec3::Z)).x;
        assert_abs_diff_eq!(peak, 32.0 / TAU, epsilon = 1e-4);
    }
}
