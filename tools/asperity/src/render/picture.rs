//! Renders the requested image in passes.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use asperity_render::geometry::mesh_file::materials::MeshMaterials;
use asperity_render::geometry::{camera::Camera, shape::Shape};
use asperity_render::image::tone::{filmic, hex, srgb};
use asperity_render::image::{Format, Image};
use asperity_render::integrator::pixels::{Sampling, Watch};
use asperity_render::light::environments::{Studio, Surroundings};
use asperity_render::materials::Facets;
use asperity_render::materials::field::{Bumps, NoiseKind};
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::scenes::{RenderRequest, Set, View, backdrop, ground};
use asperity_shading::{LevelOfDetail, material::BumpMapped};
use glam::{DVec3, Vec3};

use crate::cli::render::{Background, Material, Render, Tone};
use crate::failure::Result;
use crate::input::density::{Density, NORMAL_MAP};
use crate::output;
use crate::progress;
use crate::quality::Fineness;
use crate::render::files::{Opened, opened, patterned, surroundings};
use crate::render::materials::{Made, Parameters};
use crate::render::options::refuse_idle;

/// Exposure that suits the studio, and the mean radiance that the studio has.
const EXPOSURE: f32 = 1.45;
const BRIGHTNESS: f32 = 0.5;
/// Copper.
const TINT: u32 = 0xf2_b184;

/// Light of the image.
enum Lit {
    Lamps,
    Around(Box<dyn Surroundings>),
}

/// What covers the subject.
enum Cover {
    Chosen(Material),
    /// The materials of the mesh file.
    File(Arc<MeshMaterials>),
}

/// A validated request with its files loaded.
pub(super) struct Picture<'a> {
    wanted: &'a Render,
    pub(super) folder: PathBuf,
    pub(super) name: String,
    pub(super) format: Format,
    cover: Cover,
    density: Density,
    mesh: Option<Arc<Shape>>,
    /// The view, if the scene is a mesh.
    view: Option<View>,
    /// Whether a pattern is mapped by position.
    projected: bool,
    light: Lit,
    exposure: f32,
    /// Rotation about the vertical in degrees.
    turn: f32,
    zoom: f32,
}

/// Returns the view of a mesh. The options are in the coordinates of its file.
fn view(opened: &Opened, wanted: &Render) -> Result<View> {
    let usual = View::of_mesh(&opened.mesh);
    let place = |point: [f64; 3]| opened.place.apply(point.into()).as_vec3();
    let (eye, target) = (wanted.camera.map_or(usual.eye, place), wanted.target.map_or(usual.target, place));
    if eye == target {
        let [x, y, z] = wanted.camera.or(wanted.target).unwrap_or_default();
        return Err(format!("`--camera` and `--target` must differ, got {x},{y},{z}").into());
    }
    Ok(View::of_mesh_from(&opened.mesh, eye, target, wanted.fov.unwrap_or(usual.field)))
}

impl Cover {
    const fn chosen(&self) -> Option<Material> {
        match self {
            Self::Chosen(material) => Some(*material),
            Self::File(_) => None,
        }
    }
}

