//! STL, binary and text.

use glam::{DVec3, Vec3};

use crate::geometry::mesh_file::{
    error::MeshFileError,
    triangle_soup::{Corner, TriangleSoup},
};
use crate::input_file::{number, text};

/// Bytes before the triangles of a binary file.
const HEADER: usize = 84;
/// Bytes per triangle.
const TRIANGLE: usize = 50;

/// Reads all facets. Their normals are ignored, because they follow from the corners.
pub(super) fn parse(bytes: &[u8]) -> Result<TriangleSoup, MeshFileError> {
    let count = bytes.get(80..HEADER).map_or(0, |n| n.iter().rev().fold(0, |n, &b| n << 8 | usize::from(b)));
    let holds = bytes.len().saturating_sub(HEADER) / TRIANGLE;
    let long_enough = bytes.len() >= HEADER && holds >= count;
    // Many binary files begin with `solid`, and some have spaces after their last triangle.
    let exact = long_enough && bytes.len() == HEADER + count * TRIANGLE;
    let as_text = text(bytes);
    if !exact && is_text(&as_text) {
        return facets(&as_text);
    }
    // A binary header may contain any bytes, but text continues after it.
    let printed = |&byte: &u8| byte.is_ascii_graphic() || byte.is_ascii_whitespace();
    if bytes.len() > HEADER && !exact && bytes.iter().take(512).all(printed) {
        return Err(MeshFileError::broken("STL", "text does not begin with `solid`"));
    }
    if bytes.len() < HEADER {
        let error = "file neither begins with `solid` nor has a header of 84 bytes";
        return Err(MeshFileError::broken("STL", error));
    }
    if !long_enough {
        let held = format!("header claims {count} triangles, but {} bytes hold {holds}", bytes.len());
        return Err(MeshFileError::broken("STL", held));
    }
    // Streaming writers leave the count at 0.
    let count = if count == 0 { holds } else { count };
    let mut soup = TriangleSoup { left_out: holds > count, ..TriangleSoup::default() };
    for triangle in bytes[HEADER..].chunks_exact(TRIANGLE).take(count) {
        let corners = triangle[12..48].as_chunks::<12>().0;
        let coordinate = |corner: &[u8; 12], k: usize| {
            f32::from_le_bytes([corner[k], corner[k + 1], corner[k + 2], corner[k + 3]])
        };
        let place = |corner| Vec3::from_array([0, 4, 8].map(|k| coordinate(corner, k))).as_dvec3();
        push(&mut soup, corners.iter().map(place))?;
    }
    Ok(soup)
}

/// Whether the file begins with the word `solid`, and has either no zero bytes, which binary
/// numbers contain, or the words of facets.
fn is_text(text: &str) -> bool {
    let start = text.trim_start();
    let solid = start.get(..5).is_some_and(|word| word.eq_ignore_ascii_case("solid"));
    let head: String = start.chars().take(4096).map(|c| c.to_ascii_lowercase()).collect();
    solid && (!head.contains('\0') || head.contains("facet") && head.contains("vertex"))
}

/// Returns the facets after the name of a solid on the same line. The name may contain any word.
fn one_line(line: &str) -> Option<&str> {
    let lower = line.to_ascii_lowercase();
    lower.match_indices("facet").map(|(at, _)| at).find_map(|at| {
        let mut words = lower[at..].split_whitespace().skip(1);
        let facet = words.next() == Some("normal") && words.by_ref().take(3).filter_map(number).count() == 3;
        facet.then(|| &line[at..])
    })
}

/// Parses the facets of a text. Names of solids may contain any word.
fn facets(text: &str) -> Result<TriangleSoup, MeshFileError> {
    let mut soup = TriangleSoup::default();
    let (mut corners, mut vertices) = (Vec::new(), 0_usize);
    // A truncated file has no end.
    soup.left_out = true;
    for line in text.split(['\n', '\r']) {
        let first = line.split_whitespace().next().unwrap_or_default();
        let named = ["solid", "endsolid"].iter().any(|word| first.eq_ignore_ascii_case(word));
        soup.left_out &= !line.to_ascii_lowercase().contains("endsolid");
        let line = if named { one_line(line).unwrap_or_default() } else { line };
        let mut words = line.split_whitespace();
        while let Some(word) = words.next() {
            if word.eq_ignore_ascii_case("vertex") {
                let place = [(); 3].map(|()| words.next().and_then(number));
                let [Some(x), Some(y), Some(z)] = place else {
                    let error = format!("vertex {vertices} (counted from 0) does not have three numbers");
                    return Err(MeshFileError::broken("STL", error));
                };
                corners.push(DVec3::new(x, y, z));
                vertices += 1;
            } else if ["endloop", "endfacet", "facet"].iter().any(|end| word.eq_ignore_ascii_case(end)) {
                finish(&mut soup, &mut corners)?;
            }
        }
    }
    finish(&mut soup, &mut corners)?;
    Ok(soup)
}

/// Appends a facet. Some programs write polygons.
fn finish(soup: &mut TriangleSoup, corners: &mut Vec<DVec3>) -> Result<(), MeshFileError> {
    match corners.len() {
        0 => Ok(()),
        n @ 1..=2 => Err(MeshFileError::CornersLeft { corners: n }),
        _ => push(soup, corners.drain(..)),
    }
}

fn push(soup: &mut TriangleSoup, places: impl Iterator<Item = DVec3>) -> Result<(), MeshFileError> {
    let first = soup.corners.len() as u32;
    soup.corners.extend(places.map(|position| Corner { position, ..Default::default() }));
    soup.push_polygon(&(first..soup.corners.len() as u32).collect::<Vec<_>>())
}
