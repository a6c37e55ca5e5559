//! The materials on things: a car, a room, walls, and the teapot in each of them.

use std::sync::Arc;

use asperity_render::{
    image::tone::hex,
    integrator::{
        path_tracer::{Finish, Shadow, Stage},
        pixels::Sampling,
        request::Bumps,
    },
    light::environments::Studio,
    materials::{self, field::NoiseKind},
    scenes::{Set, View, backdrop},
};
use asperity_shading::{
    Brick, CarpetParameters, Ggx, LevelOfDetail, Marble, MetallicPaintParameters, ScratchesParameters,
    SeamPattern, StarWallpaper, TemperedGlassParameters, VariationsParameters,
};
use glam::Vec3;

use crate::{
    failure::Failure,
    gallery::figure::{Context, Drawn, Panel},
};

/// The blue under the flakes.
const PIGMENT: Vec3 = Vec3::new(0.02, 0.05, 0.14);

/// A picture of a set whose subject is of this material.
fn picture(
    context: &Context<'_>,
    set: Set,
    view: View,
    sampling: Sampling,
    subject: Box<Finish<'static>>,
    shadow: Shadow,
) -> Result<asperity_render::image::Image, Failure> {
    let studio = Studio::new(1.0);
    let mut objects = set.objects(subject)?;
    objects[0].shadow = shadow;
    let stage = Stage { objects, surroundings: &studio, backdrop: Some(backdrop()), splits: 1 };
    let image = stage.draw(sampling, &view.camera(1.0, sampling), context.progress, context.interrupted)?;
    Ok(image.filmic(1.45))
}

pub(crate) fn draw_car(context: &Context<'_>) -> Result<Drawn, Failure> {
    let paint = MetallicPaintParameters::default();
    let door =
        View { eye: Vec3::new(-0.21, -0.93, 0.66), target: Vec3::new(-0.25, -0.82, 0.63), field: 34.0 };
    let mut panels = Vec::new();
    let whole = Box::new(materials::paint(paint, 1.0, PIGMENT)?);
    let sampling = context.sampling([24, 11], 5);
    let view = View { field: 21.0, ..Set::Car.view() };
    let image = picture(context, Set::Car, view, sampling, whole, Shadow::Cast)?;
    let alt = "A blue car from the front and the side";
    panels.push(Panel::raster("whole", "The car", alt, image).spanning(2));
    let sampling = context.sampling([12, 8], 5);
    for (stem, label, subject) in [
        (
            "sparkles",
            "Its door: sparkles of two pixels",
            Box::new(materials::paint(paint, 1.0, PIGMENT)?) as Box<Finish<'static>>,
        ),
        (
            "flakes",
            "The same with counted flakes, 0.3 mm apart",
            Box::new(materials::glinting(paint, 1.0, PIGMENT, 3e-4)?),
        ),
    ] {
        let image = picture(context, Set::Car, door, sampling, subject, Shadow::Cast)?;
        panels.push(Panel::raster(stem, label, "Blue paint from nearby with points of light", image));
    }
    Ok(Drawn::new(2, panels)
        .fact(
            "orange_peel",
            format!("size {}, strength {}", paint.orange_peel_size, paint.orange_peel_strength),
        )
        .fact(
            "flake_sparkle",
            format!(
                "pixel size {}, physical size {}, variation {}, boost {}, elimination {}",
                paint.flake_sparkle_pixel_size,
                paint.flake_sparkle_physical_size,
                paint.flake_sparkle_variation,
                paint.flake_sparkle_boost,
                paint.flake_sparkle_elimination
            ),
        )
        .fact(
            "passive_flake",
            format!("size {}, strength {}", paint.passive_flake_size, paint.passive_flake_strength),
        ))
}

