//! Carpet.

use asperity_core::gpu_struct;
use asperity_noise::gpu::FbmUniform3d;

use super::surface::{SegmentsUniform, SizedFbmUniform};
use crate::material::{Carpet, SeamPattern, half_mean};

gpu_struct! {
    /// The fibers of a carpet.
    pub struct FibersUniform as "Fibers" {
        /// Cells of fibers.
        segments: SegmentsUniform,
        /// Half the width of a fiber, in texture coordinates.
        half_width: f32,
        /// Sideways bend, in texture coordinates.
        bend: f32,
        /// Contrast.
        contrast: f32,
        /// Mean of the brightness.
        mean: f32,
    }
}

gpu_struct! {
    /// A carpet.
    pub struct CarpetUniform as "Carpet" {
        /// Threads.
        threads: SizedFbmUniform,
        /// Shining threads, by turbulence.
        shine: SizedFbmUniform,
        /// Dark areas.
        dark: SizedFbmUniform,
        /// Areas where threads lean over the seams.
        crossover: SizedFbmUniform,
        /// Fibers.
        fibers: FibersUniform,
        /// Mean square of the slope of fibers.
        fiber_square_slope: f32,
        /// Weight of fibers in the colors.
        fiber_strength: f32,
        /// Tilt by fibers.
        fiber_bump: f32,
        /// Pattern of seams: 0 for none, 1 for lines, 2 for a grid.
        seams_pattern: u32,
        /// Direction across the seams in texture coordinates.
        seams_direction: [f32; 2],
        /// Frequency of the seams in radians.
        seams_frequency: f32,
        /// Darkening at a seam.
        seams_amplitude: f32,
        /// Slope at a seam.
        seams_bump: f32,
        /// Fraction of the seams that is covered by threads.
        crossover_strength: f32,
        /// Variation of the diffuse color by threads.
        thread_strength: f32,
        /// Tilt by threads.
        thread_bump: f32,
        /// Increase of the specular color by shining threads.
        shine_strength: f32,
        /// Darkening of dark areas.
        dark_strength: f32,
        /// Half the mean of the magnitude of simplex noise.
        half_mean: f32,
        /// Roughness of the facets.
        roughness: f32,
        /// Diffuse color.
        diffuse: [f32; 3],
        /// Beckmann's alpha of the gloss.
        specular_roughness: f32,
        /// Specular color.
        specular: [f32; 3],
        /// Width of the rim.
        rim_width: f32,
        /// Light of the rim.
        rim: [f32; 3],
        /// Unused.
        reserved: f32,
        /// Coefficients of the mean of shining threads given the known octaves, two for each number
        /// of octaves.
        coefficients: [[f32; 4]; 8],
    }
}

impl Carpet {
    /// Returns the uniform `carpet_uniform` of a shader.
    ///
    /// The sums of octaves have the indices from `first` on, in the order of
    /// [`gpu_sums`](Self::gpu_sums).
    ///
    /// ```
    /// use asperity_shading::{Carpet, CarpetParameters};
    ///
    /// let uniform = Carpet::new(CarpetParameters { roughness: 0.7, ..Default::default() })?.gpu(4);
    /// assert_eq!((uniform.roughness, uniform.threads.sum, uniform.crossover.sum), (0.7, 4, 7));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self, first: u32) -> CarpetUniform {
        let (p, (threads, shine, dark, seams, crossover, fibers)) = (self.parameters(), self.parts());
        let (_, frequency, coefficients) = shine.parts();
        let (segments, [half_width, mean, fiber_square_slope]) = fibers.parts();
        let sum = |i| first.wrapping_add(i);
        let coefficients = coefficients.as_flattened().as_chunks().0;
        CarpetUniform {
            threads: threads.noise().gpu(sum(0)),
            shine: SizedFbmUniform { frequency, highest: 4.0, octaves: 3.0, sum: sum(1) },
            dark: dark.noise().gpu(sum(2)),
            crossover: crossover.gpu(sum(3)),
            fibers: FibersUniform {
                segments: segments.gpu(),
                half_width,
                bend: p.fibers.fiber_bend * segments.length,
                contrast: p.fibers.fiber_contrast,
                mean,
            },
            fiber_square_slope,
            fiber_strength: p.fiber_strength,
            fiber_bump: p.fiber_bump_strength,
            seams_pattern: match p.seams_pattern {
                SeamPattern::None => 0,
                SeamPattern::Lines => 1,
                SeamPattern::Grid => 2,
            },
            seams_direction: seams.direction().into(),
            seams_frequency: seams.frequency(),
            seams_amplitude: p.seams_amplitude,
            seams_bump: p.seams_bump_strength,
            crossover_strength: p.seam_crossover_strength,
            thread_strength: p.diffuse_thread_strength,
            thread_bump: p.diffuse_thread_bump_strength,
            shine_strength: p.specular_thread_strength,
            dark_strength: p.dark_area_strength,
            half_mean: half_mean(),
            roughness: p.roughness,
            diffuse: p.diffuse.into(),
            specular_roughness: p.specular_roughness,
            specular: p.specular.into(),
            rim_width: p.fake_rim_light_width,
            rim: (p.fake_rim_light * p.fake_rim_light_color).into(),
            reserved: 0.0,
            coefficients: core::array::from_fn(|i| coefficients[i]),
        }
    }

    /// Returns the sums of octaves of threads, shining threads, dark areas, and threads over seams.
    #[must_use]
    pub fn gpu_sums(&self) -> [FbmUniform3d; 4] {
        let (threads, shine, dark, _, crossover, _) = self.parts();
        [threads.noise().gpu_sum(), shine.parts().0.gpu(), dark.noise().gpu_sum(), crossover.gpu_sum()]
    }
}
