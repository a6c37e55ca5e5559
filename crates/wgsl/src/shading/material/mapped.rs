//! Bump maps of a normal distribution, and authored normal maps.

use asperity_shading::level_of_detail::GaussianField;
use asperity_shading::material::NormalMapped;
use asperity_shading::{Beckmann, BumpMapped, Ggx, LevelOfDetail, glam::Vec3};

use super::surface::SURFACE_POINT;
use crate::ndf::GAUSSIAN_SPLIT;
use crate::noise::sums::GAUSSIAN_OCTAVES_3D;
use crate::part::{Binding, Part, part, uniform};
use crate::shading::normal_map::{SLOPE_PYRAMID, slope_pyramid_words};
use crate::shading::reflectance::{BRDF, FACET};
use crate::shading::{DIRECTION, FREQUENCY_CLAMP, LEVEL_OF_DETAIL, frequency_clamp_words};

/// Bump map of a normal distribution, [`BumpMapped`].
pub static BUMP_MAPPED: Part = part!(
    "shading/material/bump_mapped",
    SURFACE_POINT,
    GAUSSIAN_OCTAVES_3D,
    FREQUENCY_CLAMP,
    LEVEL_OF_DETAIL,
    FACET,
    DIRECTION,
    BRDF,
)
.with_bindings(&[Binding::Uniform { name: "bump_mapped_uniform", of: "BumpMapped" }]);

/// Glossy surface with an authored normal map, [`NormalMapped`].
pub static NORMAL_MAPPED: Part = part!(
    "shading/material/normal_mapped",
    SURFACE_POINT,
    SLOPE_PYRAMID,
    GAUSSIAN_SPLIT,
    FACET,
    DIRECTION,
    BRDF
)
.with_bindings(&[Binding::Uniform { name: "normal_mapped_uniform", of: "NormalMapped" }]);

uniform! {
    /// A bump map of GGX or Beckmann as the words of the structure `BumpMapped`.
    ///
    /// | words | |
    /// |---|---|
    /// | 0–3 | cells of the first octave per unit of length, base-2 logarithm of the lacunarity, maximum number of octaves; 1 for the fractal rule |
    /// | 4–7 | α along x and y; 1 for Beckmann; index of the sum of octaves |
    /// | 8–11 | reflectance of the facets, at least 0; 0 |
    ///
    /// ```
    /// use asperity_wgsl::shading::material::BumpMappedUniform;
    /// use asperity_shading::noise::{GaussianNoise, GaussianFbm, FbmSpectrum};
    /// use asperity_shading::{BumpField, BumpMapped, Ggx, LevelOfDetail, glam::Vec3};
    ///
    /// let bumps = BumpField::new(GaussianFbm::new(GaussianNoise::new(1), FbmSpectrum::default()), 20.0)?;
    /// let copper = BumpMapped { ndf: Ggx::new(0.2, 0.4)?, bumps, rule: LevelOfDetail::Exact, color: Vec3::ONE };
    /// let words = BumpMappedUniform::ggx(&copper, 0).words();
    /// assert_eq!([words[0], words[4], words[5]].map(f32::from_bits), [20.0, 0.2, 0.4]);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    BumpMappedUniform: 12, "BumpMapped";
}

impl BumpMappedUniform {
    /// Packs a GGX bump map whose sum of octaves has this index in the uniform of sums.
    #[must_use]
    pub fn ggx<F: GaussianField>(material: &BumpMapped<Ggx, F>, sum: u32) -> Self {
        Self::new(material, [material.ndf.alpha_x(), material.ndf.alpha_y()], [0, sum])
    }

    /// Packs a Beckmann bump map whose sum of octaves has this index in the uniform of sums.
    #[must_use]
    pub fn beckmann<F: GaussianField>(material: &BumpMapped<Beckmann, F>, sum: u32) -> Self {
        Self::new(material, [material.ndf.alpha_x(), material.ndf.alpha_y()], [1, sum])
    }

    fn new<N, F: GaussianField>(
        material: &BumpMapped<N, F>,
        alpha: [f32; 2],
        [density, sum]: [u32; 2],
    ) -> Self {
        let [frequency, lacunarity, octaves] = frequency_clamp_words(material.bumps.clamp());
        let rule = u32::from(material.rule == LevelOfDetail::Fractal);
        let ([x, y], [r, g, b]) = (alpha.map(f32::to_bits), colour_words(material.color));
        Self([frequency, lacunarity, octaves, rule, x, y, density, sum, r, g, b, 0])
    }
}

/// The words of a reflectance; components that are not positive become 0.
fn colour_words(colour: Vec3) -> [u32; 3] {
    colour.to_array().map(|share| share.max(0.0).to_bits())
}

uniform! {
    /// A surface with a normal map as the words of the structure `NormalMapped`.
    ///
    /// The numbers of the map are
    /// [`slope_pyramid_numbers`](crate::shading::normal_map::slope_pyramid_numbers).
    ///
    /// | words | |
    /// |---|---|
    /// | 0–3 | width and height of the map, its last level, number of groups |
    /// | 4–7 | reflectance of the facets, at least 0; Beckmann's α along x |
    /// | 8–11 | α along y; 0, 0, 0 |
    ///
    /// The example needs the feature `alloc`.
    ///
    #[cfg_attr(feature = "alloc", doc = "```")]
    #[cfg_attr(not(feature = "alloc"), doc = "```ignore")]
    /// use asperity_wgsl::shading::material::NormalMappedUniform;
    /// use asperity_shading::material::NormalMapped;
    /// use asperity_shading::{Beckmann, SlopePyramid, glam::{Vec2, Vec3}};
    ///
    /// let map = SlopePyramid::<4>::new(8, 8, vec![Vec2::ZERO; 64])?;
    /// let stone = NormalMapped { map: map.as_ref(), roughness: Beckmann::isotropic(0.2)?, color: Vec3::ONE };
    /// let words = NormalMappedUniform::new(&stone).words();
    /// assert_eq!((&words[..4], words[7]), (&[8, 8, 3, 4][..], 0.2_f32.to_bits()));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    NormalMappedUniform: 12, "NormalMapped";
}

impl NormalMappedUniform {
    /// Packs a surface.
    #[must_use]
    pub fn new<const K: usize>(material: &NormalMapped<'_, K>) -> Self {
        let [width, height, last, groups] = slope_pyramid_words(&material.map);
        let [x, y] = [material.roughness.alpha_x(), material.roughness.alpha_y()].map(f32::to_bits);
        let [r, g, b] = colour_words(material.color);
        Self([width, height, last, groups, r, g, b, x, y, 0, 0, 0])
    }
}
