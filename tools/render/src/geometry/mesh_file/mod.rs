//! Meshes from Wavefront OBJ, PLY, STL and glTF files, each centered on the origin and scaled into
//! the unit ball.

mod draco;
mod error;
pub mod gltf;
pub mod materials;
mod obj;
#[cfg(test)]
mod painted_files;
mod ply;
mod polygon;
#[cfg(test)]
mod real_files;
mod stl;
#[cfg(test)]
mod tests;
mod triangle_soup;

use std::path::Path;

pub use self::error::MeshFileError;
pub use self::triangle_soup::{MeshFile, MeshReading, Placement, Up};
use self::{error::MOST_BYTES, triangle_soup::TriangleSoup};
use crate::input_file;

/// Reads a mesh file by its extension, with the up axis rotated to z.
///
/// Missing data is computed. Normals are angle-weighted means of the triangles around a point that
/// are within the crease angle, and tangents follow ∂P/∂u. Triangles of zero area are omitted.
/// Texture coordinates are scaled so that their unit is a unit of length, averaged over the
/// surface.
pub fn open(path: &Path, reading: MeshReading) -> Result<MeshFile, MeshFileError> {
    let format = Format::of(path).ok_or(MeshFileError::UnknownExtension)?;
    let bytes = input_file::read(path, MOST_BYTES).map_err(|error| MeshFileError::Unreadable { error })?;
    decode(format, &bytes, path.parent().unwrap_or(Path::new("")), reading)
}

/// The supported formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Obj,
    Ply,
    Stl,
    /// In one file, or with its buffers next to it.
    Gltf,
}

impl Format {
    /// Returns the format of a file by its extension.
    fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_string_lossy().to_ascii_lowercase();
        Some(match &*extension {
            "obj" => Self::Obj,
            "ply" => Self::Ply,
            "stl" => Self::Stl,
            "glb" | "gltf" => Self::Gltf,
            _ => return None,
        })
    }
}

/// Decodes a mesh from bytes, like [`open`]. Other files it refers to are in `folder`.
pub fn decode(
    format: Format,
    bytes: &[u8],
    folder: &Path,
    reading: MeshReading,
) -> Result<MeshFile, MeshFileError> {
    let gltf = |bytes: &[u8]| gltf::parse(bytes, folder, reading.materials);
    let parse: &Parser<'_> = match format {
        Format::Obj => &obj::parse,
        Format::Ply => &ply::parse,
        Format::Stl => &stl::parse,
        Format::Gltf => &gltf,
    };
    mesh(parse, bytes, reading)
}

type Parser<'a> = dyn Fn(&[u8]) -> Result<TriangleSoup, MeshFileError> + 'a;

fn mesh(parse: &Parser<'_>, bytes: &[u8], reading: MeshReading) -> Result<MeshFile, MeshFileError> {
    if bytes.is_empty() {
        return Err(MeshFileError::Empty);
    }
    parse(bytes)?.into_mesh(reading)
}
