//! The marble vase and the steaming tea cup.

use asperity_shading::{
    Brdf, CookTorrance, EnergyPreservingOrenNayar, Gas, Ggx, Lambert, Marble, Schlick, Steam, SurfacePoint,
    march,
    noise::{Normalisation, Octaves, Perlin2002, Spectrum, Turbulence},
};
use glam::Vec3;

use super::panels::{half_page, raster};
use crate::{
    figure::{Context, Drawn, Failure, Figure},
    image::hex,
    scene::{
        camera::Camera,
        lights::studio,
        mesh::TracedMesh,
        render::{Sampling, jitter, render},
        revolution::{revolved, ring},
        still::{Still, Surface},
    },
};

pub(crate) const VASE: Figure = Figure {
    name: "cohen-marble-vase",
    title: "A vase of blue marble",
    source: "Cohen, Procedural Bump Mapping and Noise, listing blue_marble",
    caption: "The vase is turned from a block: its colour is that of the marble at every point in space, so that the veins run \
              through it and meet at the rim. A polished surface of Fresnel 0.04 and roughness 0.12 lies over it. As in the \
              lecture, with its colours made 2.6 times as bright.",
    draw: draw_vase,
};

pub(crate) const CUP: Figure = Figure {
    name: "cohen-tea-cup",
    title: "A steaming tea cup",
    source: "Cohen, Procedural Bump Mapping and Noise, Placing and Shaping Gas",
    caption: "Steam is turbulence raised to a power, in a column over the tea that thins out from its axis and with its height. \
              From left to right: the exponents 2, 4 and 8, with densities that give about as much steam. Light is \
              marched through it in steps that stay where they are, and the lamps shine into it unshadowed.",
    draw: draw_cup,
};

/// Points of the profile, radius and height.
const VASE_PROFILE: [[f32; 2]; 12] = [
    [0.0, 0.0],
    [0.44, 0.0],
    [0.50, 0.06],
    [0.62, 0.35],
    [0.86, 0.85],
    [0.84, 1.25],
    [0.58, 1.62],
    [0.38, 1.95],
    [0.40, 2.2],
    [0.52, 2.34],
    [0.48, 2.36],
    [0.34, 2.12],
];

const CUP_PROFILE: [[f32; 2]; 11] = [
    [0.0, 0.05],
    [0.42, 0.05],
    [0.44, 0.12],
    [0.66, 0.3],
    [0.84, 0.66],
    [0.92, 1.0],
    [0.895, 1.015],
    [0.87, 0.99],
    [0.80, 0.66],
    [0.60, 0.32],
    [0.0, 0.2],
];

const SAUCER_PROFILE: [[f32; 2]; 6] =
    [[0.0, 0.02], [0.7, 0.02], [1.2, 0.12], [1.36, 0.2], [1.34, 0.22], [0.6, 0.06]];

const TEA: f32 = 0.84;

/// A table that fades into the background.
fn table() -> TracedMesh {
    TracedMesh::new(revolved(&[[60.0, 0.0], [9.0, 0.0], [0.0, 0.0]]))
}

fn porcelain(normal: Vec3, colour: Vec3, gloss: f32) -> Surface {
    Surface { normal, brdf: Box::new(Glazed::new(colour, gloss)), albedo: colour }
}

/// A matte surface under a thin glaze.
struct Glazed {
    base: Lambert,
    glaze: CookTorrance<Ggx, Schlick>,
}

impl Glazed {
    fn new(colour: Vec3, roughness: f32) -> Self {
        let colour = colour.clamp(Vec3::ZERO, Vec3::ONE);
        let (base, glaze) = (Lambert::new(colour), Schlick::new(0.04));
        // In range: clamped above, and constant.
        Self {
            base: base.expect("a colour within [0, 1]"),
            glaze: CookTorrance::new(Ggx::clamped(roughness, roughness), glaze.expect("a share")),
        }
    }
}

impl Brdf for Glazed {
    fn value(&self, wi: Vec3, wo: Vec3) -> Vec3 {
        self.base.value(wi, wo) + self.glaze.value(wi, wo)
    }
}

fn cloth(normal: Vec3) -> Surface {
    let colour = hex(0x8d_8377);
    let brdf = EnergyPreservingOrenNayar::new(colour, 0.8).expect("parameters within [0, 1]");
    Surface { normal, brdf: Box::new(brdf), albedo: colour }
}

