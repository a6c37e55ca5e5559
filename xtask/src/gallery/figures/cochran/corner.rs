//! Figure 7 of Cochran, Lewis and Hart: a fractal object in the corner of a room, with one sample per pixel and with sixteen.

use asperity_fif::{
    glam::{DVec2, DVec3},
    paper,
};
use asperity_render::{
    geometry::{
        camera::Camera,
        fractal::{Fractal, Meeting},
    },
    image::tone::hex,
    integrator::pixels::Sampling,
    materials::pattern::{brick, checker, line, mix},
    sampling::sampler::hash,
};
use asperity_shading::{Schlick, reflect};
use glam::Vec3;

use crate::{
    failure::Failure,
    gallery::figure::{Context, Drawn, Panel},
};

/// Rays along each side of a pixel.
const GRIDS: [u32; 2] = [1, 4];

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let corner = Corner { object: Fractal::new(paper::f()?, RISE)?, gloss: Schlick::new(GLOSS)? };
    let words = [
        ["one-sample", "1 sample per pixel", "The corner with its object in hard, grainy pixels"],
        [
            "jittered",
            "4 \u{d7} 4 jittered samples per pixel",
            "The same corner, smooth: bricks, tiles and their reflections",
        ],
    ];
    let mut panels = Vec::new();
    for (grid, [stem, label, alt]) in GRIDS.into_iter().zip(words) {
        let sampling = Sampling { samples_per_pixel: 1, ..context.sampling([18, 18], 1) };
        let camera = Camera::new(EYE, TARGET, FIELD, sampling.width, sampling.height);
        let image = context.render(sampling, |x, y| {
            let rays = jittered([x as u32, y as u32], grid, context.seed);
            let mut sum = Vec3::ZERO;
            for [x, y] in rays {
                sum += corner.radiance(camera.eye().as_dvec3(), camera.direction(x, y).as_dvec3(), 0);
            }
            sum / (grid * grid) as f32
        })?;
        panels.push(Panel::raster(stem, label, alt, image.exposed(EXPOSURE)));
    }
    Ok(Drawn::new(2, panels)
        .fact("heights times", RISE.to_string())
        .fact("reflectance at normal incidence", GLOSS.to_string()))
}

const RISE: f64 = 0.3;
const GLOSS: f32 = 0.4;
const EXPOSURE: f32 = 1.12;
const EYE: Vec3 = Vec3::new(-2.3, -1.9, 2.0);
const TARGET: Vec3 = Vec3::new(1.15, 1.2, 0.55);
const FIELD: f32 = 0.62;

/// Points of a pixel, one in each cell of a square grid, by a hash of the pixel and the cell; the middle for a single one.
fn jittered(pixel: [u32; 2], grid: u32, seed: u32) -> impl Iterator<Item = [f32; 2]> {
    let unit = |bits: u32| (bits >> 8) as f32 / 16_777_216.0;
    (0..grid * grid).map(move |cell| {
        let bits = hash(cell ^ hash(pixel[0] ^ hash(pixel[1] ^ hash(seed))));
        let jitter = if grid == 1 { [0.5; 2] } else { [unit(bits), unit(hash(bits))] };
        let place = [cell % grid, cell / grid];
        core::array::from_fn(|i| pixel[i] as f32 + (place[i] as f32 + jitter[i]) / grid as f32)
    })
}

/// The walls stand at the far sides of the object's square.
struct Corner {
    object: Fractal,
    gloss: Schlick,
}

/// Reflections of reflections end here.
const BOUNCES: u32 = 3;

const LAMP: DVec3 = DVec3::new(-1.1, 0.1, 3.0);

impl Corner {
    fn radiance(&self, origin: DVec3, direction: DVec3, depth: u32) -> Vec3 {
        let room = self.room(origin, direction);
        let object = self.object.first_meeting(origin, direction);
        match (object, room) {
            (Some(meeting), room) if room.is_none_or(|(wall, _)| meeting.t <= wall.t) => {
                let (wi, normal) = (-direction.as_vec3(), meeting.normal.as_vec3());
                let own = self.lit(&meeting) * hex(0x2a_7d8c);
                if depth == BOUNCES {
                    return own;
                }
                let share = self.gloss.reflectance(wi.dot(normal));
                let mirrored = self.radiance(meeting.position, reflect(wi, normal).as_dvec3(), depth + 1);
                mix(own, mirrored, share)
            }
            (_, Some((wall, colour))) => self.lit(&wall) * colour,
            (_, None) => skylight(origin, direction),
        }
    }

