//! `cargo xtask render`: one picture of one object with chosen parameters.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity_render::geometry::{camera::Camera, mesh::TracedMesh, mesh_file, shape::Shape};
use asperity_render::image::tone::{filmic, hex, linear, shoulder, srgb};
use asperity_render::image::{Format, Image, read::ImageFile};
use asperity_render::materials::Facets;
use asperity_render::materials::field::{Bumps, NoiseKind};
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::scenes::{RenderRequest, Set, View, backdrop, ground};
use asperity_render::{integrator::pixels::Sampling, light::environments::Studio};
use asperity_shading::{Environment, EnvironmentMap, LevelOfDetail, material::BumpMapped};
use glam::Vec3;
use indicatif::ProgressBar;

use crate::cli::{Background, Images, Material, Render, Tone};
use crate::failure::{Failure, Interrupted, Result};
use crate::gallery::materials::{Made, Parameters};
use crate::input::density::{Density, NORMAL_MAP};
use crate::output::Output;
use crate::progress;

/// Grain below notice.
const NOISE: f32 = 0.008;
/// The most samples of a pixel, if no other number is asked for.
const SAMPLES: u32 = 1024;
/// Degrees between triangles from which on there is an edge.
const CREASE: f32 = 40.0;
/// Exposure that suits the studio, and the mean radiance of what has it.
const EXPOSURE: f32 = 1.45;
const BRIGHTNESS: f32 = 0.5;
/// Copper.
const TINT: u32 = 0xf2_b184;

/// Draws what was asked for, over and over as it grows finer, and tells where it lies.
pub(crate) fn render(wanted: &Render, interrupted: &AtomicBool) -> Result<()> {
    if let Some(material) = wanted.help_material {
        return help(material);
    }
    let picture = Picture::new(wanted)?;
    let output = Output::new(picture.folder.clone())?;
    let bar = progress::bar("render");
    let mut drawn = None;
    let result = picture.refined(&bar, interrupted, &mut |image, samples, noise| {
        output.write(&picture.name, &picture.developed(image).encode(picture.format)?)?;
        let grain = if noise.is_finite() { format!(", grain {noise:.4}") } else { String::new() };
        let count = if samples == 1 { "1 sample".into() } else { format!("{samples} samples") };
        let progress = format!("{count} a pixel{grain}");
        bar.set_prefix(progress.clone());
        bar.set_length(0);
        bar.set_position(0);
        drawn = Some(progress);
        Ok(())
    });
    bar.finish_and_clear();
    let Some(progress) = drawn else { return result };
    match result {
        // What was drawn until then is there.
        Err(error) if error.is::<Interrupted>() => {}
        result => result?,
    }
    progress::say(&format!("the picture: {} ({progress})", output.place(&picture.name)));
    Ok(())
}

/// Lists the parameters of a material.
fn help(material: Material) -> Result<()> {
    let own = Parameters::usual(material)?;
    let options = match material {
        Material::Bumps => {
            "--tint, --roughness or --ndf or --normal-map, --scale, --rule, --octaves, --frequency, --gain, --bump-noise"
        }
        Material::Chrome => "--tint, --roughness",
        _ => "--tint, --roughness, --scale",
    };
    progress::say(&format!("options: {options}"));
    let mut lines = own.lines().peekable();
    if lines.peek().is_some() {
        progress::say("parameters, as in --set name=value; colours are linear r,g,b or '#rrggbb':");
    }
    lines.for_each(|line| progress::say(&line));
    Ok(())
}

/// Light of the picture.
enum Lit {
    Lamps,
    Around(Box<dyn Environment + Sync>),
}

/// A request that was checked, with its files read.
struct Picture<'a> {
    wanted: &'a Render,
    folder: PathBuf,
    name: String,
    format: Format,
    material: Material,
    density: Density,
    mesh: Option<Arc<Shape>>,
    /// A pattern is laid on by position.
    projected: bool,
    light: Lit,
    exposure: f32,
}

