//! Every texture of the lecture, in the light that shows it.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::material::{
    BevelledTiles, BrickWall, Perturbed, PolishedMarble, SurfacePoint, Wallpaper,
};
use asperity_shading::pixel::Footprint;
use asperity_shading::reflectance::{Bsdf, Coat};
use asperity_shading::texture::{Bevel, Brick, Gas, Marble, PerturbedTexture, StarWallpaper, march};

use crate::shaded::materials::{VALID, subject};
use crate::shaded::subject::Subject;

/// Every texture.
#[must_use]
pub fn textures() -> Vec<Subject> {
    vec![brick(), bumped_brick(), bevel(), stars(), perturbed(), marble(), gas()]
}

fn flat_wall() -> BrickWall {
    BrickWall {
        bricks: Brick::new(0.5, 0.25, 0.04).expect(VALID),
        clay: Vec3::new(0.5, 0.15, 0.14),
        mortar: Vec3::splat(0.5),
        variation: 0.0,
        depth: 0.0,
        roughness: 0.0,
    }
}

/// A wall is filtered by the box about its pixel, without taps.
fn wall(
    name: &'static str,
    wall: impl asperity_shading::material::Material + Send + Sync + 'static,
) -> Subject {
    Subject::new(name, 8.0, move |pixel, sky| sky.on(&wall.bsdf(&pixel.whole(), pixel.view()), pixel.view()))
}

fn brick() -> Subject {
    wall("brick", flat_wall())
}

fn bumped_brick() -> Subject {
    let colour = Vec3::splat(0.6);
    wall("bumped brick", BrickWall { clay: colour, mortar: colour, depth: 0.02, ..flat_wall() })
}

/// Square tiles with a ridge along their edges.
fn bevel() -> Subject {
    let bevel = Bevel::new(0.03, 0.2, 0.2, 0.9).expect(VALID);
    let tiles = BevelledTiles { bevel, side: 1.0, colour: Vec3::splat(0.6), roughness: 0.0 };
    subject("bevel", 8.0, tiles, |point| point)
}

/// A wall that runs.
fn perturbed() -> Subject {
    let by = PerturbedTexture { scale: 0.5, strength: Vec2::new(0.15, 0.08), ..Default::default() };
    subject("perturbed texture", 8.0, Perturbed { by, material: flat_wall() }, raised)
}

/// The plane as a cut through space at 0.3, beside the planes of lattices.
fn raised(point: SurfacePoint) -> SurfacePoint {
    SurfacePoint { position: point.position + 0.3 * Vec3::Z, ..point }
}

/// A slab of gas over dark ground, seen from above.
fn gas() -> Subject {
    let gas = Gas::default();
    Subject::new("gas", 8.0, move |pixel, _| {
        pixel.over(|tap, footprint: Footprint| {
            let extinction = |p: Vec3| gas.clamped_density(p, footprint);
            let seen = march(tap.at.extend(0.0), Vec3::Z, [0.0, 1.0], 0.25, 0.5, extinction, |_| Vec3::ONE);
            let veil = Coat::veil(Vec3::splat(seen.transmittance));
            let bsdf = Bsdf::new(Vec3::Z).with_coat(veil).with_emitted(seen.light);
            let [_, ground] = bsdf.deltas(Vec3::Z, Vec2::ZERO);
            bsdf.emitted() + 0.05 * ground.weight
        })
    })
}

fn stars() -> Subject {
    let stars = StarWallpaper::new(5, [0.1, 0.3], 1.0, 0.55, 1).expect(VALID);
    subject("stars", 8.0, Wallpaper { stars, paper: Vec3::ZERO, star: Vec3::ONE }, |point| point)
}

fn marble() -> Subject {
    let marble = PolishedMarble { marble: Marble::default(), brightness: 1.0, polish: 0.0 };
    subject("marble", 8.0, marble, raised)
}
