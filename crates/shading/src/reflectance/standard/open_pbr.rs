//! The parameterization of OpenPBR.

use asperity_ndf_sampling::Ggx;
use glam::{Vec2, Vec3};

use crate::error::ShadingError;
use crate::math::sqrt;
use crate::parameter::{as_share, color, not_negative, parameters, range};
use crate::reflectance::diffuse::EnergyPreservingOrenNayar;
use crate::reflectance::fresnel::{Dielectric, Fresnel, SchlickF82, SchlickRgb};
use crate::reflectance::fuzz::ZeltnerFuzz;
use crate::reflectance::standard::layers::{Coating, Fuzz, Glass, Gloss, Layers, Reflectance};
use crate::reflectance::standard::stack::{layered_material, smoothest};

parameters! {
    /// The parameters of [`OpenPbr`], named as in OpenPBR Surface 1.1, with its defaults.
    pub struct OpenPbrParameters of OpenPbr {
        /// The factor of the base color, within `[0, 1]`. Default 1.
        base_weight: f32 = 1.0, as_share;
        /// The color of diffuse light and of metals, within `[0, 1]³`. Default 0.8.
        base_color: Vec3 = Vec3::splat(0.8), color;
        /// The roughness of the diffuse light, within `[0, 1]`. Default 0.
        base_diffuse_roughness: f32 = 0.0, as_share;
        /// From 0, a dielectric, to 1, a metal. Default 0.
        base_metalness: f32 = 0.0, as_share;
        /// The factor of the reflectance at normal incidence, within `[0, 1]`. Default 1.
        specular_weight: f32 = 1.0, as_share;
        /// The color of the reflection of dielectrics, and of metals near 82°, within `[0, 1]³`.
        /// Default white.
        specular_color: Vec3 = Vec3::ONE, color;
        /// The square root of α, within `[0, 1]`. Default 0.3.
        specular_roughness: f32 = 0.3, as_share;
        /// The anisotropy of α, within `[0, 1]`. Default 0.
        specular_roughness_anisotropy: f32 = 0.0, as_share;
        /// The index of refraction, within `[1, 3]`. Default 1.5.
        specular_ior: f32 = 1.5, range([1.0, 3.0]);
        /// The fraction of light that enters and is transmitted, within `[0, 1]`. Default 0.
        transmission_weight: f32 = 0.0, as_share;
        /// The color of transmitted light, within `[0, 1]³`. Default white.
        transmission_color: Vec3 = Vec3::ONE, color;
        /// The depth at which light in a body has that color, at least 0; 0 colors the surface.
        /// The renderer applies absorption in the body, see
        /// [`Absorption::of_color`](crate::reflectance::Absorption::of_color). Default 0.
        transmission_depth: f32 = 0.0, not_negative;
        /// The fraction under a coat, within `[0, 1]`. Default 0.
        coat_weight: f32 = 0.0, as_share;
        /// The transmittance of the coat on both ways at normal incidence, within `[0, 1]³`. Default
        /// white.
        coat_color: Vec3 = Vec3::ONE, color;
        /// The roughness of the coat, within `[0, 1]`. Default 0.
        coat_roughness: f32 = 0.0, as_share;
        /// Its anisotropy, within `[0, 1]`. Default 0.
        coat_roughness_anisotropy: f32 = 0.0, as_share;
        /// The index of refraction of the coat, within `[1, 3]`. Default 1.6.
        coat_ior: f32 = 1.6, range([1.0, 3.0]);
        /// The strength of the darkening by light that is reflected inside of the coat, within
        /// `[0, 1]`. Default 1.
        coat_darkening: f32 = 1.0, as_share;
        /// The fraction under fuzz, within `[0, 1]`. Default 0.
        fuzz_weight: f32 = 0.0, as_share;
        /// The color of the fuzz, within `[0, 1]³`. Default white.
        fuzz_color: Vec3 = Vec3::ONE, color;
        /// The roughness of the fuzz, within `[0, 1]`; below 0.01 as 0.01. Default 0.5.
        fuzz_roughness: f32 = 0.5, as_share;
        /// The luminance of the emission, at least 0. Default 0.
        emission_luminance: f32 = 0.0, not_negative;
        /// The color of the emission, within `[0, 1]³`. Default white.
        emission_color: Vec3 = Vec3::ONE, color;
        /// Whether the surface is a thin wall instead of that of a body. Default `false`.
        geometry_thin_walled: bool = false;
    }
}

