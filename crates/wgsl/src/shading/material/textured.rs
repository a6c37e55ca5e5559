//! Walls and floors: bricks, tiles, wallpaper, marble, and perturbed materials.

use asperity_shading::glam::Vec3;
use asperity_shading::material::{BeveledTiles, BrickWall, PolishedMarble, Wallpaper};

use super::surface::SURFACE_POINT;
use crate::noise::{INTEGER_HASH, key};
use crate::part::{Binding, Part, part, uniform};
use crate::shading::DIRECTION;
use crate::shading::pixel::FOOTPRINT;
use crate::shading::reflectance::{BRDF, COAT, ENERGY_PRESERVING, FACET};
use crate::shading::texture::{
    BEVEL, BRICK_FACETS, BevelUniform, BrickUniform, MARBLE, MarbleUniform, PERTURBED, STAR_WALLPAPER,
    StarWallpaperUniform,
};

/// Rough diffuse surfaces with slopes in texture coordinates, facet by facet.
pub static TEXTURED_SLOPES: Part =
    part!("shading/material/textured/textured_slopes", SURFACE_POINT, FACET, ENERGY_PRESERVING);

/// Wall of bricks with recessed mortar, [`BrickWall`].
pub static BRICK_WALL: Part = part!(
    "shading/material/textured/brick_wall",
    BRICK_FACETS,
    TEXTURED_SLOPES,
    INTEGER_HASH,
    FOOTPRINT,
    DIRECTION,
    BRDF,
)
.with_bindings(&[Binding::Uniform { name: "brick_wall_uniform", of: "BrickWall" }]);

/// Square tiles with a ridge along their edges, [`BeveledTiles`].
pub static BEVELLED_TILES: Part =
    part!("shading/material/textured/bevelled_tiles", BEVEL, TEXTURED_SLOPES, FOOTPRINT, DIRECTION, BRDF)
        .with_bindings(&[Binding::Uniform { name: "bevelled_tiles_uniform", of: "BevelledTiles" }]);

/// Paper with stars, [`Wallpaper`].
pub static WALLPAPER: Part =
    part!("shading/material/textured/starry_wallpaper", STAR_WALLPAPER, SURFACE_POINT, ENERGY_PRESERVING)
        .with_bindings(&[Binding::Uniform { name: "starry_wallpaper_uniform", of: "Wallpaper" }]);

/// Blue marble under a polish, [`PolishedMarble`].
pub static POLISHED_MARBLE: Part =
    part!("shading/material/textured/polished_marble", MARBLE, SURFACE_POINT, ENERGY_PRESERVING, COAT)
        .with_bindings(&[Binding::Uniform { name: "polished_marble_uniform", of: "PolishedMarble" }]);

/// Surface point with displaced texture coordinates, for
/// [`Perturbed`](asperity_shading::material::Perturbed) materials.
pub static PERTURBED_POINT: Part =
    part!("shading/material/textured/perturbed_point", PERTURBED, SURFACE_POINT);

uniform! {
    /// A wall as the words of the structure `BrickWall`.
    ///
    /// | words | |
    /// |---|---|
    /// | 0–3 | sides of a brick including its mortar in texture coordinates, half the mortar as a fraction of either |
    /// | 4–7 | color of bricks; its variation from brick to brick |
    /// | 8–11 | color of the mortar; its depth in texture coordinates |
    /// | 12–15 | roughness of the facets; key of the lattice of bricks; 0, 0 |
    ///
    /// ```
    /// use asperity_wgsl::shading::material::BrickWallUniform;
    /// use asperity_shading::material::BrickWall;
    ///
    /// let words = BrickWallUniform::new(&BrickWall::default()).words();
    /// assert_eq!([words[0], words[11], words[12]].map(f32::from_bits), [0.26, 0.006, 0.7]);
    /// ```
    BrickWallUniform: 16, "BrickWall";
}

impl BrickWallUniform {
    /// Packs a wall.
    #[must_use]
    pub fn new(wall: &BrickWall) -> Self {
        let mut words = [0; Self::WORDS];
        words[..4].copy_from_slice(&BrickUniform::new(&wall.bricks).words());
        words[4..8].copy_from_slice(&with(wall.clay, wall.variation));
        words[8..12].copy_from_slice(&with(wall.mortar, wall.depth));
        words[12..14].copy_from_slice(&[wall.roughness.to_bits(), key(1)]);
        Self(words)
    }
}

/// The words of a vector followed by a number.
fn with(vector: Vec3, number: f32) -> [u32; 4] {
    vector.extend(number).to_array().map(f32::to_bits)
}

