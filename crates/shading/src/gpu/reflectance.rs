//! Coats and the standard materials.

use asperity_core::gpu_struct;

use crate::reflectance::{Coat, OpenPbr, StandardMaterial};

gpu_struct! {
    /// A coat of any kind, in the frame of the surface.
    pub struct CoatUniform as "Coat" {
        /// Unit normal.
        normal: [f32; 3],
        /// Variance along each axis of the unresolved Gaussian slopes.
        slope_variance: f32,
        /// Steepest unresolved slope of a sine; zero without a sine.
        swing: [f32; 3],
        /// Beckmann's alpha of the reflection, 0 for a smooth coat.
        roughness: f32,
        /// Tint of a pane, reflectance of a metal, transmittance of a veil, otherwise 1.
        color: [f32; 3],
        /// Relative IOR of a varnish, a pane or a body.
        index: f32,
        /// 0 for a varnish, then pane, body, metal, veil.
        kind: u32,
        .. padding: [u32; 3]
    }
}

impl Coat {
    /// Returns the coat as a uniform of a shader.
    ///
    /// ```
    /// use asperity_shading::{Dielectric, reflectance::Coat};
    ///
    /// let varnish = Coat::clearcoat(Dielectric::new(1.5)?).rough(0.1).gpu();
    /// assert_eq!((varnish.normal[2], varnish.roughness, varnish.index), (1.0, 0.1, 1.5));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self) -> CoatUniform {
        let ([normal, swing, color], kind) = self.parts();
        CoatUniform {
            normal: normal.truncate().into(),
            slope_variance: normal.w,
            swing: swing.truncate().into(),
            roughness: swing.w,
            color: color.truncate().into(),
            index: color.w,
            kind,
            padding: [0; 3],
        }
    }
}

gpu_struct! {
    /// The parameters of the standard material, named as in glTF 2.0 and its extensions.
    pub struct StandardMaterialUniform as "StandardMaterial" {
        /// Base color.
        base_color: [f32; 3],
        /// From 0, a dielectric, to 1, a metal.
        metallic: f32,
        /// Radiance of the surface.
        emissive: [f32; 3],
        /// Square root of alpha.
        roughness: f32,
        /// Color of the reflection of dielectrics.
        specular_color: [f32; 3],
        /// Strength of that reflection.
        specular: f32,
        /// Color of the sheen.
        sheen_color: [f32; 3],
        /// Roughness of the sheen.
        sheen_roughness: f32,
        /// Index of refraction.
        ior: f32,
        /// Fraction under a clearcoat.
        clearcoat: f32,
        /// Roughness of the clearcoat.
        clearcoat_roughness: f32,
        /// Fraction of light that is transmitted.
        transmission: f32,
        /// Thickness of the body, 0 for a thin wall.
        thickness: f32,
        /// Strength of the anisotropy.
        anisotropy: f32,
        /// Rotation of its direction from the tangent in radians.
        anisotropy_rotation: f32,
        .. padding: [u32; 1]
    }
}

impl StandardMaterial {
    /// Returns the parameters as a uniform of a shader.
    ///
    /// ```
    /// use asperity_shading::{StandardMaterial, StandardMaterialParameters};
    ///
    /// let material = StandardMaterial::new(StandardMaterialParameters { roughness: 0.3, ..Default::default() })?;
    /// assert_eq!((material.gpu().roughness, material.gpu().ior), (0.3, 1.5));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self) -> StandardMaterialUniform {
        let p = self.parameters();
        StandardMaterialUniform {
            base_color: p.base_color.into(),
            metallic: p.metallic,
            emissive: p.emissive.into(),
            roughness: p.roughness,
            specular_color: p.specular_color.into(),
            specular: p.specular,
            sheen_color: p.sheen_color.into(),
            sheen_roughness: p.sheen_roughness,
            ior: p.ior,
            clearcoat: p.clearcoat,
            clearcoat_roughness: p.clearcoat_roughness,
            transmission: p.transmission,
            thickness: p.thickness,
            anisotropy: p.anisotropy,
            anisotropy_rotation: p.anisotropy_rotation,
            padding: [0; 1],
        }
    }
}

gpu_struct! {
    /// The parameters of OpenPBR Surface 1.1.
    pub struct OpenPbrUniform as "OpenPbr" {
        /// Color of diffuse light and of metals.
        base_color: [f32; 3],
        /// Factor of that color.
        base_weight: f32,
        /// Color of the reflection of dielectrics, and of metals near 82 degrees.
        specular_color: [f32; 3],
        /// Factor of the reflectance at normal incidence.
        specular_weight: f32,
        /// Transmittance of the coat on both ways.
        coat_color: [f32; 3],
        /// Fraction under a coat.
        coat_weight: f32,
        /// Color of the fuzz.
        fuzz_color: [f32; 3],
        /// Fraction under fuzz.
        fuzz_weight: f32,
        /// Color of the emission.
        emission_color: [f32; 3],
        /// Luminance of the emission.
        emission_luminance: f32,
        /// Roughness of the diffuse light.
        base_diffuse_roughness: f32,
        /// From 0, a dielectric, to 1, a metal.
        base_metalness: f32,
        /// Square root of alpha.
        specular_roughness: f32,
        /// Anisotropy of alpha.
        specular_roughness_anisotropy: f32,
        /// Index of refraction.
        specular_ior: f32,
        /// Fraction of light that is transmitted.
        transmission_weight: f32,
        /// Roughness of the coat.
        coat_roughness: f32,
        /// Anisotropy of the coat.
        coat_roughness_anisotropy: f32,
        /// Index of refraction of the coat.
        coat_ior: f32,
        /// Strength of the darkening by the coat.
        coat_darkening: f32,
        /// Roughness of the fuzz.
        fuzz_roughness: f32,
        /// 1 for a thin wall, 0 for the surface of a body.
        geometry_thin_walled: u32,
    }
}

impl OpenPbr {
    /// Returns the parameters as a uniform of a shader, which does not transmit light.
    ///
    /// ```
    /// use asperity_shading::{OpenPbr, OpenPbrParameters};
    ///
    /// let material = OpenPbr::new(OpenPbrParameters { coat_weight: 0.5, ..Default::default() })?;
    /// assert_eq!((material.gpu().coat_weight, material.gpu().coat_ior), (0.5, 1.6));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self) -> OpenPbrUniform {
        let p = self.parameters();
        OpenPbrUniform {
            base_color: p.base_color.into(),
            base_weight: p.base_weight,
            specular_color: p.specular_color.into(),
            specular_weight: p.specular_weight,
            coat_color: p.coat_color.into(),
            coat_weight: p.coat_weight,
            fuzz_color: p.fuzz_color.into(),
            fuzz_weight: p.fuzz_weight,
            emission_color: p.emission_color.into(),
            emission_luminance: p.emission_luminance,
            base_diffuse_roughness: p.base_diffuse_roughness,
            base_metalness: p.base_metalness,
            specular_roughness: p.specular_roughness,
            specular_roughness_anisotropy: p.specular_roughness_anisotropy,
            specular_ior: p.specular_ior,
            transmission_weight: p.transmission_weight,
            coat_roughness: p.coat_roughness,
            coat_roughness_anisotropy: p.coat_roughness_anisotropy,
            coat_ior: p.coat_ior,
            coat_darkening: p.coat_darkening,
            fuzz_roughness: p.fuzz_roughness,
            geometry_thin_walled: u32::from(p.geometry_thin_walled),
        }
    }
}
