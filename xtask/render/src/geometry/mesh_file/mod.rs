//! Meshes from files: Wavefront OBJ, PLY and binary glTF, each centred on the origin and scaled into the unit ball.

mod error;
mod glb;
mod obj;
mod ply;
mod polygon;
#[cfg(test)]
mod tests;
mod triangle_soup;

use std::{fs::File, io::Read, path::Path};

pub use self::error::MeshFileError;
pub use self::triangle_soup::Up;
use self::{error::MOST_BYTES, triangle_soup::TriangleSoup};
use crate::geometry::mesh::Mesh;

/// Reads the mesh of a file by its extension, and turns its `up` to z.
///
/// Data that the file does not give are computed: normals by the angles of the triangles around a point,
/// tangents along ∂P/∂u. Triangles without area are left out.
pub fn open(path: &Path, up: Up) -> Result<Mesh, MeshFileError> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    let parse = match extension.as_deref() {
        Some("obj") => obj::parse,
        Some("ply") => ply::parse,
        Some("glb") => glb::parse,
        _ => return Err(MeshFileError::UnknownExtension),
    };
    let unreadable = |error| MeshFileError::Unreadable { error };
    let file = File::open(path).map_err(unreadable)?;
    let metadata = file.metadata().map_err(unreadable)?;
    if !metadata.is_file() {
        return Err(MeshFileError::NotAFile);
    }
    let mut bytes = Vec::new();
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(MeshFileError::TooLong { bytes: metadata.len() });
    }
    mesh(parse, &bytes, up)
}

type Parser = fn(&[u8]) -> Result<TriangleSoup, MeshFileError>;

fn mesh(parse: Parser, bytes: &[u8], up: Up) -> Result<Mesh, MeshFileError> {
    if bytes.is_empty() {
        return Err(MeshFileError::Empty);
    }
    parse(bytes)?.into_mesh(up)
}
