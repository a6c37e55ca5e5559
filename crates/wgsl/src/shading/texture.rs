//! Procedural textures: brick, bevel, stars, marble, gas, perturbed coordinates.

use asperity_noise::{Noise, Perlin};
use asperity_shading::texture::{Bevel, Gas, PerturbedTexture, StarWallpaper};
use asperity_shading::{Brick, Marble};

use crate::ndf::ELEMENTARY;
use crate::noise::sums::{FREQUENCY_CLAMP, OctavesUniform, octaves_3d};
use crate::noise::{PERLIN_2002, WHITE, key};
use crate::part::{Part, part, uniform};
use crate::shading::pixel::FOOTPRINT;
use crate::shading::{DIRECTION, MATH};

/// Bricks with grooves of mortar, at points and over boxes, [`Brick`].
pub static BRICK: Part = part!("shading/texture/brick", DIRECTION);

/// Slopes within a pixel of a wall of bricks as facets, [`Brick::facets`].
pub static BRICK_FACETS: Part = part!("shading/texture/brick_facets", BRICK, DIRECTION);

/// Ridges along the edges of a tile, at points and as facets, [`Bevel`].
pub static BEVEL: Part = part!("shading/texture/bevel", DIRECTION);

/// Stars in random cells of a grid, filtered over a pixel: [`StarWallpaper`].
pub static STAR_WALLPAPER: Part =
    part!("shading/texture/star_wallpaper", MATH, DIRECTION, ELEMENTARY, FREQUENCY_CLAMP, WHITE);

/// Blue marble by position, filtered over a pixel: [`Marble`].
pub static MARBLE: Part = part!("shading/texture/marble", MATH, FREQUENCY_CLAMP, PERLIN_2002);

/// Density of gas in 3-D, filtered over a pixel, and its fraction in a column of steam: [`Gas`],
/// [`Steam`](asperity_shading::texture::Steam).
pub static GAS: Part = part!("shading/texture/gas", ELEMENTARY, FOOTPRINT, octaves_3d::PERLIN_2002);

/// Light and transmittance along a ray through gas, and its interval in steam:
/// [`march`](fn@asperity_shading::texture::march),
/// [`Steam::interval`](asperity_shading::texture::Steam::interval).
pub static GAS_MARCH: Part = part!("shading/texture/gas_march", GAS, DIRECTION, MATH, ELEMENTARY);

/// Texture coordinates displaced by noise, [`PerturbedTexture`].
pub static PERTURBED: Part = part!("shading/texture/perturbed", FOOTPRINT, PERLIN_2002);

/// A wall of bricks as the words of the structure `Brick`.
///
/// Sides of a brick including its mortar in texture coordinates, and half the mortar as a fraction
/// of either side.
///
/// ```
/// use asperity_wgsl::shading::texture::BrickUniform;
/// use asperity_shading::Brick;
///
/// let words = BrickUniform::new(&Brick::new(0.2, 0.1, 0.05)?).words();
/// assert_eq!(words.map(f32::from_bits), [0.25, 0.15, 0.1, 0.025 / 0.15]);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BrickUniform([u32; Self::WORDS]);

impl BrickUniform {
    /// Words of a wall.
    pub const WORDS: usize = 4;

    /// Packs a wall.
    #[must_use]
    pub fn new(wall: &Brick) -> Self {
        let (cell, margin) = (wall.cell(), wall.margin());
        Self([cell.x, cell.y, margin.x, margin.y].map(f32::to_bits))
    }

    /// Returns the words, in the layout of `Brick`.
    #[must_use]
    pub const fn words(&self) -> [u32; Self::WORDS] {
        self.0
    }
}

/// A ridge as the words of the structure `Bevel`.
///
/// Widths of the plateau and of the flank, and the flank's slopes at its top and its bottom.
///
/// ```
/// use asperity_wgsl::shading::texture::BevelUniform;
/// use asperity_shading::texture::Bevel;
///
/// let words = BevelUniform::new(&Bevel::new(0.25, 0.75, 0.0, 1.0)?).words();
/// assert_eq!(words.map(f32::from_bits), [0.25, 0.5, 0.0, 1.0]);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BevelUniform([u32; Self::WORDS]);

impl BevelUniform {
    /// Words of a ridge.
    pub const WORDS: usize = 4;

    /// Packs a ridge.
    #[must_use]
    pub fn new(ridge: &Bevel) -> Self {
        Self([ridge.plateau(), ridge.flank(), ridge.top(), ridge.bottom()].map(f32::to_bits))
    }

    /// Returns the words, in the layout of `Bevel`.
    #[must_use]
    pub const fn words(&self) -> [u32; Self::WORDS] {
        self.0
    }
}

uniform! {
    /// Wallpaper as the words of the structure `StarWallpaper`.
    ///
    /// | words | |
    /// |---|---|
    /// | 0–3 | points of a star; radii of its notches and points in texture coordinates; cells per unit |
    /// | 4–8 | probability of a star; far-field fraction of stars; cosine and sine of half the angle between points; that angle in radians |
    /// | 9–11 | keys of the lattices of the presence and the position of stars |
    ///
    /// ```
    /// use asperity_wgsl::shading::texture::StarWallpaperUniform;
    /// use asperity_shading::texture::StarWallpaper;
    ///
    /// let words = StarWallpaperUniform::new(&StarWallpaper::default()).words();
    /// assert_eq!([words[0], words[3]].map(f32::from_bits), [5.0, 10.0]);
    /// ```
    StarWallpaperUniform: 12, "StarWallpaper";
}

