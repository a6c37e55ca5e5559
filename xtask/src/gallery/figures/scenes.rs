//! The materials on things: a car, a room, walls, and the teapot in each of them.

use std::sync::Arc;

use asperity_render::{
    image::tone::hex,
    integrator::pixels::Sampling,
    light::environments::Studio,
    materials::{
        Bumped,
        field::{Bumps, NoiseKind},
        in_metres,
    },
    scene::{Backdrop, Light, Scene, Surface},
    scenes::{Set, View, backdrop},
};
use asperity_shading::material::SeamPattern;
use asperity_shading::texture::StarWallpaper;
use asperity_shading::{
    Carpet, CarpetParameters, Ggx, LevelOfDetail, Marble, MetallicPaint, MetallicPaintParameters, Scratches,
    ScratchesParameters, TemperedGlass, TemperedGlassParameters, Variations, VariationsParameters,
    material::{BrickWall, GlassBody, PaintFlakes, PolishedMarble, Wallpaper},
};
use glam::Vec3;

use crate::{
    failure::Failure,
    gallery::figure::{Context, Drawn, Panel},
};

/// A picture of a set whose subject is of this material.
fn picture(
    context: &Context<'_>,
    set: Set,
    view: View,
    sampling: Sampling,
    subject: Box<Surface<'static>>,
    body: Option<Vec3>,
) -> Result<asperity_render::image::Image, Failure> {
    let studio = Studio::new(1.0);
    let mut objects = set.objects(subject)?;
    if let (Some(tint), Some(object)) = (body, objects.first_mut()) {
        (object.body, object.passes) = (Some(tint), 1.0);
    }
    let scene = Scene::new(objects, Light::Around(&studio), Backdrop::Colour(backdrop()));
    Ok(context.draw(&scene, sampling, &view.camera(1.0, sampling))?.filmic(1.45))
}

pub(crate) fn draw_car(context: &Context<'_>) -> Result<Drawn, Failure> {
    let paint = MetallicPaintParameters::default();
    let door = View::new([-0.21, -0.93, 0.66], [-0.25, -0.82, 0.63], 34.0);
    let mut panels = Vec::new();
    let whole = Box::new(MetallicPaint::new(paint)?);
    let sampling = context.sampling([24, 11], 5);
    let view = View { field: 21.0, ..Set::Car.view() };
    let image = picture(context, Set::Car, view, sampling, whole, None)?;
    let alt = "A blue car from the front and the side";
    panels.push(Panel::raster("whole", "The car", alt, image).spanning(2));
    let sampling = context.sampling([12, 8], 5);
    let counted = PaintFlakes::Counted { spacing: 3e-4, bin: 0.12 };
    for (stem, label, subject) in [
        (
            "sparkles",
            "Its door: sparkles of two pixels",
            Box::new(MetallicPaint::new(paint)?) as Box<Surface<'static>>,
        ),
        (
            "flakes",
            "The same with counted flakes, 0.3 mm apart",
            Box::new(MetallicPaint::new(MetallicPaintParameters { flakes: counted, ..paint })?),
        ),
    ] {
        let image = picture(context, Set::Car, door, sampling, subject, None)?;
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
    let lines = CarpetParameters {
        diffuse: Vec3::new(0.24, 0.21, 0.19),
        fake_rim_light_colour: Vec3::splat(0.5),
        ..Default::default()
    };
    let grid = CarpetParameters { seams_pattern: SeamPattern::Grid, ..lines };
    let rim = CarpetParameters { fake_rim_light: 0.6, fake_rim_light_width: 0.5, ..lines };
    let near = View::new([0.30, -0.62, 0.16], [0.2, -0.46, 0.0], 36.0);
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
        let subject = Box::new(in_metres(Carpet::new(carpet)?, set.metres()));
        let image = picture(context, set, view, sampling, subject, None)?;
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
    let stars = Wallpaper { stars, paper: hex(0x2c_3a5e), star: hex(0xe8_d9a8) };
    let mut panels: Vec<Panel> = Vec::new();
    for (stem, label, alt, subject) in [
        (
            "bricks",
            "Bricks of 25 by 8 cm",
            "A brick wall that runs away to the right",
            Box::new(BrickWall::default()) as Box<Surface<'static>>,
        ),
        (
            "stars",
            "Stars in cells of 10 cm",
            "Dark blue wallpaper with pale stars",
            Box::new(in_metres(stars, 10.0)),
        ),
    ] {
        let image = picture(context, Set::Wall, Set::Wall.view(), sampling, subject, None)?;
        panels.push(Panel::raster(stem, label, alt, image));
    }
    Ok(Drawn::new(2, panels))
}

pub(crate) fn draw_teapots(context: &Context<'_>) -> Result<Drawn, Failure> {
    let metres = Set::Teapot.metres();
    let bumps = Bumps { kind: NoiseKind::Gaussian, frequency: 16.0, octaves: 16, gain: 0.8 };
    let paint = MetallicPaintParameters {
        specular: Vec3::new(0.6, 0.2, 0.12),
        pigment: Vec3::new(0.10, 0.01, 0.008),
        ..Default::default()
    };
    let plastic = VariationsParameters {
        diffuse: Vec3::new(0.10, 0.22, 0.12),
        dent_size: 0.03,
        dent_strength: 0.08,
        gloss_roughness: 0.15,
        ..Default::default()
    };
    let scratches = ScratchesParameters {
        scratch_size: 0.25,
        scratch_width: 0.012,
        scratch_cover: 3.0,
        specular: hex(0xc8_ccd2),
        roughness: 0.2,
        ..Default::default()
    };
    let glass = TemperedGlassParameters { body: GlassBody::Solid, ..Default::default() };
    let copper = Bumped {
        ndf: Arc::new(Ggx::new(0.15, 0.35)?),
        rule: LevelOfDetail::Exact,
        bumps: bumps.field(context.seed)?,
        colour: hex(0xf2_b184),
    };
    let marble = PolishedMarble { marble: Marble::default(), brightness: 2.6, polish: 0.12 };
    let subjects: [(&str, &str, Box<Surface<'static>>); 6] = [
        ("bumps", "Bumps of a density", Box::new(copper)),
        ("paint", "Metallic paint", Box::new(in_metres(MetallicPaint::new(paint)?, metres))),
        ("plastic", "Plastic with dents", Box::new(in_metres(Variations::new(plastic)?, metres))),
        ("scratched", "Scratched metal", Box::new(Scratches::new(scratches)?)),
        ("marble", "Blue marble", Box::new(in_metres(marble, 0.8))),
        ("glass", "Glass", Box::new(in_metres(TemperedGlass::new(glass)?, metres))),
    ];
    let view = View { field: 21.5, ..Set::Teapot.view() };
    let sampling = context.sampling([11, 9], 5);
    let mut panels = Vec::new();
    for (stem, label, subject) in subjects {
        let body = (stem == "glass").then_some(Vec3::new(0.80, 0.93, 0.89));
        let image = picture(context, Set::Teapot, view, sampling, subject, body)?;
        panels.push(Panel::raster(stem, label, format!("The Utah teapot: {}", label.to_lowercase()), image));
    }
    Ok(Drawn::new(3, panels).fact("a unit of the teapot", format!("{metres} m")))
}
