//! `cargo xtask render`: one picture of one object with chosen parameters.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity_render::geometry::{camera::Camera, mesh::TracedMesh, mesh_file, shape::Shape};
use asperity_render::image::tone::{hex, linear};
use asperity_render::image::{Image, read::ImageFile};
use asperity_render::materials::field::{Bumps, NoiseKind};
use asperity_render::materials::{Facets, InMetres};
use asperity_render::scene::{Backdrop, Light, Object, Scene, Surface};
use asperity_render::scenes::{RenderRequest, Set, View, backdrop, ground};
use asperity_render::{integrator::pixels::Sampling, light::environments::Studio};
use asperity_shading::material::{BrickWall, BumpMapped, GlassBody, PaintFlakes, PolishedMarble, Wallpaper};
use asperity_shading::{
    Carpet, CarpetParameters, Environment, EnvironmentMap, Marble, MetallicPaint, MetallicPaintParameters,
    Scratches, ScratchesParameters, TemperedGlass, TemperedGlassParameters, Variations, VariationsParameters,
    reflectance::Coat, texture::StarWallpaper,
};
use glam::Vec3;

use crate::cli::{Material, Render, Tone};
use crate::failure::{Failure, Result};
use crate::input::density::{Density, NORMAL_MAP};
use crate::output::Output;
use crate::progress;

/// Draws what was asked for and tells where it lies.
pub(crate) fn render(wanted: &Render, interrupted: &AtomicBool) -> Result<()> {
    let spec = match &wanted.normal_map {
        Some(file) => format!("{NORMAL_MAP}{}", file.display()),
        None => wanted.ndf.clone(),
    };
    let density = Density::parse(&spec, wanted.images)?;
    let path = std::path::absolute(&wanted.out)?;
    let name = path.file_name().map(|name| name.to_string_lossy());
    let (Some(folder), Some(name), false) = (path.parent(), name, path.is_dir()) else {
        return Err(format!("`{}` is a folder; name a file in it", wanted.out.display()).into());
    };
    let has_ending = |ending| path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending));
    if !has_ending("png") && !has_ending("exr") {
        return Err(format!("picture `{}`: its name must end in .png or .exr", wanted.out.display()).into());
    }
    let open = |file: &PathBuf| {
        let named = |error| Failure::from(format!("mesh `{}`: {error}", file.display()));
        mesh_file::open(file, wanted.up).map(TracedMesh::new).map_err(named)
    };
    let mesh = wanted.mesh.as_ref().map(open).transpose()?;
    let output = Output::new(folder)?;
    let &Render { size, spp: samples_per_pixel, seed, .. } = wanted;
    let sampling = Sampling { width: size, height: size, samples_per_pixel, seed };
    let material = wanted.material.unwrap_or(match wanted.scene {
        Set::Teapot | Set::Sphere | Set::Plane => Material::Bumps,
        Set::Car => Material::Paint,
        Set::Room => Material::Carpet,
        Set::Wall => Material::Brick,
        Set::Vase => Material::Marble,
    });
    let lamps = match &wanted.light {
        Some(light) => light == "lamps",
        None => material == Material::Bumps,
    };
    let bar = progress::bar("render");
    let draw = |scene: &Scene<'_, '_>, camera: Camera| scene.draw(sampling, &camera, &bar, interrupted);
    let image = if lamps {
        by_lamps(wanted, mesh, material, &density, sampling, draw)
    } else {
        staged(wanted, mesh, material, &density, sampling, draw)
    };
    bar.finish_and_clear();
    let image = image?;
    let bytes = match (lamps, wanted.tone) {
        _ if has_ending("exr") => image.exr()?,
        // The lamps' exposure is chosen for the soft shoulder.
        (true, Tone::Filmic) => image.exposed(1.0).png()?,
        (true, Tone::Plain) => image.png()?,
        (false, Tone::Filmic) => image.filmic(wanted.exposure).png()?,
        (false, Tone::Plain) => image.map(|p| p * wanted.exposure).png()?,
    };
    output.write(&name, &bytes)?;
    progress::say(&format!("the picture: {}", path.display()));
    Ok(())
}