impl<'a> Picture<'a> {
    fn new(wanted: &'a Render) -> Result<Self> {
        let path = std::path::absolute(&wanted.out)?;
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
        let (Some(folder), Some(name), false) = (path.parent(), name, path.is_dir()) else {
            return Err(format!("`{}` is a folder; name a file in it", wanted.out.display()).into());
        };
        let format = Format::of(&path).ok_or_else(|| {
            format!("picture `{}`: its name must end in .png, .jpg, .webp or .exr", wanted.out.display())
        })?;
        let material = wanted.material.unwrap_or(match wanted.scene {
            Set::Teapot | Set::Sphere | Set::Plane => Material::Bumps,
            Set::Car => Material::Paint,
            Set::Room => Material::Carpet,
            Set::Wall => Material::Brick,
            Set::Vase => Material::Marble,
        });
        let lamps = wanted.light.as_ref().map_or(material == Material::Bumps, |light| light == "lamps");
        refuse_idle(wanted, material, lamps, format)?;
        let spec = match (&wanted.normal_map, &wanted.ndf, wanted.roughness) {
            (Some(file), ..) => format!("{NORMAL_MAP}{}", file.display()),
            (_, Some(spec), _) => spec.clone(),
            (.., Some(alpha)) if material == Material::Bumps => format!("ggx:{alpha}"),
            _ => "ggx:0.2,0.4".into(),
        };
        let density = Density::parse(&spec, wanted.images)?;
        let patterned = matches!(
            material,
            Material::Carpet | Material::Scratched | Material::Brick | Material::Wallpaper
        );
        let (mesh, projected) = match &wanted.mesh {
            Some(file) => {
                let (mesh, uv) = opened(file, wanted, patterned)?;
                (Some(Arc::new(Shape::Mesh(mesh))), patterned && !uv)
            }
            None => (None, false),
        };
        let (light, exposure) = match wanted.light.as_deref() {
            _ if lamps => (Lit::Lamps, EXPOSURE),
            None | Some("studio") => (Lit::Around(Box::new(Studio::new(1.0))), EXPOSURE),
            Some("day") => (Lit::Around(Box::new(Studio::day(1.0))), EXPOSURE),
            Some(file) => {
                let map = surroundings(Path::new(file))?;
                let mean = map.as_ref().total() / (4.0 * std::f32::consts::PI);
                let exposure = if mean > 0.0 { EXPOSURE * BRIGHTNESS / mean } else { EXPOSURE };
                if wanted.exposure.is_none() && format != Format::Exr {
                    progress::note(&format!(
                        "light `{file}`: exposure {exposure:.3} by its mean; --exposure sets it"
                    ));
                }
                (Lit::Around(Box::new(map)), exposure)
            }
        };
        let (folder, exposure) = (folder.to_owned(), wanted.exposure.unwrap_or(exposure));
        Ok(Self { wanted, folder, name, format, material, density, mesh, projected, light, exposure })
    }

    /// Draws it in passes, each handed over with its samples of a pixel and its grain.
    fn refined(
        &self,
        bar: &ProgressBar,
        interrupted: &AtomicBool,
        pass: &mut dyn FnMut(Image, u32, f32) -> Result<()>,
    ) -> Result<()> {
        let &Render { size, spp, noise, seed, .. } = self.wanted;
        let sampling =
            Sampling { width: size, height: size, samples_per_pixel: spp.unwrap_or(SAMPLES), seed };
        let goal = noise.unwrap_or(if spp.is_some() { 0.0 } else { NOISE });
        let mut draw = |scene: &Scene<'_, '_>, camera: Camera| {
            let goal = (goal, |x| self.shown(x));
            scene.refine(sampling, &camera, goal, bar, interrupted, &mut *pass)
        };
        match &self.light {
            Lit::Lamps => self.by_lamps(sampling, &mut draw),
            Lit::Around(light) => self.staged(light.as_ref(), sampling, &mut draw),
        }
    }

