//! Path traces two spheres under a sky, with multiple importance sampling, to a PNG: `cargo run
//! --release --example path_tracer [path]`.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::reflectance::Coat;
use asperity_shading::{CookTorrance, Dielectric, Environment, EnvironmentMap, Footprint, Ggx, Lambert};
use asperity_shading::{Material, SurfacePoint};

const SIDE: u32 = 64;
const SAMPLES: u32 = 8;

/// A sphere of radius 1.
struct Sphere(Vec3, Box<dyn Material>);

/// Uniform numbers in [0, 1).
struct Random(u32);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((self.0 >> ((self.0 >> 28) + 4)) ^ self.0).wrapping_mul(277_803_737);
        (word >> 8) as f32 / 16_777_216.0
    }

    fn square(&mut self) -> Vec2 {
        Vec2::new(self.next(), self.next())
    }
}

fn hit(scene: &[Sphere], origin: Vec3, direction: Vec3) -> Option<(f32, &Sphere)> {
    let hits = scene.iter().filter_map(|sphere| {
        let to = sphere.0 - origin;
        let (middle, square) = (to.dot(direction), to.length_squared() - 1.0);
        let half = (middle * middle - square).sqrt();
        [middle - half, middle + half].into_iter().find(|t| *t > 1e-3).map(|t| (t, sphere))
    });
    hits.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The power heuristic.
fn weight(pdf: f32, other: f32) -> f32 {
    pdf * pdf / (pdf * pdf + other * other)
}

fn radiance(scene: &[Sphere], sky: &EnvironmentMap, mut o: Vec3, mut d: Vec3, random: &mut Random) -> Vec3 {
    let (mut sum, mut throughput, mut sky_weight) = (Vec3::ZERO, Vec3::ONE, 1.0);
    for _ in 0..8 {
        let Some((t, sphere)) = hit(scene, o, d) else {
            return sum + throughput * sky.radiance(d) * sky_weight;
        };
        let (p, wo) = (o + t * d, -d);
        let point = SurfacePoint::new(p, p - sphere.0, Footprint::from_distance(t, 0.02, 1.0));
        let bsdf = sphere.1.bsdf(&point, wo);
        let wi = sky.sample(random.square());
        let (pdf, f) = (sky.pdf(wi), bsdf.eval_cos(wo, wi));
        if f != Vec3::ZERO && hit(scene, p, wi).is_none() {
            sum += throughput * f * sky.radiance(wi) * (weight(pdf, bsdf.pdf(wo, wi)) / pdf);
        }
        let Some(s) = bsdf.sample(wo, random.next(), random.square()) else { break };
        throughput *= s.weight();
        sky_weight = if s.is_specular() { 1.0 } else { weight(s.pdf, sky.pdf(s.wi)) };
        (o, d) = (p, s.wi);
    }
    sum
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sky = EnvironmentMap::from_fn(64, 32, |d| {
        let sun = (d.dot(Vec3::new(0.5, -0.3, 0.81)) - 0.97).max(0.0) * Vec3::new(1500.0, 1300.0, 1000.0);
        sun + Vec3::new(0.15, 0.13, 0.1).lerp(Vec3::new(0.5, 0.7, 1.0), 0.5 + 0.5 * d.z)
    })?;
    let scene = |materials: [Box<dyn Material>; 3]| {
        let places = [Vec3::new(-2.1, 0.0, 0.0), Vec3::ZERO, Vec3::new(2.1, 0.0, 0.0)];
        places
            .into_iter()
            .zip(materials)
            .map(|(center, material)| Sphere(center, material))
            .collect::<Vec<_>>()
    };
    let glass = Coat::dielectric(Dielectric::new(1.5)?);
    let brushed = CookTorrance::new(Ggx::new(0.1, 0.4)?, Vec3::new(0.9, 0.85, 0.7));
    let still_life = scene([Box::new(Lambert::new(Vec3::splat(0.6))?), Box::new(glass), Box::new(brushed)]);
    // Glass keeps all light: a sphere of it in uniform light is invisible.
    let (white, alone) =
        (EnvironmentMap::from_fn(2, 1, |_| Vec3::ONE)?, [Sphere(Vec3::ZERO, Box::new(glass))]);
    let mut random = Random(1);
    let mut furnace = Vec3::ZERO;
    for _ in 0..2000 {
        let from = Vec3::new(random.next() - 0.5, -3.0, random.next() - 0.5);
        furnace += radiance(&alone, &white, from, Vec3::Y, &mut random) / 2000.0;
    }
    assert!((furnace - 1.0).abs().max_element() < 0.02, "{furnace}");
    let pixels: Vec<u8> = (0..2 * SIDE * SIDE)
        .flat_map(|k| {
            let mut sum = Vec3::ZERO;
            for _ in 0..SAMPLES {
                let at = Vec2::new((k % (2 * SIDE)) as f32, (k / (2 * SIDE)) as f32) + random.square();
                let (x, z) = (at.x / SIDE as f32 - 1.0, 0.5 - at.y / SIDE as f32);
                let direction = Vec3::new(x, 1.8, z).normalize();
                sum += radiance(&still_life, &sky, Vec3::new(0.0, -6.0, 0.0), direction, &mut random);
            }
            let light = sum / SAMPLES as f32;
            (light / (1.0 + light)).powf(1.0 / 2.2).to_array().map(|c| (255.0 * c) as u8)
        })
        .collect();
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/path_tracer.png".into());
    let mut png = png::Encoder::new(std::fs::File::create(&path)?, 2 * SIDE, SIDE);
    png.set_color(png::ColorType::Rgb);
    png.write_header()?.write_image_data(&pixels)?;
    Ok(())
}