impl StarWallpaperUniform {
    /// Packs a wallpaper.
    #[must_use]
    pub fn new(wallpaper: &StarWallpaper) -> Self {
        let (floats, seeds) = wallpaper.parts();
        let mut words = [0; Self::WORDS];
        words[..9].copy_from_slice(&floats.map(f32::to_bits));
        words[9..].copy_from_slice(&seeds.map(key));
        Self(words)
    }
}

uniform! {
    /// Marble as the words of the structure `Marble`.
    ///
    /// | words | |
    /// |---|---|
    /// | 0–3 | cells of the first octave per unit of length; standard deviation of one octave; 0, 0 |
    /// | 4–7 | keys of its octaves |
    /// | 8–23 | distribution function of an octave at −3.5, −3, … 4 standard deviations |
    ///
    /// ```
    /// use asperity_wgsl::shading::texture::MarbleUniform;
    /// use asperity_shading::Marble;
    ///
    /// let words = MarbleUniform::new(&Marble::default()).words();
    /// assert_eq!([words[0], words[15], words[23]].map(f32::from_bits), [2.5, 0.5, 1.0]);
    /// ```
    MarbleUniform: 24, "Marble";
}

impl MarbleUniform {
    /// Packs a marble.
    #[must_use]
    pub fn new(marble: &Marble) -> Self {
        let ((scale, seed), statistics) = (marble.parts(), Perlin::default().statistics(3));
        let mut words = [0; Self::WORDS];
        words[..2].copy_from_slice(&[scale, statistics.standard_deviation].map(f32::to_bits));
        words[4..8].copy_from_slice(&[0, 1, 2, 3].map(|i| key(seed.wrapping_add(i))));
        let parts = words[8..].len();
        for (word, k) in words[8..].iter_mut().zip(1..) {
            let at = statistics.cdf.get(k * statistics.cdf.len() / parts).filter(|_| k < parts);
            *word = at.copied().unwrap_or(1.0).to_bits();
        }
        Self(words)
    }
}

/// Gas as the words of the structure `Gas`, and its sum of octaves.
///
/// Octaves, maximum density, exponent, variance of the magnitude of an octave; index of the sum, 1
/// for veins, 0, 0.
///
/// ```
/// use asperity_wgsl::shading::texture::GasUniform;
/// use asperity_shading::texture::Gas;
///
/// let words = GasUniform::new(&Gas::default(), 2).words();
/// assert_eq!([words[0], words[1], words[2]].map(f32::from_bits), [5.0, 2.0, 3.0]);
/// assert_eq!(words[4..], [2, 0, 0, 0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GasUniform {
    words: [u32; Self::WORDS],
    sum: OctavesUniform<3>,
}

impl GasUniform {
    /// Words of the structure.
    pub const WORDS: usize = 8;

    /// Packs gas whose sum of octaves has this index in the uniform of sums.
    #[must_use]
    pub fn new(gas: &Gas, sum: u32) -> Self {
        let (turbulence, [octaves, density, exponent], veins) = gas.parts();
        let [first, second, ..] = turbulence.field().statistics(3).absolute_moments;
        let floats = [octaves, density, exponent, second - first * first];
        let [a, b, c, d] = floats.map(f32::to_bits);
        Self { words: [a, b, c, d, sum, u32::from(veins), 0, 0], sum: OctavesUniform::new(turbulence) }
    }

    /// Returns the words, in the layout of `Gas`.
    #[must_use]
    pub const fn words(&self) -> [u32; Self::WORDS] {
        self.words
    }

    /// Returns the sum of octaves, for the uniform of sums.
    #[must_use]
    pub const fn sum(&self) -> OctavesUniform<3> {
        self.sum
    }
}

uniform! {
    /// Texture coordinates displaced by noise as the words of the structure `PerturbedTexture`.
    ///
    /// Strengths in texture coordinates, cells of noise per unit of length, its standard deviation;
    /// two keys, 0, 0.
    ///
    /// ```
    /// use asperity_wgsl::shading::texture::PerturbedUniform;
    /// use asperity_shading::texture::PerturbedTexture;
    ///
    /// let words = PerturbedUniform::new(&PerturbedTexture::default()).words();
    /// assert_eq!([words[0], words[1], words[2]].map(f32::from_bits), [0.1, 0.05, 0.2]);
    /// ```
    PerturbedUniform: 8, "PerturbedTexture";
}

impl PerturbedUniform {
    /// Packs a texture.
    #[must_use]
    pub fn new(texture: &PerturbedTexture) -> Self {
        let deviation = texture.noise.statistics(3).standard_deviation;
        let floats = [texture.strength.x, texture.strength.y, texture.scale, deviation];
        let [a, b, c, d] = floats.map(f32::to_bits);
        Self([a, b, c, d, key(texture.seed), key(texture.seed.wrapping_add(1)), 0, 0])
    }
}
