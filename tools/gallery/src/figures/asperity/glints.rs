//! Glitter on a floor: round and elongated pixels, lights of some size, a moving camera, and a sky.

use asperity_render::image::{Image, tone::filmic};
use asperity_shading::material::GlintField;
use asperity_shading::noise::{IntegerHash, Lattice};
use asperity_shading::{Beckmann, Footprint, Ndf, PixelEllipse, half_vector, reflect};
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn, Panel};
use asperity::failure::Result;
use asperity::quality::EXPOSURE;

const WIDTH: u32 = 384;
const HEIGHT: u32 = 256;
/// Pixels per radian.
const FOCAL: f32 = 320.0;
/// The step of the camera from one row of a strip to the next.
const STEP: f32 = 0.01;
/// Samples along each side of a pixel for the reference.
const SIDE: u8 = 4;

/// Where samples of an environment come from.
#[derive(Clone, Copy)]
enum Drawing {
    Smooth,
    Flakes,
    Ndf,
}

/// A sky that is brighter near the horizon, with a sun.
fn sky(w: Vec3) -> Vec3 {
    let sun = Vec3::new(0.0, 0.94, 0.34).normalize();
    let haze = (1.0 - w.z.clamp(0.0, 1.0)).powi(3);
    let blue = Vec3::new(0.05, 0.1, 0.25).lerp(Vec3::new(0.35, 0.3, 0.3), haze);
    blue + if w.dot(sun) > 0.995 { Vec3::new(24.0, 18.0, 12.0) } else { Vec3::ZERO }
}

/// The light of the sky in the flakes of a pixel: F = 0.8, without masking.
fn under_sky(field: &GlintField<Beckmann>, x: f32, y: f32, drawing: Drawing, count: u32) -> Vec3 {
    let (p, wo) = floor(x, y, 0.0);
    let [right, down] = [Vec2::X, Vec2::Y].map(|step| floor(x + step.x, y + step.y, 0.0).0 - p);
    let pixel = PixelEllipse::from_derivatives(right, down);
    // A grid of golden ratios, turned by pixel.
    let turn = IntegerHash.word([x as i32, y as i32], 1) as f32 / 4_294_967_296.0;
    let light = |k: u32| {
        let u = Vec2::new((k as f32 + turn) / count as f32, (k as f32 * 0.618_034 + 7.0 * turn).fract());
        let (m, weight) = match drawing {
            Drawing::Flakes => (field.sample(u, p, &pixel), 1.0),
            Drawing::Smooth => (field.ndf().sample(u), 1.0),
            Drawing::Ndf => {
                let m = field.ndf().sample(u);
                (m, field.density_over(m, 0.0, p, &pixel) / field.ndf().d(m))
            }
        };
        let wi = reflect(wo, m);
        // Masked at the horizon instead of by a masking function: at most twice the light.
        let shown = (wo.dot(m).max(0.0) / (wo.z * m.z)).min(2.0);
        if wi.z > 0.0 { 0.8 * weight * shown * sky(wi) } else { Vec3::ZERO }
    };
    let sum: Vec3 = (0..count).map(light).sum();
    (0.8 * sum / count as f32).map(filmic)
}

/// What a pixel averages.
#[derive(Clone, Copy)]
enum Seen {
    /// The flakes of a round pixel as wide as the long axis.
    Round,
    /// The flakes of the elongated pixel, under a light of this spread of half vectors.
    Elongated(f32),
    /// Points of the pixel.
    Samples,
}

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let field = GlintField::new(Beckmann::isotropic(0.3)?, 2e-3, 0.1, context.seed)?;
    let kinds = [
        ("round", "round pixels", Seen::Round),
        ("elongated", "elongated pixels", Seen::Elongated(0.0)),
        ("samples", "16 samples", Seen::Samples),
        ("lamp", "a light of 11°", Seen::Elongated(0.05)),
    ];
    let mut panels = Vec::new();
    for (stem, name, seen) in kinds {
        let image = Image::from_fn(WIDTH, HEIGHT, |x, y| shade(&field, x as f32, y as f32, 0.0, seen));
        let alt = format!("A floor of glitter to the horizon, {name}.");
        panels.push(Panel::new(stem, name, alt, image));
    }
    for (stem, name, seen) in kinds {
        let image = Image::from_fn(WIDTH, HEIGHT, |x, frame| {
            shade(&field, x as f32, 0.35 * HEIGHT as f32, STEP * frame as f32, seen)
        });
        let alt =
            format!("One row of pixels over time while the camera moves forward, {name}: glints are lines.");
        panels.push(Panel::new(format!("{stem}-motion"), format!("{name}, over time"), alt, image));
    }
    let skies = [
        ("sky-smooth", "a sky, no flakes", Drawing::Smooth, 512),
        ("sky-flakes", "a sky, 8 samples of the flakes", Drawing::Flakes, 8),
        ("sky-ndf", "a sky, 8 samples of the NDF", Drawing::Ndf, 8),
        ("sky-many", "a sky, 32 samples of the flakes", Drawing::Flakes, 32),
    ];
    for (stem, name, drawing, count) in skies {
        let image =
            Image::from_fn(WIDTH, HEIGHT, |x, y| under_sky(&field, x as f32, y as f32, drawing, count));
        let alt = format!("The floor of glitter under {name}.");
        panels.push(Panel::new(stem, name, alt, image));
    }
    Ok(Drawn::new(4, panels))
}

/// The point of the floor and the direction to the eye, for a camera that moved forward.
fn floor(x: f32, y: f32, moved: f32) -> (Vec3, Vec3) {
    let ray = Vec3::new((x - 0.5 * WIDTH as f32) / FOCAL, 1.0, -(y + 4.0) / FOCAL);
    let eye = Vec3::new(0.0, moved, 1.0);
    (eye + ray / -ray.z, -ray.normalize())
}

fn shade(field: &GlintField<Beckmann>, x: f32, y: f32, moved: f32, seen: Seen) -> Vec3 {
    let sun = Vec3::new(0.0, 0.94, 0.34).normalize();
    let of = |x: f32, y: f32, wide: f32| {
        let (p, wo) = floor(x, y, moved);
        let [right, down] = [Vec2::X, Vec2::Y].map(|step| floor(x + step.x, y + step.y, moved).0 - p);
        (p, half_vector(sun, wo), PixelEllipse::from_derivatives(wide * right, wide * down))
    };
    let density = match seen {
        Seen::Round => {
            let (p, h, pixel) = of(x, y, 1.0);
            field.density(h, p, Footprint::from_width(pixel.long().width()))
        }
        Seen::Elongated(spread) => {
            let (p, h, pixel) = of(x, y, 1.0);
            field.density_over(h, spread, p, &pixel)
        }
        Seen::Samples => {
            let places =
                (0..SIDE).flat_map(|i| (0..SIDE).map(move |k| Vec2::new(f32::from(i), f32::from(k))));
            let sample = |place: Vec2| {
                let offset = (place + 0.5) / f32::from(SIDE) - 0.5;
                let (p, h, pixel) = of(x + offset.x, y + offset.y, 1.0 / f32::from(SIDE));
                field.density_over(h, 0.0, p, &pixel)
            };
            places.map(sample).sum::<f32>() / f32::from(SIDE * SIDE)
        }
    };
    let color = 0.06 * density * Vec3::new(1.0, 0.85, 0.6) + Vec3::new(0.01, 0.012, 0.02);
    (EXPOSURE * color).map(filmic)
}
