//! The Lambertian BRDF.

use core::f32::consts::FRAC_1_PI;
use glam::Vec3;

use crate::error::ShadingError;
use crate::parameter::color;
use crate::reflectance::brdf::{Brdf, are_above};

/// The Lambertian BRDF: the same value in every direction.
///
/// ```text
/// f_r = ρ / π
/// ```
///
/// - **Range:** `[0, 1/π]` sr⁻¹ in each channel. Reciprocal; the albedo is ρ from every direction.
/// - **Sampling:** cosine-weighted, so every sample has the weight ρ.
///
/// Lambert 1760, *Photometria*.
///
/// ```
/// use asperity_shading::{Brdf, Lambert, glam::Vec3};
///
/// let paper = Lambert::new(Vec3::new(0.9, 0.88, 0.8))?;
/// assert_eq!(paper.eval(Vec3::Z, Vec3::Z).x, 0.9 * core::f32::consts::FRAC_1_PI);
/// assert_eq!(paper.eval(Vec3::NEG_Z, Vec3::Z), Vec3::ZERO);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[doc(alias = "lambertian")]
#[doc(alias = "diffuse")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lambert {
    albedo: Vec3,
}

impl Lambert {
    /// Creates the BRDF with this albedo ρ, linear RGB.
    ///
    /// # Errors
    /// [`ShadingError`] unless every component is within `[0, 1]`.
    pub fn new(albedo: Vec3) -> Result<Self, ShadingError> {
        Ok(Self { albedo: color("albedo", albedo)? })
    }

    /// The albedo ρ.
    #[must_use]
    pub const fn albedo(&self) -> Vec3 {
        self.albedo
    }
}

impl Brdf for Lambert {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if are_above(wi, wo) { self.albedo * FRAC_1_PI } else { Vec3::ZERO }
    }
}
