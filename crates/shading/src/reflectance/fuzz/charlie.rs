//! The Charlie sheen model.

use core::f32::consts::{FRAC_1_PI, TAU};

use glam::{Vec2, Vec3};

use crate::direction::half_vector;
use crate::error::ShadingError;
use crate::math::{clamp_to, cos, exp, pow, sin, sqrt};
use crate::parameter::{color, within};
use crate::reflectance::brdf::{Brdf, BsdfSample, are_above, finite};
use crate::reflectance::energy::spline::{as_number, blend, weights};
use crate::reflectance::fuzz::charlie_albedo::CHARLIE;

/// Sheen of cloth: microfibers with an inverted Gaussian-like distribution of normals.
///
/// ```text
/// f = color D(h) / (4 cos θ_i cos θ_o (1 + Λ(θ_i) + Λ(θ_o))),      D = (2 + 1/α) sin(θ_h)^(1/α) / (2π)
/// Λ = e^L(cos θ) for cos θ < ½, else e^(2 L(½) − L(1 − cos θ)),    L(x) = a/(1 + b x^c) + d x + e
/// ```
///
/// - **Domain:** roughness α within `[0.07, 1]`; the color within `[0, 1]³`. For
///   `KHR_materials_sheen` α is the square of the sheen roughness.
/// - **Range:** at least 0, finite. Reciprocal. The softened terminator of the source is omitted
///   because it is not.
/// - **Energy:** the albedo is at most 0.97 for cosines of at least 0.002, one bounce only. Nearer to
///   the horizon it exceeds 1. Below α = 0.07 it would exceed 1 near
///   the horizon, because Λ is a fit.
/// - **Sampling:** uniform over the hemisphere.
///
/// Estevez, Kulla 2017, *Production Friendly Microfacet Sheen BRDF*, eq. 2 and 3 and the table of
/// the fit.
///
/// ```
/// use asperity_shading::reflectance::{CharlieSheen, directional_albedo};
/// use asperity_shading::{Brdf, glam::Vec3};
///
/// let velvet = CharlieSheen::new(Vec3::ONE, 0.3)?;
/// let wo = Vec3::new(0.8, 0.0, 0.6);
/// let exact = directional_albedo(&velvet, wo, 4096);
/// assert!((velvet.albedo(wo.z) - exact).length() < 2e-3);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[doc(alias = "sheen")]
#[doc(alias = "velvet")]
#[doc(alias = "cloth")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CharlieSheen {
    color: Vec3,
    alpha: f32,
    /// a to e of L.
    fit: [f32; 5],
}

impl CharlieSheen {
    /// The minimum roughness.
    pub const MIN_ALPHA: f32 = 0.07;

    /// Creates the sheen of this color and roughness.
    ///
    /// # Errors
    /// [`ShadingError`] unless the color is within `[0, 1]³` and the roughness within `[0.07, 1]`.
    pub fn new(color_of_fibers: Vec3, alpha: f32) -> Result<Self, ShadingError> {
        let (color, alpha) =
            (color("color", color_of_fibers)?, within("alpha", alpha, [Self::MIN_ALPHA, 1.0])?);
        let smooth = (1.0 - alpha) * (1.0 - alpha);
        let fit = [
            [21.547_3, 25.324_5],
            [3.829_87, 3.324_35],
            [0.198_23, 0.168_01],
            [-1.977_6, -1.273_93],
            [-4.320_54, -4.859_67],
        ];
        Ok(Self { color, alpha, fit: fit.map(|[rough, fine]| rough + smooth * (fine - rough)) })
    }

    /// The fraction of light that the sheen reflects seen at this angle, in each channel.
    ///
    /// From a table that `cargo xtask tables` computes, within 0.002 for cosines of at
    /// least 0.002. The cosine is clamped to `[0, 1]`; NaN is the horizon.
    #[must_use]
    pub fn albedo(&self, cos_theta: f32) -> Vec3 {
        let (column, across) = weights(sqrt(sqrt(clamp_to(cos_theta, 1.0))), CHARLIE[0].len());
        let least = sqrt(Self::MIN_ALPHA);
        let (row, down) = weights((sqrt(self.alpha) - least) / (1.0 - least), CHARLIE.len());
        let sum = blend(down, |i| blend(across, |j| as_number(CHARLIE[row + i][column + j])));
        self.color * clamp_to(sum, 1.0)
    }

    /// The entries of the table of [`albedo`](Self::albedo) for WGSL: 12 rows of 20.
    pub fn table() -> impl Iterator<Item = f32> {
        CHARLIE.as_flattened().iter().map(|&entry| as_number(entry))
    }

    /// The fraction of light that reaches and leaves the layer beneath: `1 − max albedo`.
    ///
    /// Multiply the BRDF beneath by it.
    #[must_use]
    pub fn transmittance(&self, cos_theta: f32) -> f32 {
        1.0 - self.albedo(cos_theta).max_element()
    }

    /// `Λ` of a cosine in `(0, 1]`.
    fn lambda(&self, cos_theta: f32) -> f32 {
        let [a, b, c, d, e] = self.fit;
        let l = |x: f32| a / (1.0 + b * pow(x, c)) + d * x + e;
        if cos_theta < 0.5 { exp(l(cos_theta)) } else { exp(2.0 * l(0.5) - l((1.0 - cos_theta).max(0.0))) }
    }
}

impl Brdf for CharlieSheen {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if !are_above(wi, wo) {
            return Vec3::ZERO;
        }
        let h = half_vector(wi, wo);
        let across = sqrt(h.x * h.x + h.y * h.y).min(1.0);
        let inverse = 1.0 / self.alpha;
        let d = (2.0 + inverse) * pow(across, inverse) * (0.5 * FRAC_1_PI);
        let both = 1.0 + self.lambda(wi.z.min(1.0)) + self.lambda(wo.z.min(1.0));
        self.color * finite(d / (4.0 * wi.z * wo.z * both))
    }

    fn sample(&self, wo: Vec3, _: f32, u: Vec2) -> Option<BsdfSample> {
        let (z, turn) = (1.0 - clamp_to(u.x, 1.0 - 1e-4), TAU * clamp_to(u.y, 1.0));
        let across = sqrt((1.0 - z * z).max(0.0));
        BsdfSample::from_direction(self, wo, Vec3::new(across * cos(turn), across * sin(turn), z))
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if are_above(wi, wo) { 0.5 * FRAC_1_PI } else { 0.0 }
    }
}
