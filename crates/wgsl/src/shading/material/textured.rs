//! Walls and floors: bricks, tiles, wallpaper, marble, and perturbed materials.

use asperity_shading::gpu::{BeveledTilesUniform, BrickWallUniform, PolishedMarbleUniform, WallpaperUniform};

use super::surface::SURFACE_POINT;
use crate::noise::INTEGER_HASH;
use crate::part::{Binding, Part, part};
use crate::shading::DIRECTION;
use crate::shading::pixel::FOOTPRINT;
use crate::shading::reflectance::{BRDF, COAT, ENERGY_PRESERVING, FACET};
use crate::shading::texture::{BEVEL, BRICK, MARBLE, PERTURBED, STAR_WALLPAPER};

/// Rough diffuse surfaces with slopes in texture coordinates, facet by facet.
pub(crate) static TEXTURED_SLOPES: Part =
    part!("shading/material/textured/textured_slopes", SURFACE_POINT, FACET, ENERGY_PRESERVING);

/// Wall of bricks with recessed mortar, [`BrickWall`](asperity_shading::material::BrickWall).
pub static BRICK_WALL: Part = part!(
    "shading/material/textured/brick_wall",
    [BrickWallUniform],
    BRICK,
    TEXTURED_SLOPES,
    INTEGER_HASH,
    FOOTPRINT,
    DIRECTION,
    BRDF,
)
.with_bindings(&[Binding::Uniform { name: "brick_wall_uniform", of: "BrickWall" }]);

/// Square tiles with a ridge along their edges,
/// [`BeveledTiles`](asperity_shading::material::BeveledTiles).
pub static BEVELED_TILES: Part = part!(
    "shading/material/textured/beveled_tiles",
    [BeveledTilesUniform],
    BEVEL,
    TEXTURED_SLOPES,
    FOOTPRINT,
    DIRECTION,
    BRDF
)
.with_bindings(&[Binding::Uniform { name: "beveled_tiles_uniform", of: "BeveledTiles" }]);

/// Paper with stars, [`Wallpaper`](asperity_shading::material::Wallpaper).
pub static WALLPAPER: Part = part!(
    "shading/material/textured/wallpaper",
    [WallpaperUniform],
    STAR_WALLPAPER,
    SURFACE_POINT,
    ENERGY_PRESERVING
)
.with_bindings(&[Binding::Uniform { name: "wallpaper_uniform", of: "Wallpaper" }]);

/// Blue marble under a polish, [`PolishedMarble`](asperity_shading::material::PolishedMarble).
pub static POLISHED_MARBLE: Part = part!(
    "shading/material/textured/polished_marble",
    [PolishedMarbleUniform],
    MARBLE,
    SURFACE_POINT,
    ENERGY_PRESERVING,
    COAT
)
.with_bindings(&[Binding::Uniform { name: "polished_marble_uniform", of: "PolishedMarble" }]);

/// Surface point with displaced texture coordinates, for
/// [`Perturbed`](asperity_shading::material::Perturbed) materials.
pub static PERTURBED_POINT: Part =
    part!("shading/material/textured/perturbed_point", PERTURBED, SURFACE_POINT);
