//! Wavefront OBJ.
//!
//! Specification: Wavefront Technologies 1995, "Object Files (.obj)", Advanced Visualizer manual,
//! appendix B1.

use std::{borrow::Cow, collections::HashMap};

use glam::{DVec3, Vec2, Vec3};

use crate::geometry::mesh_file::{
    error::MeshFileError,
    triangle_soup::{Corner, TriangleSoup},
};
use crate::input_file::{number, text};

/// Reads the faces of all objects. Materials, groups, vertex colors and weights are ignored.
/// Free-form surfaces are an error.
pub(super) fn parse(bytes: &[u8]) -> Result<TriangleSoup, MeshFileError> {
    let text = text(bytes);
    // An invalid vertex affects only the faces that use it. Invalid or absent normals and texture
    // coordinates affect none.
    let mut places: Vec<Result<DVec3, MeshFileError>> = Vec::new();
    let (mut uvs, mut normals): (Vec<Vec2>, Vec<Vec3>) = (Vec::new(), Vec::new());
    let mut soup = TriangleSoup::default();
    // Indices are resolved at the end, because a face may precede its vertices.
    let (mut faces, mut corners) = (Vec::new(), Vec::new());
    for (line, statement) in statements(&text) {
        let mut words = statement.split_whitespace();
        let keyword = words.next().unwrap_or_default();
        match keyword {
            "v" => places.push(numbers(line, "vertex", 3, words).map(DVec3::from_array)),
            "vt" => {
                let [u, v, _] = numbers(line, "texture coordinate", 1, words).unwrap_or_default();
                uvs.push(Vec2::new(u as f32, v as f32));
            }
            "vn" => {
                let normal = numbers(line, "normal", 3, words).unwrap_or_default();
                normals.push(DVec3::from_array(normal).as_vec3());
            }
            "f" | "fo" => {
                let (first, counts) = (corners.len(), [places.len(), uvs.len(), normals.len()]);
                for word in words {
                    corners.push(corner(line, word, counts)?);
                }
                faces.push((line, first..corners.len()));
            }
            "l" | "p" => soup.thin = true,
            "surf" | "bzp" | "bsp" | "cdc" | "cdp" | "call" => {
                return Err(broken(line, &format!("`{keyword}` is not supported (polygons only)")));
            }
            _ => {}
        }
    }
    if places.is_empty() && faces.is_empty() {
        return Err(MeshFileError::Lacks { what: "vertices" });
    }
    soup.thin |= faces.is_empty();
    let mut known: HashMap<[u32; 3], u32> = HashMap::new();
    let mut polygon = Vec::new();
    for (line, range) in faces {
        polygon.clear();
        for &indices in &corners[range] {
            let [v, vt, vn] = indices.map(|i| i as usize);
            let position = match places.get(v) {
                Some(Ok(place)) => *place,
                Some(Err(_)) => return places.swap_remove(v).map(|_| soup),
                None => return Err(no_such(line, v as i64 + 1, places.len())),
            };
            polygon.push(*known.entry(indices).or_insert_with(|| {
                soup.corners.push(Corner {
                    position,
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

/// Index of an absent attribute.
const ABSENT: u32 = u32::MAX;

/// Returns statements with line numbers, without comments. Lines that end in a backslash are joined
/// only for statements that are parsed, because names may be Windows paths.
fn statements(text: &str) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let lines = text.split('\n').flat_map(|line| line.strip_suffix('\r').unwrap_or(line).split('\r'));
    let mut lines = lines.map(trimmed).enumerate();
    std::iter::from_fn(move || {
        let (k, line) = lines.next()?;
        let mut statement = Cow::Borrowed(line);
        let read = ["v", "vt", "vn", "f", "fo", "l", "p"];
        let is_read = line.split_whitespace().next().is_some_and(|word| read.contains(&word));
        while is_read && statement.ends_with('\\') {
            let joined = statement.to_mut();
            joined.pop();
            let Some((_, next)) = lines.next() else { break };
            joined.push(' ');
            joined.push_str(next);
        }
        Some((k + 1, statement))
    })
}

/// Trims a line up to a number sign, without spaces, zero bytes and byte order marks of
/// concatenated files.
fn trimmed(line: &str) -> &str {
    let line = line.split('#').next().unwrap_or_default();
    line.trim_matches(|c: char| c.is_whitespace() || c == '\0' || c == '\u{feff}')
}

/// Parses at least `least` numbers of a statement, up to three. Missing numbers are 0.
fn numbers<'a>(
    line: usize,
    what: &str,
    least: usize,
    words: impl Iterator<Item = &'a str>,
) -> Result<[f64; 3], MeshFileError> {
    let (mut values, mut count) = ([0.0; 3], 0);
    for (value, word) in values.iter_mut().zip(words) {
        *value = number(word).ok_or_else(|| broken(line, &format!("`{word}` is not a number")))?;
        count += 1;
    }
    if count < least {
        let numbers = if least == 1 { "1 number".into() } else { format!("{least} numbers") };
        return Err(broken(line, &format!("a {what} must have {numbers}, got {count}")));
    }
    Ok(values)
}

/// Parses the indices `v`, `v/vt`, `v//vn` or `v/vt/vn` to indices counted from 0, given the number
/// of preceding elements. Missing texture coordinates and normals are treated as absent, because
/// many exporters write indices without the elements.
fn corner(line: usize, word: &str, above: [usize; 3]) -> Result<[u32; 3], MeshFileError> {
    let mut indices = [ABSENT; 3];
    for (k, text) in word.split('/').enumerate().take(3) {
        if text.is_empty() && k > 0 {
            continue;
        }
        let index: i64 = text.parse().map_err(|_| broken(line, &format!("invalid face corner `{word}`")))?;
        let from_0 = if index < 0 { index.saturating_add(above[k] as i64) } else { index - 1 };
        match u32::try_from(from_0).ok().filter(|&found| found != ABSENT) {
            Some(found) => indices[k] = found,
            None if k > 0 => {}
            None => return Err(no_such(line, index, above[k])),
        }
    }
    Ok(indices)
}

fn no_such(line: usize, index: i64, count: usize) -> MeshFileError {
    MeshFileError::NoSuchIndex { line, index, count }
}

fn broken(line: usize, error: &str) -> MeshFileError {
    MeshFileError::broken("OBJ", format!("line {line}: {error}"))
}
