//! The metallic–roughness material of glTF 2.0 with its extensions.

use asperity_ndf_sampling::Ggx;
use core::f32::consts::TAU;
use glam::{Vec2, Vec3};

use crate::error::ShadingError;
use crate::math::{clamp_to, cos, sin};
use crate::parameter::{as_share, color, not_negative, parameters, range};
use crate::reflectance::diffuse::EnergyPreservingOrenNayar;
use crate::reflectance::fresnel::{Dielectric, SchlickRgb};
use crate::reflectance::fuzz::CharlieSheen;
use crate::reflectance::standard::layers::{Coating, Fuzz, Glass, Gloss, Layers, Reflectance};
use crate::reflectance::standard::stack::{layered_material, smoothest};

parameters! {
    /// The parameters of [`StandardMaterial`], named and ranged as in glTF 2.0 and its extensions.
    ///
    /// Textures multiply them. Colors are linear RGB.
    pub struct StandardMaterialParameters of StandardMaterial {
        /// The base color, within `[0, 1]³`. Default white.
        base_color: Vec3 = Vec3::ONE, color;
        /// From 0, a dielectric, to 1, a metal. Default 1.
        metallic: f32 = 1.0, as_share;
        /// The square root of α, within `[0, 1]`. Default 1.
        roughness: f32 = 1.0, as_share;
        /// The radiance of the surface, at least 0: `emissiveFactor` times `emissiveStrength` of
        /// `KHR_materials_emissive_strength`. Default 0.
        emissive: Vec3 = Vec3::ZERO, radiance;
        /// The index of refraction, at least 1, or 0 for a reflectance of 1
        /// (`KHR_materials_ior`). Default 1.5.
        ior: f32 = 1.5, index;
        /// The strength of the reflection of dielectrics, within `[0, 1]`
        /// (`KHR_materials_specular`). Default 1.
        specular: f32 = 1.0, as_share;
        /// The color of that reflection at normal incidence, at least 0. Default white.
        specular_color: Vec3 = Vec3::ONE, radiance;
        /// The fraction under a clearcoat, within `[0, 1]` (`KHR_materials_clearcoat`). Default 0.
        clearcoat: f32 = 0.0, as_share;
        /// The roughness of the clearcoat, within `[0, 1]`. Default 0.
        clearcoat_roughness: f32 = 0.0, as_share;
        /// The color of the sheen, within `[0, 1]³` (`KHR_materials_sheen`). Default black: none.
        sheen_color: Vec3 = Vec3::ZERO, color;
        /// The roughness of the sheen, within `[0, 1]`; below 0.265 as 0.265. Default 0.
        sheen_roughness: f32 = 0.0, as_share;
        /// The fraction of light that enters and is transmitted instead of scattered, within
        /// `[0, 1]` (`KHR_materials_transmission`). Default 0.
        transmission: f32 = 0.0, as_share;
        /// The thickness of the body in units of length, at least 0 (`KHR_materials_volume`). 0 is a
        /// thin wall, anything else the surface of a body, whose absorption the
        /// renderer applies, see [`Absorption`](crate::reflectance::Absorption). Default 0.
        thickness: f32 = 0.0, not_negative;
        /// The strength of the anisotropy, within `[0, 1]` (`KHR_materials_anisotropy`). Default 0.
        anisotropy: f32 = 0.0, as_share;
        /// The rotation of the direction of anisotropy from the tangent towards the bitangent in
        /// radians, within `[−2π, 2π]`. Default 0.
        anisotropy_rotation: f32 = 0.0, range([-TAU, TAU]);
    }
}