/// The material of OpenPBR Surface 1.1 with every bounce, and exact at every zoom.
///
/// The layers are those of [`StandardMaterial`](crate::reflectance::StandardMaterial), with
///
/// ```text
/// metal    F82: f0 = base_weight base_color, specular_color at 82°, times specular_weight
/// ε        = √specular_weight (η − 1)/(η + 1),   η′ = (1 + ε)/(1 − ε),   η: specular_ior over the index above
/// r′⁴      = lerp(r, min(1, r⁴ + 2 r_c⁴)^¼, coat_weight)⁴            roughness below a coat
/// α_x      = r² √(2/(1 + (1 − a)²)),   α_y = (1 − a) α_x             a: anisotropy
/// coat     transmits lerp(1, coat_color^((1/cos θ_ti + 1/cos θ_to)/2), coat_weight)
/// Δ        = (1 − K)/(1 − E_b K),   K = lerp(K_s, K_r, roughness of the base)     darkening
/// ```
///
/// - **Differs from the specification:** dielectrics reflect by Schlick's approximation, whose
///   albedo is known. It has the exact reflectance at normal incidence, and the exact mean for
///   indices up to 1.34 and from 2.47. In between the mean is up to 8 % too low. Glass reflects by the exact term. Its index is relative to air, also under a
///   coat. `specular_color` does not tint it. There is no subsurface scattering, thin film,
///   dispersion or scattering in the body.
/// - **Domain, energy, bumps, sampling** as for `StandardMaterial`.
///
/// Academy Software Foundation 2024, *OpenPBR Surface specification* 1.1: §*Metal*, *Glossy-diffuse*,
/// *Coat*, eq. 65 to 71 for the darkening.
///
/// ```
/// use asperity_shading::reflectance::{OpenPbr, OpenPbrParameters, directional_albedo};
/// use asperity_shading::glam::Vec3;
///
/// // Wet stone is darker than dry stone.
/// let stone = OpenPbrParameters { base_color: Vec3::splat(0.4), specular_roughness: 0.7, ..Default::default() };
/// let wet = OpenPbrParameters { coat_weight: 1.0, coat_ior: 1.33, ..stone };
/// let [dry, wet] = [stone, wet].map(|p| OpenPbr::new(p).map(|m| directional_albedo(&m, Vec3::Z, 4096).x));
/// assert!(wet? < 0.8 * dry?);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[doc(alias = "pbr")]
#[doc(alias = "principled")]
#[doc(alias = "openpbr")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenPbr {
    parameters: OpenPbrParameters,
    layers: Layers,
}

impl OpenPbr {
    /// Creates the material.
    ///
    /// # Errors
    /// [`ShadingError`] with the first parameter that is out of its range.
    pub fn new(parameters: OpenPbrParameters) -> Result<Self, ShadingError> {
        parameters.check()?;
        Ok(Self { parameters, layers: layers(&parameters) })
    }
}

fn facets(roughness: f32, anisotropy: f32) -> Ggx {
    let across = 1.0 - anisotropy;
    let along = roughness * roughness * sqrt(2.0 / (1.0 + across * across));
    Ggx::new_clamped(smoothest(along), smoothest(across * along))
}

fn fourth_power(x: f32) -> f32 {
    x * x * (x * x)
}