    /// Bumps by the source's shading, under lamps without shadows.
    fn by_lamps(
        &self,
        sampling: Sampling,
        draw: &mut dyn FnMut(&Scene<'_, '_>, Camera) -> Result<()>,
    ) -> Result<()> {
        let wanted = self.wanted;
        let mut request = RenderRequest::new(wanted.scene, self.density.ndf.as_ref(), sampling);
        if let Some(Shape::Mesh(mesh)) = self.mesh.as_deref() {
            (request.view, request.bumps.frequency) = (View::of_mesh(mesh), 24.0);
        }
        request.facets = Facets::Consistent(wanted.rule.unwrap_or(LevelOfDetail::Exact));
        request.zoom = wanted.zoom;
        request.bumps = self.bumps(request.bumps);
        request.tint = hex(wanted.tint.unwrap_or(TINT));
        request.exposure = self.exposure;
        let shape = self.mesh.clone().unwrap_or_else(|| RenderRequest::shape(wanted.scene));
        let mut scene = request.scene(&shape)?;
        if let Some(Background::Colour(rgb)) = wanted.background {
            scene.backdrop = Backdrop::Colour(hex(rgb));
        }
        draw(&scene, request.camera())
    }

    /// Any material in light from all around, with shadows.
    fn staged(
        &self,
        light: &(dyn Environment + Sync),
        sampling: Sampling,
        draw: &mut dyn FnMut(&Scene<'_, '_>, Camera) -> Result<()>,
    ) -> Result<()> {
        let (wanted, set) = (self.wanted, self.wanted.scene);
        let around = wanted.light.is_some() || set == Set::Plane && self.mesh.is_none();
        let colour = match wanted.background {
            Some(Background::Colour(rgb)) => Some(hex(rgb)),
            None if !around => Some(backdrop()),
            _ => None,
        };
        // A colour is that of the picture, whatever its exposure.
        let colour = colour.map(|colour| colour * EXPOSURE / self.exposure);
        let behind = |direction: Vec3| colour.unwrap_or_else(|| light.radiance(direction));
        // A mesh is as large as shows a pattern well.
        let metres = match (&self.mesh, self.material) {
            (None, _) => set.metres(),
            (_, Material::Brick) => 1.2,
            (_, Material::Wallpaper) => 0.4,
            _ => Set::Sphere.metres(),
        };
        let Made { surface, body } = self.subject(metres)?;
        let (mut objects, camera) = match &self.mesh {
            Some(shape) => {
                let Shape::Mesh(mesh) = shape.as_ref() else { return Err("no mesh".into()) };
                let objects = vec![Object::new(Arc::clone(shape), surface), ground(mesh.bottom(), &behind)?];
                (objects, View::of_mesh(mesh).camera(wanted.zoom, sampling))
            }
            None => (set.objects(surface, &behind)?, set.view().camera(wanted.zoom, sampling)),
        };
        if matches!(self.material, Material::Glass | Material::Frosted) {
            (objects[0].passes, objects[0].body) = (1.0, body);
        }
        let backdrop = colour.map_or(Backdrop::Light, Backdrop::Colour);
        draw(&Scene::new(objects, Light::Around(light), backdrop), camera)
    }

    fn bumps(&self, usual: Bumps) -> Bumps {
        let wanted = self.wanted;
        Bumps {
            kind: wanted.bump_noise.unwrap_or(usual.kind),
            octaves: wanted.octaves.unwrap_or(usual.octaves),
            frequency: wanted.frequency.unwrap_or(usual.frequency) / wanted.scale.unwrap_or(1.0),
            gain: wanted.gain.unwrap_or(usual.gain),
        }
    }