/// The material of glTF 2.0: metallic–roughness with clearcoat, sheen, transmission, index,
/// specular color, anisotropy and emission, with every bounce, and exact at every zoom.
///
/// ```text
/// f       = f_sheen + (1 − E_sheen) (clearcoat f_clearcoat + (1 − clearcoat E_clearcoat) f_base)
/// f_base  = g f_gloss + (1 − metallic) (1 − transmission) (1 − E_d) base_color/π + t f_glass
/// f_gloss = GGX with every bounce, F = f0 + (f90 − f0) (1 − ωo·h)⁵
/// f0      = lerp(f0_d, base_color, metallic/g),   f90 = lerp(specular, 1, metallic/g),   α = roughness²
/// f0_d    = min(1, ((ior − 1)/(ior + 1))² specular_color) specular
/// α_x     = lerp(α, 1, anisotropy²),   α_y = α,   t = (1 − metallic) transmission,   g = 1 − t
/// ```
///
/// All E are directional albedos seen from ωo. metallic/g is 0 where g is 0.
///
/// - **Domain:** `wo` and `wi` above the surface; on both sides with transmission. A body seen from
///   inside shows its glass only. A thin wall shows the same on its back, with `−wo`, `−wi` and the
///   same bumps: clearcoat and sheen are on the side of the viewer. α is at least 10⁻³.
/// - **Energy:** each layer passes the light that it does not reflect, by its albedo towards ωo
///   with all bounces between facets. A white dielectric, metal or body of glass has the albedo 1;
///   measured within 0.2 % for roughness from 0.25 to 1, also for a white thin wall and from inside a
///   body. With an anisotropy of 0.5 all are within 0.6 %, metals and dielectrics with 1 within 6 %.
/// - **Reciprocity** is given up for energy, as the albedos depend on ωo alone. Light from grazing
///   directions is not attenuated a second time.
/// - **Bumps:** as a [`FacetBrdf`](crate::reflectance::FacetBrdf) its facets become bumps. Gloss,
///   clearcoat and glass are seen by the same bumps, each with its own roughness. Diffuse light is
///   weighted by the irradiance of the bump over its mean. The mean over the surface is this BRDF at
///   every zoom. Sheen has no bumps.
/// - **Sampling:** one lobe by its albedo. All lobes count in the pdf.
/// - **Any input** is valid, as for [`Brdf`](crate::Brdf).
///
/// Khronos Group 2021, *glTF 2.0 Specification*, Appendix B, and the extensions
/// `KHR_materials_anisotropy`, `_clearcoat`, `_emissive_strength`, `_ior`, `_sheen`, `_specular`,
/// `_transmission` and `_volume`. They leave the layering to implementations and show one with the
/// Fresnel term of single facets. Here the albedos take its place, which keeps the energy. Glass
/// reflects by its index alone, without `specular` and `specular_color`.
///
/// ```
/// use asperity_shading::reflectance::{FacetBrdf, StandardMaterial, StandardMaterialParameters};
/// use asperity_shading::level_of_detail::ResolvedBumps;
/// use asperity_shading::{Brdf, glam::{Vec2, Vec3}};
///
/// let paint = StandardMaterial::new(StandardMaterialParameters {
///     base_color: Vec3::new(0.6, 0.05, 0.02),
///     metallic: 0.0,
///     roughness: 0.5,
///     clearcoat: 1.0,
///     ..Default::default()
/// })?;
/// let (wo, wi) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.28, 0.0, 0.96));
/// let near = ResolvedBumps { z: Vec2::new(0.8, -0.3), variance: 0.75, blend: 1.0 };
/// assert_eq!(paint.eval_resolved(wo, wi, ResolvedBumps::FAR), paint.eval(wo, wi));
/// assert_ne!(paint.eval_resolved(wo, wi, near), paint.eval(wo, wi));
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[doc(alias = "pbr")]
#[doc(alias = "principled")]
#[doc(alias = "gltf")]
#[doc(alias = "metallic roughness")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StandardMaterial {
    parameters: StandardMaterialParameters,
    layers: Layers,
}

/// A color that is finite and not negative.
fn radiance(parameter: &'static str, value: Vec3) -> Result<Vec3, ShadingError> {
    value.to_array().into_iter().try_for_each(|c| not_negative(parameter, c).map(|_| ()))?;
    Ok(value)
}

/// An index of refraction, or 0.
fn index(parameter: &'static str, value: f32) -> Result<f32, ShadingError> {
    if value == 0.0 || (1.0..=f32::MAX).contains(&value) {
        Ok(value)
    } else {
        Err(ShadingError::Ior { parameter, value })
    }
}

