//! A landscape that is no product of curves beside one that is, with the grain of both measured.

use asperity_fif::{
    Cached, FifBuf, HeightField, Interval, Pyramid, Ray, SmoothBuf, Surface, TorusBuf,
    glam::{DVec2, DVec3},
};
use asperity_render::{
    geometry::camera::Camera, image::tone::hex, materials::pattern::mix, sampling::sampler::hash,
};
use glam::Vec3;
use rayon::prelude::*;

use crate::{
    failure::{Failure, Interrupted},
    gallery::{
        figure::{Context, Drawn, Panel},
        power_spectrum::PowerSpectrum,
    },
};

/// Nodes along a side of the torus, and maps of a curve.
const NODES: [usize; 2] = [4, 8];
const FACTOR: f64 = 0.4;
/// Magnitude of the vertical factors of the curves' slopes.
const ROUGHNESS: f64 = 0.7;
/// Standard deviation of the heights, over the side.
const RELIEF: f64 = 0.062;
/// The ground under the block.
const FLOOR: f64 = -0.22;
/// Higher than any summit.
const TOP: f64 = 0.35;
/// Lengths that a ray may be wrong by: less than half a pixel.
const TOLERANCE: f64 = 5e-4;
/// Periods per side of the waves whose grain is measured.
const RING: [f64; 2] = [8.0, 128.0];

const EYE: Vec3 = Vec3::new(-0.50, -0.86, 0.78);
const TARGET: Vec3 = Vec3::new(0.47, 0.43, -0.085);
const FIELD: f32 = 0.76;
const SUN: DVec3 = DVec3::new(-0.85, 0.05, 0.40);

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let seed = hash(context.seed + 2);
    let random = |k: usize| f64::from(hash(k as u32 ^ seed)) / f64::from(u32::MAX) - 0.5;
    let [f, g] = [curve(&random, 1000)?, curve(&random, 2000)?];
    let grounds = [
        Ground::new(Box::new(Pyramid::with_levels(torus(&random)?, 8))),
        Ground::new(Box::new(HeightField::new(Cached::new(f), Cached::new(g)))),
    ];
    let words = [
        ["torus", "the torus surface", "A block of mountains with ridges and gorges in every direction"],
        [
            "product",
            "a product of two curves",
            "A block of mountains whose ridges all run along its two sides",
        ],
    ];
    let (mut panels, mut grains) = (Vec::new(), Vec::new());
    for (ground, [stem, label, alt]) in grounds.iter().zip(words) {
        let sampling = context.sampling([18, 18], 1);
        let camera = Camera::new(EYE, TARGET, FIELD, sampling.width, sampling.height);
        let image = context.render(sampling, |x, y| {
            ground.radiance(camera.eye().as_dvec3(), camera.direction(x, y).as_dvec3())
        })?;
        let grain = format!("{:.2}", ground.grain(context)?);
        panels.push(Panel::raster(stem, &format!("{label}, grain {grain}"), alt, image));
        grains.push(grain);
    }
    Ok(Drawn::new(2, panels)
        .fact("torus", format!("{0} \u{d7} {0} nodes, M = (2, \u{2212}1; 1, 2), s = {FACTOR}", NODES[0]))
        .fact("curves", format!("{} maps, vertical factors \u{b1}{ROUGHNESS}, integrated once", NODES[1]))
        .fact("grain", &grains.join(" and "))
        .fact("waves measured", format!("{} to {} periods per side", RING[0], RING[1])))
}

fn torus(random: &impl Fn(usize) -> f64) -> Result<TorusBuf, Failure> {
    let count = NODES[0] * NODES[0];
    let z: Vec<f64> = (0..count).map(|k| 2.0 * random(k)).collect();
    let d: Vec<[f64; 2]> = (0..count).map(|k| [100, 200].map(|row| 6.0 * random(k + row))).collect();
    Ok(TorusBuf::new(NODES[0], [[2, -1], [1, 2]], FACTOR, &z, &d)?.narrowed())
}

/// The integral of a rough function of mean 0 on the unit interval.
fn curve(random: &impl Fn(usize) -> f64, row: usize) -> Result<SmoothBuf<3, 2>, Failure> {
    let knots: Vec<f64> = (0..=NODES[1]).map(|k| k as f64 / NODES[1] as f64).collect();
    let alpha: Vec<f64> = (0..NODES[1]).map(|k| ROUGHNESS.copysign(random(row + 100 + k))).collect();
    let mut y: Vec<f64> = (0..=NODES[1]).map(|k| random(row + k)).collect();
    let mean = FifBuf::<2>::affine(&knots, &y, &alpha)?.total_integral();
    y.iter_mut().for_each(|y| *y -= mean);
    Ok(SmoothBuf::integral(FifBuf::<2>::affine(&knots, &y, &alpha)?, 0.05)?)
}