    /// The material of the subject, where a unit of the scene is so many metres.
    fn subject(&self, metres: f32) -> Result<Made<'_>> {
        let wanted = self.wanted;
        if self.material != Material::Bumps {
            let parameters = Parameters::of(wanted, self.material)?;
            return parameters.make(self.material, metres / wanted.scale.unwrap_or(1.0), self.projected);
        }
        let usual = Bumps { frequency: 24.0, gain: 0.8, kind: NoiseKind::Gaussian, octaves: 16 };
        let (bumps, ndf) = (self.bumps(usual).field(wanted.seed)?, self.density.ndf.as_ref());
        let (rule, colour) = (wanted.rule.unwrap_or(LevelOfDetail::Exact), hex(wanted.tint.unwrap_or(TINT)));
        Ok(Made { surface: Box::new(BumpMapped { ndf, bumps, rule, colour }), body: None })
    }

    /// The channel as a screen shows it.
    fn shown(&self, radiance: f32) -> f32 {
        let exposed = radiance * self.exposure;
        srgb(
            match (&self.light, self.wanted.tone) {
                // The lamps' exposure is chosen for the soft shoulder, and in their brightness.
                (Lit::Lamps, Some(Tone::Plain)) => radiance,
                (Lit::Lamps, _) => shoulder(radiance),
                (Lit::Around(_), Some(Tone::Plain)) => exposed,
                (Lit::Around(_), _) => filmic(exposed),
            }
            .clamp(0.0, 1.0),
        )
    }

    /// The image as its file has it.
    fn developed(&self, image: Image) -> Image {
        match (&self.light, self.wanted.tone) {
            _ if self.format == Format::Exr => image,
            (Lit::Lamps, Some(Tone::Plain)) => image,
            (Lit::Lamps, _) => image.exposed(1.0),
            (Lit::Around(_), Some(Tone::Plain)) => image.map(|p| p * self.exposure),
            (Lit::Around(_), _) => image.filmic(self.exposure),
        }
    }
}

/// Refuses options that would change nothing.
fn refuse_idle(wanted: &Render, material: Material, lamps: bool, format: Format) -> Result<()> {
    let bumps = material == Material::Bumps;
    if lamps && !matches!(wanted.scene, Set::Teapot | Set::Sphere | Set::Plane) {
        return Err("lamps light the teapot, the sphere and the plane only; take `--light studio`".into());
    }
    if lamps && !bumps {
        return Err("lamps light bumps only; take `--light studio`".into());
    }
    let exr = format == Format::Exr;
    let image = wanted.ndf.as_ref().is_some_and(|ndf| ndf != "painted" && !ndf.contains(':'));
    let Images { measure, reconstruction, tangent_space } = wanted.images;
    let given = [
        ("--ndf", wanted.ndf.is_some(), bumps, "it is of bumps"),
        ("--normal-map", wanted.normal_map.is_some(), bumps, "it is of bumps"),
        ("--rule", wanted.rule.is_some(), bumps, "it is of bumps"),
        ("--octaves", wanted.octaves.is_some(), bumps, "it is of bumps"),
        ("--frequency", wanted.frequency.is_some(), bumps, "it is of bumps"),
        ("--gain", wanted.gain.is_some(), bumps, "it is of bumps"),
        ("--bump-noise", wanted.bump_noise.is_some(), bumps, "it is of bumps"),
        ("--measure", measure.is_some(), bumps && image, "it is of an image given by --ndf"),
        ("--reconstruction", reconstruction.is_some(), bumps && image, "it is of an image given by --ndf"),
        ("--tangent-space", tangent_space.is_some(), wanted.normal_map.is_some(), "it is of --normal-map"),
        ("--set", !wanted.set.is_empty(), !bumps, "bumps are set by options of their own"),
        ("--scale", wanted.scale.is_some(), material != Material::Chrome, "chrome has no pattern"),
        ("--tone", wanted.tone.is_some(), !exr, "an OpenEXR file has the radiance itself"),
        ("--exposure", wanted.exposure.is_some(), !exr || lamps, "an OpenEXR file has the radiance itself"),
        (
            "--background",
            wanted.background == Some(Background::Light),
            !lamps,
            "lamps are not seen; take a colour, or `--light studio`",
        ),
    ];
    let idle = given.iter().find(|(_, given, used, _)| *given && !*used);
    idle.map_or(Ok(()), |(option, .., why)| {
        let name = format!("{material:?}").to_lowercase();
        Err(format!("{option} would change nothing of {name}: {why}; see `--help-material {name}`").into())
    })
}

