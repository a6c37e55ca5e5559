//! STL, binary and text.

use glam::Vec3;

use crate::geometry::mesh_file::{
    error::MeshFileError,
    triangle_soup::{Corner, TriangleSoup},
};

/// Bytes before the triangles of a binary file.
const HEADER: usize = 84;
/// Bytes of a triangle.
const TRIANGLE: usize = 50;

/// All triangles; the normals of the file are passed over, because they follow from its corners.
///
/// A file is binary if it is as long as its number of triangles asks: many begin with `solid` as text does.
pub(super) fn parse(bytes: &[u8]) -> Result<TriangleSoup, MeshFileError> {
    let count =
        bytes.get(80..HEADER).and_then(|n| n.try_into().ok()).map(u32::from_le_bytes).unwrap_or(0) as usize;
    let left = bytes.len().checked_sub(HEADER);
    let whole = left.zip(count.checked_mul(TRIANGLE)).is_some_and(|(left, length)| left >= length);
    let text = bytes.trim_ascii_start().starts_with(b"solid");
    // Some programs write blanks behind the last triangle.
    let binary = whole && (!text || bytes.len() == HEADER + count * TRIANGLE);
    if binary {
        let number = |bytes: &[u8]| bytes.try_into().map_or(f32::NAN, f32::from_le_bytes);
        let triangles = bytes[HEADER..].chunks_exact(TRIANGLE).take(count);
        // A normal comes before the corners.
        return soup(triangles.flat_map(|triangle| triangle[12..48].chunks_exact(4).map(number)));
    }
    if !text {
        return Err(MeshFileError::broken(
            "STL",
            format!("{} bytes do not hold {count} triangles", bytes.len()),
        ));
    }
    let text = String::from_utf8_lossy(bytes);
    let (mut words, mut numbers) = (text.split_whitespace(), Vec::new());
    while let Some(word) = words.next() {
        if word.eq_ignore_ascii_case("vertex") {
            let vertex = numbers.len() / 3;
            for _ in 0..3 {
                let number = words.next().and_then(|word| word.parse::<f32>().ok());
                let broken = || {
                    MeshFileError::broken(
                        "STL",
                        format!("vertex {vertex}, counted from 0, is not three numbers"),
                    )
                };
                numbers.push(number.ok_or_else(broken)?);
            }
        }
    }
    soup(numbers)
}

/// Triangles of coordinates by nines.
fn soup(coordinates: impl IntoIterator<Item = f32>) -> Result<TriangleSoup, MeshFileError> {
    let coordinates: Vec<f32> = coordinates.into_iter().collect();
    let (places, _) = coordinates.as_chunks::<3>();
    let corners = places.iter().map(|&p| Corner { position: Vec3::from(p).as_dvec3(), ..Default::default() });
    let mut soup = TriangleSoup { corners: corners.collect(), triangles: Vec::new() };
    if places.len() % 3 != 0 {
        return Err(MeshFileError::CornersLeft { corners: places.len() });
    }
    (0..places.len() as u32 / 3).try_for_each(|k| soup.push([0, 1, 2].map(|i| 3 * k + i)))?;
    Ok(soup)
}
