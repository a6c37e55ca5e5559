//! Wavefront OBJ.
//!
//! Specification: Wavefront Technologies 1995, "Object Files (.obj)", Advanced Visualizer manual, appendix B1.

use std::collections::HashMap;

use glam::{DVec3, Vec2, Vec3};

use crate::geometry::mesh_file::{
    error::MeshFileError,
    triangle_soup::{Corner, TriangleSoup},
};
use crate::input_file::{number, text};

/// Reads the faces of all objects. Materials, groups, vertex colors and weights are ignored, free-form surfaces are refused.
pub(super) fn parse(bytes: &[u8]) -> Result<TriangleSoup, MeshFileError> {
    let text = text(bytes);
    // A broken vertex matters only to the faces that use it.
    let mut places: Vec<Result<DVec3, MeshFileError>> = Vec::new();
    let (mut uvs, mut normals): (Vec<Vec2>, Vec<Vec3>) = (Vec::new(), Vec::new());
    let mut soup = TriangleSoup::default();
    // Indices are resolved at the end: a face may come before its vertices.
    let (mut faces, mut corners) = (Vec::new(), Vec::new());
    for (line, statement) in statements(&text) {
        let mut words = statement.split_whitespace();
        let keyword = words.next().unwrap_or_default();
        match keyword {
            "v" => places.push(numbers(line, "vertex", 3, words).map(DVec3::from_array)),
            "vt" => {
                let [u, v, _] = numbers(line, "texture coordinate", 1, words)?;
                uvs.push(Vec2::new(u as f32, v as f32));
            }
            "vn" => normals.push(DVec3::from_array(numbers(line, "normal", 3, words)?).as_vec3()),
            "f" | "fo" => {
                let (first, counts) = (corners.len(), [places.len(), uvs.len(), normals.len()]);
                for word in words {
                    corners.push(corner(line, word, counts)?);
                }
                faces.push((line, first..corners.len()));
            }
            "l" | "p" => soup.thin = true,
            "surf" | "bzp" | "bsp" | "cdc" | "cdp" | "call" => {
                return Err(broken(line, format!("`{keyword}` is not supported, only polygons are")));
            }
            _ => {}
        }
    }
    soup.thin |= faces.is_empty() && !places.is_empty();
    // Many exporters number texture coordinates and normals that they do not write.
    let counts = [places.len(), uvs.len(), normals.len()];
    let kept = [true, !uvs.is_empty(), !normals.is_empty()];
    let mut known: HashMap<[u32; 3], u32> = HashMap::new();
    let mut polygon = Vec::new();
    for (line, range) in faces {
        polygon.clear();
        for indices in &corners[range] {
            let indices = std::array::from_fn(|k| if kept[k] { indices[k] } else { ABSENT });
            if let Some(k) = (0..3).find(|&k| indices[k] != ABSENT && indices[k] as usize >= counts[k]) {
                return Err(no_such(line, k, i64::from(indices[k]) + 1, counts[k]));
            }
            let [v, vt, vn] = indices.map(|i| i as usize);
            if places[v].is_err() {
                return places.swap_remove(v).map(|_| soup);
            }
            polygon.push(*known.entry(indices).or_insert_with(|| {
                soup.corners.push(Corner {
                    position: *places[v].as_ref().unwrap_or(&DVec3::NAN),
                    normal: normals.get(vn).copied().unwrap_or_default(),
                    uv: uvs.get(vt).copied().unwrap_or_default(),
                });
                soup.corners.len() as u32 - 1
            }));
        }
        soup.push_polygon(&polygon)?;
    }
    Ok(soup)
}

/// An index that a corner does not have.
const ABSENT: u32 = u32::MAX;

/// Statements with the numbers of their lines, without comments; lines that end in a backslash are joined.
fn statements(text: &str) -> impl Iterator<Item = (usize, String)> {
    // Files of the classic Mac OS have no line feeds.
    let end = if text.contains('\n') { '\n' } else { '\r' };
    let mut lines = text.split(end).enumerate();
    std::iter::from_fn(move || {
        let (k, line) = lines.next()?;
        let mut statement = without_comment(line).to_owned();
        while statement.ends_with('\\') {
            statement.pop();
            let Some((_, next)) = lines.next() else { break };
            statement.push(' ');
            statement.push_str(without_comment(next));
        }
        Some((k + 1, statement))
    })
}

/// The line up to a number sign. A path of Windows at its end joins nothing.
fn without_comment(line: &str) -> &str {
    let line = line.split('#').next().unwrap_or_default().trim();
    let name = ["o ", "g ", "mtllib ", "usemtl "].iter().any(|word| line.starts_with(word));
    if name { line.trim_end_matches('\\') } else { line }
}

/// At least so many numbers of a statement, up to three; those that are not given are 0.
fn numbers<'a>(
    line: usize,
    what: &str,
    least: usize,
    words: impl Iterator<Item = &'a str>,
) -> Result<[f64; 3], MeshFileError> {
    let (mut values, mut count) = ([0.0; 3], 0);
    for (value, word) in values.iter_mut().zip(words) {
        *value = number(word).ok_or_else(|| broken(line, format!("`{word}` is not a number")))?;
        count += 1;
    }
    if count < least {
        let numbers = if least == 1 { "1 number".into() } else { format!("{least} numbers") };
        return Err(broken(line, format!("a {what} must have {numbers}, got {count}")));
    }
    Ok(values)
}

/// The indices `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 0, where so many are above.
fn corner(line: usize, word: &str, above: [usize; 3]) -> Result<[u32; 3], MeshFileError> {
    let mut indices = [ABSENT; 3];
    for (k, text) in word.split('/').enumerate().take(3) {
        if text.is_empty() && k > 0 {
            continue;
        }
        let index: i64 = text.parse().map_err(|_| broken(line, format!("`{word}` is not a face corner")))?;
        let from_0 = if index < 0 { index.saturating_add(above[k] as i64) } else { index - 1 };
        // An index beyond all lists is refused with the others.
        let found = u32::try_from(from_0.min(i64::from(ABSENT) - 1));
        match found {
            Ok(found) => indices[k] = found,
            // Of what the file does not have at all, every index is ignored.
            Err(_) if k > 0 && above[k] == 0 && index != 0 => {}
            Err(_) => return Err(no_such(line, k, index, above[k])),
        }
        if i64::from(indices[k]) < from_0 {
            return Err(no_such(line, k, index, above[k]));
        }
    }
    Ok(indices)
}

fn no_such(line: usize, k: usize, index: i64, count: usize) -> MeshFileError {
    MeshFileError::NoSuchIndex { line, what: ["vertex", "texture coordinate", "normal"][k], index, count }
}

fn broken(line: usize, error: String) -> MeshFileError {
    MeshFileError::broken("OBJ", format!("line {line}: {error}"))
}