/// The mesh of a file, and whether it has texture coordinates.
fn opened(file: &Path, wanted: &Render, patterned: bool) -> Result<(TracedMesh, bool)> {
    let failed = |error: &dyn std::fmt::Display| Failure::from(format!("mesh `{}`: {error}", file.display()));
    let stl = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("stl"));
    let up = wanted.up.unwrap_or(if stl { mesh_file::Up::Z } else { mesh_file::Up::Y });
    let crease = wanted.crease.unwrap_or(CREASE);
    let mesh_file::MeshFile { mesh, normals, uv } =
        mesh_file::open(file, mesh_file::MeshReading { up, crease }).map_err(|error| failed(&error))?;
    if normals && wanted.crease.is_some() {
        return Err(failed(&"it has normals of its own, so --crease would change nothing"));
    }
    let name = file.display();
    if !normals {
        progress::note(&format!(
            "mesh `{name}` has no normals: smooth up to edges of {crease}°; --crease sets it"
        ));
    }
    if patterned && uv {
        progress::note(&format!(
            "mesh `{name}`: the pattern follows its texture coordinates, at the scale of lengths"
        ));
    } else if patterned {
        progress::note(&format!(
            "mesh `{name}` has no texture coordinates: the pattern is laid on from three sides"
        ));
    }
    Ok((TracedMesh::new(mesh), uv))
}