pub(crate) fn draw_room(context: &Context<'_>) -> Result<Drawn, Failure> {
    let lines = CarpetParameters { diffuse: Vec3::new(0.24, 0.21, 0.19), ..Default::default() };
    let grid = CarpetParameters { seams_pattern: SeamPattern::Grid, ..lines };
    let rim = CarpetParameters { fake_rim_light: 0.6, fake_rim_light_width: 0.5, ..lines };
    let near = View { eye: Vec3::new(0.30, -0.62, 0.16), target: Vec3::new(0.2, -0.46, 0.0), field: 36.0 };
    let sampling = context.sampling([12, 12], 6);
    let mut panels = Vec::new();
    for (stem, label, alt, set, view, carpet) in [
        (
            "corner",
            "A floor of carpet",
            "The corner of a room with a red ball",
            Set::Room,
            Set::Room.view(),
            lines,
        ),
        ("grid", "Seams in a grid, from 20 cm", "Threads and crossing seams", Set::Room, near, grid),
        (
            "rim",
            "Rim light on a ball",
            "A ball of carpet, lighter along its rim",
            Set::Sphere,
            Set::Sphere.view(),
            rim,
        ),
    ] {
        let subject = Box::new(materials::carpet(carpet, set.metres(), Vec3::splat(0.5))?);
        let image = picture(context, set, view, sampling, subject, Shadow::Cast)?;
        panels.push(Panel::raster(stem, label, alt, image));
    }
    Ok(Drawn::new(3, panels)
        .fact("seam_distance", lines.seam_distance.to_string())
        .fact("dark_area_size", lines.dark_area_size.to_string())
        .fact(
            "fake_rim_light on the ball",
            format!("{}, width {}", rim.fake_rim_light, rim.fake_rim_light_width),
        ))
}

pub(crate) fn draw_walls(context: &Context<'_>) -> Result<Drawn, Failure> {
    let sampling = context.sampling([16, 12], 4);
    let stars = StarWallpaper::new(5, [0.1, 0.3], 1.0, 0.55, context.seed)?;
    let mut panels: Vec<Panel> = Vec::new();
    for (stem, label, alt, subject) in [
        (
            "bricks",
            "Bricks of 25 by 8 cm",
            "A brick wall that runs away to the right",
            Box::new(materials::bricks(Brick::default(), 1.0)) as Box<Finish<'static>>,
        ),
        (
            "stars",
            "Stars in cells of 10 cm",
            "Dark blue wallpaper with pale stars",
            Box::new(materials::wallpaper(stars, 10.0, [hex(0x2c_3a5e), hex(0xe8_d9a8)])),
        ),
    ] {
        let image = picture(context, Set::Wall, Set::Wall.view(), sampling, subject, Shadow::Cast)?;
        panels.push(Panel::raster(stem, label, alt, image));
    }
    Ok(Drawn::new(2, panels))
}

pub(crate) fn draw_teapots(context: &Context<'_>) -> Result<Drawn, Failure> {
    let metres = Set::Teapot.metres();
    let bumps = Bumps { kind: NoiseKind::Gaussian, frequency: 16.0, octaves: 16, gain: 0.8 };
    let paint = MetallicPaintParameters { specular: Vec3::new(0.6, 0.2, 0.12), ..Default::default() };
    let plastic = VariationsParameters {
        diffuse: Vec3::new(0.10, 0.22, 0.12),
        dent_size: 0.03,
        dent_strength: 0.08,
        ..Default::default()
    };
    let scratches = ScratchesParameters {
        scratch_size: 0.25,
        scratch_width: 0.012,
        scratch_cover: 3.0,
        ..Default::default()
    };
    let ndf = Arc::new(Ggx::new(0.15, 0.35)?);
    let subjects: [(&str, &str, Box<Finish<'static>>); 6] = [
        (
            "bumps",
            "Bumps of a density",
            Box::new(materials::bumped(
                ndf,
                LevelOfDetail::Exact,
                bumps.field(context.seed)?,
                hex(0xf2_b184),
            )),
        ),
        ("paint", "Metallic paint", Box::new(materials::paint(paint, metres, Vec3::new(0.10, 0.01, 0.008))?)),
        ("plastic", "Plastic with dents", Box::new(materials::panel(plastic, metres, 0.15)?)),
        (
            "scratched",
            "Scratched metal",
            Box::new(materials::scratched(scratches, 1.0, hex(0xc8_ccd2), 0.2)?),
        ),
        ("marble", "Blue marble", Box::new(materials::marble(Marble::default(), 0.8, 2.6)?)),
        (
            "glass",
            "Glass",
            Box::new(materials::glass(
                TemperedGlassParameters::default(),
                metres,
                Vec3::new(0.80, 0.93, 0.89),
            )?),
        ),
    ];
    let view = View { field: 21.5, ..Set::Teapot.view() };
    let sampling = context.sampling([11, 9], 5);
    let mut panels = Vec::new();
    for (stem, label, subject) in subjects {
        let shadow = if stem == "glass" { Shadow::None } else { Shadow::Cast };
        let image = picture(context, Set::Teapot, view, sampling, subject, shadow)?;
        panels.push(Panel::raster(stem, label, &format!("The Utah teapot: {}", label.to_lowercase()), image));
    }
    Ok(Drawn::new(3, panels).fact("a unit of the teapot", format!("{metres} m")))
}
