//! Glass.

use asperity_shading::TemperedGlass;
use asperity_shading::material::{GlassBody, GlassWaves};

use super::surface::{FBM, SURFACE_POINT, fbm_words, octaves_of};
use crate::noise::sums::OctavesUniform;
use crate::part::{Binding, Part, part};
use crate::shading::reflectance::{COAT, ROUGH_DIELECTRIC};

/// Tempered glass, a pane or a body, smooth or frosted, with sine or noise waves:
/// [`TemperedGlass`].
pub static TEMPERED_GLASS: Part =
    part!("shading/material/tempered_glass", SURFACE_POINT, FBM, COAT, ROUGH_DIELECTRIC)
        .with_bindings(&[Binding::Uniform { name: "tempered_glass_uniform", of: "TemperedGlass" }]);

/// Tempered glass as the words of the structure `TemperedGlass`, and its sum of octaves.
///
/// | words | |
/// |---|---|
/// | 0–3 | noise: cells per unit of length, 1, octaves, index of the sum |
/// | 4–7 | unit direction of the waves; their frequency in radians per unit of length |
/// | 8–11 | tint; amplitude of the waves in units of length |
/// | 12–15 | relative IOR; Beckmann's α, 0 for smooth glass; 1 for noise; 1 for a body |
///
/// ```
/// use asperity_wgsl::shading::material::TemperedGlassUniform;
/// use asperity_shading::{TemperedGlass, TemperedGlassParameters};
///
/// let words = TemperedGlassUniform::new(&TemperedGlass::new(TemperedGlassParameters::default())?, 0).words();
/// assert_eq!([words[5], words[7]].map(f32::from_bits), [1.0, 20.0]);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TemperedGlassUniform {
    words: [u32; Self::WORDS],
    sum: OctavesUniform<3>,
}

impl TemperedGlassUniform {
    /// Words of the structure.
    pub const WORDS: usize = 16;

    /// Packs glass whose sum of octaves has this index in the uniform of sums.
    #[must_use]
    pub fn new(glass: &TemperedGlass, sum: u32) -> Self {
        let (p, (direction, noise)) = (glass.parameters(), glass.parts());
        let [[a, b, c], [d, e, f]] = [direction, p.tint].map(|v| v.to_array());
        let floats = [a, b, c, p.wave_frequency, d, e, f, p.wave_amplitude, p.index, p.roughness];
        let mut words = [0; Self::WORDS];
        words[..4].copy_from_slice(&fbm_words(noise, sum));
        words[4..14].copy_from_slice(&floats.map(f32::to_bits));
        words[14] = u32::from(p.waves == GlassWaves::Noise);
        words[15] = u32::from(p.body == GlassBody::Solid);
        Self { words, sum: octaves_of(noise) }
    }

    /// Returns the words, in the layout of `TemperedGlass`.
    #[must_use]
    pub const fn words(&self) -> [u32; Self::WORDS] {
        self.words
    }

    /// Returns the sum of octaves of noise, for the uniform of sums; glass with sine waves does not
    /// read it.
    #[must_use]
    pub const fn sum(&self) -> OctavesUniform<3> {
        self.sum
    }
}
