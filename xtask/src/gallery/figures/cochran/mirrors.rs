//! Figure 6 of Cochran, Lewis and Hart: two fractal mirrors in a ruled room.

use asperity_fif::{glam::DVec3, paper};
use asperity_render::{
    geometry::{camera::Camera, fractal::Fractal},
    image::tone::hex,
    integrator::pixels::Sampling,
    materials::pattern::{line, mix},
};
use asperity_shading::{Conductor, reflect};
use glam::Vec3;

use crate::{
    failure::Failure,
    gallery::figure::{Context, Drawn, Panel},
};

/// Heights are multiplied by these, so that the reflections stay within the room; they reach 4 and 1.02.
const RISE: [f64; 2] = [0.3, 0.1];

/// Samples per pixel, as multiples of the figure's.
const OVERSAMPLING: [u32; 2] = [4, 16];

/// Reflections of reflections beyond this many are taken from the room.
const BOUNCES: u32 = 6;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let silver = silver()?;
    let mut panels = Vec::new();
    let words = [
        [
            "f-hat",
            "f\u{302} \u{d7} f\u{302}",
            "A tent-shaped mirror; red and blue lines run over it in frayed arcs",
        ],
        ["g-hat", "\u{11d} \u{d7} \u{11d}", "A low mirror that scatters the red and blue lines into grain"],
    ];
    for ((((slope, rise), factor), [stem, label, alt]), [eye, target]) in
        [paper::f()?, paper::g()?].into_iter().zip(RISE).zip(OVERSAMPLING).zip(words).zip(VIEWS)
    {
        let mirror = Fractal::new(slope, rise)?;
        let sampling = context.sampling([18, 18], 1);
        let sampling = Sampling { samples_per_pixel: sampling.samples_per_pixel * factor, ..sampling };
        let camera = Camera::new(eye, target, FIELD, sampling.width, sampling.height);
        let image = context.render(sampling, |x, y| {
            radiance(&mirror, &silver, camera.eye().as_dvec3(), camera.direction(x, y).as_dvec3())
        })?;
        panels.push(Panel::raster(stem, label, alt, image));
    }
    let samples = OVERSAMPLING.map(|factor| (factor * context.samples_per_pixel).to_string()).join(" and ");
    Ok(Drawn::new(2, panels)
        .fact("heights times", RISE.map(|r| r.to_string()).join(" and "))
        .fact("samples per pixel", samples)
        .fact("metal", "silver"))
}

/// Eye and target of each picture: the right mirror is flatter.
const VIEWS: [[Vec3; 2]; 2] = [
    [Vec3::new(-2.5, -2.5, 2.7), Vec3::new(1.0, 1.0, 0.5)],
    [Vec3::new(-2.1, -2.1, 2.55), Vec3::new(1.0, 1.0, 0.2)],
];

/// Angle of view in radians.
const FIELD: f32 = 0.56;

/// Complex refractive indices at about 650, 550 and 450 nm, from Johnson and Christy 1972, "Optical Constants of the
/// Noble Metals".
fn silver() -> Result<[Conductor; 3], Failure> {
    Ok([Conductor::new(0.159, 3.93)?, Conductor::new(0.145, 3.19)?, Conductor::new(0.135, 2.38)?])
}

fn radiance(mirror: &Fractal, metal: &[Conductor; 3], origin: DVec3, direction: DVec3) -> Vec3 {
    let (mut origin, mut direction) = (origin, direction);
    let mut weight = Vec3::ONE;
    for _ in 0..BOUNCES {
        let Some(meeting) = mirror.first_meeting(origin, direction) else { break };
        let (wi, normal) = (-direction.as_vec3(), meeting.normal.as_vec3());
        weight *= Vec3::from_array(metal.map(|channel| channel.reflectance(wi.dot(normal))));
        direction = reflect(wi, normal).as_dvec3();
        origin = meeting.position;
    }
    weight * room(origin, direction)
}

/// Opposite corners of the room.
const ROOM: [DVec3; 2] = [DVec3::new(-6.0, -6.0, 0.0), DVec3::new(8.0, 8.0, 9.0)];

/// Distance between the lines on the walls.
const SPACING: f64 = 2.0;

/// What a ray sees that starts within the room: ruled walls and ceiling, a tiled floor.
fn room(origin: DVec3, direction: DVec3) -> Vec3 {
    let far = DVec3::select(direction.cmpgt(DVec3::ZERO), ROOM[1], ROOM[0]);
    // A direction along a wall divides by zero, of either sign: that wall is infinitely far ahead.
    let t = ((far - origin) / direction).abs();
    let p = origin + direction * t.min_element();
    let ruled = |u: f64, v: f64, paper: u32, light: f32| {
        let lines = |w: f64| line(w / SPACING + 0.5, 0.16, 0.01);
        mix(mix(hex(paper), hex(0x24_557f), lines(u)), hex(0xb4_512c), lines(v)) * light
    };
    let height = (p.z / ROOM[1].z) as f32;
    if t.x <= t.y.min(t.z) {
        ruled(p.y, p.z, 0xe9_e4da, 0.5 + 0.5 * height)
    } else if t.y <= t.z {
        ruled(p.x, p.z, 0xe4_e2de, 0.5 + 0.5 * height)
    } else if direction.z > 0.0 {
        ruled(p.x, p.y, 0xf4_f0e8, 1.0)
    } else {
        let joint = line(p.x, 0.04, 0.01).max(line(p.y, 0.04, 0.01));
        let away = ((p.x - 1.0) * (p.x - 1.0) + (p.y - 1.0) * (p.y - 1.0)) as f32;
        hex(0xd8_d2c6) * (0.8 * (1.0 - 0.22 * joint) / (1.0 + away / 40.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_along_the_walls_see_the_wall_ahead() {
        let origin = DVec3::new(1.5, 1.6, 0.9);
        for zero in [0.0, -0.0] {
            for direction in
                [DVec3::new(zero, -0.02, 1.0), DVec3::new(zero, zero, 1.0), DVec3::new(1.0, zero, 0.3)]
            {
                let near = room(origin, direction + DVec3::splat(1e-9));
                assert!(room(origin, direction).abs_diff_eq(near, 1e-5), "{direction}");
            }
        }
    }

    #[test]
    fn a_mirror_of_no_height_shows_the_mirrored_room() {
        let mirror = Fractal::new(paper::f().unwrap(), 1e-9).unwrap();
        let (origin, direction) = (DVec3::new(0.2, 0.3, 1.0), DVec3::new(0.4, 0.5, -1.0));
        let metal = silver().unwrap();
        let seen = radiance(&mirror, &metal, origin, direction.normalize());
        let upwards = DVec3::new(direction.x, direction.y, -direction.z);
        let cos_theta = (1.0 / direction.length()) as f32;
        let share = Vec3::from_array(metal.map(|channel| channel.reflectance(cos_theta)));
        assert!(seen.abs_diff_eq(share * room(origin + direction, upwards), 1e-4), "{seen}");
    }
}