fn bumps(wanted: &Render, usual: Bumps) -> Bumps {
    Bumps {
        kind: wanted.noise,
        octaves: wanted.octaves,
        frequency: wanted.frequency.unwrap_or(usual.frequency),
        gain: wanted.gain.unwrap_or(usual.gain),
    }
}

/// Bumps by the source's shading, under lamps without shadows.
fn by_lamps(
    wanted: &Render,
    mesh: Option<TracedMesh>,
    material: Material,
    density: &Density,
    sampling: Sampling,
    draw: impl Fn(&Scene<'_, '_>, Camera) -> Result<Image>,
) -> Result<Image> {
    let set = wanted.scene;
    if !matches!(set, Set::Teapot | Set::Sphere | Set::Plane) {
        return Err("lamps light the teapot, the sphere and the plane only; take `--light studio`".into());
    }
    if material != Material::Bumps {
        return Err("lamps light bumps only; take `--light studio`".into());
    }
    let mut request = RenderRequest::new(set, density.ndf.as_ref(), sampling);
    if let Some(mesh) = &mesh {
        (request.view, request.bumps.frequency) = (View::of_mesh(mesh), 24.0);
    }
    request.facets = Facets::Consistent(wanted.rule);
    request.zoom = wanted.zoom;
    request.bumps = bumps(wanted, request.bumps);
    request.tint = hex(wanted.tint);
    request.exposure = wanted.exposure;
    let shape = mesh.map_or_else(|| RenderRequest::shape(set), |mesh| Arc::new(Shape::Mesh(mesh)));
    draw(&request.scene(&shape)?, request.camera())
}

/// Any material in light from all around, with shadows.
fn staged(
    wanted: &Render,
    mesh: Option<TracedMesh>,
    material: Material,
    density: &Density,
    sampling: Sampling,
    draw: impl Fn(&Scene<'_, '_>, Camera) -> Result<Image>,
) -> Result<Image> {
    let set = wanted.scene;
    let surroundings: Box<dyn Environment + Sync> = match wanted.light.as_deref() {
        None | Some("studio") => Box::new(Studio::new(1.0)),
        Some("day") => Box::new(Studio::day(1.0)),
        Some(file) => Box::new(surroundings(Path::new(file))?),
    };
    let metres = if mesh.is_some() { Set::Sphere.metres() } else { set.metres() };
    let subject = surface(wanted, material, density, metres)?;
    let (mut objects, camera) = match mesh {
        Some(mesh) => {
            let camera = View::of_mesh(&mesh).camera(wanted.zoom, sampling);
            let bottom = mesh.bottom();
            let body = Object::new(Shape::Mesh(mesh), subject);
            (vec![body, ground(bottom)?], camera)
        }
        None => (set.objects(subject)?, set.view().camera(wanted.zoom, sampling)),
    };
    if material == Material::Glass {
        (objects[0].passes, objects[0].body) = (1.0, Some(Vec3::new(0.86, 0.95, 0.92)));
    }
    let around = wanted.light.is_some() || set == Set::Plane;
    let backdrop = if around { Backdrop::Light } else { Backdrop::Colour(backdrop()) };
    draw(&Scene::new(objects, Light::Around(surroundings.as_ref()), backdrop), camera)
}

/// The image of the surroundings in a file.
fn surroundings(file: &Path) -> Result<EnvironmentMap> {
    let fail = |error: &dyn std::fmt::Display| Failure::from(format!("light `{}`: {error}", file.display()));
    let image = ImageFile::open(file).map_err(|error| fail(&error))?;
    let grey = image.grey();
    let [r, g, b] = image.components(&[["R", "G", "B"]]).unwrap_or([&grey, &grey, &grey]);
    // Numbers of an 8-bit image are those of a screen.
    let light = |x: f32| if image.signed { x } else { linear(x) };
    let texels = (0..image.width * image.height).map(|i| Vec3::new(light(r[i]), light(g[i]), light(b[i])));
    EnvironmentMap::new(image.width, image.height, texels.collect()).map_err(|error| fail(&error))
}

