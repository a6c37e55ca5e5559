//! Bump maps and normal maps.

use core::ops::Deref;

use asperity_core::gpu_struct;
use asperity_ndf_sampling::{Beckmann, Ggx};
use glam::{Vec2, Vec3};

use crate::level_of_detail::{GaussianField, LevelOfDetail};
use crate::material::{BumpMapped, NormalMapped};
use crate::normal_map::{SlopeLobes, SlopePyramid};
use crate::pixel::FrequencyClamp;

gpu_struct! {
    /// Octaves that a pixel resolves.
    pub struct FrequencyClampUniform as "FrequencyClamp" {
        /// Cells of the first octave per unit of length.
        frequency: f32,
        /// Base-2 logarithm of the ratio of the frequencies of successive octaves, above 0.
        log_lacunarity: f32,
        /// Maximum number of octaves.
        max_octaves: f32,
    }
}

impl FrequencyClamp {
    /// Returns the clamp as a uniform of a shader.
    ///
    /// ```
    /// use asperity_shading::pixel::FrequencyClamp;
    ///
    /// let clamp = FrequencyClamp::new(10.0, 2.0, 8.0)?.gpu();
    /// assert_eq!((clamp.frequency, clamp.log_lacunarity, clamp.max_octaves), (10.0, 1.0, 8.0));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self) -> FrequencyClampUniform {
        FrequencyClampUniform {
            frequency: self.frequency(),
            log_lacunarity: self.log2_lacunarity(),
            max_octaves: self.max_octaves(),
        }
    }
}

gpu_struct! {
    /// A bump map of GGX or Beckmann.
    pub struct BumpMappedUniform as "BumpMapped" {
        /// Cells of the first octave per unit of length.
        frequency: f32,
        /// Base-2 logarithm of the ratio of the frequencies of successive octaves, above 0.
        log_lacunarity: f32,
        /// Maximum number of octaves.
        max_octaves: f32,
        /// 0 for the exact rule, 1 for the fractal rule.
        rule: u32,
        /// Roughness along x and y.
        alpha: [f32; 2],
        /// 0 for GGX, 1 for Beckmann.
        ndf: u32,
        /// Index of the sum of octaves.
        sum: u32,
        /// Reflectance of the facets, at least 0.
        color: [f32; 3],
        .. padding: u32
    }
}

impl<F: GaussianField> BumpMapped<Ggx, F> {
    /// Returns the uniform `bump_mapped_uniform` of a shader.
    ///
    /// The sum of octaves has the index `sum`.
    ///
    /// ```
    /// use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
    /// use asperity_shading::{BumpField, BumpMapped, Ggx, LevelOfDetail, glam::Vec3};
    ///
    /// let octaves = GaussianFbm::new(GaussianNoise::new(1), FbmSpectrum::default());
    /// let (ndf, bumps) = (Ggx::new(0.2, 0.4)?, BumpField::new(octaves, 20.0)?);
    /// let copper = BumpMapped { ndf, bumps, rule: LevelOfDetail::Exact, color: Vec3::ONE }.gpu(0);
    /// assert_eq!((copper.frequency, copper.alpha), (20.0, [0.2, 0.4]));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    pub fn gpu(&self, sum: u32) -> BumpMappedUniform {
        self.packed([self.ndf.alpha_x(), self.ndf.alpha_y()], [0, sum])
    }
}

impl<F: GaussianField> BumpMapped<Beckmann, F> {
    /// Returns the uniform `bump_mapped_uniform` of a shader.
    ///
    /// The sum of octaves has the index `sum`.
    #[must_use]
    pub fn gpu(&self, sum: u32) -> BumpMappedUniform {
        self.packed([self.ndf.alpha_x(), self.ndf.alpha_y()], [1, sum])
    }
}

impl<N, F: GaussianField> BumpMapped<N, F> {
    fn packed(&self, alpha: [f32; 2], [ndf, sum]: [u32; 2]) -> BumpMappedUniform {
        let FrequencyClampUniform { frequency, log_lacunarity, max_octaves } = self.bumps.clamp().gpu();
        let rule = u32::from(self.rule == LevelOfDetail::Fractal);
        let color = reflectance(self.color);
        BumpMappedUniform { frequency, log_lacunarity, max_octaves, rule, alpha, ndf, sum, color, padding: 0 }
    }
}

/// A reflectance; components that are not positive become 0.
fn reflectance(color: Vec3) -> [f32; 3] {
    color.to_array().map(|component| component.max(0.0))
}

gpu_struct! {
    /// A normal map at every zoom.
    pub struct SlopePyramidUniform as "SlopePyramid" {
        /// Texels of a row of the map.
        width: u32,
        /// Rows of the map.
        height: u32,
        /// The level with a single texel.
        last_level: u32,
        /// Groups of slopes.
        groups: u32,
    }
}

impl<const K: usize, S: Deref<Target = [Vec2]>, L: Deref<Target = [SlopeLobes<K>]>> SlopePyramid<K, S, L> {
    /// Returns the map as a uniform of a shader.
    ///
    /// The example needs the feature `alloc`.
    ///
    #[cfg_attr(feature = "alloc", doc = "```")]
    #[cfg_attr(not(feature = "alloc"), doc = "```ignore")]
    /// use asperity_shading::{SlopePyramid, glam::Vec2};
    ///
    /// let map = SlopePyramid::<2>::new(4, 2, vec![Vec2::X; 8])?;
    /// let uniform = map.gpu();
    /// assert_eq!((uniform.width, uniform.height, uniform.last_level, uniform.groups), (4, 2, 2, 2));
    /// // Two centers, eight slopes, eleven texels of two lobes.
    /// assert_eq!(map.gpu_numbers().count(), 2 * 2 + 2 * 8 + 6 * 2 * 11);
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self) -> SlopePyramidUniform {
        let ([width, height], ..) = self.parts();
        SlopePyramidUniform {
            width: width as u32,
            height: height as u32,
            last_level: self.last_level(),
            groups: K as u32,
        }
    }

    /// Iterates over the numbers of the table `slope_pyramid_number` of a shader.
    ///
    /// Two numbers for the center of each group, two for the slope of each texel, and six for each
    /// group of each texel of every level: weight, mean, covariance.
    pub fn gpu_numbers(&self) -> impl Iterator<Item = f32> {
        let (_, slopes, centers, lobes) = self.parts();
        let places = centers.iter().chain(slopes).flat_map(Vec2::to_array);
        places.chain(lobes.iter().flat_map(SlopeLobes::lobes).flat_map(|lobe| {
            let ([x, y], [xx, xy, yy]) = (lobe.moments.mean.to_array(), lobe.moments.covariance);
            [lobe.weight, x, y, xx, xy, yy]
        }))
    }
}

gpu_struct! {
    /// A glossy surface with a normal map.
    pub struct NormalMappedUniform as "NormalMapped" {
        /// Map.
        map: SlopePyramidUniform,
        /// Reflectance of the facets, at least 0.
        color: [f32; 3],
        /// Beckmann's alpha along x, of the surface between the slopes of the map.
        alpha_x: f32,
        /// Beckmann's alpha along y.
        alpha_y: f32,
        .. padding: [u32; 3]
    }
}

impl<const K: usize> NormalMapped<'_, K> {
    /// Returns the uniform `normal_mapped_uniform` of a shader.
    #[must_use]
    pub fn gpu(&self) -> NormalMappedUniform {
        NormalMappedUniform {
            map: self.map.gpu(),
            color: reflectance(self.color),
            alpha_x: self.roughness.alpha_x(),
            alpha_y: self.roughness.alpha_y(),
            padding: [0; 3],
        }
    }
}
