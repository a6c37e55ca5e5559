//! Meshes and light of files.

use std::path::Path;

use asperity_render::geometry::{mesh::TracedMesh, mesh_file};
use asperity_render::image::content::Content;
use asperity_render::image::read::ImageFile;
use asperity_render::image::tone::linear;
use asperity_shading::EnvironmentMap;
use glam::Vec3;

use asperity::cli::Render;
use asperity::failure::{Failure, Result};
use asperity::progress;

/// Degrees between triangles from which on there is an edge.
const CREASE: f32 = 40.0;

/// The mesh of a file, and whether it has texture coordinates.
pub(super) fn opened(file: &Path, wanted: &Render, patterned: bool) -> Result<(TracedMesh, bool)> {
    let failed = |error: &dyn std::fmt::Display| Failure::from(format!("mesh `{}`: {error}", file.display()));
    let stl = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("stl"));
    let up = wanted.up.unwrap_or(if stl { mesh_file::Up::Z } else { mesh_file::Up::Y });
    let crease = wanted.crease.unwrap_or(CREASE);
    let mesh_file::MeshFile { mesh, normals, uv, thin, left_out } =
        mesh_file::open(file, mesh_file::MeshReading { up, crease }).map_err(|error| failed(&error))?;
    if normals && wanted.crease.is_some() {
        return Err(failed(&"it has normals of its own, so --crease would change nothing"));
    }
    let name = file.display();
    if thin {
        progress::note(&format!("mesh `{name}`: its points and lines are not drawn"));
    }
    if left_out {
        progress::note(&format!(
            "mesh `{name}`: incomplete triangles, or with vertices that do not exist, are not drawn"
        ));
    }
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
pub(super) fn surroundings(file: &Path) -> Result<EnvironmentMap> {
    let name = file.display();
    let fail = |error: &dyn std::fmt::Display| Failure::from(format!("light `{name}`: {error}"));
    let image = ImageFile::open(file, Content::Colors).map_err(|error| fail(&error))?;
    let [r, g, b] = image.colors();
    let (width, height) = (image.width, image.height);
    if width.abs_diff(2 * height) > height / 50 {
        progress::note(&format!(
            "light `{name}`: its {width} × {height} pixels cover the whole sphere; latitude\u{2013}longitude images are 2 : 1"
        ));
    }
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
            "light `{name}`: {wrong} texels ({share:.3} %) that are NaN, below 0 or beyond 65504 were cut off"
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
    fn light_that_rings_below_0_is_cut_off_there() {
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
    fn an_image_of_the_surroundings_is_read_and_a_broken_one_named() {
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
