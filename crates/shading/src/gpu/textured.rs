//! Walls and floors.

use asperity_core::gpu_struct;
use asperity_noise::IntegerHash;

use super::texture::{BevelUniform, BrickUniform, MarbleUniform, StarWallpaperUniform};
use crate::material::{BeveledTiles, BrickWall, PolishedMarble, Wallpaper};

gpu_struct! {
    /// A brick wall.
    pub struct BrickWallUniform as "BrickWall" {
        /// Bricks and mortar.
        bricks: BrickUniform,
        /// Color of bricks.
        clay: [f32; 3],
        /// Variation of the color from brick to brick.
        variation: f32,
        /// Color of the mortar.
        mortar: [f32; 3],
        /// Depth of the mortar in texture coordinates.
        depth: f32,
        /// Roughness of the facets.
        roughness: f32,
        /// Key of the lattice of the brightness of bricks.
        key: u32,
        .. padding: [u32; 2]
    }
}

impl BrickWall {
    /// Returns the uniform `brick_wall_uniform` of a shader.
    ///
    /// ```
    /// let wall = asperity_shading::material::BrickWall::default().gpu();
    /// assert_eq!((wall.bricks.cell[0], wall.depth, wall.roughness), (0.26, 0.006, 0.7));
    /// ```
    #[must_use]
    pub fn gpu(&self) -> BrickWallUniform {
        BrickWallUniform {
            bricks: self.bricks.gpu(),
            clay: self.clay.into(),
            variation: self.variation,
            mortar: self.mortar.into(),
            depth: self.depth,
            roughness: self.roughness,
            key: IntegerHash::gpu_key(1),
            padding: [0; 2],
        }
    }
}

gpu_struct! {
    /// Tiles with a ridge along their edges.
    pub struct BeveledTilesUniform as "BeveledTiles" {
        /// Ridge, for tiles of side 1.
        bevel: BevelUniform,
        /// Color.
        color: [f32; 3],
        /// Roughness of the facets.
        roughness: f32,
        /// Side of a tile in texture coordinates, above 0.
        side: f32,
        .. padding: [u32; 3]
    }
}

impl BeveledTiles {
    /// Returns the uniform `beveled_tiles_uniform` of a shader.
    ///
    /// A side that is not positive becomes one tile of the largest finite size.
    #[must_use]
    pub fn gpu(&self) -> BeveledTilesUniform {
        BeveledTilesUniform {
            bevel: self.bevel.gpu(),
            color: self.color.into(),
            roughness: self.roughness,
            side: if self.side > 0.0 { self.side.min(f32::MAX) } else { f32::MAX },
            padding: [0; 3],
        }
    }
}

gpu_struct! {
    /// Paper with stars.
    pub struct WallpaperUniform as "Wallpaper" {
        /// Stars.
        stars: StarWallpaperUniform,
        /// Color of the paper.
        paper: [f32; 3],
        /// Roughness of the facets.
        roughness: f32,
        /// Color of stars.
        star: [f32; 3],
        .. padding: u32
    }
}

impl Wallpaper {
    /// Returns the uniform `starry_wallpaper_uniform` of a shader.
    #[must_use]
    pub fn gpu(&self) -> WallpaperUniform {
        WallpaperUniform {
            stars: self.stars.gpu(),
            paper: self.paper.into(),
            roughness: self.roughness,
            star: self.star.into(),
            padding: 0,
        }
    }
}

gpu_struct! {
    /// Polished marble.
    pub struct PolishedMarbleUniform as "PolishedMarble" {
        /// Veins.
        marble: MarbleUniform,
        /// Factor of the colors.
        tint: [f32; 3],
        /// Beckmann's alpha of the polish, 0 for none.
        polish: f32,
    }
}

impl PolishedMarble {
    /// Returns the uniform `polished_marble_uniform` of a shader.
    #[must_use]
    pub fn gpu(&self) -> PolishedMarbleUniform {
        PolishedMarbleUniform { marble: self.marble.gpu(), tint: self.tint.into(), polish: self.polish }
    }
}
