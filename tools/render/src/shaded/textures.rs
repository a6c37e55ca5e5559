//! Textures of the lecture, measured at the horizon.

use asperity_shading::Frame;
use asperity_shading::material::{
    BeveledTiles, BrickWall, Material, Perturbed, PolishedMarble, SurfacePoint, Wallpaper,
};
use asperity_shading::reflectance::{Bsdf, Coat};
use asperity_shading::texture::{
    Bevel, BevelParameters, Brick, Gas, Marble, PerturbedTexture, StarWallpaper, StarWallpaperParameters,
    march,
};
use glam::{Vec2, Vec3};

use crate::shaded::{
    materials::VALID,
    subject::{Sky, Subject},
};

/// Textures of walls, floors, stone and gas.
#[must_use]
pub fn textures() -> Vec<Subject> {
    let flat = BrickWall {
        bricks: Brick::new(0.5, 0.25, 0.04).expect(VALID),
        clay: Vec3::new(0.5, 0.15, 0.14),
        mortar: Vec3::splat(0.5),
        variation: 0.0,
        depth: 0.0,
        roughness: 0.0,
    };
    let color = Vec3::splat(0.6);
    let bumped = BrickWall { clay: color, mortar: color, depth: 0.02, ..flat };
    // Square tiles with a ridge along their edges.
    let bevel =
        Bevel::new(BevelParameters { plateau: 0.03, ridge: 0.2, top: 0.2, bottom: 0.9 }).expect(VALID);
    let stars = StarWallpaper::new(StarWallpaperParameters {
        r_min: 0.1,
        r_max: 0.3,
        cells: 1.0,
        seed: 1,
        ..Default::default()
    })
    .expect(VALID);
    // A wall in running bond.
    let by = PerturbedTexture { scale: 0.5, strength: Vec2::new(0.15, 0.08), ..Default::default() };
    let marble = PolishedMarble { marble: Marble::default(), tint: Vec3::ONE, polish: 0.0 };
    vec![
        wall("brick", flat),
        wall("bumped brick", bumped),
        Subject::of("bevel", 8.0, BeveledTiles { bevel, side: 1.0, color, roughness: 0.0 }, |p| p),
        Subject::of(
            "stars",
            8.0,
            Wallpaper { stars, paper: Vec3::ZERO, star: Vec3::ONE, roughness: 0.0 },
            |p| p,
        ),
        Subject::of("perturbed texture", 8.0, Perturbed { by, material: flat }, raised),
        Subject::of("marble", 8.0, marble, raised),
        gas(),
    ]
}

/// A wall is filtered over the box around its pixel, without taps.
fn wall(name: &'static str, wall: BrickWall) -> Subject {
    Subject::new(name, 8.0, move |pixel, skies, radiances| {
        let view = pixel.view(&pixel.point);
        radiances.fill(Vec3::ZERO);
        Sky::add(skies, &wall.bsdf(&pixel.point, view), view, radiances);
    })
}

/// The plane as a slice through space at 0.3, away from lattice planes.
fn raised(point: SurfacePoint) -> SurfacePoint {
    SurfacePoint { position: point.position + 0.3 * Vec3::Z, ..point }
}

/// A slab of gas over dark ground, seen from above.
fn gas() -> Subject {
    let gas = Gas::default();
    Subject::new("gas", 8.0, move |pixel, _, radiances| {
        pixel.over(radiances, |tap, _, sums| {
            let extinction = |p: Vec3| gas.clamped_density(p, tap.footprint());
            let seen = march(tap.position, Vec3::Z, [0.0, 1.0], 0.25, 0.5, extinction, |_| Vec3::ONE);
            let veil = Coat::transparent(Vec3::splat(seen.transmittance));
            let bsdf = Bsdf::new(Frame::IDENTITY, Vec3::Z).with_coat(veil).with_emitted(seen.light);
            let [_, ground] = bsdf.specular_samples(Vec3::Z, Vec2::ZERO);
            let ground = ground.map_or(Vec3::ZERO, |sample| 0.05 * sample.eval_cos);
            sums.iter_mut().for_each(|sum| *sum += bsdf.emitted() + ground);
        });
    })
}
