//! A fractal surface at seven zooms, each ten times the last.

use asperity_fif::{
    HeightField, Table,
    glam::{DVec2, DVec3},
    paper,
};
use asperity_render::{
    geometry::{camera::Camera, fractal::Fractal, ray::Ray, shape::Shape},
    image::tone::hex,
    integrator::pixels::Sampling,
    light::lamps::{Lamps, direction},
    materials::chalk,
    scene::{Backdrop, Light, Object, Scene},
};
use asperity_shading::SurfacePoint;
use glam::Vec3;

use crate::{
    failure::Failure,
    gallery::figure::{Context, Drawn, Panel},
};

/// Powers of ten.
const POWERS: i32 = 6;

/// Heights are multiplied by this; f(x) f(y) reaches 16/9.
const RISE: f64 = 0.4;

/// The point that the camera approaches. 19/63 and 35/63 of the domain have the binary digits 010011 and 100011, repeated:
/// the rises and falls of all levels cancel there, and neither the camera's way nor the light's is ever blocked.
const POINT: DVec2 = DVec2::new(38.0 / 63.0, 10.0 / 9.0);

/// From the point to the camera at zoom 1, in the surface's units.
const AWAY: Vec3 = Vec3::new(-1.9, -2.7, 3.5);

const FIELD: f32 = 0.7;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let surface = Surface::new()?;
    // Seven panels side by side are small, and mean slopes are smooth already.
    let sampling = context.square();
    let side = sampling.width - sampling.width / 4;
    let samples_per_pixel = sampling.samples_per_pixel.div_ceil(2);
    let sampling = Sampling { width: side, height: side, samples_per_pixel, ..sampling };
    let mut panels = Vec::new();
    for power in 0..=POWERS {
        let scale = 10.0_f64.powi(-power);
        let target = POINT.extend(surface.height(POINT));
        // Rays meet it about the point, in lengths of the zoom: directions and colours stay what they are.
        let shape = Fractal::new(HeightField::new(paper::f()?, paper::f()?).tabulated(), RISE, 0.0);
        let shape = Shape::Fractal(shape.within(0.0).magnified(target, scale));
        let camera = Camera::new(AWAY, Vec3::ZERO, FIELD, sampling.width, sampling.height);
        let pixel = 2.0 * (0.5 * FIELD).tan() / sampling.height as f32;
        let rock = |point: &SurfacePoint, wo: Vec3| {
            let p = point.position;
            let reach = 0.75 * pixel * p.distance(AWAY);
            let at = target.truncate() + scale * p.truncate().as_dvec2();
            let normal = surface.normal(at, scale * f64::from(reach)).as_vec3();
            // Steep faces are bare.
            let steep = ((0.83 - normal.z) / 0.2).clamp(0.0, 1.0);
            let rock = hex(0xc6_b69c).lerp(hex(0x93_7a66), steep);
            chalk(wo, point.frame().to_local(normal), rock, rock * hex(0x9f_b6d6) * (0.3 + 0.24 * normal.z))
        };
        let room = |ray: &Ray| ground(target + scale * ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let lamps = vec![Lamps::one(direction(-168.0, 36.0), hex(0xff_ecd0) * 2.3)];
        let light = Light::Lamps { lamps, room: &room };
        let mut scene = Scene::new(vec![Object::shaded(shape, rock)], light, Backdrop::Light);
        scene.start = 1.125 * pixel;
        let image = context.draw(&scene, sampling, &camera)?;
        let zoom = ["1", "10", "100", "1000", "10\u{2074}", "10\u{2075}", "10\u{2076}"];
        let zoom = zoom.get(power as usize).copied().unwrap_or_default();
        let label = format!("\u{d7}{zoom}");
        let alt = format!("Jagged mountains in low light, magnified {zoom} times");
        panels.push(Panel::raster(format!("e{power}"), label, alt, image.exposed(1.1)));
    }
    Ok(Drawn::new(4, panels)
        .fact("heights times", RISE.to_string())
        .fact("point", "(38/63, 10/9)")
        .fact("distance at \u{d7}1", format!("{:.2}", AWAY.length()))
        .fact("samples per pixel", sampling.samples_per_pixel.to_string()))
}

struct Surface {
    values: Table<2>,
}

impl Surface {
    fn new() -> Result<Self, Failure> {
        Ok(Self { values: paper::f()?.table(1e-14)? })
    }

    fn height(&self, p: DVec2) -> f64 {
        RISE * self.values.value(p.x) * self.values.value(p.y)
    }

    /// The upward unit normal of the mean slope over a square of side `2 reach`.
    fn normal(&self, p: DVec2, reach: f64) -> DVec3 {
        let across = |step: DVec2| (self.height(p + step) - self.height(p - step)) / (2.0 * reach);
        let slope = DVec2::new(across(DVec2::new(reach, 0.0)), across(DVec2::new(0.0, reach)));
        DVec3::new(-slope.x, -slope.y, 1.0).normalize()
    }
}

/// The table that the surface stands on, and the room behind it.
fn ground(eye: DVec3, towards: DVec3) -> Vec3 {
    let p = eye.truncate() - towards.truncate() * (eye.z / towards.z.min(-1e-9));
    let away = ((p - 1.0).length() / 5.0).min(1.0) as f32;
    hex(0xcf_ccc6).lerp(hex(0x8d_949c), away)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_relief_is_as_steep_at_every_zoom() {
        let surface = Surface::new().unwrap();
        for power in 0..=POWERS {
            let side = 10.0_f64.powi(-power);
            let mut square = 0.0;
            for k in 0..400 {
                let place = DVec2::new(f64::from(k % 20), f64::from(k / 20)) / 20.0 - 0.5;
                let normal = surface.normal(POINT + place * side, 0.002 * side);
                square += (normal.truncate() / normal.z).length_squared() / 400.0;
            }
            // Measured 1.70 to 2.05.
            assert!((1.5..2.3).contains(&square.sqrt()), "10^{power}: {square}");
        }
    }
}
