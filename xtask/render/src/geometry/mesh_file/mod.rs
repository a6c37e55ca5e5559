//! Meshes from files: Wavefront OBJ, PLY, STL and glTF, each centred on the origin and scaled into the unit ball.

mod draco;
mod error;
mod glb;
mod obj;
mod ply;
mod polygon;
mod stl;
#[cfg(test)]
mod tests;
mod triangle_soup;

use std::{fs::File, io::Read, path::Path};

pub use self::error::MeshFileError;
pub use self::triangle_soup::{MeshFile, MeshReading, Up};
use self::{error::MOST_BYTES, triangle_soup::TriangleSoup};

/// Reads the mesh of a file by its extension, and turns what is up to z.
///
/// Data that the file does not give are computed: normals by the angles of the triangles around a point that are no crease
/// apart, tangents along ∂P/∂u. Triangles without area are left out. Texture coordinates are scaled so that their
/// unit is a unit of length, in the mean over the surface.
pub fn open(path: &Path, reading: MeshReading) -> Result<MeshFile, MeshFileError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let gltf = |bytes: &[u8]| glb::parse(bytes, folder);
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    let parse: &Parser<'_> = match extension.as_deref() {
        Some("obj") => &obj::parse,
        Some("ply") => &ply::parse,
        Some("stl") => &stl::parse,
        Some("glb" | "gltf") => &gltf,
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
    mesh(parse, &bytes, reading)
}

type Parser<'a> = dyn Fn(&[u8]) -> Result<TriangleSoup, MeshFileError> + 'a;

fn mesh(parse: &Parser<'_>, bytes: &[u8], reading: MeshReading) -> Result<MeshFile, MeshFileError> {
    if bytes.is_empty() {
        return Err(MeshFileError::Empty);
    }
    parse(bytes)?.into_mesh(reading)
}