uniform! {
    /// Tiles as the words of the structure `BevelledTiles`.
    ///
    /// | words | |
    /// |---|---|
    /// | 0–3 | widths of plateau and flank as fractions of the side, the flank's slopes at its top and its bottom |
    /// | 4–7 | color; roughness of the facets |
    /// | 8–11 | side of a tile in texture coordinates; 0, 0, 0 |
    ///
    /// A side that is not positive becomes one tile of the largest finite size.
    ///
    /// ```
    /// use asperity_wgsl::shading::material::BevelledTilesUniform;
    /// use asperity_shading::{glam::Vec3, material::BeveledTiles, texture::Bevel};
    ///
    /// let bevel = Bevel::new(0.0, 0.125, 0.0, 1.0)?;
    /// let tiles = BeveledTiles { bevel, side: 0.3, color: Vec3::splat(0.5), roughness: 0.2 };
    /// assert_eq!(BevelledTilesUniform::new(&tiles).words()[8], 0.3_f32.to_bits());
    /// # Ok::<(), asperity_shading::ParameterError>(())
    /// ```
    BevelledTilesUniform: 12, "BevelledTiles";
}

impl BevelledTilesUniform {
    /// Packs tiles.
    #[must_use]
    pub fn new(tiles: &BeveledTiles) -> Self {
        let mut words = [0; Self::WORDS];
        words[..4].copy_from_slice(&BevelUniform::new(&tiles.bevel).words());
        words[4..8].copy_from_slice(&with(tiles.color, tiles.roughness));
        words[8] = if tiles.side > 0.0 { tiles.side.min(f32::MAX) } else { f32::MAX }.to_bits();
        Self(words)
    }
}

uniform! {
    /// Wallpaper as the words of the structure `Wallpaper`.
    ///
    /// | words | |
    /// |---|---|
    /// | 0–11 | stars, [`StarWallpaperUniform`] |
    /// | 12–15 | color of the paper; roughness of the facets |
    /// | 16–19 | color of stars; 0 |
    ///
    /// ```
    /// use asperity_wgsl::shading::material::WallpaperUniform;
    /// use asperity_shading::{glam::Vec3, material::Wallpaper, texture::StarWallpaper};
    ///
    /// let stars = StarWallpaper::default();
    /// let wallpaper = Wallpaper { stars, paper: Vec3::splat(0.6), star: Vec3::X, roughness: 0.3 };
    /// let words = WallpaperUniform::new(&wallpaper).words();
    /// assert_eq!([words[3], words[12], words[15], words[16]].map(f32::from_bits), [10.0, 0.6, 0.3, 1.0]);
    /// ```
    WallpaperUniform: 20, "Wallpaper";
}

impl WallpaperUniform {
    /// Packs a wallpaper.
    #[must_use]
    pub fn new(wallpaper: &Wallpaper) -> Self {
        let mut words = [0; Self::WORDS];
        words[..12].copy_from_slice(&StarWallpaperUniform::new(&wallpaper.stars).words());
        words[12..16].copy_from_slice(&with(wallpaper.paper, wallpaper.roughness));
        words[16..].copy_from_slice(&with(wallpaper.star, 0.0));
        Self(words)
    }
}

uniform! {
    /// Polished marble as the words of the structure `PolishedMarble`.
    ///
    /// | words | |
    /// |---|---|
    /// | 0–23 | veins, [`MarbleUniform`] |
    /// | 24–27 | factor of the colors; Beckmann's α of the polish, 0 for none |
    ///
    /// ```
    /// use asperity_wgsl::shading::material::PolishedMarbleUniform;
    /// use asperity_shading::{Marble, glam::Vec3, material::PolishedMarble};
    ///
    /// let stone = PolishedMarble { marble: Marble::default(), tint: Vec3::ONE, polish: 0.05 };
    /// let words = PolishedMarbleUniform::new(&stone).words();
    /// assert_eq!([words[0], words[27]].map(f32::from_bits), [2.5, 0.05]);
    /// ```
    PolishedMarbleUniform: 28, "PolishedMarble";
}

impl PolishedMarbleUniform {
    /// Packs a stone.
    #[must_use]
    pub fn new(stone: &PolishedMarble) -> Self {
        let mut words = [0; Self::WORDS];
        words[..24].copy_from_slice(&MarbleUniform::new(&stone.marble).words());
        words[24..].copy_from_slice(&with(stone.tint, stone.polish));
        Self(words)
    }
}
