//! A landscape that is not a product of curves, next to one that is, with the measured anisotropy
//! of both.

use asperity_fif::{Fif, HeightField, Intersect, PeriodicSurface, Surface, Tabulated, glam::DVec2};
use asperity_render::geometry::mesh::{Mesh, Vertex};
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::{
    geometry::fractal::Fractal, geometry::ray::Ray, geometry::shape::Shape, image::tone::hex,
    interpolation::smoothstep, light::lamps::Lamps, materials::chalk, sampling::sampler::hash,
};
use asperity_shading::{SurfacePoint, reflectance::Bsdf};
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn};
use crate::power_spectrum::PowerSpectrum;
use asperity::failure::Result;

/// Nodes along a side of the torus, and maps of a curve.
const NODES: [usize; 2] = [4, 8];
const FACTOR: f64 = 0.4;
/// Magnitude of the vertical factors of the curves' slopes.
const ROUGHNESS: f64 = 0.7;
/// Standard deviation of the heights, relative to the side.
const RELIEF: f64 = 0.062;
/// The ground below the block.
const FLOOR: f32 = -0.22;
/// Tolerated error of a hit along the ray: less than half a pixel.
const TOLERANCE: f64 = 5e-4;
/// Periods per side of the waves whose anisotropy is measured.
const RING: [f64; 2] = [8.0, 128.0];

const EYE: Vec3 = Vec3::new(-0.50, -0.86, 0.78);
const TARGET: Vec3 = Vec3::new(0.47, 0.43, -0.085);
const FIELD: f32 = 0.76;
const SUN: Vec3 = Vec3::new(-0.85, 0.05, 0.40);
const SUNLIGHT: Vec3 = Vec3::new(1.75, 1.52, 1.16);

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let seed = hash(context.seed + 2);
    let random = |k: usize| f64::from(hash(k as u32 ^ seed)) / f64::from(u32::MAX) - 0.5;
    let [f, g] = [curve(&random, 1000)?, curve(&random, 2000)?];
    let grounds =
        [ground(Tabulated::with_levels(torus(&random)?, 8)), ground(HeightField::new(f, g).tabulated())];
    let grains = [grain(context, grounds[0].surface())?, grain(context, grounds[1].surface())?];
    let [first, second] = grains.map(|grain| format!("{grain:.2}"));
    let torus = format!("the torus surface, grain {first}");
    let product = format!("a product of two curves, grain {second}");
    let alts = [
        "A block of mountains with ridges and gorges in every direction",
        "A block of mountains whose ridges all run along its two sides",
    ];
    let words = [["torus", &torus, alts[0]], ["product", &product, alts[1]]];
    let drawn = Drawn::pictures(2, words.into_iter().zip(grounds), |ground| {
        context.look(&block(ground), context.sampling([18, 18], 1), [EYE, TARGET], FIELD)
    })?;
    Ok(drawn
        .fact("torus", format!("{0} × {0} nodes, M = (2, −1; 1, 2), s = {FACTOR}", NODES[0]))
        .fact("curves", format!("{} maps, vertical factors ±{ROUGHNESS}, integrated once", NODES[1]))
        .fact("grain", format!("{first} and {second}"))
        .fact("waves measured", format!("{} to {} periods per side", RING[0], RING[1])))
}

fn torus(random: &impl Fn(usize) -> f64) -> Result<PeriodicSurface> {
    let count = NODES[0] * NODES[0];
    let z: Vec<f64> = (0..count).map(|k| 2.0 * random(k)).collect();
    let d: Vec<[f64; 2]> = (0..count).map(|k| [100, 200].map(|row| 6.0 * random(k + row))).collect();
    Ok(PeriodicSurface::new(NODES[0], [[2, -1], [1, 2]], FACTOR, &z, &d)?.narrowed())
}

