//! Glitter on a floor: round and elongated pixels, lights of some size, and a moving camera.

use asperity_render::image::{Image, tone::filmic};
use asperity_shading::material::GlintField;
use asperity_shading::{Beckmann, Footprint, PixelEllipse, half_vector};
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
