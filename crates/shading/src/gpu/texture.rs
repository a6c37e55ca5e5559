//! Procedural textures.

use asperity_core::gpu_struct;
use asperity_noise::{IntegerHash, gpu::FbmUniform3d};
use asperity_noise::{Noise, Perlin};

use crate::texture::{Bevel, BevelParameters, Brick, Gas, Marble, PerturbedTexture, StarWallpaper};

gpu_struct! {
    /// A wall of bricks.
    pub struct BrickUniform as "Brick" {
        /// Sides of a brick including its mortar, in texture coordinates.
        cell: [f32; 2],
        /// Half the mortar as a fraction of either side.
        margin: [f32; 2],
    }
}

impl Brick {
    /// Returns the wall as a uniform of a shader.
    ///
    /// ```
    /// use asperity_shading::Brick;
    ///
    /// let wall = Brick::new(0.2, 0.1, 0.05)?.gpu();
    /// assert_eq!((wall.cell, wall.margin), ([0.25, 0.15], [0.1, 0.025 / 0.15]));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self) -> BrickUniform {
        BrickUniform { cell: self.cell().into(), margin: self.margin().into() }
    }
}

gpu_struct! {
    /// A ridge along the edges of a tile.
    pub struct BevelUniform as "Bevel" {
        /// Width of the plateau.
        plateau: f32,
        /// Width of the flank.
        flank: f32,
        /// Slope of the flank at its top.
        top: f32,
        /// Slope of the flank at its bottom.
        bottom: f32,
    }
}

impl Bevel {
    /// Returns the ridge as a uniform of a shader.
    #[must_use]
    pub fn gpu(&self) -> BevelUniform {
        let BevelParameters { plateau, top, bottom, .. } = *self.parameters();
        BevelUniform { plateau, flank: self.flank(), top, bottom }
    }
}

gpu_struct! {
    /// Wallpaper with stars.
    pub struct StarWallpaperUniform as "StarWallpaper" {
        /// Points of a star, from 2 to 1000.
        points: f32,
        /// Radius of the notches of a star, in texture coordinates.
        r_min: f32,
        /// Radius of its points.
        r_max: f32,
        /// Cells per unit of texture coordinates.
        cells: f32,
        /// Probability that a cell has a star.
        chance: f32,
        /// Far-field fraction of stars.
        mean: f32,
        /// Cosine and sine of half the angle between two points.
        half_angle: [f32; 2],
        /// A full turn divided by the number of points.
        angle: f32,
        /// Key of the lattice of the presence of stars.
        presence: u32,
        /// Key of the lattice of their position along u.
        across: u32,
        /// Key of the lattice of their position along v.
        along: u32,
    }
}

impl StarWallpaper {
    /// Returns the stars as a uniform of a shader.
    #[must_use]
    pub fn gpu(&self) -> StarWallpaperUniform {
        let ([points, r_min, r_max, cells, chance, mean, x, y, angle], seeds) = self.parts();
        let [presence, across, along] = seeds.map(IntegerHash::gpu_key);
        let half_angle = [x, y];
        StarWallpaperUniform {
            points,
            r_min,
            r_max,
            cells,
            chance,
            mean,
            half_angle,
            angle,
            presence,
            across,
            along,
        }
    }
}

gpu_struct! {
    /// Blue marble.
    pub struct MarbleUniform as "Marble" {
        /// Keys of four octaves.
        keys: [u32; 4],
        /// Distribution function of an octave at steps of 1/2 deviations from -4 on, without the
        /// first, where it is 0.
        cdf: [[f32; 4]; 4],
        /// Cells of the first octave per unit of length.
        scale: f32,
        /// Standard deviation of one octave.
        deviation: f32,
        .. padding: [u32; 2]
    }
}

impl Marble {
    /// Returns the marble as a uniform of a shader.
    ///
    /// ```
    /// let marble = asperity_shading::Marble::default().gpu();
    /// assert_eq!((marble.scale, marble.cdf[1][3], marble.cdf[3][3]), (2.5, 0.5, 1.0));
    /// ```
    #[must_use]
    pub fn gpu(&self) -> MarbleUniform {
        let ((scale, seed), statistics) = (self.parts(), Perlin::default().statistics(3));
        let at = |k: usize| statistics.cdf.get(k * statistics.cdf.len() / 16).filter(|_| k < 16).copied();
        MarbleUniform {
            keys: [0, 1, 2, 3].map(|i| IntegerHash::gpu_key(seed.wrapping_add(i))),
            cdf: core::array::from_fn(|i| core::array::from_fn(|k| at(4 * i + k + 1).unwrap_or(1.0))),
            scale,
            deviation: statistics.standard_deviation,
            padding: [0; 2],
        }
    }
}

gpu_struct! {
    /// Gas.
    pub struct GasUniform as "Gas" {
        /// Number of octaves.
        octaves: f32,
        /// Maximum density.
        max_density: f32,
        /// Exponent of the density.
        exponent: f32,
        /// Variance of the magnitude of one octave.
        variance: f32,
        /// Index of the sum in the uniform of sums.
        sum: u32,
        /// 1 for veins.
        has_veins: u32,
        .. padding: [u32; 2]
    }
}

impl Gas {
    /// Returns the gas as a uniform of a shader.
    ///
    /// The sum of octaves [`gpu_sum`](Self::gpu_sum) has the index `sum`.
    ///
    /// ```
    /// let gas = asperity_shading::texture::Gas::default().gpu(2);
    /// assert_eq!((gas.octaves, gas.max_density, gas.exponent, gas.sum), (5.0, 2.0, 3.0, 2));
    /// ```
    #[must_use]
    pub fn gpu(&self, sum: u32) -> GasUniform {
        let (turbulence, [octaves, max_density, exponent], veins) = self.parts();
        let [first, second, ..] = turbulence.field().statistics(3).absolute_moments;
        let variance = second - first * first;
        GasUniform {
            octaves,
            max_density,
            exponent,
            variance,
            sum,
            has_veins: u32::from(veins),
            padding: [0; 2],
        }
    }

    /// Returns the sum of octaves.
    #[must_use]
    pub fn gpu_sum(&self) -> FbmUniform3d {
        self.parts().0.gpu()
    }
}

gpu_struct! {
    /// Texture coordinates displaced by noise.
    pub struct PerturbedTextureUniform as "PerturbedTexture" {
        /// Strengths in texture coordinates.
        strength: [f32; 2],
        /// Cells of the noise per unit of length.
        scale: f32,
        /// Standard deviation of the noise.
        deviation: f32,
        /// Keys of both channels.
        keys: [u32; 2],
        .. padding: [u32; 2]
    }
}

impl PerturbedTexture {
    /// Returns the displacement as a uniform of a shader.
    #[must_use]
    pub fn gpu(&self) -> PerturbedTextureUniform {
        PerturbedTextureUniform {
            strength: self.strength.into(),
            scale: self.scale,
            deviation: self.noise.statistics(3).standard_deviation,
            keys: [self.seed, self.seed.wrapping_add(1)].map(IntegerHash::gpu_key),
            padding: [0; 2],
        }
    }
}
