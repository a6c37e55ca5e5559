//! Wavefront OBJ, by `tobj`.

use std::io::Cursor;

use glam::Vec3;

use crate::geometry::mesh_file::{
    error::MeshFileError,
    triangle_soup::{Corner, TriangleSoup},
};

/// All faces of all objects. Materials, lines and points are passed over.
pub(super) fn parse(bytes: &[u8]) -> Result<TriangleSoup, MeshFileError> {
    // Comments and names may be in any encoding.
    let text = faces_alone(&String::from_utf8_lossy(bytes));
    check_indices(&text)?;
    let options =
        tobj::LoadOptions { single_index: true, triangulate: false, ignore_points: true, ignore_lines: true };
    let mut reader = Cursor::new(text.as_bytes());
    let loaded = tobj::load_obj_buf(&mut reader, &options, |_| Ok(Default::default()));
    let (models, _) = loaded.map_err(|error| {
        // The loader stops behind the line that it refuses.
        let behind = &text.as_bytes()[..reader.position() as usize];
        let line =
            behind.iter().filter(|&&byte| byte == b'\n').count() + usize::from(!behind.ends_with(b"\n"));
        MeshFileError::broken("OBJ", format!("line {line}: {error}"))
    })?;
    let mut soup = TriangleSoup::default();
    for model in &models {
        append(&mut soup, &model.mesh)?;
    }
    Ok(soup)
}

fn append(soup: &mut TriangleSoup, mesh: &tobj::Mesh) -> Result<(), MeshFileError> {
    let first = soup.corners.len();
    let (places, _) = mesh.positions.as_chunks::<3>();
    let ((normals, _), (uv, _)) = (mesh.normals.as_chunks::<3>(), mesh.texcoords.as_chunks::<2>());
    // Where a corner has none, the loader leaves a gap that nothing tells: then the model has none.
    let normals = if normals.len() == places.len() { normals } else { &[] };
    let uv = if uv.len() == places.len() { uv } else { &[] };
    soup.corners.extend(places.iter().enumerate().map(|(k, &place)| Corner {
        position: Vec3::from(place).as_dvec3(),
        normal: normals.get(k).copied().unwrap_or_default().into(),
        uv: uv.get(k).copied().unwrap_or_default().into(),
    }));
    let mut corners = mesh.indices.iter().map(|&i| first as u32 + i);
    // No list of arities: triangles only.
    let arities = mesh.face_arities.iter().map(|&n| n as usize).chain(std::iter::repeat(3));
    let faces = arities.map(|arity| corners.by_ref().take(arity).collect::<Vec<_>>());
    faces.take_while(|face| !face.is_empty()).try_for_each(|face| soup.push_polygon(&face))
}

/// The text without lines of points, which the loader takes for faces when they have three or more.
fn faces_alone(text: &str) -> String {
    let kept = |line| if str::split_whitespace(line).next() == Some("l") { "" } else { line };
    text.lines().flat_map(|line| [kept(line), "\n"]).collect()
}

/// Refuses indices that name nothing. The loader says so only for vertices, and computes with the others unchecked.
fn check_indices(text: &str) -> Result<(), MeshFileError> {
    const KINDS: [(&str, &str); 3] = [("v", "vertex"), ("vt", "texture coordinate"), ("vn", "normal")];
    let kind = |line: &str| {
        let word = line.split_whitespace().next();
        KINDS.iter().position(|&(own, _)| word == Some(own))
    };
    let mut all = [0_usize; 3];
    text.lines().filter_map(kind).for_each(|k| all[k] += 1);
    let mut before = [0_usize; 3];
    for (number, line) in text.lines().enumerate() {
        if let Some(k) = kind(line) {
            before[k] += 1;
        }
        let mut words = line.split_whitespace();
        if words.next() != Some("f") {
            continue;
        }
        for word in words {
            for (k, index) in word.split('/').enumerate().take(3) {
                // What is no number is the loader's to refuse.
                let Ok(index) = index.parse::<i64>() else { continue };
                let most = if index < 0 { before[k] } else { all[k] };
                if index == 0 || index.unsigned_abs() > most as u64 {
                    let what = KINDS[k].1;
                    return Err(MeshFileError::NoSuchIndex { line: number + 1, what, index, count: most });
                }
            }
        }
    }
    Ok(())
}
