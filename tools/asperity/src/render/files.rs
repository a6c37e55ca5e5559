//! Loads meshes and environment maps from files.

use std::path::Path;

use asperity_render::geometry::mesh_file::{Placement, materials::MeshMaterials};
use asperity_render::geometry::{mesh::TracedMesh, mesh_file};
use asperity_render::image::content::Content;
use asperity_render::image::read::ImageFile;
use asperity_render::image::tone::linear;
use asperity_shading::EnvironmentMap;
use glam::Vec3;

use crate::cli::render::{Material, Render};
use crate::failure::{Failure, Result};
use crate::progress;

/// Minimum angle in degrees between triangles at which an edge stays sharp.
const CREASE: f32 = 40.0;

/// A mesh of a file.
pub(super) struct Opened {
    pub(super) mesh: TracedMesh,
    /// Whether it has texture coordinates.
    pub(super) uv: bool,
    /// The materials of the file, if no other is chosen and the file has some.
    pub(super) materials: Option<MeshMaterials>,
    pub(super) place: Placement,
}

/// Loads a mesh.
pub(super) fn opened(file: &Path, wanted: &Render) -> Result<Opened> {
    let failed = |error: &dyn std::fmt::Display| Failure::from(format!("mesh `{}`: {error}", file.display()));
    let stl = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("stl"));
    let up = wanted.up.unwrap_or(if stl { mesh_file::Up::Z } else { mesh_file::Up::Y });
    let crease = wanted.crease.unwrap_or(CREASE);
    let reading = mesh_file::MeshReading { up, crease, materials: wanted.material.is_none() };
    let mesh_file::MeshFile { mesh, normals, uv, thin, left_out, materials, ignored, place } =
        mesh_file::open(file, reading).map_err(|error| failed(&error))?;
    if normals && wanted.crease.is_some() {
        return Err(failed(&"`--crease` has no effect because the mesh has normals"));
    }
    let name = file.display();
    if thin {
        progress::note(&format!("mesh `{name}`: points and lines are ignored"));
    }
    if left_out {
        progress::note(&format!(
            "mesh `{name}`: ignored incomplete triangles or triangles with missing vertices"
        ));
    }
    if !normals {
        progress::note(&format!(
            "mesh `{name}` has no normals: smoothed up to a crease angle of {crease}° (set with --crease)"
        ));
    }
    if !ignored.is_empty() {
        let features = ignored.join(", ");
        progress::note(&format!("mesh `{name}`: ignored features of its materials: {features}"));
    }
    let patterned = wanted.material.is_some_and(patterned);
    if patterned && uv {
        progress::note(&format!("mesh `{name}`: the pattern uses texture coordinates, scaled to lengths"));
    } else if patterned {
        progress::note(&format!("mesh `{name}` has no texture coordinates: using triplanar mapping"));
    }
    Ok(Opened { mesh: TracedMesh::new(mesh), uv, materials, place })
}

/// Whether a material has a pattern in texture coordinates.
pub(super) fn patterned(material: Material) -> bool {
    matches!(material, Material::Carpet | Material::Scratched | Material::Brick | Material::Wallpaper)
}

/// Reads an environment map from an image file.
pub(super) fn surroundings(file: &Path) -> Result<EnvironmentMap> {
    let name = file.display();
    let fail = |error: &dyn std::fmt::Display| Failure::from(format!("light `{name}`: {error}"));
    let image = ImageFile::open(file, Content::Colors).map_err(|error| fail(&error))?;
    let [r, g, b] = image.colors();
    let (width, height) = (image.width, image.height);
    if width.abs_diff(2 * height) > height / 50 {
        progress::note(&format!(
            "light `{name}`: {width} × {height} pixels are mapped to the whole sphere (latitude\u{2013}longitude images are 2 : 1)"
        ));
    }
    // 8-bit images are encoded for a screen.
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
            "light `{name}`: clamped {wrong} texels ({share:.3} %) that were NaN, negative or above 65504"
        ));
    }
    EnvironmentMap::new(image.width, image.height, texels).map_err(|error| fail(&error))
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;
    use asperity_render::image::{Format, Image};
    use asperity_shading::Environment;

    use super::*;

    #[test]
    fn surroundings_clamp_negative_values() {
        let scratch = tempfile::tempdir().unwrap();
        let file = scratch.path().join("rings.exr");
        let ringing = Image::from_fn(16, 8, |x, _| match x {
            0 => Vec3::new(-0.25, 1.0, 2.0),
            1 => Vec3::new(f32::NAN, f32::INFINITY, 0.0),
            _ => Vec3::ONE,
        });
        std::fs::write(&file, ringing.encode(Format::Exr).unwrap()).unwrap();
        let map = surroundings(&file).unwrap();
        let all = (0..64).map(|k| {
            map.radiance(Vec3::new((f32::from(k as u8) * 0.1).cos(), (f32::from(k as u8) * 0.1).sin(), 0.0))
        });
        assert!(all.into_iter().all(|light| light.min_element() >= 0.0 && light.max_element() <= 65_504.0));
    }

    #[test]
    fn surroundings_read_images_and_report_broken_files() {
        let scratch = tempfile::tempdir().unwrap();
        let sky = Image::from_fn(16, 8, |_, y| Vec3::new(3.0, 2.0, y as f32));
        let file = scratch.path().join("sky.exr");
        std::fs::write(&file, sky.encode(Format::Exr).unwrap()).unwrap();
        let map = surroundings(&file).unwrap();
        assert_abs_diff_eq!(map.radiance(Vec3::X), Vec3::new(3.0, 2.0, 3.5), epsilon = 0.01);
        std::fs::write(&file, b"no image").unwrap();
        let error = surroundings(&file).err().unwrap().to_string();
        let whole = error.starts_with("light `") && error.contains("sky.exr") && !error.contains('\n');
        assert!(whole, "{error}");
    }
}