impl<'a> Picture<'a> {
    pub(super) fn new(wanted: &'a Render) -> Result<Self> {
        let (folder, name) = output::split(&wanted.out)?;
        let format = Format::of(&wanted.out).ok_or_else(|| {
            format!(
                "image `{}`: unsupported file extension (expected .png, .jpg, .webp or .exr)",
                wanted.out.display()
            )
        })?;
        let mut opened = wanted.mesh.as_ref().map(|file| opened(file, wanted)).transpose()?;
        let materials = opened.as_mut().and_then(|opened| opened.materials.take());
        let cover = match (materials, wanted.material) {
            (Some(materials), _) => Cover::File(Arc::new(materials)),
            (None, chosen) => Cover::Chosen(chosen.unwrap_or(match wanted.scene {
                Set::Teapot | Set::Sphere | Set::Plane => Material::Bumps,
                Set::Car => Material::Paint,
                Set::Room => Material::Carpet,
                Set::Wall => Material::Brick,
                Set::Vase => Material::Marble,
            })),
        };
        let material = cover.chosen();
        let bumps = material == Some(Material::Bumps);
        let lamps = wanted.light.as_ref().map_or(bumps, |light| light == "lamps");
        refuse_idle(wanted, material, lamps, format)?;
        let spec = match (&wanted.normal_map, &wanted.ndf, wanted.roughness) {
            (Some(file), ..) => format!("{NORMAL_MAP}{}", file.display()),
            (_, Some(spec), _) => spec.clone(),
            (.., Some(alpha)) if bumps => format!("ggx:{alpha}"),
            _ => "ggx:0.2,0.4".into(),
        };
        let density = Density::parse(&spec, wanted.images)?;
        let projected = opened.as_ref().is_some_and(|opened| !opened.uv) && material.is_some_and(patterned);
        let view = opened.as_ref().map(|opened| view(opened, wanted)).transpose()?;
        let mesh = opened.map(|Opened { mesh, .. }| Arc::new(Shape::Mesh(mesh)));
        let (light, exposure) = match wanted.light.as_deref() {
            _ if lamps => (Lit::Lamps, EXPOSURE),
            None | Some("studio") => (Lit::Around(Box::new(Studio::new(1.0))), EXPOSURE),
            Some("day") => (Lit::Around(Box::new(Studio::day(1.0))), EXPOSURE),
            Some(file) => {
                let map = surroundings(Path::new(file))?;
                let mean = map.view().total() / (4.0 * std::f32::consts::PI);
                let exposure = if mean > 0.0 { EXPOSURE * BRIGHTNESS / mean } else { EXPOSURE };
                if wanted.exposure.is_none() && format != Format::Exr {
                    progress::note(&format!(
                        "light `{file}`: exposure {exposure:.3} from the mean radiance (set with --exposure)"
                    ));
                }
                (Lit::Around(Box::new(map)), exposure)
            }
        };
        let (folder, exposure) = (folder.to_owned(), wanted.exposure.unwrap_or(exposure));
        Ok(Self {
            wanted,
            folder,
            name,
            format,
            cover,
            density,
            mesh,
            view,
            projected,
            light,
            exposure,
            turn: 0.0,
            zoom: wanted.zoom,
        })
    }

    /// Moves the camera: rotation about the vertical in degrees, and magnification.
    pub(super) fn from(&mut self, turn: f32, zoom: f32) {
        (self.turn, self.zoom) = (turn, zoom);
    }

    /// Renders in passes and hands over each pass with its samples per pixel and noise.
    pub(super) fn refined(
        &self,
        watch: Watch<'_>,
        pass: &mut dyn FnMut(Image, u32, f32) -> Result<()>,
    ) -> Result<()> {
        let &Render { quality, size, spp, noise, seed, .. } = self.wanted;
        let Fineness { side, grain: (grain, most), .. } = quality.fineness();
        let side = size.unwrap_or(side);
        let sampling = Sampling { width: side, height: side, samples_per_pixel: spp.unwrap_or(most), seed };
        let goal = noise.unwrap_or(if spp.is_some() { 0.0 } else { grain });
        let mut draw = |scene: &Scene<'_, '_>, camera: Camera| {
            let goal = (goal, |x| self.shown(x));
            scene.refine(sampling, &camera, goal, watch, &mut *pass)
        };
        match &self.light {
            Lit::Lamps => self.by_lamps(sampling, &mut draw),
            Lit::Around(light) => self.staged(light.as_ref(), sampling, &mut draw),
        }
    }

    /// Renders bumps with the shading of the source, under lamps without shadows.
    fn by_lamps(
        &self,
        sampling: Sampling,
        draw: &mut dyn FnMut(&Scene<'_, '_>, Camera) -> Result<()>,
    ) -> Result<()> {
        let wanted = self.wanted;
        let mut request = RenderRequest::new(wanted.scene, self.density.ndf.as_ref(), sampling);
        if let Some(view) = self.view {
            (request.view, request.bumps.frequency) = (view, 24.0);
        }
        request.facets = Facets::Consistent(wanted.rule.unwrap_or(LevelOfDetail::Exact));
        (request.zoom, request.view) = (self.zoom, request.view.turned(self.turn));
        request.bumps = self.bumps(request.bumps);
        request.tint = hex(wanted.tint.unwrap_or(TINT));
        request.exposure = self.exposure;
        let shape = self.mesh.clone().unwrap_or_else(|| RenderRequest::shape(wanted.scene));
        let mut scene = request.scene(&shape)?;
        if let Some(Background::Color(rgb)) = wanted.background {
            scene.backdrop = Backdrop::Color(hex(rgb));
        }
        draw(&scene, request.camera())
    }

