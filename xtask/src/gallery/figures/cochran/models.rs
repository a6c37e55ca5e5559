//! Fractal objects under the illumination models of Cochran, Lewis and Hart: matte, Phong, Torrance–Sparrow, transparent.

use std::f32::consts::{PI, TAU};

use asperity_fif::{FixedFif, SystemError, glam::DVec3};
use asperity_ndf_sampling::{Microfacet, Ndf};
use asperity_render::{
    geometry::{
        camera::Camera,
        fractal::{Fractal, Meeting},
    },
    image::tone::hex,
    light::lamps::{Light, direction, studio},
    materials::pattern::{checker, line, mix},
};
use asperity_shading::{Beckmann, Conductor, Dielectric, Frame, half_vector, reflect};
use glam::Vec3;

use crate::{
    failure::Failure,
    gallery::figure::{Context, Drawn, Panel},
};

/// Vertical factors of the slopes.
const FACTORS: [f64; 2] = [0.25, 0.5];

/// Heights are multiplied by this; they reach 1/4.
const RISE: f64 = 3.4;

const EYE: Vec3 = Vec3::new(3.6, -3.0, 3.3);
const TARGET: Vec3 = Vec3::new(1.0, 1.0, 0.2);
const FIELD: f32 = 0.46;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let models = [
        ("matte", Model::Matte(hex(0xe6_dac6))),
        ("phong", Model::Phong { diffuse: hex(0x9c_2b22), gloss: 0.16, exponent: PHONG }),
        (
            "torrance-sparrow",
            Model::TorranceSparrow { facets: Beckmann::new(ROUGHNESS, ROUGHNESS)?, metal: copper()? },
        ),
        ("glass", Model::Glass(Dielectric::new(GLASS)?)),
    ];
    let labels = ["Matte", "Phong", "Torrance\u{2013}Sparrow, copper", "Glass"];
    let sampling = context.square();
    let camera = Camera::new(EYE, TARGET, FIELD, sampling.width, sampling.height);
    let mut panels = Vec::new();
    for factor in FACTORS {
        let mut scene = Scene {
            object: Fractal::new(slope(factor)?, RISE)?,
            model: Model::Matte(Vec3::ONE),
            lamps: studio(Vec3::ONE),
        };
        for ((stem, model), label) in models.iter().zip(labels) {
            scene.model = *model;
            let image = context.render(sampling, |x, y| {
                scene.radiance(camera.eye().as_dvec3(), camera.direction(x, y).as_dvec3(), 0)
            })?;
            let alt =
                format!("A square cushion with a fractal surface on a tiled floor: {}", label.to_lowercase());
            let label = format!("{label}; factors {factor}");
            panels.push(Panel::raster(
                &format!("{stem}-{}", (100.0 * factor).round()),
                &label,
                &alt,
                image.exposed(1.0),
            ));
        }
    }
    Ok(Drawn::new(4, panels)
        .fact("slope through", "(0, 0), (1/2, 1), (1, 0), (3/2, \u{2212}1), (2, 0)")
        .fact("heights times", RISE.to_string())
        .fact("Phong exponent", PHONG.to_string())
        .fact("roughness of the copper", format!("{ROUGHNESS}, Beckmann"))
        .fact("index of the glass", GLASS.to_string())
        .fact("samples per pixel", sampling.samples_per_pixel.to_string()))
}

const PHONG: f32 = 60.0;
const ROUGHNESS: f32 = 0.42;
const GLASS: f32 = 1.5;

/// A slope that rises and falls and integrates to zero: its integral is a hump that touches the ground without an edge.
fn slope(factor: f64) -> Result<FixedFif<4, 2>, SystemError> {
    FixedFif::affine(&[0.0, 0.5, 1.0, 1.5, 2.0], &[0.0, 1.0, 0.0, -1.0, 0.0], &[factor; 4])
}

/// Complex refractive indices at about 650, 550 and 450 nm, from Johnson and Christy 1972, "Optical Constants of the
/// Noble Metals".
fn copper() -> Result<[Conductor; 3], Failure> {
    Ok([Conductor::new(0.21, 3.67)?, Conductor::new(1.02, 2.59)?, Conductor::new(1.17, 2.36)?])
}