/// The image of the surroundings in a file.
fn surroundings(file: &Path) -> Result<EnvironmentMap> {
    let name = file.display();
    let fail = |error: &dyn std::fmt::Display| Failure::from(format!("light `{name}`: {error}"));
    let image = ImageFile::open(file).map_err(|error| fail(&error))?;
    let grey = image.grey();
    let [r, g, b] = image.components(&[["R", "G", "B"]]).unwrap_or([&grey, &grey, &grey]);
    // Numbers of an 8-bit image are those of a screen.
    let light = |x: f32| if image.floats { x } else { linear(x) };
    let mut wrong = 0;
    let texels = (0..image.width * image.height).map(|i| {
        let texel = Vec3::new(light(r[i]), light(g[i]), light(b[i]));
        // Lossy compression rings below 0, and a sun may be beyond a half float.
        let right = texel.map(|c| if c.is_nan() { 0.0 } else { c.clamp(0.0, 65_504.0) });
        wrong += usize::from(right != texel);
        right
    });
    let texels: Vec<Vec3> = texels.collect();
    if wrong > 0 {
        let share = 100.0 * wrong as f32 / texels.len() as f32;
        progress::note(&format!(
            "light `{name}`: {wrong} texels ({share:.3} %) below 0 or beyond 65504 were cut off"
        ));
    }
    EnvironmentMap::new(image.width, image.height, texels).map_err(|error| fail(&error))
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;
    use clap::Parser;

    use super::*;
    use crate::cli::{Cli, Command};

    /// The file of a command line.
    fn bytes(line: &str) -> Result<Vec<u8>> {
        let cli = Cli::try_parse_from(["xtask", "render"].into_iter().chain(line.split_whitespace()))?;
        let Command::Render(wanted) = cli.command else { return Err("another command".into()) };
        let (picture, mut bytes) = (Picture::new(&wanted)?, Vec::new());
        picture.refined(&ProgressBar::hidden(), &AtomicBool::new(false), &mut |image, _, _| {
            bytes = picture.developed(image).encode(picture.format)?;
            Ok(())
        })?;
        Ok(bytes)
    }

    #[test]
    fn every_option_changes_the_picture_of_every_material_or_is_refused() {
        let bumps_alone = [
            "--ndf ggx:0.5",
            "--rule fractal",
            "--octaves 2",
            "--frequency 3",
            "--gain 0.5",
            "--bump-noise simplex",
        ];
        let all = [
            "--tint 3060c0",
            "--roughness 0.6",
            "--scale 30",
            "--seed 7",
            "--zoom 2",
            "--size 20",
            "--spp 2",
            "--noise 1",
            "--exposure 3",
            "--tone plain",
            "--background 204060",
            "--background light",
            "--light day",
            "--scene teapot",
            "--out a.jpg",
        ];
        // Of images and of meshes that are not there.
        let idle = ["--measure normals", "--reconstruction bilinear", "--tangent-space directx"];
        for (material, set) in [
            ("bumps", "gain=0.5"),
            ("carpet", "seams_pattern=grid"),
            ("paint", "coat_roughness=0.3"),
            ("flakes", "flakes.counted.bin=0.5"),
            ("glass", "index=1.2"),
            ("frosted", "index=1.2"),
            ("plastic", "dent_strength=0.9"),
            ("scratched", "specular=0.9,0.1,0.1"),
            ("chrome", "colour=#204060"),
            ("brick", "mortar_colour=#ffffff"),
            ("marble", "veins=9"),
            ("wallpaper", "points=3"),
        ] {
            // From afar bumps are too fine to be seen.
            let frequency = if material == "bumps" { "--frequency 1" } else { "" };
            let own = [
                "--scene sphere",
                "--light studio",
                "--background 808080",
                "--size 16",
                "--spp 4",
                frequency,
            ];
            let line = |but: &str| {
                let kept: Vec<_> = own.iter().copied().filter(|own| !own.starts_with(but)).collect();
                format!("{} --material {material}", kept.join(" "))
            };
            let plain = bytes(&line("none")).unwrap();
            let set = format!("--set {set}");
            for option in all.iter().chain(&bumps_alone).chain(&idle).copied().chain([set.as_str()]) {
                let word = option.split(' ').next().unwrap();
                // An option is not given twice.
                let got = bytes(&format!("{} {option}", line(word)));
                let refused = match material {
                    "bumps" => idle.contains(&option) || word == "--set",
                    "chrome" if word == "--scale" => true,
                    _ => idle.contains(&option) || bumps_alone.contains(&option),
                };
                match got {
                    Ok(got) => assert!(!refused && got != plain, "{material} {option}: the same picture"),
                    Err(error) => {
                        let said = error.to_string();
                        assert!(refused && said.lines().count() == 1, "{material} {option}: {said}");
                    }
                }
            }
        }
        for line in [
            "--out a.exr --tone plain --material paint",
            "--out a.exr --exposure 2 --material paint",
            "--background light",
            "--set coat=1 --material paint",
            "--set coat_index=9 --material paint",
            "--set seams_pattern=dots --material carpet",
            "--mesh render/tests/data/cube.glb --crease 20",
        ] {
            assert!(bytes(line).is_err(), "{line}");
        }
    }

    #[test]
    fn light_that_rings_below_0_is_cut_off_there() {
        let scratch = tempfile::tempdir().unwrap();
        let file = scratch.path().join("rings.exr");
        let ringing = Image::from_fn(16, 8, |x, _| match x {
            0 => Vec3::new(-0.25, 1.0, 2.0),
            1 => Vec3::new(f32::NAN, f32::INFINITY, 0.0),
            _ => Vec3::ONE,
        });
        std::fs::write(&file, ringing.exr().unwrap()).unwrap();
        let map = surroundings(&file).unwrap();
        let all = (0..64).map(|k| {
            map.radiance(Vec3::new((f32::from(k as u8) * 0.1).cos(), (f32::from(k as u8) * 0.1).sin(), 0.0))
        });
        assert!(all.into_iter().all(|light| light.min_element() >= 0.0 && light.max_element() <= 65_504.0));
    }

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
