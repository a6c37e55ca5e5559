//! The materials on objects: a car, a room, walls, and teapots.

use asperity_render::image::{Image, tone::hex};
use asperity_render::integrator::adaptive::{Detail, Goal, Grain};
use asperity_render::light::environments::Studio;
use asperity_render::materials::InMetres;
use asperity_render::materials::field::{Bumps, NoiseKind};
use asperity_render::scene::{Backdrop, Light, Object, Scene, Surface};
use asperity_render::scenes::{PLAIN, Set, View, backdrop};
use asperity_shading::material::{
    BrickWall, BumpMapped, GlassBody, PaintFlakes, PolishedMarble, SeamPattern, Wallpaper,
};
use asperity_shading::reflectance::Absorption;
use asperity_shading::texture::{StarWallpaper, StarWallpaperParameters};
use asperity_shading::{
    Carpet, CarpetParameters, Ggx, LevelOfDetail, Marble, MetallicPaint, MetallicPaintParameters, Scratches,
    ScratchesParameters, TemperedGlass, TemperedGlassParameters, Variations, VariationsParameters,
};
use glam::{DVec3, Vec3};

use crate::figure::{Context, Drawn, Panel};
use asperity::failure::Result;
use asperity::quality::EXPOSURE;

type Subject = Box<Surface<'static>>;

/// Still-life renders of objects, with their noise.
struct Stills<'a> {
    context: &'a Context<'a>,
    studio: Studio,
    grains: Vec<Grain>,
}

impl<'a> Stills<'a> {
    fn new(context: &'a Context<'a>) -> Self {
        Self { context, studio: Studio::new(1.0), grains: Vec::new() }
    }

    fn picture(
        &mut self,
        objects: Vec<Object<'_>>,
        view: View,
        size: [u32; 2],
        detail: Detail,
    ) -> Result<Image> {
        let scene = Scene::new(objects, Light::Around(&self.studio), Backdrop::Color(backdrop()));
        let sampling = self.context.sampling(size, 1);
        let context = Context { goal: Goal { detail, ..self.context.goal }, ..*self.context };
        let (image, grain) = context.still(&scene, sampling, &view.camera(1.0, sampling))?;
        self.grains.push(grain);
        Ok(image.filmic(EXPOSURE))
    }
}

pub(crate) fn draw_car(context: &Context<'_>) -> Result<Drawn> {
    let paint = MetallicPaintParameters::default();
    let flakes = PaintFlakes::Counted { spacing: 3e-4, bin: 0.12 };
    let counted = MetallicPaintParameters { flakes, ..paint };
    let whole = View { field: 21.0, ..Set::Car.view() };
    let door = View::new([-0.21, -0.93, 0.66], [-0.25, -0.82, 0.63], 34.0);
    let from_nearby = "Blue paint close up with glints";
    let flaked = "The same with counted flakes, 0.3 mm apart";
    let pictures = [
        (
            ["whole", "The car", "A blue car from the front and the side"],
            (whole, [32, 15], paint, Detail::Coarse),
        ),
        (
            ["sparkles", "Its door: sparkles of two pixels", from_nearby],
            (door, [16, 11], paint, Detail::Fine),
        ),
        (["flakes", flaked, from_nearby], (door, [16, 11], counted, Detail::Fine)),
    ];
    let mut stills = Stills { studio: Studio::hall(1.0), ..Stills::new(context) };
    let mut drawn = Drawn::pictures(2, pictures, |(view, size, paint, detail)| {
        let objects = Set::Car.objects(Box::new(MetallicPaint::new(paint)?), PLAIN)?;
        stills.picture(objects, view, size, detail)
    })?
    .grain(&stills.grains);
    drawn.panels[0].span = 2;
    let sparkles = format!(
        "pixel size {}, physical size {}, variation {}, boost {}, elimination {}",
        paint.flake_sparkle_pixel_size,
        paint.flake_sparkle_physical_size,
        paint.flake_sparkle_variation,
        paint.flake_sparkle_boost,
        paint.flake_sparkle_elimination
    );
    let sized = |size: f32, strength: f32| format!("size {size}, strength {strength}");
    Ok(drawn
        .fact("orange_peel", sized(paint.orange_peel_size, paint.orange_peel_strength))
        .fact("flake_sparkle", sparkles)
        .fact("passive_flake", sized(paint.passive_flake_size, paint.passive_flake_strength)))
}