fn draw_vase(context: &Context<'_>) -> Result<Drawn, Failure> {
    let sampling = half_page(context);
    let sampling = Sampling { samples_per_pixel: sampling.samples_per_pixel * 2, ..sampling };
    let marble = Marble::default();
    let still = Still {
        objects: vec![
            (
                TracedMesh::new(revolved(&VASE_PROFILE)),
                Box::new(move |point| {
                    porcelain(point.normal, 2.6 * marble.colour(point.position, point.footprint), 0.12)
                }),
            ),
            (table(), Box::new(|point| cloth(point.normal))),
        ],
        lights: studio(Vec3::splat(0.9)),
    };
    let mut panels = Vec::new();
    for (stem, label, eye, target) in [
        ("vase", "The vase", Vec3::new(0.0, -7.2, 2.6), Vec3::new(0.0, 0.0, 1.12)),
        ("neck", "Its neck, from nearby", Vec3::new(0.7, -2.6, 3.1), Vec3::new(0.0, 0.0, 1.95)),
    ] {
        let camera = Camera::new(eye, target, 0.44, sampling.width, sampling.height);
        let image = render(sampling, context.progress, context.interrupted, |x, y| {
            let seen = still.radiance(&camera, camera.direction(x, y));
            seen.map_or(hex(0x2a_2d33), |(colour, t)| far(colour, t))
        })?;
        panels.push(raster(stem, label, "A tall vase with blue veins on a table", image.exposed(1.0)));
    }
    Ok(Drawn {
        panels,
        columns: 2,
        parameters: vec![("cells of the first octave per unit".to_owned(), "2.5".to_owned())],
        table: None,
    })
}

fn draw_cup(context: &Context<'_>) -> Result<Drawn, Failure> {
    let sampling = Sampling {
        width: context.size,
        height: context.size * 4 / 3,
        samples_per_pixel: context.samples_per_pixel * 2,
        seed: context.seed,
    };
    let camera = Camera::new(
        Vec3::new(1.2, -6.6, 3.0),
        Vec3::new(0.1, 0.0, 1.15),
        0.56,
        sampling.width,
        sampling.height,
    );
    let white = |point: &SurfacePoint| porcelain(point.normal, hex(0xf0_ede6), 0.1);
    let still = Still {
        objects: vec![
            (TracedMesh::new(revolved(&CUP_PROFILE)), Box::new(white)),
            (TracedMesh::new(ring(Vec3::new(1.0, 0.0, 0.58), 0.26, 0.065)), Box::new(white)),
            (TracedMesh::new(revolved(&SAUCER_PROFILE)), Box::new(white)),
            (
                TracedMesh::new(revolved(&[[0.85, TEA], [0.4, TEA], [0.0, TEA]])),
                Box::new(|point| porcelain(point.normal, hex(0x7a_2f10), 0.05)),
            ),
            (table(), Box::new(|point| cloth(point.normal))),
        ],
        lights: studio(Vec3::splat(0.9)),
    };
    let steam = Steam::new(Vec3::new(0.0, 0.0, TEA), 0.8, 1.9)?;
    let mut panels = Vec::new();
    for (exponent, densest) in [(2.0, 5.2), (4.0, 4.2), (8.0, 3.7)] {
        let octaves = Octaves::new(Perlin2002::default(), Spectrum::default(), Normalisation::Range, 3);
        let gas = Gas::new(octaves.with_shape(Turbulence), 5.0, densest, exponent)?;
        let extinction = |p: Vec3| {
            let share = steam.share(p);
            // Steam rises in streaks: its noise is drawn out upwards.
            if share > 0.0 {
                3.2 * share * share * gas.density(p * Vec3::new(1.5, 1.5, 0.8)).min(3.0)
            } else {
                0.0
            }
        };
        let image = render(sampling, context.progress, context.interrupted, |x, y| {
            let direction = camera.direction(x, y);
            let (behind, t) = still
                .radiance(&camera, direction)
                .map_or((hex(0x2a_2d33), 50.0), |(colour, t)| (far(colour, t), t));
            let offset = jitter((x * 97.0) as u32, (y * 97.0) as u32, context.seed).x;
            let seen = march(camera.eye(), direction, [3.0, t.min(10.0)], 0.06, offset, extinction, |_| {
                Vec3::new(0.78, 0.8, 0.82)
            });
            seen.light + seen.transmittance * behind
        })?;
        panels.push(raster(
            &format!("exponent-{exponent}"),
            &format!("Exponent {exponent}"),
            "A white tea cup on its saucer, with steam over it",
            image.exposed(1.0),
        ));
    }
    Ok(Drawn {
        panels,
        columns: 3,
        parameters: vec![
            ("steps".to_owned(), "0.06".to_owned()),
            ("height of the steam".to_owned(), "1.9".to_owned()),
        ],
        table: None,
    })
}

/// The table's far end in the dark of the room.
fn far(colour: Vec3, t: f32) -> Vec3 {
    hex(0x2a_2d33) + (colour - hex(0x2a_2d33)) * (-((t - 6.0).max(0.0) / 7.0).powi(2)).exp()
}
