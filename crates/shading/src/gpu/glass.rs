//! Tempered glass.

use asperity_core::gpu_struct;
use asperity_noise::gpu::FbmUniform3d;

use super::surface::SizedFbmUniform;
use crate::material::{GlassBody, GlassWaves, TemperedGlass};

gpu_struct! {
    /// Tempered glass.
    pub struct TemperedGlassUniform as "TemperedGlass" {
        /// Noise of the waves.
        noise: SizedFbmUniform,
        /// Unit direction of the waves.
        direction: [f32; 3],
        /// Frequency of the waves in radians per unit of length.
        frequency: f32,
        /// Fraction of the light that a pane transmits.
        tint: [f32; 3],
        /// Amplitude of the waves in units of length.
        amplitude: f32,
        /// Relative IOR.
        index: f32,
        /// Beckmann's alpha of the surfaces, 0 for smooth glass.
        roughness: f32,
        /// 1 for noise waves, 0 for a sine.
        is_noisy: u32,
        /// 1 for the surface of a body, 0 for a pane.
        is_solid: u32,
    }
}

impl TemperedGlass {
    /// Returns the uniform `tempered_glass_uniform` of a shader.
    ///
    /// The sum of octaves [`gpu_sum`](Self::gpu_sum) has the index `sum`.
    ///
    /// ```
    /// use asperity_shading::{TemperedGlass, TemperedGlassParameters};
    ///
    /// let uniform = TemperedGlass::new(TemperedGlassParameters::default())?.gpu(0);
    /// assert_eq!((uniform.direction[1], uniform.frequency), (1.0, 20.0));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self, sum: u32) -> TemperedGlassUniform {
        let (p, (direction, noise)) = (self.parameters(), self.parts());
        TemperedGlassUniform {
            noise: noise.gpu(sum),
            direction: direction.into(),
            frequency: p.wave_frequency,
            tint: p.tint.into(),
            amplitude: p.wave_amplitude,
            index: p.index,
            roughness: p.roughness,
            is_noisy: u32::from(p.waves == GlassWaves::Noise),
            is_solid: u32::from(p.body == GlassBody::Solid),
        }
    }

    /// Returns the sum of octaves of noise waves; glass with sine waves does not read it.
    #[must_use]
    pub fn gpu_sum(&self) -> FbmUniform3d {
        self.parts().1.gpu_sum()
    }
}