/// A surface over the unit square, as a block of ground.
struct Ground {
    surface: Box<dyn Surface + Sync>,
    rise: f64,
    mean: f64,
}

impl Ground {
    /// Heights of mean 0 and the standard deviation [`RELIEF`], as measured on a grid.
    fn new(surface: Box<dyn Surface + Sync>) -> Self {
        const SIDE: usize = 96;
        let at = |k: usize| (k as f64 + 0.5) / SIDE as f64;
        let heights: Vec<f64> =
            (0..SIDE * SIDE).map(|k| surface.evaluate(at(k % SIDE), at(k / SIDE), 1e-4).value).collect();
        let count = heights.len() as f64;
        let mean = heights.iter().sum::<f64>() / count;
        let variance = heights.iter().map(|h| (h - mean).powi(2)).sum::<f64>() / count;
        Self { surface, rise: RELIEF / variance.sqrt(), mean }
    }

    fn height(&self, p: DVec2) -> f64 {
        (self.surface.evaluate(p.x, p.y, 1e-5).value - self.mean) * self.rise
    }

    /// Where a ray first meets the surface, and the height and the gradient there.
    fn meets(&self, origin: DVec3, direction: DVec3) -> Option<(f64, f64, DVec2)> {
        let ray = Ray {
            origin: DVec3::new(origin.x, origin.y, origin.z / self.rise + self.mean),
            direction: DVec3::new(direction.x, direction.y, direction.z / self.rise),
        };
        let hit = self.surface.first_hit_within(&ray, Interval::new(0.0, f64::INFINITY), TOLERANCE)?;
        Some((hit.t, (hit.height - self.mean) * self.rise, hit.gradient? * self.rise))
    }

    fn radiance(&self, origin: DVec3, direction: DVec3) -> Vec3 {
        let sun = SUN.normalize();
        let sky = sky(direction);
        let Some((near, far)) = block(origin, direction) else { return self.table(origin, direction, sky) };
        let enters = origin + direction * near;
        if enters.z < self.height(enters.truncate()) {
            return haze(self.wall(enters, sun), near);
        }
        let Some((t, height, gradient)) = self.meets(origin, direction).filter(|(t, ..)| *t <= far + 1e-9)
        else {
            return self.table(origin, direction, sky);
        };
        let position = origin + direction * t;
        let normal = DVec3::new(-gradient.x, -gradient.y, 1.0).normalize();
        let mut light = normal.dot(sun).max(0.0) as f32;
        if light > 0.0 && self.meets(position + normal * 3e-3, sun).is_some() {
            light = 0.0;
        }
        let (level, steep, up) = ((height / RELIEF) as f32, 1.0 - normal.z as f32, normal.z as f32);
        let meadow = mix(hex(0x4e_6a2c), hex(0x9a_9453), (0.45 + 0.35 * level).clamp(0.0, 1.0));
        let rock = mix(hex(0x7d_7064), hex(0x97_897a), (0.5 + 0.3 * level).clamp(0.0, 1.0));
        let ground = mix(meadow, rock, smoothstep(0.22, 0.42, steep + 0.06 * level.max(0.0)));
        let ground = mix(ground, hex(0xf3_f5f8), smoothstep(0.85, 1.35, level - 1.6 * steep));
        // Valleys see less of the sky.
        let open = (0.72 + 0.16 * level).clamp(0.45, 1.0) * (0.55 + 0.45 * up);
        haze(ground * (Vec3::new(1.75, 1.52, 1.16) * light + Vec3::new(0.19, 0.25, 0.35) * open), t)
    }

    /// The block's side, layered, with soil on top.
    fn wall(&self, at: DVec3, sun: DVec3) -> Vec3 {
        let outward = if at.x < 1e-6 { DVec3::NEG_X } else { DVec3::NEG_Y };
        let depth = (self.height(at.truncate()) - at.z) as f32;
        let layer = (at.z * 140.0 + 3.0 * (at.x * 9.0 + at.y * 7.0).sin()).sin() as f32;
        let stone = mix(hex(0x6f_6256), hex(0x87_7767), 0.3 + 0.3 * layer);
        let ground = mix(hex(0x4c_3f33), stone, (depth * 60.0).clamp(0.0, 1.0));
        let light = outward.dot(sun).max(0.0) as f32;
        ground * (Vec3::new(1.3, 1.2, 1.02) * light + Vec3::new(0.36, 0.38, 0.42))
    }

