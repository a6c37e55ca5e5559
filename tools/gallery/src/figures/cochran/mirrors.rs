//! Figure 6 of Cochran, Lewis and Hart: two fractal mirrors in a ruled room.

use asperity_fif::cochran_2000;
use asperity_render::materials::pattern::{grid, line};
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::{
    geometry::fractal::Fractal, geometry::ray::Ray, geometry::shape::Shape, image::tone::hex,
};
use asperity_shading::{Conductor, Fresnel, reflectance::Coat};
use glam::Vec3;

use crate::figure::{Context, Drawn};
use asperity::failure::Result;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    // Heights, which reach 4 and 1.02, are scaled so that reflections stay within the room. The
    // right mirror is flatter.
    let tent = [Vec3::new(-2.5, -2.5, 2.7), Vec3::new(1.0, 1.0, 0.5)];
    let low = [Vec3::new(-2.1, -2.1, 2.55), Vec3::new(1.0, 1.0, 0.2)];
    let alts = [
        "A tent-shaped mirror that reflects red and blue lines as frayed arcs",
        "A low mirror that scatters the red and blue lines into noise",
    ];
    let mirrors = [
        (["f-hat", "f\u{302} × f\u{302}", alts[0]], (cochran_2000::f()?, 0.3, 4, tent)),
        (["g-hat", "ĝ × ĝ", alts[1]], (cochran_2000::g()?, 0.1, 16, low)),
    ];
    let drawn = Drawn::pictures(2, mirrors, |(slope, rise, times, view)| {
        let scene = mirror(Fractal::square(slope, rise)?)?;
        context.look(&scene, context.sampling([18, 18], times), view, FIELD)
    })?;
    let samples = format!("{} and {}", 4 * context.samples_per_pixel, 16 * context.samples_per_pixel);
    Ok(drawn.fact("height scale", "0.3 and 0.1").fact("samples per pixel", samples).fact("metal", "silver"))
}

/// Field of view in radians.
const FIELD: f32 = 0.56;

/// Complex refractive indices at about 650, 550 and 450 nm, from Johnson and Christy 1972, "Optical
/// Constants of the Noble Metals".
fn silver() -> Result<[Conductor; 3]> {
    Ok([Conductor::new(0.159, 3.93)?, Conductor::new(0.145, 3.19)?, Conductor::new(0.135, 2.38)?])
}

/// A silver mirror in the ruled room.
fn mirror(surface: Fractal) -> Result<Scene<'static, 'static>> {
    // Reflectance at normal incidence, from which Schlick's approximation increases.
    let silver = Coat::conductor(silver()?.reflectance_rgb(1.0));
    let light = Light::Lamps { lamps: Vec::new(), room: &room };
    Ok(Scene::new(vec![Object::new(Shape::Fractal(surface), silver)], light, Backdrop::Light))
}

/// Opposite corners of the room.
const ROOM: [Vec3; 2] = [Vec3::new(-6.0, -6.0, 0.0), Vec3::new(8.0, 8.0, 9.0)];

/// Distance between the lines on the walls.
const SPACING: f32 = 2.0;

/// Light along a ray that starts inside the room: ruled walls and ceiling, a tiled floor.
fn room(ray: &Ray) -> Vec3 {
    let Ray { origin, direction, .. } = *ray;
    let far = Vec3::select(direction.cmpgt(Vec3::ZERO), ROOM[1], ROOM[0]);
    // A direction along a wall divides by zero of either sign: the wall is infinitely far ahead.
    let t = ((far - origin) / direction).abs();
    let p = origin + direction * t.min_element();
    let ruled = |u: f32, v: f32, paper: u32, light: f32| {
        let lines = |w: f32| line(w / SPACING + 0.5, 0.16, 0.01);
        hex(paper).lerp(hex(0x24_557f), lines(u)).lerp(hex(0xb4_512c), lines(v)) * light
    };
    let light = 0.5 + 0.5 * p.z / ROOM[1].z;
    if t.x <= t.y.min(t.z) {
        ruled(p.y, p.z, 0xe9_e4da, light)
    } else if t.y <= t.z {
        ruled(p.x, p.z, 0xe4_e2de, light)
    } else if direction.z > 0.0 {
        ruled(p.x, p.y, 0xf4_f0e8, 1.0)
    } else {
        let joint = grid(p.truncate(), 0.04, 0.01);
        let away = (p.truncate() - 1.0).length_squared();
        hex(0xd8_d2c6) * (0.8 * (1.0 - 0.22 * joint) / (1.0 + away / 40.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::{abs_diff_eq, assert_abs_diff_eq};

    fn ray(origin: Vec3, direction: Vec3) -> Ray {
        Ray { origin, direction, origin_by: [Vec3::ZERO; 2], direction_by: [Vec3::ZERO; 2] }
    }

    #[test]
    fn rays_along_walls_hit_the_wall_ahead() {
        let origin = Vec3::new(1.5, 1.6, 0.9);
        for zero in [0.0, -0.0] {
            for [x, y, z] in [[zero, -0.02, 1.0], [zero, zero, 1.0], [1.0, zero, 0.3]] {
                let direction = Vec3::new(x, y, z);
                let near = room(&ray(origin, direction + Vec3::splat(1e-9)));
                assert!(abs_diff_eq!(room(&ray(origin, direction)), near, epsilon = 1e-5), "{direction}");
            }
        }
    }

    #[test]
    fn flat_mirror_shows_the_mirrored_room() {
        let scene = mirror(Fractal::square(cochran_2000::f().unwrap(), 1e-9).unwrap()).unwrap();
        let (origin, direction) = (Vec3::new(0.2, 0.3, 1.0), Vec3::new(0.4, 0.5, -1.0));
        let mut sampler = asperity_render::sampling::sampler::Sampler::new(0, 0);
        let seen = scene.seen(&ray(origin, direction.normalize()), [0.5; 2], &mut sampler).radiance;
        let upwards = Vec3::new(direction.x, direction.y, -direction.z);
        let share = silver().unwrap().reflectance_rgb(1.0 / direction.length());
        assert_abs_diff_eq!(seen, share * room(&ray(origin + direction, upwards)), epsilon = 1e-3);
    }
}