    /// The nearest of the floor and the two walls, with its colour.
    fn room(&self, origin: DVec3, direction: DVec3) -> Option<(Meeting, Vec3)> {
        let side = self.object.side();
        let planes = [(DVec3::NEG_X, -side), (DVec3::NEG_Y, -side), (DVec3::Z, 0.0)];
        let (t, normal) = planes
            .into_iter()
            .map(|(normal, offset)| ((offset - origin.dot(normal)) / direction.dot(normal), normal))
            .filter(|(t, normal)| direction.dot(*normal) < 0.0 && *t > 1e-6)
            .min_by(|a, b| a.0.total_cmp(&b.0))?;
        let position = origin + direction * t;
        let colour = match normal {
            DVec3::Z => tiles(DVec2::new(position.x, position.y)),
            DVec3::NEG_X => bricks(DVec2::new(position.y, position.z)),
            _ => bricks(DVec2::new(-position.x, position.z)),
        };
        (position.z < CEILING).then_some((Meeting { t, position, normal }, colour))
    }

    /// Light that a white matte surface would send back.
    fn lit(&self, meeting: &Meeting) -> Vec3 {
        let Meeting { position, normal, .. } = *meeting;
        let towards = LAMP - position;
        let cos_theta = towards.normalize().dot(normal).max(0.0) as f32;
        let start = position + normal * 1e-4;
        let lamp = if cos_theta > 0.0 && !self.object.hides(start, LAMP - start) {
            Vec3::new(6.0, 5.7, 5.2) * (cos_theta / towards.length_squared() as f32)
        } else {
            Vec3::ZERO
        };
        // The open side of the room is bright; deep in the corner less of it is seen.
        let open = normal.dot(DVec3::new(-0.5, -0.5, 0.707)) as f32;
        let side = self.object.side();
        let depth = (position.x - side).hypot(position.y - side).min(2.0) as f32;
        lamp + Vec3::new(0.36, 0.38, 0.41) * ((0.6 + 0.4 * open) * (0.55 + 0.225 * depth))
    }
}

const CEILING: f64 = 4.0;

/// Running bond with bricks of slightly different tones.
fn bricks(p: DVec2) -> Vec3 {
    let ([i, j], mortar) = brick(p / 0.16, 2.6, 0.14);
    let tone = (hash(i as u32 ^ hash(j as u32)) >> 24) as f32 / 255.0;
    mix(mix(hex(0xa5_7f6b), hex(0xcf_b29c), tone), hex(0xee_e9e0), mortar)
}

/// What a ray sees that leaves the corner: a window of panes overhead, a pale wall elsewhere.
fn skylight(origin: DVec3, direction: DVec3) -> Vec3 {
    let wall = hex(0xc9_c4ba) * 0.8;
    let p = origin + direction * ((CEILING - origin.z) / direction.z);
    if direction.z <= 0.0 || p.x.abs().max(p.y.abs()) > 6.0 {
        return wall;
    }
    let bars = line(p.x / 0.75, 0.12, 0.02).max(line(p.y / 0.75, 0.12, 0.02));
    mix(hex(0xf6_faff) * 1.25, hex(0x55_636e), bars)
}

/// Dark and light tiles with a joint between them.
fn tiles(p: DVec2) -> Vec3 {
    let p = p / 0.4;
    let tile = mix(hex(0xe9_e2d4), hex(0x6d_7684), checker(p));
    mix(tile, hex(0xb8_b2a6), line(p.x, 0.03, 0.005).max(line(p.y, 0.03, 0.005)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_jittered_ray_passes_each_cell_and_the_same_each_time() {
        let rays: Vec<_> = jittered([7, 9], 4, 1).collect();
        for (cell, ray) in rays.iter().enumerate() {
            let place = [7.0 + (cell % 4) as f32 / 4.0, 9.0 + (cell / 4) as f32 / 4.0];
            assert!((0..2).all(|i| ray[i] >= place[i] && ray[i] <= place[i] + 0.25), "cell {cell}: {ray:?}");
        }
        assert!(jittered([7, 9], 4, 1).eq(rays.iter().copied()));
        assert!(jittered([9, 7], 4, 1).zip(&rays).all(|(a, b)| a[0].fract() != b[0].fract()));
        assert!(jittered([3, 4], 1, 1).eq([[3.5, 4.5]]));
    }
}
