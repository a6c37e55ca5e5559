//! Wear of surfaces.

use asperity_core::gpu_struct;
use asperity_noise::gpu::FbmUniform3d;

use super::surface::{SegmentsUniform, SizedFbmUniform};
use crate::material::{Scratches, Variations, half_mean};

gpu_struct! {
    /// Scratches on metal. Lengths are in texture coordinates.
    pub struct ScratchesUniform as "Scratches" {
        /// Cells of scratches.
        segments: SegmentsUniform,
        /// Specular color of the metal.
        specular: [f32; 3],
        /// Half the width of a scratch.
        half_width: f32,
        /// Far-field mean squares of slopes across: along u, mixed, along v.
        removed_far: [f32; 3],
        /// Far-field fraction that is covered by scratches.
        covered_far: f32,
        /// Depth of a scratch over half its width.
        strength: f32,
        /// Beckmann's alpha of the metal.
        roughness: f32,
        .. padding: [u32; 2]
    }
}

impl Scratches {
    /// Returns the uniform `scratches_uniform` of a shader.
    ///
    /// ```
    /// use asperity_shading::{Scratches, ScratchesParameters};
    ///
    /// let uniform = Scratches::new(ScratchesParameters::default())?.gpu();
    /// assert_eq!((uniform.segments.cell, uniform.strength), (0.05, 0.5));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self) -> ScratchesUniform {
        let (p, (covered_far, removed)) = (self.parameters(), self.far());
        ScratchesUniform {
            segments: self.segments().gpu(),
            specular: p.specular.into(),
            half_width: self.half_width(),
            removed_far: removed.into(),
            covered_far,
            strength: p.scratch_strength,
            roughness: p.roughness,
            padding: [0; 2],
        }
    }
}

gpu_struct! {
    /// A surface with blemishes and dents.
    pub struct VariationsUniform as "Variations" {
        /// Blemishes.
        blemishes: SizedFbmUniform,
        /// Dents.
        dents: SizedFbmUniform,
        /// Diffuse color.
        diffuse: [f32; 3],
        /// Roughness of the facets.
        roughness: f32,
        /// Specular color.
        specular: [f32; 3],
        /// Beckmann's alpha of the gloss.
        gloss_roughness: f32,
        /// Tilt by blemishes.
        blemish_bump: f32,
        /// Variation of the color by blemishes.
        blemish_color: f32,
        /// Tilt by dents.
        dent_strength: f32,
        /// Fraction of the gradients of dents that is kept.
        dent_cover: f32,
        /// Gradients of dents whose words are below this are dropped.
        dropped: u32,
        /// Half the mean of the magnitude of simplex noise.
        half_mean: f32,
        .. padding: [u32; 2]
    }
}

impl Variations {
    /// Returns the uniform `variations_uniform` of a shader.
    ///
    /// The sums of octaves have the indices from `first` on, in the order of
    /// [`gpu_sums`](Self::gpu_sums).
    ///
    /// ```
    /// use asperity_shading::{Variations, VariationsParameters};
    ///
    /// let uniform = Variations::new(VariationsParameters::default())?.gpu(3);
    /// assert_eq!((uniform.blemishes.sum, uniform.dents.sum), (3, 4));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self, first: u32) -> VariationsUniform {
        let (p, (blemishes, dents)) = (self.parameters(), self.parts());
        VariationsUniform {
            blemishes: blemishes.noise().gpu(first),
            dents: dents.noise().gpu(first.wrapping_add(1)),
            diffuse: p.diffuse.into(),
            roughness: p.roughness,
            specular: p.specular.into(),
            gloss_roughness: p.gloss_roughness,
            blemish_bump: p.small_blemish_bump_strength,
            blemish_color: p.small_blemish_color_strength,
            dent_strength: p.dent_strength,
            dent_cover: p.dent_cover,
            dropped: dents.dropped(),
            half_mean: half_mean(),
            padding: [0; 2],
        }
    }

    /// Returns the sums of octaves of blemishes and of dents.
    #[must_use]
    pub fn gpu_sums(&self) -> [FbmUniform3d; 2] {
        let (blemishes, dents) = self.parts();
        [blemishes.noise().gpu_sum(), dents.noise().gpu_sum()]
    }
}