/// Returns the integral of a rough function of mean 0 on the unit interval.
fn curve(random: &impl Fn(usize) -> f64, row: usize) -> Result<Fif<3>> {
    let knots: Vec<f64> = (0..=NODES[1]).map(|k| k as f64 / NODES[1] as f64).collect();
    let alpha: Vec<f64> = (0..NODES[1]).map(|k| ROUGHNESS.copysign(random(row + 100 + k))).collect();
    let mut y: Vec<f64> = (0..=NODES[1]).map(|k| random(row + k)).collect();
    let mean = Fif::affine(&knots, &y, &alpha)?.total_integral();
    y.iter_mut().for_each(|y| *y -= mean);
    Ok(Fif::affine(&knots, &y, &alpha)?.integral(0.05)?)
}

/// Returns heights of mean 0 and the standard deviation [`RELIEF`], as measured on a grid.
fn ground(surface: impl Intersect + Send + Sync + 'static) -> Fractal {
    const SIDE: usize = 96;
    let at = |k: usize| (k as f64 + 0.5) / SIDE as f64;
    let heights: Vec<f64> =
        (0..SIDE * SIDE).map(|k| surface.evaluate(at(k % SIDE), at(k / SIDE), 1e-4).value).collect();
    let count = heights.len() as f64;
    let mean = heights.iter().sum::<f64>() / count;
    let variance = heights.iter().map(|h| (h - mean).powi(2)).sum::<f64>() / count;
    Fractal::new(surface, RELIEF / variance.sqrt(), mean).within(TOLERANCE)
}

/// Returns a block of ground over the unit square, on a table.
fn block(ground: Fractal) -> Scene<'static, 'static> {
    let sides = [Vec2::X, Vec2::Y].map(|along| Object::shaded(side(&ground, along), stone));
    let [table, wide] = [Vec3::new(-20.0, -20.0, FLOOR), Vec3::splat(41.0)];
    let table = Mesh::parallelogram(table, [Vec3::X * wide, Vec3::Y * wide]);
    let mut objects = vec![Object::shaded(Shape::Fractal(ground), land), Object::shaded(table, cloth)];
    objects.extend(sides);
    let lamps = vec![Lamps::one(SUN.normalize(), SUNLIGHT)];
    let mut scene =
        Scene::new(objects, Light::Lamps { lamps, room: &|ray: &Ray| sky(ray.direction) }, Backdrop::Light);
    scene.start = 2e-3;
    scene
}

/// Returns the side of the block below an edge of the square. Its texture coordinates are lengths
/// along and below the surface.
fn side(ground: &Fractal, along: Vec2) -> Mesh {
    const STEPS: u32 = 1024;
    let mut mesh = Mesh::default();
    for k in 0..=STEPS {
        let x = k as f32 / STEPS as f32;
        let p = x * along;
        let top = ground.height(p.as_dvec2()) as f32;
        let vertex = |z: f32| Vertex {
            position: p.extend(z),
            normal: (along - 1.0).extend(0.0),
            tangent: along.extend(0.0),
            uv: Vec2::new(x, top - z),
        };
        mesh.vertices.extend([vertex(FLOOR), vertex(top)]);
        if k > 0 {
            let a = 2 * k - 2;
            mesh.triangles.extend([[a, a + 2, a + 1], [a + 1, a + 2, a + 3]]);
        }
    }
    mesh
}

/// Meadows, rock and snow, by height and slope.
fn land(point: &SurfacePoint, wo: Vec3) -> Bsdf<'static> {
    let normal = point.normal;
    let (level, steep) = (point.position.z / RELIEF as f32, 1.0 - normal.z);
    let meadow = hex(0x4e_6a2c).lerp(hex(0x9a_9453), (0.45 + 0.35 * level).clamp(0.0, 1.0));
    let rock = hex(0x7d_7064).lerp(hex(0x97_897a), (0.5 + 0.3 * level).clamp(0.0, 1.0));
    let ground = meadow.lerp(rock, smoothstep(0.22, 0.42, steep + 0.06 * level.max(0.0)));
    let ground = ground.lerp(hex(0xf3_f5f8), smoothstep(0.85, 1.35, level - 1.6 * steep));
    // Valleys see less of the sky.
    let open = (0.72 + 0.16 * level).clamp(0.45, 1.0) * (0.55 + 0.45 * normal.z);
    hazy(point, wo, ground, Vec3::new(0.19, 0.25, 0.35) * open)
}

