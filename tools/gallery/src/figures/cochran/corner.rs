//! Figure 7 of Cochran, Lewis and Hart: a fractal object in the corner of a room, with one and with
//! sixteen samples per pixel.

use asperity_fif::cochran_2000;
use asperity_render::geometry::{camera::Camera, fractal::Fractal, mesh::Mesh, ray::Ray, shape::Shape};
use asperity_render::materials::chalk;
use asperity_render::materials::pattern::{checker, grid};
use asperity_render::sampling::sampler::{Sampler, hash};
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::{image::tone::hex, integrator::pixels::Sampling, light::lamps::Lamps};
use asperity_shading::{Brick, Footprint, Schlick, SurfacePoint, reflectance::Coat};
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn};
use asperity::failure::Result;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let scene = corner()?;
    let sampling = Sampling { samples_per_pixel: 1, ..context.sampling([18, 18], 1) };
    let camera = Camera::new(EYE, TARGET, FIELD, sampling.width, sampling.height);
    let smooth = "The same corner, smooth: bricks, tiles and their reflections";
    let pictures = [
        (["one-sample", "1 sample per pixel", "The corner with its object, aliased and noisy"], 1),
        (["jittered", "4 × 4 jittered samples per pixel", smooth], 4),
    ];
    let drawn = Drawn::pictures(2, pictures, |grid| {
        let image = context.render(sampling, |x, y| {
            let rays = jittered([x as u32, y as u32], grid, context.seed);
            let mut sampler = Sampler::new(0, 0);
            let seen = rays.map(|[x, y]| scene.seen(&camera.ray(x, y), [0.0; 2], &mut sampler).radiance);
            seen.sum::<Vec3>() / (grid * grid) as f32
        })?;
        Ok(image.exposed(EXPOSURE))
    })?;
    Ok(drawn.fact("height scale", RISE).fact("reflectance at normal incidence", GLOSS))
}

const RISE: f64 = 0.3;
const GLOSS: f32 = 0.4;
const EXPOSURE: f32 = 1.12;
const EYE: Vec3 = Vec3::new(-2.3, -1.9, 2.0);
const TARGET: Vec3 = Vec3::new(1.15, 1.2, 0.55);
const FIELD: f32 = 0.62;

/// Returns sample points of a pixel, one per cell of a square grid, jittered by a hash of the pixel
/// and the cell. A single sample is at the center.
fn jittered(pixel: [u32; 2], grid: u32, seed: u32) -> impl Iterator<Item = [f32; 2]> {
    let unit = |bits: u32| (bits >> 8) as f32 / 16_777_216.0;
    (0..grid * grid).map(move |cell| {
        let bits = hash(cell ^ hash(pixel[0] ^ hash(pixel[1] ^ hash(seed))));
        let jitter = if grid == 1 { [0.5; 2] } else { [unit(bits), unit(hash(bits))] };
        let place = [cell % grid, cell / grid];
        core::array::from_fn(|i| pixel[i] as f32 + (place[i] as f32 + jitter[i]) / grid as f32)
    })
}

/// Side of the object's square; the walls are at its far sides.
const SIDE: f32 = 2.0;
const CEILING: f32 = 4.0;
const LAMP: Vec3 = Vec3::new(-1.1, 0.1, 3.0);