    /// Renders any material under an environment, with shadows.
    fn staged(
        &self,
        light: &dyn Surroundings,
        sampling: Sampling,
        draw: &mut dyn FnMut(&Scene<'_, '_>, Camera) -> Result<()>,
    ) -> Result<()> {
        let (wanted, set) = (self.wanted, self.wanted.scene);
        let around = wanted.light.is_some() || set == Set::Plane && self.mesh.is_none();
        let color = match wanted.background {
            Some(Background::Color(rgb)) => Some(hex(rgb)),
            None if !around => Some(backdrop()),
            _ => None,
        };
        // The background color is independent of exposure.
        let color = color.map(|color| color * EXPOSURE / self.exposure);
        let behind = |direction: Vec3| color.unwrap_or_else(|| light.radiance(direction));
        // Size a mesh so that patterns are clearly visible.
        let metres = match (&self.mesh, self.cover.chosen()) {
            (None, _) => set.metres(),
            (_, Some(Material::Brick)) => 1.2,
            (_, Some(Material::Wallpaper)) => 0.4,
            _ => Set::Sphere.metres(),
        };
        let view = self.view.unwrap_or_else(|| set.view()).turned(self.turn);
        let focus = view.focus.as_dvec3();
        // The windows of the car are given in world coordinates.
        let world = self.cover.chosen() != Some(Material::Bumps) || self.mesh.is_none() && set == Set::Car;
        let anchor = if world { DVec3::ZERO } else { focus };
        let mut objects = match (&self.mesh, &self.cover) {
            (Some(shape), Cover::File(materials)) => {
                vec![Object::painted(Arc::clone(shape), Arc::clone(materials))]
            }
            (None, Cover::File(_)) => return Err("the scene has no mesh".into()),
            (mesh, &Cover::Chosen(material)) => {
                let Made { surface, body } = self.subject(material, metres, anchor)?;
                let mut objects = match mesh {
                    Some(shape) => vec![Object::new(Arc::clone(shape), surface)],
                    None => set.objects(surface, &behind)?,
                };
                if matches!(material, Material::Glass | Material::Frosted) {
                    (objects[0].passes, objects[0].body) = (1.0, body);
                }
                objects
            }
        };
        objects[0].anchor = anchor;
        if let Some(Shape::Mesh(mesh)) = self.mesh.as_deref()
            && !wanted.no_ground
        {
            objects.push(ground(mesh.bottom(), &behind)?);
        }
        let backdrop = color.map_or(Backdrop::Light, Backdrop::Color);
        let scene = Scene::new(objects, Light::Around(light), backdrop).about(focus);
        draw(&scene, view.camera(self.zoom, sampling))
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

    /// Builds the subject's material, with the size of a scene unit in meters. Bumps receive
    /// positions relative to an anchor.
    fn subject(&self, material: Material, metres: f32, anchor: DVec3) -> Result<Made<'_>> {
        let wanted = self.wanted;
        if material != Material::Bumps {
            let parameters = Parameters::of(wanted, material)?;
            return parameters.make(material, metres / wanted.scale.unwrap_or(1.0), self.projected);
        }
        let usual = Bumps { frequency: 24.0, gain: 0.8, kind: NoiseKind::Gaussian, octaves: 16 };
        let (bumps, ndf) = (self.bumps(usual).field(wanted.seed, anchor)?, self.density.ndf.as_ref());
        let (rule, color) = (wanted.rule.unwrap_or(LevelOfDetail::Exact), hex(wanted.tint.unwrap_or(TINT)));
        Ok(Made { surface: Box::new(BumpMapped { ndf, bumps, rule, color }), body: None })
    }

    /// Converts a channel for display.
    fn shown(&self, radiance: f32) -> f32 {
        let exposed = radiance * self.exposure;
        srgb(
            match (&self.light, self.wanted.tone) {
                // The brightness of the lamps already includes the exposure.
                (Lit::Lamps, Some(Tone::Plain)) => radiance,
                (Lit::Lamps, _) => filmic(radiance),
                (Lit::Around(_), Some(Tone::Plain)) => exposed,
                (Lit::Around(_), _) => filmic(exposed),
            }
            .clamp(0.0, 1.0),
        )
    }

    /// Converts the image for its file format.
    pub(super) fn developed(&self, image: Image) -> Image {
        match (&self.light, self.wanted.tone) {
            _ if self.format == Format::Exr => image,
            (Lit::Lamps, Some(Tone::Plain)) => image,
            (Lit::Lamps, _) => image.filmic(1.0),
            (Lit::Around(_), Some(Tone::Plain)) => image.map(|p| p * self.exposure),
            (Lit::Around(_), _) => image.filmic(self.exposure),
        }
    }
}