/// How the object answers to light.
#[derive(Clone, Copy)]
enum Model {
    Matte(Vec3),
    Phong { diffuse: Vec3, gloss: f32, exponent: f32 },
    TorranceSparrow { facets: Beckmann, metal: [Conductor; 3] },
    Glass(Dielectric),
}

struct Scene {
    object: Fractal<4>,
    model: Model,
    /// The key light first, in several directions, then those that cast no shadow.
    lamps: Vec<Light>,
}

/// Lights of the key, whose middle casts the shadow.
const KEY: usize = 16;

/// Meetings along one path.
const BOUNCES: u32 = 6;

impl Scene {
    fn radiance(&self, origin: DVec3, direction: DVec3, depth: u32) -> Vec3 {
        let floor = (direction.z < 0.0).then(|| -origin.z / direction.z).filter(|t| *t > 1e-9);
        let meeting = self.object.first_meeting(origin, direction);
        match (meeting, floor) {
            (Some(meeting), floor) if floor.is_none_or(|t| meeting.t < t) => {
                self.surface(&meeting, direction, depth)
            }
            (_, Some(t)) => self.floor(origin + direction * t),
            (_, None) => sky(direction.as_vec3()),
        }
    }

    fn surface(&self, meeting: &Meeting, towards: DVec3, depth: u32) -> Vec3 {
        let (wi, normal) = (-towards.as_vec3(), meeting.normal.as_vec3());
        match self.model {
            Model::Glass(glass) => self.through(meeting, glass, towards, depth),
            Model::Matte(colour) => {
                self.gather(meeting, |light| colour * lambert(light, normal), colour * ambient(normal))
            }
            Model::Phong { diffuse, gloss, exponent } => {
                let mirror = reflect(wi, normal);
                // Normalised like a lobe of the cosine's power about the mirrored direction.
                let scale = gloss * (exponent + 2.0) / TAU;
                let lobe = |light: Vec3| {
                    let shine =
                        scale * light.dot(mirror).max(0.0).powf(exponent) * light.dot(normal).max(0.0);
                    diffuse * lambert(light, normal) + Vec3::splat(shine)
                };
                self.gather(meeting, lobe, diffuse * ambient(normal) + 0.08 * sky(mirror))
            }
            Model::TorranceSparrow { facets, metal } => {
                let frame = Frame::from_normal(normal);
                let fresnel =
                    |cos_theta: f32| Vec3::from_array(metal.map(|channel| channel.reflectance(cos_theta)));
                let eye = frame.to_local(wi);
                // D G F / (4 cos θ_l cos θ_e), times cos θ_l.
                let lobe = |light: Vec3| {
                    let (towards, h) = (frame.to_local(light), frame.to_local(half_vector(light, wi)));
                    if towards.z <= 0.0 || eye.z <= 0.0 {
                        return Vec3::ZERO;
                    }
                    fresnel(h.dot(eye)) * (facets.density(h) * facets.g2(towards, eye) / (4.0 * eye.z))
                };
                let room = fresnel(wi.dot(normal)) * 0.3 * sky(reflect(wi, normal));
                self.gather(meeting, lobe, room)
            }
        }
    }

    /// Light of all lamps times `response`, the key's in the shadow of the object left out, and the rest.
    fn gather(&self, meeting: &Meeting, response: impl Fn(Vec3) -> Vec3, ambient: Vec3) -> Vec3 {
        let start = meeting.position + meeting.normal * 1e-5;
        let shadowed = self.object.hides(start, key() * 10.0);
        let first = if shadowed { KEY } else { 0 };
        self.lamps
            .iter()
            .skip(first)
            .fold(ambient, |sum, light| sum + light.colour * POWER * response(light.direction))
    }

    /// Reflected and refracted light of a smooth dielectric that stands on the floor without a gap.
    fn through(&self, meeting: &Meeting, glass: Dielectric, towards: DVec3, depth: u32) -> Vec3 {
        if depth == BOUNCES {
            return sky(towards.as_vec3());
        }
        let (wi, normal) = (-towards.as_vec3(), meeting.normal.as_vec3());
        // The normal looks back along the ray: from below the ray is inside.
        let inside = meeting.normal.z < 0.0;
        let glass = if inside { glass.reversed() } else { glass };
        let share = glass.reflectance(wi.dot(normal));
        let mirrored = self.radiance(meeting.position, reflect(wi, normal).as_dvec3(), depth + 1);
        let highlight = if inside { Vec3::ZERO } else { self.glint(reflect(wi, normal)) * share };
        let bent = refract(towards, meeting.normal, f64::from(glass.relative_index()));
        let passed = bent.map_or(Vec3::ZERO, |direction| {
            let tint = if inside { Vec3::ONE } else { Vec3::new(0.9, 0.97, 0.95) };
            tint * self.radiance(meeting.position, direction, depth + 1)
        });
        mix(passed, mirrored, share) + highlight
    }