impl StandardMaterial {
    /// Creates the material.
    ///
    /// # Errors
    /// [`ShadingError`] with the first parameter that is out of its range.
    pub fn new(parameters: StandardMaterialParameters) -> Result<Self, ShadingError> {
        parameters.check()?;
        Ok(Self { parameters, layers: layers(&parameters) })
    }

    /// Creates the material with every parameter clamped to its range; NaN is read as the lower
    /// limit. For values from textures.
    #[must_use]
    pub fn new_clamped(parameters: StandardMaterialParameters) -> Self {
        let (p, rotation) = (parameters, parameters.anisotropy_rotation);
        let share = |x: f32| clamp_to(x, 1.0);
        let colored = |c: Vec3| c.map(|x| clamp_to(x, 1.0));
        let bright = |c: Vec3| c.map(|x| clamp_to(x, f32::MAX));
        let parameters = StandardMaterialParameters {
            base_color: colored(p.base_color),
            metallic: share(p.metallic),
            roughness: share(p.roughness),
            emissive: bright(p.emissive),
            ior: if p.ior == 0.0 { 0.0 } else { clamp_to(p.ior, f32::MAX).max(1.0) },
            specular: share(p.specular),
            specular_color: bright(p.specular_color),
            clearcoat: share(p.clearcoat),
            clearcoat_roughness: share(p.clearcoat_roughness),
            sheen_color: colored(p.sheen_color),
            sheen_roughness: share(p.sheen_roughness),
            transmission: share(p.transmission),
            thickness: clamp_to(p.thickness, f32::MAX),
            anisotropy: share(p.anisotropy),
            anisotropy_rotation: if rotation.is_nan() { -TAU } else { rotation.clamp(-TAU, TAU) },
        };
        Self { parameters, layers: layers(&parameters) }
    }
}

/// The reflectance at normal incidence for this index; 1 for 0.
fn normal_reflectance(ior: f32) -> f32 {
    let root = (ior - 1.0) / (ior + 1.0);
    root * root
}

fn layers(p: &StandardMaterialParameters) -> Layers {
    let alpha = smoothest(p.roughness * p.roughness);
    let along = alpha + (1.0 - alpha) * p.anisotropy * p.anisotropy;
    let ggx = Ggx::new_clamped(along, alpha);
    let f0 = (normal_reflectance(p.ior) * p.specular_color).min(Vec3::ONE) * p.specular;
    let dielectric = SchlickRgb { f0, f90: Vec3::splat(p.specular), dip: Vec3::ZERO };
    let metal = SchlickRgb { f0: p.base_color, f90: Vec3::ONE, dip: Vec3::ZERO };
    let transmitted = (1.0 - p.metallic) * p.transmission;
    let opaque = 1.0 - transmitted;
    let gloss = Gloss::new(ggx, dielectric.lerp(metal, if opaque > 0.0 { p.metallic / opaque } else { 0.0 }));
    let coat_alpha = smoothest(p.clearcoat_roughness * p.clearcoat_roughness);
    let coat =
        Coating::new(p.clearcoat, Ggx::new_clamped(coat_alpha, coat_alpha), Dielectric::new_clamped(1.5));
    let fresnel = Dielectric::new_clamped(p.ior);
    let glass = (transmitted > 0.0).then(|| {
        let make = if p.thickness > 0.0 { Glass::body } else { Glass::thin };
        make(transmitted, ggx, fresnel, p.base_color)
    });
    let sheen_alpha = p.sheen_roughness * p.sheen_roughness;
    let sheen = CharlieSheen::new(p.sheen_color, sheen_alpha.max(CharlieSheen::MIN_ALPHA)).ok();
    let diffuse = p.base_color * ((1.0 - p.metallic) * (1.0 - p.transmission));
    Layers {
        turn: Vec2::new(cos(p.anisotropy_rotation), sin(p.anisotropy_rotation)),
        fuzz: sheen.filter(|_| p.sheen_color != Vec3::ZERO).map_or(Fuzz::None, Fuzz::Charlie),
        coat,
        below_coat: Vec3::ONE,
        interface: Reflectance::new(dielectric, gloss.table()),
        gloss,
        opaque,
        diffuse: EnergyPreservingOrenNayar::new_clamped(diffuse, 0.0),
        glass,
        emitted: p.emissive,
    }
}

layered_material!(StandardMaterial);
