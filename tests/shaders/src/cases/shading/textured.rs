//! Walls and floors.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::material::{BeveledTiles, BrickWall, Perturbed, PolishedMarble, Wallpaper};
use asperity_shading::texture::{Bevel, BevelParameters, PerturbedTexture, StarWallpaper};
use asperity_shading::{Marble, PixelEllipse};
use asperity_wgsl::shading::material::{
    BEVELED_TILES, BRICK_WALL, PERTURBED_POINT, POLISHED_MARBLE, WALLPAPER,
};
use asperity_wgsl::shading::texture::BRICK;
use asperity_wgsl::{Binding, Part};

use super::material::material;
use super::texture::wall;
use super::{equal, inputs, number, vec2, words};
use crate::case::{Bound, Case, packed};

pub(super) fn cases() -> Vec<Case> {
    vec![brick_facets(), brick_wall(), beveled_tiles(), wallpaper(), perturbed_wallpaper(), marble()]
}

/// Sums over the facets of a wall: fractions, fractions of brick, slopes, and squares of slopes.
fn brick_facets() -> Case {
    Case {
        name: "shading/texture/brick_facets".into(),
        parts: vec![&BRICK],
        body: "\
    let facets = brick_facets(Brick(a.xy, a.zw), b.xy, b.zw);
    var sums = vec4<f32>(0.0);
    var squares = 0.0;
    for (var j = 0u; j < brick_facets_rows(facets); j++) {
        let row = brick_facets_row(facets, j);
        for (var k = 0u; k < brick_facets_columns(facets, row); k++) {
            let facet = brick_facet(facets, row, k);
            sums += facet.share * vec4<f32>(1.0, facet.brick, facet.slope);
            squares += facet.share * dot(facet.slope, facet.slope);
        }
    }
    outcome.a = bits(sums);
    outcome.b = bits(vec4<f32>(squares, 0.0, 0.0, 0.0));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let uv = [0, 1].map(|k| number(i, k, [-3.0, 3.0]));
            let widths = [2, 3].map(|k| match i % 4 {
                0 => 0.0,
                1 => number(i, k, [0.0, 0.2]),
                _ => number(i, k, [-8.0, 1.0]).exp(),
            });
            let mut words = inputs(i, &[0.0, 0.0, 0.0, 0.0, uv[0], uv[1], widths[0], widths[1]]);
            words[..4].copy_from_slice(&packed(&wall(i).gpu()));
            words[8] = i;
            words
        }),
        reference: Box::new(|inputs| {
            let (wall, uv, widths) = (wall(inputs[8]), vec2(inputs, 4), vec2(inputs, 6));
            let mut sums = [0.0; 5];
            wall.facets(uv, PixelEllipse::aligned(widths), |share, brick, slope| {
                for (sum, of) in sums.iter_mut().zip([1.0, brick, slope.x, slope.y, slope.dot(slope)]) {
                    *sum += share * of;
                }
            });
            words(&sums)
        }),
        outputs: vec![
            equal("shares", 0..2, Bound::Absolute(2e-3)),
            // For flanks of width 0.006, whose slopes are steep.
            equal("slope", 2..4, Bound::Absolute(1e-2)),
            equal("its square", 4..5, Bound::Relative(1e-3)),
        ],
    }
}

fn brick_wall() -> Case {
    let wall = BrickWall::default();
    material(
        "textured/brick_wall",
        &BRICK_WALL,
        vec![("brick_wall_uniform", packed(&wall.gpu()))],
        [0.5, 1e-4, 1.0],
        // Up to 32 facets differ only by the crate's arc tangents. Beyond that, the crate merges
        // some.
        [Bound::Absolute(1.6e-4), Bound::Absolute(1e-3)],
        wall,
    )
}

fn beveled_tiles() -> Case {
    let bevel =
        Bevel::new(BevelParameters { plateau: 0.03, ridge: 0.2, top: 0.2, bottom: 0.9 }).expect("a ridge");
    let tiles = BeveledTiles { bevel, side: 0.3, color: Vec3::new(0.7, 0.5, 0.3), roughness: 0.4 };
    material(
        "textured/beveled_tiles",
        &BEVELED_TILES,
        vec![("beveled_tiles_uniform", packed(&tiles.gpu()))],
        [1.0, 1e-4, 1.0],
        // Of the hundred facets of whole tiles, the crate merges all beyond the 32nd.
        [Bound::Absolute(5.4e-3), Bound::Absolute(1e-2)],
        tiles,
    )
}

fn paper() -> Wallpaper {
    let (paper, star) = (Vec3::new(0.6, 0.55, 0.5), Vec3::new(0.1, 0.2, 0.6));
    Wallpaper { stars: StarWallpaper::default(), paper, star, roughness: 0.3 }
}

fn wallpaper() -> Case {
    let paper = paper();
    material(
        "textured/wallpaper",
        &WALLPAPER,
        vec![("wallpaper_uniform", packed(&paper.gpu()))],
        [1.0, 1e-4, 0.1],
        // Angles come from the library in the crate.
        [Bound::Absolute(1e-6), Bound::Absolute(1e-2)],
        paper,
    )
}

static PERTURBED_WALLPAPER: Part = Part::new(
    "case/perturbed_wallpaper",
    "\
fn perturbed_wallpaper(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return wallpaper(perturbed_point(perturbed_uniform, point), wo, wi);
}
",
    &[&WALLPAPER, &PERTURBED_POINT],
)
.with_bindings(&[Binding::Uniform { name: "perturbed_uniform", of: "PerturbedTexture" }]);

fn perturbed_wallpaper() -> Case {
    let (material_there, by) =
        (paper(), PerturbedTexture { scale: 4.0, strength: Vec2::new(0.1, 0.05), ..Default::default() });
    material(
        "textured/perturbed_wallpaper",
        &PERTURBED_WALLPAPER,
        vec![("wallpaper_uniform", packed(&material_there.gpu())), ("perturbed_uniform", packed(&by.gpu()))],
        [2.0, 1e-3, 0.3],
        [Bound::Absolute(1e-6), Bound::Absolute(1e-2)],
        Perturbed { by, material: material_there },
    )
}

fn marble() -> Case {
    let stone = PolishedMarble { marble: Marble::default(), tint: Vec3::new(1.6, 1.7, 1.8), polish: 0.1 };
    material(
        "textured/polished_marble",
        &POLISHED_MARBLE,
        vec![("polished_marble_uniform", packed(&stone.gpu()))],
        [2.0, 1e-3, 1.0],
        [Bound::Relative(1e-6), Bound::Relative(1e-3)],
        stone,
    )
}
