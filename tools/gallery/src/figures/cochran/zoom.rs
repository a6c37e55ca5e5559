//! A fractal surface at seven zooms, each ten times the previous.

use asperity_fif::glam::{DVec2, DVec3};
use asperity_fif::{HeightField, Table, cochran_2000};
use asperity_render::image::tone::{hex, shoulder, srgb};
use asperity_render::light::lamps::{Lamps, direction};
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::{
    geometry::camera::Camera,
    geometry::fractal::Fractal,
    geometry::ray::Ray,
    geometry::shape::Shape,
    integrator::{
        adaptive::{Detail, Goal},
        pixels::Sampling,
    },
    materials::chalk,
};
use asperity_shading::SurfacePoint;
use glam::Vec3;

use crate::figure::{Context, Drawn};
use asperity::failure::Result;

/// Height scale; f(x) f(y) reaches 16/9.
const RISE: f64 = 0.4;

/// The point that the camera approaches. 19/63 and 35/63 of the domain have the repeating binary
/// digits 010011 and 100011. The rises and falls of all levels cancel there, and neither the
/// camera's path nor the light's is ever blocked.
const POINT: DVec2 = DVec2::new(38.0 / 63.0, 10.0 / 9.0);

/// From the point to the camera at zoom 1, in the surface's units.
const AWAY: Vec3 = Vec3::new(-1.9, -2.7, 3.5);

const FIELD: f32 = 0.7;

const EXPOSURE: f32 = 1.1;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let values = cochran_2000::f()?.table(1e-14)?;
    // Seven panels side by side are small.
    let side = context.size - context.size / 4;
    let sampling = Sampling { width: side, height: side, ..context.square() };
    // Mean slopes are already smooth: the many samples are for edges of the surface and its
    // shadows.
    let samples = [context.goal.samples[0].div_ceil(2), context.goal.samples[1].div_ceil(4)];
    let goal =
        Goal { shown: |x| srgb(shoulder(EXPOSURE * x)), samples, detail: Detail::Fine, ..context.goal };
    let pixel = 2.0 * (0.5 * FIELD).tan() / side as f32;
    let zooms = ["1", "10", "100", "1000", "10⁴", "10⁵", "10⁶"];
    let pictures = zooms.into_iter().zip(0..).map(|(zoom, power)| {
        let alt = format!("Jagged mountains in low light, magnified {zoom} times");
        ([format!("e{power}"), format!("×{zoom}"), alt], 10.0_f64.powi(-power))
    });
    let target = POINT.extend(height(&values, POINT));
    let mut grains = Vec::new();
    let drawn = Drawn::pictures(4, pictures, |scale| {
        // Rays are relative to the point, in units of the zoom, so that directions and colors are
        // unaffected.
        let shape =
            Fractal::new(HeightField::new(cochran_2000::f()?, cochran_2000::f()?).tabulated(), RISE, 0.0);
        // A tenth of a pixel.
        let shape = shape.within(0.1 * f64::from(pixel * AWAY.length()));
        let shape = Shape::Fractal(shape.magnified(target, scale));
        let rock = |point: &SurfacePoint, wo: Vec3| {
            let p = point.position;
            let reach = 0.75 * pixel * p.distance(AWAY);
            let at = target.truncate() + scale * p.truncate().as_dvec2();
            let normal = normal(&values, at, scale * f64::from(reach)).as_vec3();
            // Steep faces are bare.
            let steep = ((0.83 - normal.z) / 0.2).clamp(0.0, 1.0);
            let rock = hex(0xc6_b69c).lerp(hex(0x93_7a66), steep);
            chalk(
                point.frame(),
                wo,
                point.frame().to_local(normal),
                rock,
                rock * hex(0x9f_b6d6) * (0.3 + 0.24 * normal.z),
            )
        };
        let room = |ray: &Ray| ground(target + scale * ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let lamps = vec![Lamps::one(direction(-168.0, 36.0), hex(0xff_ecd0) * 2.3)];
        let light = Light::Lamps { lamps, room: &room };
        let mut scene = Scene::new(vec![Object::shaded(shape, rock)], light, Backdrop::Light);
        scene.start = 1.125 * pixel;
        let camera = Camera::new(AWAY, Vec3::ZERO, FIELD, side, side);
        let (image, grain) = scene.draw_until(sampling, &goal, &camera, context.watch)?;
        grains.push(grain);
        Ok(image.exposed(EXPOSURE))
    })?;
    Ok(drawn
        .fact("height scale", RISE)
        .fact("point", "(38/63, 10/9)")
        .fact("distance at ×1", format!("{:.2}", AWAY.length()))
        .grain(&grains))
}

fn height(values: &Table<2>, p: DVec2) -> f64 {
    RISE * values.value(p.x) * values.value(p.y)
}

/// Returns the upward unit normal of the mean slope over a square of side `2 reach`.
fn normal(values: &Table<2>, p: DVec2, reach: f64) -> DVec3 {
    let across = |step: DVec2| (height(values, p + step) - height(values, p - step)) / (2.0 * reach);
    let slope = DVec2::new(across(DVec2::new(reach, 0.0)), across(DVec2::new(0.0, reach)));
    DVec3::new(-slope.x, -slope.y, 1.0).normalize()
}

/// The table below the surface, and the room behind it.
fn ground(eye: DVec3, towards: DVec3) -> Vec3 {
    let p = eye.truncate() - towards.truncate() * (eye.z / towards.z.min(-1e-9));
    let away = ((p - 1.0).length() / 5.0).min(1.0) as f32;
    hex(0xcf_ccc6).lerp(hex(0x8d_949c), away)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relief_is_equally_steep_at_every_zoom() {
        let values = cochran_2000::f().unwrap().table(1e-14).unwrap();
        for side in (0..=6).map(|power| 10.0_f64.powi(-power)) {
            let mut square = 0.0;
            for k in 0..400 {
                let place = DVec2::new(f64::from(k % 20), f64::from(k / 20)) / 20.0 - 0.5;
                let normal = normal(&values, POINT + place * side, 0.002 * side);
                square += (normal.truncate() / normal.z).length_squared() / 400.0;
            }
            // Measured 1.70 to 2.05.
            assert!((1.5..2.3).contains(&square.sqrt()), "{side}: {square}");
        }
    }
}
