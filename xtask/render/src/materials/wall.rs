//! The lecture's textures on things: bricks, wallpaper, marble.

use asperity_shading::{
    Brick, CookTorrance, EnergyPreservingOrenNayar, Footprint, Ggx, Lambert, Marble, PixelEllipse, Schlick,
    StarWallpaper, bumped_normal,
};
use glam::{Vec2, Vec3};

use crate::materials::in_metres;
use crate::{
    failure::Failure,
    image::tone::hex,
    integrator::path_tracer::{Appearance, Layer, Seen},
    sampling::sampler::hash,
};

/// How deep mortar lies, in metres.
const DEPTH: f32 = 0.006;

/// The changes of u and v across the pixel, in metres of the texture.
fn widths(seen: &Seen, metres: f32) -> Vec2 {
    let width = seen.point.footprint().width();
    Vec2::from(seen.point.tangents.map(|tangent| width / tangent.length().max(1e-12) * metres))
}

/// A wall of bricks, on texture coordinates; a colour of its own for every brick that a pixel resolves.
pub fn bricks(wall: Brick, metres: f32) -> impl Fn(&Seen) -> Appearance + Sync {
    move |seen: &Seen| {
        let point = in_metres(seen, metres);
        let size = widths(seen, metres);
        let sample = wall.filtered(point.uv, PixelEllipse::aligned(size));
        let [column, row] = wall.sample(point.uv).cell;
        let own = hash(column as u32 ^ hash(row as u32)) as f32 / 4_294_967_296.0 - 0.5;
        let resolved = (1.0 - size.max_element() / 0.12).clamp(0.0, 1.0);
        let clay = hex(0xa5_4f3c) * (1.0 + 0.5 * own * resolved);
        let colour = hex(0xb4_aea4).lerp(clay, sample.brick);
        let mut layers = Vec::new();
        // Facets of like slopes are one reflectance each, with a share of the light.
        wall.facets(point.uv, PixelEllipse::aligned(size), |share, _, slope| {
            let [u, v] = seen.point.tangents;
            let along = |t: Vec3| t / t.length_squared().max(1e-20);
            let gradient = DEPTH * metres * (along(u) * slope.x + along(v) * slope.y);
            let normal = bumped_normal(point.normal, gradient);
            if let Ok(brdf) = EnergyPreservingOrenNayar::new(colour * share, 0.7) {
                layers.push(Layer { normal, brdf: Box::new(brdf) });
            }
        });
        Appearance { layers, ..Default::default() }
    }
}

/// Stars on paper, on texture coordinates.
pub fn wallpaper(
    stars: StarWallpaper,
    metres: f32,
    [paper, star]: [Vec3; 2],
) -> impl Fn(&Seen) -> Appearance + Sync {
    move |seen: &Seen| {
        let point = in_metres(seen, metres);
        let share = stars.coverage(point.uv, Footprint::from_width(widths(seen, metres).max_element()));
        let layers = Lambert::new(paper.lerp(star, share))
            .map(|brdf| vec![Layer { normal: point.normal, brdf: Box::new(brdf) }]);
        Appearance { layers: layers.unwrap_or_default(), ..Default::default() }
    }
}

/// Polished blue marble, as bright as this over the lecture's colours.
pub fn marble(
    marble: Marble,
    metres: f32,
    brightness: f32,
) -> Result<impl Fn(&Seen) -> Appearance + Sync, Failure> {
    let polish = CookTorrance::new(Ggx::new(0.12, 0.12)?, Schlick::new(0.04)?);
    Ok(move |seen: &Seen| {
        let point = in_metres(seen, metres);
        let colour = brightness * marble.colour(point.position, point.footprint());
        let mut layers = vec![Layer { normal: point.normal, brdf: Box::new(polish) }];
        if let Ok(stone) = Lambert::new(colour.clamp(Vec3::ZERO, Vec3::splat(0.96))) {
            layers.push(Layer { normal: point.normal, brdf: Box::new(stone) });
        }
        Appearance { layers, ..Default::default() }
    })
}