pub(crate) fn draw_room(context: &Context<'_>) -> Result<Drawn> {
    let lines = CarpetParameters {
        diffuse: Vec3::new(0.24, 0.21, 0.19),
        // So wide and faint that they look like threads with another orientation, not like stains.
        dark_area_strength: 0.16,
        dark_area_size: 1.6,
        fake_rim_light_color: Vec3::splat(0.5),
        ..Default::default()
    };
    let grid = CarpetParameters { seams_pattern: SeamPattern::Grid, ..lines };
    let rim = CarpetParameters { fake_rim_light: 0.6, fake_rim_light_width: 0.5, ..lines };
    let near = View::new([0.30, -0.62, 0.16], [0.2, -0.46, 0.0], 36.0);
    let (room, ball) = ((Set::Room, Set::Room.view()), (Set::Sphere, Set::Sphere.view()));
    let corner = "The corner of a room with a red ball";
    let pictures = [
        (["corner", "A floor of carpet", corner], (room, lines, 16, Detail::Coarse)),
        (
            ["grid", "Seams in a grid, from 20 cm", "Threads and crossing seams"],
            ((Set::Room, near), grid, 12, Detail::Fine),
        ),
        (
            ["rim", "Rim light on a ball", "A ball of carpet, lighter along its rim"],
            (ball, rim, 12, Detail::Fine),
        ),
    ];
    let mut stills = Stills::new(context);
    let drawn = Drawn::pictures(3, pictures, |((set, view), carpet, side, detail)| {
        let objects = set.objects(Box::new(InMetres(Carpet::new(carpet)?, set.metres())), PLAIN)?;
        stills.picture(objects, view, [side, side], detail)
    })?
    .grain(&stills.grains);
    let light = format!("{}, width {}", rim.fake_rim_light, rim.fake_rim_light_width);
    Ok(drawn
        .fact("seam_distance", lines.seam_distance)
        .fact("dark_area_size", lines.dark_area_size)
        .fact("fake_rim_light on the ball", light))
}

pub(crate) fn draw_walls(context: &Context<'_>) -> Result<Drawn> {
    let stars = StarWallpaper::new(StarWallpaperParameters {
        r_min: 0.1,
        r_max: 0.3,
        cells: 1.0,
        seed: context.seed,
        ..Default::default()
    })?;
    let stars =
        InMetres(Wallpaper { stars, paper: hex(0x2c_3a5e), star: hex(0xe8_d9a8), roughness: 0.0 }, 10.0);
    let (away, pale) = ("A brick wall that recedes to the right", "Dark blue wallpaper with pale stars");
    let pictures: [([&str; 3], Subject); 2] = [
        (["bricks", "Bricks of 25 by 8 cm", away], Box::new(BrickWall::default())),
        (["stars", "Stars in cells of 10 cm", pale], Box::new(stars)),
    ];
    let mut stills = Stills::new(context);
    let drawn = Drawn::pictures(2, pictures, |subject| {
        stills.picture(Set::Wall.objects(subject, PLAIN)?, Set::Wall.view(), [20, 15], Detail::Coarse)
    })?;
    Ok(drawn.grain(&stills.grains))
}

pub(crate) fn draw_teapots(context: &Context<'_>) -> Result<Drawn> {
    let metres = Set::Teapot.metres();
    let bumps = Bumps { kind: NoiseKind::Gaussian, frequency: 16.0, octaves: 16, gain: 0.8 };
    let paint = MetallicPaint::new(MetallicPaintParameters {
        specular: Vec3::new(0.6, 0.2, 0.12),
        pigment: Vec3::new(0.10, 0.01, 0.008),
        ..Default::default()
    })?;
    let plastic = Variations::new(VariationsParameters {
        diffuse: Vec3::new(0.10, 0.22, 0.12),
        dent_size: 0.03,
        dent_strength: 0.08,
        gloss_roughness: 0.15,
        ..Default::default()
    })?;
    let scratches = Scratches::new(ScratchesParameters {
        scratch_size: 0.4,
        scratch_width: 0.02,
        scratch_cover: 3.0,
        specular: hex(0xc8_ccd2),
        roughness: 0.14,
        ..Default::default()
    })?;
    let glass = TemperedGlassParameters { body: GlassBody::Solid, ..Default::default() };
    let copper = BumpMapped {
        ndf: Ggx::new(0.15, 0.35)?,
        rule: LevelOfDetail::Exact,
        bumps: bumps.field(context.seed, DVec3::ZERO)?,
        color: hex(0xf2_b184),
    };
    let marble = PolishedMarble { marble: Marble::default(), tint: Vec3::splat(2.6), polish: 0.12 };
    let subjects: [(&str, &str, Subject); 6] = [
        ("bumps", "Bumps of a density", Box::new(copper)),
        ("paint", "Metallic paint", Box::new(InMetres(paint, metres))),
        ("plastic", "Plastic with dents", Box::new(InMetres(plastic, metres))),
        ("scratched", "Scratched metal", Box::new(scratches)),
        ("marble", "Blue marble", Box::new(InMetres(marble, 0.8))),
        ("glass", "Glass", Box::new(InMetres(TemperedGlass::new(glass)?, metres))),
    ];
    let (mut panels, mut stills) = (Vec::new(), Stills::new(context));
    for (stem, label, subject) in subjects {
        let mut objects = Set::Teapot.objects(subject, PLAIN)?;
        if stem == "glass" {
            let inside = Absorption::of_color(Vec3::new(0.80, 0.93, 0.89), 1.0)?;
            (objects[0].body, objects[0].passes) = (Some(inside), 1.0);
        }
        let detail = if stem == "bumps" { Detail::Fine } else { Detail::Coarse };
        let image = stills.picture(objects, Set::Teapot.view(), [16, 16], detail)?;
        panels.push(Panel::new(stem, label, format!("The Utah teapot: {}", label.to_lowercase()), image));
    }
    Ok(Drawn::new(3, panels).fact("a unit of the teapot", format!("{metres} m")).grain(&stills.grains))
}