    /// The table on which the block stands, with its shadow.
    fn table(&self, origin: DVec3, direction: DVec3, sky: Vec3) -> Vec3 {
        let t = (FLOOR - origin.z) / direction.z;
        if direction.z >= 0.0 || t > 20.0 {
            return sky;
        }
        let (p, sun) = (origin + direction * t, SUN.normalize());
        let beside = ((p.truncate() - 0.5).abs() - 0.5).max(DVec2::ZERO).length() as f32;
        let shadow = block(p, sun).is_some_and(|(near, _)| {
            let enters = p + sun * near;
            enters.z < self.height(enters.truncate()) || self.meets(p, sun).is_some()
        });
        let light = if shadow { 0.62 } else { 1.0 } * (0.62 + 0.38 * smoothstep(0.0, 0.35, beside));
        mix(hex(0xd8_d2c8) * light, sky, 1.0 - (-0.3 * (t as f32 - 1.2).max(0.0)).exp())
    }

    /// The mean density of the slopes' power within 5° of the axes over that in all directions.
    fn grain(&self, context: &Context<'_>) -> Result<f64, Failure> {
        const SIDE: usize = 512;
        let at = |k: usize| (k as f64 + 0.5) / SIDE as f64;
        let rows: Result<Vec<Vec<DVec2>>, Interrupted> = (0..SIDE)
            .into_par_iter()
            .map(|j| {
                context.checkpoint().map_err(|_| Interrupted)?;
                let slope = |i| self.surface.gradient_near(at(i), at(j), 1e-4).unwrap_or(DVec2::ZERO);
                Ok((0..SIDE).map(slope).collect())
            })
            .collect();
        let slopes = rows?.concat();
        let mean = slopes.iter().sum::<DVec2>() / slopes.len() as f64;
        let spectrum = PowerSpectrum::mean(SIDE, 1.0 / SIDE as f64, 1, |k| {
            slopes.iter().map(|slope| (*slope - mean)[k] as f32).collect()
        });
        let energy = |wanted: fn(f64) -> bool| -> f64 {
            let rings = spectrum.rings(RING, wanted);
            rings.iter().map(|[frequency, density]| frequency * frequency * density).sum()
        };
        // Within 5° of an axis the cosine of four times the angle is over cos 20°.
        Ok(energy(|cos_4| cos_4 > 20_f64.to_radians().cos()) / energy(|_| true))
    }
}

fn sky(direction: DVec3) -> Vec3 {
    let up = (direction.z * 2.2 + 0.75).clamp(0.0, 1.0) as f32;
    mix(hex(0xe9_e4da), hex(0x9f_bdd6), up)
}

/// Far things fade into the air.
fn haze(colour: Vec3, t: f64) -> Vec3 {
    mix(colour, hex(0xd9_dfe4), 1.0 - (-0.07 * (t as f32 - 0.4).max(0.0)).exp())
}

fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The stretch of a ray, from its origin on, within the unit square between [`FLOOR`] and [`TOP`].
fn block(origin: DVec3, direction: DVec3) -> Option<(f64, f64)> {
    let (a, b) = (
        (DVec3::new(0.0, 0.0, FLOOR) - origin) / direction,
        (DVec3::new(1.0, 1.0, TOP) - origin) / direction,
    );
    let (near, far) = (a.min(b).max_element().max(0.0), a.max(b).min_element());
    (near < far).then_some((near, far))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_block_is_met_from_outside_and_left_from_inside() {
        assert_eq!(block(DVec3::new(-1.0, 0.5, 0.0), DVec3::X), Some((1.0, 2.0)));
        assert_eq!(block(DVec3::new(0.5, 0.5, 0.0), DVec3::X), Some((0.0, 0.5)));
        assert_eq!(block(DVec3::new(0.5, 0.5, 1.0), DVec3::X), None);
    }

    #[test]
    fn heights_have_the_relief_that_is_asked_for() {
        let random = |k: usize| f64::from(hash(k as u32)) / f64::from(u32::MAX) - 0.5;
        let ground = Ground::new(Box::new(torus(&random).unwrap()));
        let at = |k: u32| f64::from(k) / 64.0;
        let squares: f64 =
            (0..4096).map(|k| ground.height(DVec2::new(at(k % 64), at(k / 64))).powi(2)).sum::<f64>()
                / 4096.0;
        assert!((squares.sqrt() / RELIEF - 1.0).abs() < 0.1, "{}", squares.sqrt());
    }
}
