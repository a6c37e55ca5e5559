//! Procedural textures: brick, bevel, stars, marble, gas, perturbed coordinates.

use asperity_shading::gpu::{
    BevelUniform, BrickUniform, GasUniform, MarbleUniform, PerturbedTextureUniform, StarWallpaperUniform,
};

use crate::ndf::ELEMENTARY;
use crate::noise::sums::{FREQUENCY_CLAMP, fbm_3d};
use crate::noise::{PERLIN, WHITE};
use crate::part::{Part, part};
use crate::shading::pixel::FOOTPRINT;
use crate::shading::{DIRECTION, MATH};

/// Bricks with grooves of mortar, at points and over boxes, [`Brick`](asperity_shading::Brick).
pub static BRICK: Part = part!("shading/texture/brick", [BrickUniform], DIRECTION);

/// Slopes within a pixel of a wall of bricks as facets,
/// [`Brick::facets`](asperity_shading::Brick::facets).
pub static BRICK_FACETS: Part = part!("shading/texture/brick_facets", BRICK, DIRECTION);

/// Ridges along the edges of a tile, at points and as facets,
/// [`Bevel`](asperity_shading::texture::Bevel).
pub static BEVEL: Part = part!("shading/texture/bevel", [BevelUniform], DIRECTION);

/// Stars in random cells of a grid, filtered over a pixel:
/// [`StarWallpaper`](asperity_shading::texture::StarWallpaper).
pub static STAR_WALLPAPER: Part = part!(
    "shading/texture/star_wallpaper",
    [StarWallpaperUniform],
    MATH,
    DIRECTION,
    ELEMENTARY,
    FREQUENCY_CLAMP,
    WHITE
);

/// Blue marble by position, filtered over a pixel: [`Marble`](asperity_shading::Marble).
pub static MARBLE: Part = part!("shading/texture/marble", [MarbleUniform], MATH, FREQUENCY_CLAMP, PERLIN);

/// Density of gas in 3-D, filtered over a pixel, and its fraction in a column of steam:
/// [`Gas`](asperity_shading::texture::Gas), [`Steam`](asperity_shading::texture::Steam).
pub static GAS: Part = part!("shading/texture/gas", [GasUniform], ELEMENTARY, FOOTPRINT, fbm_3d::PERLIN);

/// Light and transmittance along a ray through gas, and its interval in steam:
/// [`march`](fn@asperity_shading::texture::march),
/// [`Steam::interval`](asperity_shading::texture::Steam::interval).
pub static GAS_MARCH: Part = part!("shading/texture/gas_march", GAS, DIRECTION, MATH, ELEMENTARY);

/// Texture coordinates displaced by noise,
/// [`PerturbedTexture`](asperity_shading::texture::PerturbedTexture).
pub static PERTURBED: Part = part!("shading/texture/perturbed", [PerturbedTextureUniform], FOOTPRINT, PERLIN);
