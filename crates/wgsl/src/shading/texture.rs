//! Procedural textures: brick, bevel, stars, marble, gas, perturbed coordinates.

use asperity_shading::gpu::{
    BevelUniform, BrickUniform, GasUniform, MarbleUniform, PerturbedTextureUniform, StarWallpaperUniform,
};

use crate::ndf::ELEMENTARY;
use crate::noise::{FBM_3D, sums::FREQUENCY_CLAMP};
use crate::noise::{PERLIN, WHITE};
use crate::part::{Part, part};
use crate::shading::pixel::FOOTPRINT;
use crate::shading::{DIRECTION, MATH};

/// Bricks with grooves of mortar, at points and over boxes.
static BRICK_POINTS: Part = part!("shading/texture/brick", [BrickUniform], DIRECTION);

/// Bricks with grooves of mortar, at points, over boxes and as facets of a pixel:
/// [`Brick`](asperity_shading::Brick).
pub static BRICK: Part = part!("shading/texture/brick_facets", BRICK_POINTS, DIRECTION);

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

/// Density of gas in 3-D, filtered over a pixel, and its fraction in a column of steam.
static GAS_DENSITY: Part = part!("shading/texture/gas", [GasUniform], ELEMENTARY, FOOTPRINT, FBM_3D.perlin);

/// Density of gas in 3-D, filtered over a pixel, with light and transmittance along a ray:
/// [`Gas`](asperity_shading::texture::Gas), [`Steam`](asperity_shading::texture::Steam),
/// [`march`](fn@asperity_shading::texture::march).
pub static GAS: Part = part!("shading/texture/gas_march", GAS_DENSITY, DIRECTION, MATH, ELEMENTARY);

/// Texture coordinates displaced by noise,
/// [`PerturbedTexture`](asperity_shading::texture::PerturbedTexture).
pub(crate) static PERTURBED: Part =
    part!("shading/texture/perturbed", [PerturbedTextureUniform], FOOTPRINT, PERLIN);