/// The material with its usual parameters, where a unit of the scene is so many metres.
fn surface<'a>(
    wanted: &Render,
    material: Material,
    density: &'a Density,
    metres: f32,
) -> Result<Box<Surface<'a>>> {
    let seed = wanted.seed;
    let paint = MetallicPaintParameters { seed, ..Default::default() };
    Ok(match material {
        Material::Bumps => {
            let usual = Bumps { frequency: 24.0, gain: 0.8, kind: NoiseKind::Gaussian, octaves: 16 };
            let bumps = bumps(wanted, usual).field(seed)?;
            let ndf = density.ndf.as_ref();
            Box::new(BumpMapped { ndf, bumps, rule: wanted.rule, colour: hex(wanted.tint) })
        }
        Material::Carpet => {
            let diffuse = Vec3::new(0.24, 0.21, 0.19);
            let fake_rim_light_colour = Vec3::splat(0.5);
            let carpet = CarpetParameters { diffuse, fake_rim_light_colour, seed, ..Default::default() };
            Box::new(InMetres(Carpet::new(carpet)?, metres))
        }
        Material::Paint => Box::new(InMetres(MetallicPaint::new(paint)?, metres)),
        Material::Flakes => {
            let flakes = PaintFlakes::Counted { spacing: 2e-4, bin: 0.12 };
            Box::new(InMetres(MetallicPaint::new(MetallicPaintParameters { flakes, ..paint })?, metres))
        }
        Material::Glass => {
            let glass = TemperedGlassParameters { body: GlassBody::Solid, seed, ..Default::default() };
            Box::new(InMetres(TemperedGlass::new(glass)?, metres))
        }
        Material::Plastic => {
            let (diffuse, gloss_roughness) = (Vec3::new(0.34, 0.12, 0.06), 0.2);
            let plastic = VariationsParameters { diffuse, gloss_roughness, seed, ..Default::default() };
            Box::new(InMetres(Variations::new(plastic)?, metres))
        }
        Material::Scratched => {
            let (specular, roughness) = (hex(0xc8_ccd2), 0.2);
            let metal = ScratchesParameters { specular, roughness, seed, ..Default::default() };
            Box::new(InMetres(Scratches::new(metal)?, metres))
        }
        Material::Chrome => Box::new(Coat::metal(hex(0xe4_e6ea))),
        Material::Brick => Box::new(InMetres(BrickWall::default(), metres)),
        Material::Marble => {
            let marble = PolishedMarble { marble: Marble::default(), brightness: 2.6, polish: 0.12 };
            Box::new(InMetres(marble, metres / 0.2))
        }
        Material::Wallpaper => {
            let stars = StarWallpaper::new(5, [0.1, 0.3], 1.0, 0.55, seed)?;
            let paper = Wallpaper { stars, paper: hex(0x2c_3a5e), star: hex(0xe8_d9a8) };
            Box::new(InMetres(paper, metres / 0.1))
        }
    })
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn an_image_of_the_surroundings_is_read_and_a_broken_one_named() {
        let scratch = tempfile::tempdir().unwrap();
        let sky = Image::from_fn(16, 8, |_, y| Vec3::new(3.0, 2.0, y as f32));
        let file = scratch.path().join("sky.exr");
        std::fs::write(&file, sky.exr().unwrap()).unwrap();
        let map = surroundings(&file).unwrap();
        assert_abs_diff_eq!(map.radiance(Vec3::X), Vec3::new(3.0, 2.0, 3.5), epsilon = 0.01);
        std::fs::write(&file, b"no image").unwrap();
        let error = surroundings(&file).err().unwrap().to_string();
        let whole = error.starts_with("light `") && error.contains("sky.exr") && !error.contains('\n');
        assert!(whole, "{error}");
    }
}
