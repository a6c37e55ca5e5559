//! Images of the live page compared with the crates: a browser's render of the teapot and its
//! reported camera.

use std::fs;
use std::path::Path;

use asperity_render::geometry::teapot::teapot;
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::{BumpField, Footprint, Frame};
use glam::{DVec3, Vec2, Vec3};
use serde::Deserialize;

use crate::picture::{
    Look, difference, png, reference,
    scene::{Corner, Scene, View},
};

/// Camera, lamp and appearance of an image.
#[derive(Deserialize)]
struct Described {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    half: f64,
    light: DVec3,
    focus: DVec3,
    settings: Settings,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Settings {
    shape: String,
    density: String,
    rule: String,
    alpha_x: f32,
    alpha_y: f32,
    frequency: f32,
    gain: f32,
    lacunarity: f32,
    seed: u32,
    share: f32,
    exposure: f32,
}

/// Maximum fraction of pixels that may differ by more than 2 of 255.
const SHARE: f64 = 1e-3;

/// Compares every image `*.rgba` in a folder with the crates' render of its `*.json`, and writes
/// both as PNG.
pub(crate) fn run(folder: &Path) -> Result<(), String> {
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", folder.display());
    let mut files: Vec<_> = fs::read_dir(folder)
        .map_err(|error| failed(&error))?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "rgba"))
        .collect();
    files.sort();
    if files.is_empty() {
        return Err(failed(&"no .rgba files"));
    }
    println!("| picture | pixels that differ by more than 2 of 255 |\n|---|---|");
    let mut broken = vec![];
    for file in files {
        let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let share = compared(&file).map_err(|error| format!("{}: {error}", file.display()))?;
        println!("| {name} | {:.3} % |", 100.0 * share);
        if share > SHARE {
            broken.push(name);
        }
    }
    if broken.is_empty() { Ok(()) } else { Err(format!("{} differ from the crates", broken.join(", "))) }
}

/// Returns the fraction of pixels of an image that differ from the crates by more than 2 of 255.
fn compared(file: &Path) -> Result<f64, String> {
    let bytes = fs::read(file).map_err(|error| error.to_string())?;
    let theirs: Vec<[u8; 3]> = bytes.chunks_exact(4).map(|rgba| [rgba[0], rgba[1], rgba[2]]).collect();
    let size = theirs.len().isqrt() as u32;
    if (size * size) as usize != theirs.len() || size == 0 {
        return Err(format!("{} pixels do not form a square", theirs.len()));
    }
    let text = fs::read_to_string(file.with_extension("json")).map_err(|error| error.to_string())?;
    let described: Described = serde_json::from_str(&text).map_err(|error| error.to_string())?;
    let settings = &described.settings;
    let asked = [settings.shape.as_str(), &settings.density, &settings.rule];
    if asked != ["teapot", "ggx", "exact"] {
        return Err(format!(
            "only the teapot with GGX and the exact rule is supported, got {}",
            asked.join(", ")
        ));
    }
    let look = Look {
        alpha: Vec2::new(settings.alpha_x, settings.alpha_y),
        frequency: settings.frequency,
        share: settings.share,
        exposure: settings.exposure,
    };
    let spectrum =
        FbmSpectrum::new(settings.lacunarity, settings.gain, 16).map_err(|error| error.to_string())?;
    let at: [f64; 3] = (described.focus * f64::from(look.frequency)).into();
    let octaves = GaussianFbm::<Vec3>::new(GaussianNoise::new(settings.seed), spectrum).anchored(at);
    let bumps = BumpField::new(octaves, look.frequency).map_err(|error| error.to_string())?;
    let scene = scene(&described, size);
    let seen = |corner: &Corner, frame: &Frame, pixel: Footprint| {
        bumps.coordinates(corner.position.as_vec3(), frame, pixel)
    };
    let ours = reference::picture(&scene, &look, seen, size)?;
    png(&file.with_extension("png"), size, &[vec![&theirs, &ours]])?;
    let off = ours.iter().zip(&theirs).filter(|(a, b)| difference(**a, **b) > 2).count();
    Ok(off as f64 / theirs.len() as f64)
}

fn scene(described: &Described, size: u32) -> Scene {
    let Described { eye, right, up, forward, half, light, focus, .. } = *described;
    let mesh = teapot();
    let triangles = mesh.triangles.iter().map(|corners| {
        corners.map(|i| {
            let vertex = mesh.vertices[i as usize];
            let [position, normal, tangent] =
                [vertex.position, vertex.normal, vertex.tangent].map(Vec3::as_dvec3);
            Corner { position: position - focus, normal, tangent, uv: vertex.uv.as_dvec2() }
        })
    });
    let pixel_angle = 2.0 * half / f64::from(size);
    Scene {
        triangles: triangles.collect(),
        view: View { eye, right, up, forward, pixel_angle, light },
        focus,
    }
}
