//! Texels of octaves of noise for a mip-mapped texture.

use asperity_noise::{Fbm, FbmSpectrum, GaussianNoise, IntegerHash, NoiseError, glam::Vec2, lattice::Tiled};

/// A two-channel texture of a tileable sum of octaves; mip level l contains all octaves except the
/// finest l.
///
/// ```text
/// texel = Σ_{i < k} aᵢ nᵢ(p),   k = max_octaves − level,   p = period · (x + ½, y + ½)/size
/// ```
///
/// Sizes halve from level to level, and so does the frequency of the finest octave. Every level
/// therefore has the same number of texels per cell of its finest octave. A blend of two levels by
/// a sampler is the sum with a fraction of one octave, so that `mip_mapped_fbm` of the shader
/// only divides it.
///
/// After Kautz, Heidrich, Seidel 2001, "Real-Time Bump Map Synthesis", §5.2.2, with Gaussian noise
/// instead of turbulence and N(0, 1) instead of the numbers that index L. There filtering narrows
/// the distribution of the numbers, here only between texels.
///
/// ```
/// use asperity_wgsl::noise::MipMapped;
///
/// let texture = MipMapped::new(7, 8, 5, 0.5)?;
/// assert_eq!([texture.size(0), texture.size(5)], [8 * 16 * 4, 16]);
/// assert_eq!(texture.texel(5, 3, 2), [0.0; 2]);
/// assert_ne!(texture.texel(0, 3, 2), texture.texel(1, 1, 1));
/// # Ok::<(), asperity_noise::NoiseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MipMapped {
    sum: Fbm<GaussianNoise<Tiled<IntegerHash, 2>>, Vec2>,
    period: u32,
}

impl MipMapped {
    /// Texels along a cell of the finest octave of each level.
    pub const TEXELS_PER_CELL: u32 = 4;

    /// Creates the texture of a seed.
    ///
    /// `period` is the number of cells of the first octave along each side, `octaves` the number of
    /// octaves of lacunarity 2. `period` should be a power of two; otherwise hardware rounds the
    /// sizes of levels.
    ///
    /// # Errors
    ///
    /// If [`FbmSpectrum::new`] rejects `gain` or `octaves`, or [`Fbm::tiled`] rejects `period`.
    pub fn new(seed: u32, period: u32, octaves: u32, gain: f32) -> Result<Self, NoiseError> {
        let spectrum = FbmSpectrum::new(2.0, gain, octaves)?;
        let sum = Fbm::new(GaussianNoise::new(seed), spectrum);
        Ok(Self { sum: sum.tiled([period; 2])?, period })
    }

    /// Returns the sum of octaves of the texture, for the uniform of sums.
    #[must_use]
    pub const fn sum(&self) -> &Fbm<GaussianNoise<Tiled<IntegerHash, 2>>, Vec2> {
        &self.sum
    }

    /// Returns the number of levels of the texture, including the last, which has no octaves.
    #[must_use]
    pub fn levels(&self) -> u32 {
        self.sum.spectrum().max_octaves() + 1
    }

    /// Returns the number of texels along a side of a level.
    #[must_use]
    pub fn size(&self, level: u32) -> u32 {
        let octaves = self.sum.spectrum().max_octaves();
        let finest = self.period.saturating_mul(Self::TEXELS_PER_CELL).saturating_mul(1 << (octaves - 1));
        finest >> level.min(31)
    }

    /// Returns both channels of a texel, column `x` of row `y`.
    #[must_use]
    pub fn texel(&self, level: u32, x: u32, y: u32) -> [f32; 2] {
        let spectrum = self.sum.spectrum();
        let octaves = spectrum.max_octaves().saturating_sub(level) as f32;
        let per_texel = self.period as f32 / self.size(level).max(1) as f32;
        let p = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) * per_texel;
        let scale = spectrum.root_sum_of_squares(octaves);
        self.sum.pair_with_octaves(p, octaves).map(|channel| scale * channel.value)
    }
}