/// Layers of stone, with soil on top.
fn stone(point: &SurfacePoint, wo: Vec3) -> Bsdf<'static> {
    let (at, depth) = (point.position, point.uv.y);
    let layer = (at.z * 140.0 + 3.0 * (at.x * 9.0 + at.y * 7.0).sin()).sin();
    let stone = hex(0x6f_6256).lerp(hex(0x87_7767), 0.3 + 0.3 * layer);
    let ground = hex(0x4c_3f33).lerp(stone, (depth * 60.0).clamp(0.0, 1.0));
    // Duller in sunlight than the land.
    let dull = Vec3::new(1.3, 1.2, 1.02) / SUNLIGHT;
    hazy(point, wo, ground * dull, Vec3::new(0.36, 0.38, 0.42) / dull)
}

/// The table below the block, with its shadow.
fn cloth(point: &SurfacePoint, wo: Vec3) -> Bsdf<'static> {
    let p = point.position;
    let beside = ((p.truncate() - 0.5).abs() - 0.5).max(Vec2::ZERO).length();
    let color = hex(0xd8_d2c8) * (0.62 + 0.38 * smoothstep(0.0, 0.35, beside));
    let sun = SUNLIGHT * SUN.normalize().z / 0.38;
    let kept = (-0.3 * (p.distance(EYE) - 1.2).max(0.0)).exp();
    let sky = sky(-wo);
    chalk(point.frame(), wo, Vec3::Z, kept * color / sun, sky.lerp(0.62 * color, kept))
}

/// A matte color under ambient light, with distance haze.
fn hazy(point: &SurfacePoint, wo: Vec3, color: Vec3, around: Vec3) -> Bsdf<'static> {
    let kept = (-0.07 * (point.position.distance(EYE) - 0.4).max(0.0)).exp();
    chalk(point.frame(), wo, Vec3::Z, kept * color, hex(0xd9_dfe4).lerp(color * around, kept))
}

fn sky(direction: Vec3) -> Vec3 {
    hex(0xe9_e4da).lerp(hex(0x9f_bdd6), (direction.z * 2.2 + 0.75).clamp(0.0, 1.0))
}

/// Returns the mean power density of the slopes within 5° of the axes, relative to all directions.
fn grain(context: &Context<'_>, surface: &(dyn Surface + Send + Sync)) -> Result<f64> {
    const SIDE: usize = 512;
    let at = |k: usize| (k as f64 + 0.5) / SIDE as f64;
    let slope = |i, j| surface.gradient_near(at(i), at(j), 1e-4).unwrap_or(DVec2::ZERO);
    let slopes: Vec<DVec2> = context.rows(SIDE, |j| (0..SIDE).map(move |i| slope(i, j)))?;
    let mean = slopes.iter().sum::<DVec2>() / slopes.len() as f64;
    let spectrum = PowerSpectrum::mean(SIDE, 1.0 / SIDE as f64, 1, |k| {
        slopes.iter().map(|slope| (*slope - mean)[k] as f32).collect()
    });
    let energy = |wanted: fn(f64) -> bool| -> f64 {
        let rings = spectrum.rings(RING, wanted);
        rings.iter().map(|[frequency, density]| frequency * frequency * density).sum()
    };
    // Within 5° of an axis, the cosine of four times the angle exceeds cos 20°.
    Ok(energy(|cos_4| cos_4 > 20_f64.to_radians().cos()) / energy(|_| true))
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn heights_have_the_given_relief() {
        let random = |k: usize| f64::from(hash(k as u32)) / f64::from(u32::MAX) - 0.5;
        let ground = ground(torus(&random).unwrap());
        let at = |k: u32| DVec2::new(f64::from(k % 64), f64::from(k / 64)) / 64.0;
        let squares = (0..4096).map(|k| ground.height(at(k)).powi(2)).sum::<f64>() / 4096.0;
        assert_relative_eq!(squares.sqrt(), RELIEF, max_relative = 0.1);
    }
}