    /// The key light as a mirror shows it.
    fn glint(&self, mirror: Vec3) -> Vec3 {
        let near = ((mirror.dot(key().as_vec3()) - 0.98) / 0.012).clamp(0.0, 1.0);
        Vec3::splat(6.0 * near)
    }

    /// Tiles, in the shadow of the object or under it.
    fn floor(&self, p: DVec3) -> Vec3 {
        let tile = mix(hex(0xe6_e1d6), hex(0x76_8592), checker((p / TILE).truncate()));
        let joint = line(p.x / TILE, 0.05, 0.01).max(line(p.y / TILE, 0.05, 0.01));
        let tile = mix(tile, hex(0xa9_a49a), joint);
        let start = DVec3::new(p.x, p.y, 1e-5);
        let dark = self.object.hides(start, key() * 10.0);
        let glass = matches!(self.model, Model::Glass(_));
        let light = match (dark, glass) {
            (false, _) => 1.0,
            (true, true) => 0.78,
            (true, false) => 0.36,
        };
        let away = (p.truncate() - TARGET.as_dvec3().truncate()).length() as f32;
        tile * (0.92 * light / (1.0 + away * away / 30.0))
    }
}

/// Side of a tile.
const TILE: f64 = 0.4;

/// Of all lamps together.
const POWER: f32 = 2.2;

/// The middle of the key light.
fn key() -> DVec3 {
    direction(-132.0, 46.0).as_dvec3()
}

/// A matte white surface, times the cosine.
fn lambert(light: Vec3, normal: Vec3) -> Vec3 {
    Vec3::splat(light.dot(normal).max(0.0) / PI)
}

/// Light from all around that a matte surface sends back.
fn ambient(normal: Vec3) -> Vec3 {
    Vec3::new(0.11, 0.12, 0.14) * (0.6 + 0.4 * normal.z)
}

/// A pale room with a bright ceiling.
fn sky(direction: Vec3) -> Vec3 {
    let t = direction.z.clamp(0.0, 1.0);
    hex(0x8e_949c).lerp(hex(0xee_f1f4), t * (2.0 - t))
}

/// The direction behind an interface of relative index `eta`, by Snell's law; `normal` looks back along the ray.
///
/// `None` beyond the critical angle.
fn refract(direction: DVec3, normal: DVec3, eta: f64) -> Option<DVec3> {
    let cos_i = -direction.dot(normal);
    let along = direction + normal * cos_i;
    let sin2_t = along.length_squared() / (eta * eta);
    (sin2_t < 1.0).then(|| along / eta - normal * (1.0 - sin2_t).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refraction_keeps_snell_s_law_and_reverses() {
        let normal = DVec3::new(0.1, -0.2, 0.9).normalize();
        for x in [-0.9, -0.3, 0.0, 0.5] {
            let direction = DVec3::new(x, 0.2, -0.7).normalize();
            let bent = refract(direction, normal, 1.5).unwrap();
            assert!((bent.length() - 1.0).abs() < 1e-12);
            let sines = [direction, bent].map(|d| d.cross(normal).length());
            assert!((sines[0] - 1.5 * sines[1]).abs() < 1e-12);
            let back = refract(-bent, -normal, 1.0 / 1.5).unwrap();
            assert!(back.distance(-direction) < 1e-12);
        }
        assert!(refract(DVec3::new(0.9, 0.0, -0.435).normalize(), DVec3::Z, 1.0 / 1.5).is_none());
    }

    #[test]
    fn the_object_touches_the_floor_without_an_edge() {
        for factor in FACTORS {
            let slope = slope(factor).unwrap();
            let hump: FixedFif<4, 3> = slope.integral(0.0).unwrap();
            assert!(hump.end_values()[1].abs() < 1e-15 && slope.end_values() == [0.0, 0.0]);
            assert!(hump.range().lo > -0.02, "{:?}", hump.range());
        }
    }
}