fn corner() -> Result<Scene<'static, 'static>> {
    let gloss = Schlick::new(GLOSS)?;
    // A metal of this color also has Schlick's reflectance.
    let mirror = Coat::conductor(Vec3::splat(GLOSS));
    let object = move |point: &SurfacePoint, wo: Vec3| {
        let own = (1.0 - gloss.reflectance(wo.dot(point.normal))) * hex(0x2a_7d8c);
        chalk(point.frame(), wo, Vec3::Z, own, own * around(point)).with_coat(mirror)
    };
    let floor = [Vec3::X, Vec3::Y].map(|axis| axis * (30.0 + SIDE));
    let floor = Mesh::parallelogram(Vec3::new(-30.0, -30.0, 0.0), floor);
    // Bricks of 42 by 16 cm, with 2 cm of mortar.
    let brick = Brick::new(0.394, 0.138, 0.022)?;
    let matte = |point: &SurfacePoint, wo, color: Vec3| {
        chalk(point.frame(), wo, Vec3::Z, color, color * around(point))
    };
    let wall = |axis: Vec3, along: Vec3| {
        let sides = [axis * -(30.0 + SIDE), Vec3::Z * CEILING];
        let side = Mesh::parallelogram(Vec3::new(SIDE, SIDE, 0.0), sides);
        Object::shaded(side, move |point, wo| {
            let place = Vec2::new(point.position.dot(along), point.position.z);
            matte(point, wo, bricks(&brick, place))
        })
    };
    let objects = vec![
        Object::shaded(Shape::Fractal(Fractal::square(cochran_2000::f()?, RISE)?), object),
        Object::shaded(floor, move |point, wo| matte(point, wo, tiles(point.position.truncate()))),
        wall(Vec3::Y, Vec3::Y),
        wall(Vec3::X, Vec3::NEG_X),
    ];
    let lamps = vec![Lamps::Near { place: LAMP, color: Vec3::new(6.0, 5.7, 5.2) }];
    Ok(Scene::new(objects, Light::Lamps { lamps, room: &skylight }, Backdrop::Light))
}

/// Light from the bright open side of the room, partly occluded deep in the corner.
fn around(point: &SurfacePoint) -> Vec3 {
    let open = point.normal.dot(Vec3::new(-0.5, -0.5, 0.707));
    let depth = (point.position.truncate() - SIDE).length().min(2.0);
    Vec3::new(0.36, 0.38, 0.41) * ((0.6 + 0.4 * open) * (0.55 + 0.225 * depth))
}

/// Running bond with bricks of slightly different tones.
fn bricks(wall: &Brick, p: Vec2) -> Vec3 {
    let sample = wall.filtered(p, Footprint::from_width(0.003).into());
    let tone = (hash(sample.cell[0] as u32 ^ hash(sample.cell[1] as u32)) >> 24) as f32 / 255.0;
    hex(0xee_e9e0).lerp(hex(0xa5_7f6b).lerp(hex(0xcf_b29c), tone), sample.brick)
}

/// Light along a ray that leaves the corner: a paned window overhead, a pale wall elsewhere.
fn skylight(ray: &Ray) -> Vec3 {
    let p = ray.origin + ray.direction * ((CEILING - ray.origin.z) / ray.direction.z);
    if ray.direction.z <= 0.0 || p.x.abs().max(p.y.abs()) > 6.0 {
        return hex(0xc9_c4ba) * 0.8;
    }
    (hex(0xf6_faff) * 1.25).lerp(hex(0x55_636e), grid(p.truncate() / 0.75, 0.12, 0.02))
}

/// Dark and light tiles with a joint between them.
fn tiles(p: Vec2) -> Vec3 {
    let p = p / 0.4;
    let tile = hex(0xe9_e2d4).lerp(hex(0x6d_7684), checker(p));
    tile.lerp(hex(0xb8_b2a6), grid(p, 0.03, 0.005))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jittered_has_one_reproducible_point_per_cell() {
        let rays = || jittered([7, 9], 4, 1);
        for (cell, ray) in (0_u8..).zip(rays()) {
            let place = [7.0 + f32::from(cell % 4) / 4.0, 9.0 + f32::from(cell / 4) / 4.0];
            assert!((0..2).all(|i| ray[i] >= place[i] && ray[i] <= place[i] + 0.25), "cell {cell}: {ray:?}");
        }
        assert!(rays().eq(rays()) && jittered([3, 4], 1, 1).eq([[3.5, 4.5]]));
        assert!(jittered([9, 7], 4, 1).zip(rays()).all(|(a, b)| a[0].fract() != b[0].fract()));
    }
}
