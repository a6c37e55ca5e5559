//! Metallic paint and its flakes.

use asperity_core::gpu_struct;
use asperity_ndf_sampling::Ndf;
use asperity_noise::{IntegerHash, gpu::FbmUniform3d};

use super::surface::SizedFbmUniform;
use crate::material::{Elimination, GlintField, MetallicPaint};

gpu_struct! {
    /// Metallic paint; [`CountedFlakesUniform`] adds counted flakes.
    pub struct MetallicPaintUniform as "MetallicPaint" {
        /// Orange peel of the coat.
        orange_peel: SizedFbmUniform,
        /// Passive flakes.
        passive: SizedFbmUniform,
        /// Keys of sparkles, for four numbers of each flake.
        keys: [u32; 4],
        /// Keys of three further numbers.
        more_keys: [u32; 4],
        /// Specular color of the flakes.
        specular: [f32; 3],
        /// Beckmann's alpha of the flakes.
        flake_roughness: f32,
        /// Color of the pigment.
        pigment: [f32; 3],
        /// Strength of the orange peel.
        peel_strength: f32,
        /// Target of the color of boosted sparkles.
        boost_target: [f32; 3],
        /// Boost of sparkles.
        boost: f32,
        /// Width of a sparkle in pixels.
        pixel_size: f32,
        /// Maximum width of a sparkle.
        physical_size: f32,
        /// Tilt of sparkles.
        variation: f32,
        /// Fraction of the sparkles that is left out.
        elimination: f32,
        /// Inverse of the unit of adaptive elimination; 0 without it.
        per_unit: f32,
        /// Strength of passive flakes.
        passive_strength: f32,
        /// Relative IOR of the coat.
        coat_index: f32,
        /// Beckmann's alpha of the coat, 0 for a smooth one.
        coat_roughness: f32,
    }
}

gpu_struct! {
    /// Flakes counted within pixels.
    pub struct GlintFieldUniform as "GlintField" {
        /// Distance between flakes.
        spacing: f32,
        /// Standard deviations of the tilt of flakes that mirror a light source.
        bin: f32,
        /// Keys of the two coordinates of a flake's normal.
        tilt_keys: [u32; 2],
        /// Key of the lattice.
        key: u32,
        .. padding: [u32; 3]
    }
}

gpu_struct! {
    /// Metallic paint with counted flakes.
    pub struct CountedFlakesUniform as "CountedFlakes" {
        /// Paint without its sparkles.
        paint: MetallicPaintUniform,
        /// Flakes.
        flakes: GlintFieldUniform,
    }
}

impl MetallicPaint {
    /// Returns the uniform `metallic_paint_uniform` of a shader.
    ///
    /// The sums of octaves have the indices from `first` on, in the order of
    /// [`gpu_sums`](Self::gpu_sums).
    ///
    /// ```
    /// use asperity_shading::{MetallicPaint, MetallicPaintParameters};
    ///
    /// let uniform = MetallicPaint::new(MetallicPaintParameters::default())?.gpu(0);
    /// assert_eq!((uniform.per_unit, uniform.coat_index), (1.0 / 0.002, 1.5));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self, first: u32) -> MetallicPaintUniform {
        let (p, (peel, sparkles, passive)) = (self.parameters(), self.parts());
        let key_of = |k: u32| IntegerHash::gpu_key(sparkles.seed() ^ k.wrapping_mul(0x9e37_79b9));
        MetallicPaintUniform {
            orange_peel: peel.noise().gpu(first),
            passive: passive.noise().gpu(first.wrapping_add(1)),
            keys: [0, 1, 2, 3].map(key_of),
            more_keys: [key_of(4), key_of(5), key_of(6), 0],
            specular: p.specular.into(),
            flake_roughness: p.flake_roughness,
            pigment: p.pigment.into(),
            peel_strength: p.orange_peel_strength,
            boost_target: p.flake_sparkle_boost_target.into(),
            boost: p.flake_sparkle_boost,
            pixel_size: p.flake_sparkle_pixel_size,
            physical_size: p.flake_sparkle_physical_size,
            variation: p.flake_sparkle_variation,
            elimination: p.flake_sparkle_elimination,
            per_unit: match p.smart_flake_sparkle {
                Elimination::Fixed => 0.0,
                Elimination::Adaptive { unit } => 1.0 / unit,
            },
            passive_strength: p.passive_flake_strength,
            coat_index: p.coat_index,
            coat_roughness: p.coat_roughness,
        }
    }

    /// Returns the uniform `counted_flakes_uniform` of a shader; `None` for paint with sparkling
    /// flakes.
    ///
    /// ```
    /// use asperity_shading::{MetallicPaint, MetallicPaintParameters, material::PaintFlakes};
    ///
    /// let flakes = PaintFlakes::Counted { spacing: 2e-4, bin: 0.1 };
    /// let paint = MetallicPaint::new(MetallicPaintParameters { flakes, ..Default::default() })?;
    /// assert_eq!(paint.gpu_counted(0).map(|counted| counted.flakes.spacing), Some(2e-4));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu_counted(&self, first: u32) -> Option<CountedFlakesUniform> {
        Some(CountedFlakesUniform { paint: self.gpu(first), flakes: self.glints()?.gpu() })
    }

    /// Returns the sums of octaves of orange peel and of passive flakes.
    #[must_use]
    pub fn gpu_sums(&self) -> [FbmUniform3d; 2] {
        let (peel, _, passive) = self.parts();
        [peel.noise().gpu_sum(), passive.noise().gpu_sum()]
    }
}

impl<N: Ndf> GlintField<N> {
    /// Returns the flakes as a uniform of a shader.
    #[must_use]
    pub fn gpu(&self) -> GlintFieldUniform {
        let ([spacing, bin], seed) = self.parts();
        let tilt_keys = Self::TILTS.map(|tilt| IntegerHash::gpu_key(seed ^ tilt));
        GlintFieldUniform { spacing, bin, tilt_keys, key: IntegerHash::gpu_key(seed), padding: [0; 3] }
    }
}