fn layers(p: &OpenPbrParameters) -> Layers {
    let (coat, coat_index) = (p.coat_weight, Dielectric::new_clamped(p.coat_ior));
    let below = (fourth_power(p.specular_roughness) + 2.0 * fourth_power(p.coat_roughness)).min(1.0);
    let roughness = p.specular_roughness + coat * (sqrt(sqrt(below)) - p.specular_roughness);
    let ggx = facets(roughness, p.specular_roughness_anisotropy);
    let over_air = Dielectric::new_clamped(weighted(p.specular_ior, p.specular_weight));
    let above = 1.0 + coat * (p.coat_ior - 1.0);
    // Inverted below a denser coat, because the coat does not bend light towards total reflection.
    let relative = (p.specular_ior / above).max(above / p.specular_ior);
    let under_coat = Dielectric::new_clamped(weighted(relative, p.specular_weight));
    let dielectric = SchlickRgb::of_dielectric(under_coat, p.specular_color);
    let base_color = p.base_weight * p.base_color;
    let metal = metal(base_color, p.specular_color, p.specular_weight);
    let transmitted = (1.0 - p.base_metalness) * p.transmission_weight;
    let (opaque, scattered) = (1.0 - transmitted, 1.0 - p.base_metalness - transmitted);
    let mixed = if opaque > 0.0 { p.base_metalness / opaque } else { 0.0 };
    let gloss = Gloss::new(ggx, dielectric.lerp(metal, mixed));
    let glass = (transmitted > 0.0).then(|| {
        let make = if p.geometry_thin_walled { Glass::thin } else { Glass::body };
        let is_colored = p.geometry_thin_walled || p.transmission_depth <= 0.0;
        make(transmitted, ggx, over_air, if is_colored { p.transmission_color } else { Vec3::ONE })
    });
    let below_coat = if coat * p.coat_darkening > 0.0 {
        let specular = under_coat.mean_reflectance_rgb().x;
        let base = p.base_metalness * metal.mean_reflectance_rgb()
            + scattered * base_color.lerp(Vec3::ONE, specular)
            + Vec3::splat(transmitted);
        let specularity = p.base_metalness + (1.0 - p.base_metalness) * specular;
        let rough = 1.0 + specularity * (roughness - 1.0);
        let darker = darkening(coat_index, base.min(Vec3::ONE), rough);
        Vec3::ONE.lerp(darker, coat * p.coat_darkening)
    } else {
        Vec3::ONE
    };
    let coat_gloss = facets(p.coat_roughness, p.coat_roughness_anisotropy);
    let fuzz = ZeltnerFuzz::new(p.fuzz_color, p.fuzz_roughness.max(0.01)).ok();
    Layers {
        turn: Vec2::X,
        fuzz: fuzz
            .filter(|_| p.fuzz_weight > 0.0)
            .map_or(Fuzz::None, |fuzz| Fuzz::Zeltner(fuzz, p.fuzz_weight)),
        coat: Coating::new(coat, coat_gloss, coat_index).tinted(p.coat_color.map(sqrt)),
        below_coat,
        interface: Reflectance::new(dielectric, gloss.table()),
        gloss,
        opaque,
        diffuse: EnergyPreservingOrenNayar::new_clamped(base_color * scattered, p.base_diffuse_roughness),
        glass,
        emitted: p.emission_luminance * p.emission_color,
    }
}

/// The index whose reflectance at normal incidence is this fraction of that of another.
fn weighted(index: f32, weight: f32) -> f32 {
    let root = sqrt(weight) * (index - 1.0) / (index + 1.0);
    (1.0 + root) / (1.0 - root)
}

fn metal(f0: Vec3, tint: Vec3, weight: f32) -> SchlickRgb {
    let dip = Vec3::from_array([0, 1, 2].map(|k| SchlickF82::new(f0[k], tint[k]).map_or(0.0, |f| f.dip())));
    SchlickRgb { f0: weight * f0, f90: Vec3::splat(weight), dip: weight * dip }
}

/// The light that remains of the base below a coat after all reflections inside of the coat.
///
/// `K_s = F_avg` for a smooth base, and `K_r = 1 − (1 − F_avg)/η²` for a rough one.
fn darkening(coat: Dielectric, base: Vec3, rough: f32) -> Vec3 {
    let (mean, index) = (coat.mean_reflectance_rgb().x, coat.relative_index());
    let inner = 1.0 - (1.0 - mean) / (index * index);
    let k = mean + rough * (inner - mean);
    (1.0 - k) / (Vec3::ONE - base * k)
}

layered_material!(OpenPbr);
