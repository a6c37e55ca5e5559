//! Fractal objects with the illumination models of Cochran, Lewis and Hart: matte, Phong,
//! Torrance–Sparrow, transparent.

use std::{f32::consts::PI, sync::Arc};

use asperity_fif::{FifError, FixedFif};
use asperity_render::geometry::{fractal::Fractal, ray::Ray, shape::Shape};
use asperity_render::image::tone::hex;
use asperity_render::light::lamps::{Lamps, direction, studio};
use asperity_render::materials::pattern::{checker, grid};
use asperity_render::materials::{Shaded, chalk};
use asperity_render::scene::{Backdrop, Light, Object, Scene, Surface};
use asperity_shading::reflectance::{Absorption, Bsdf, Coat, Lobe};
use asperity_shading::{
    Beckmann, Brdf, Conductor, Dielectric, Fresnel, Phong, SurfacePoint, TorranceSparrow, bump::Facet,
    material::Material, reflect,
};
use glam::Vec3;

use crate::figure::{Context, Drawn};
use asperity::failure::Result;

/// Vertical factors of the slopes.
const FACTORS: [f64; 2] = [0.25, 0.5];

/// Height scale; unscaled heights reach 1/4.
const RISE: f64 = 3.4;

const EYE: Vec3 = Vec3::new(3.6, -3.0, 3.3);
const TARGET: Vec3 = Vec3::new(1.0, 1.0, 0.2);
const FIELD: f32 = 0.46;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let sampling = context.square();
    let mut pictures = Vec::new();
    for factor in FACTORS {
        let shape = Arc::new(Shape::Fractal(Fractal::square(slope(factor)?, RISE)?));
        for (stem, label, object) in models(&shape)? {
            let alt = label.to_lowercase();
            let alt = format!("A square cushion with a fractal surface on a tiled floor: {alt}");
            let (stem, label) =
                (format!("{stem}-{}", (100.0 * factor).round()), format!("{label}; factors {factor}"));
            pictures.push(([stem, label, alt], object));
        }
    }
    let drawn = Drawn::pictures(4, pictures, |object| {
        let floor = Object::shaded(Shape::Plane, |point, wo| matte(point, wo, tiles(point)));
        let mut key = studio(Vec3::splat(POWER / PI));
        // The center of the key light, the first 16 lamps, casts a shadow. The others do not.
        let others = Lamps::open(key.split_off(16));
        let key = Lamps::Far { lights: key, shadow: Some(direction(-132.0, 46.0)) };
        let light = Light::Lamps { lamps: vec![key, others], room: &room };
        let scene = Scene::new(vec![object, floor], light, Backdrop::Light);
        Ok(context.look(&scene, sampling, [EYE, TARGET], FIELD)?.exposed(1.0))
    })?;
    Ok(drawn
        .fact("slope through", "(0, 0), (1/2, 1), (1, 0), (3/2, −1), (2, 0)")
        .fact("height scale", RISE)
        .fact("Phong exponent", PHONG)
        .fact("roughness of the copper", format!("{ROUGHNESS}, Beckmann"))
        .fact("index of the glass", GLASS)
        .fact("samples per pixel", sampling.samples_per_pixel))
}

const PHONG: f32 = 60.0;
const ROUGHNESS: f32 = 0.42;
const GLASS: f32 = 1.5;

/// A slope that rises and falls and integrates to zero. Its integral is a hump that meets the
/// ground smoothly.
fn slope(factor: f64) -> Result<FixedFif<4, 2>, FifError> {
    FixedFif::affine(&[0.0, 0.5, 1.0, 1.5, 2.0], &[0.0, 1.0, 0.0, -1.0, 0.0], &[factor; 4])
}

/// Name, label, and an object of this shape.
type Model = (&'static str, &'static str, Object<'static>);

fn models(shape: &Arc<Shape>) -> Result<[Model; 4]> {
    let object = |surface: Box<Surface<'static>>| Object::new(Arc::clone(shape), surface);
    let matte = |color| Shaded(move |point, wo| matte(point, wo, color));
    let lacquer =
        Glossy { lobe: Phong::new(Vec3::splat(0.16), PHONG)?, base: hex(0x9c_2b22), room: Vec3::splat(0.08) };
    // Indices at about 650, 550 and 450 nm, from Johnson and Christy 1972, "Optical Constants of
    // the Noble Metals".
    let copper = [Conductor::new(0.21, 3.67)?, Conductor::new(1.02, 2.59)?, Conductor::new(1.17, 2.36)?];
    let facets = TorranceSparrow::new(Beckmann::isotropic(ROUGHNESS)?, copper);
    let copper = Glossy { lobe: facets, base: Vec3::ZERO, room: 0.3 * copper.reflectance_rgb(1.0) };
    let glass = object(Box::new(Coat::dielectric(Dielectric::new(GLASS)?)));
    let inside = Absorption::of_color(Vec3::new(0.7, 0.9, 0.84), 1.0)?;
    let glass = Object { body: Some(inside), passes: 0.65, ..glass };
    Ok([
        ("matte", "Matte", object(Box::new(matte(hex(0xe6_dac6))))),
        ("phong", "Phong", object(Box::new(lacquer))),
        ("torrance-sparrow", "Torrance–Sparrow, copper", object(Box::new(copper))),
        ("glass", "Glass", glass),
    ])
}

/// A lobe over a matte base, in a room of this brightness.
struct Glossy<B> {
    lobe: B,
    base: Vec3,
    room: Vec3,
}

impl<B: Brdf> Material for Glossy<B> {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let mirror = reflect(wo, point.normal);
        matte(point, wo, self.base)
            .with([Facet::FLAT], [Lobe::from(&self.lobe as &dyn Brdf)])
            .with_emitted(self.room * sky(mirror))
    }
}

/// Factor for all lamps.
const POWER: f32 = 2.2;

fn matte(point: &SurfacePoint, wo: Vec3, color: Vec3) -> Bsdf<'static> {
    let around = Vec3::new(0.11, 0.12, 0.14) * (0.6 + 0.4 * point.normal.z);
    chalk(point.frame(), wo, Vec3::Z, color, color * around)
}

/// The color of the floor, paler far away.
fn tiles(point: &SurfacePoint) -> Vec3 {
    let p = point.position.truncate() / 0.4;
    let tile = hex(0xe6_e1d6).lerp(hex(0x76_8592), checker(p)).lerp(hex(0xa9_a49a), grid(p, 0.05, 0.01));
    tile / (1.0 + (point.position - TARGET).truncate().length_squared() / 30.0)
}

/// A pale room with a bright ceiling, and the reflection of the key light.
fn room(ray: &Ray) -> Vec3 {
    let key = ((ray.direction.dot(direction(-132.0, 46.0)) - 0.98) / 0.012).clamp(0.0, 1.0);
    sky(ray.direction) + 6.0 * key
}

fn sky(direction: Vec3) -> Vec3 {
    let t = direction.z.clamp(0.0, 1.0);
    hex(0x8e_949c).lerp(hex(0xee_f1f4), t * (2.0 - t))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn object_meets_the_floor_smoothly() {
        for slope in FACTORS.map(|factor| slope(factor).unwrap()) {
            let hump: FixedFif<4, 3> = slope.integral(0.0).unwrap();
            assert_abs_diff_eq!(hump.end_values()[1], 0.0, epsilon = 1e-15);
            assert!(slope.end_values() == [0.0, 0.0] && hump.range().lo > -0.02, "{:?}", hump.range());
        }
    }
}
