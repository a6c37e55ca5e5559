//! Meshes from files: Wavefront OBJ, PLY, STL and glTF, each centred on the origin and scaled into the unit ball.

mod draco;
mod error;
mod gltf;
mod obj;
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
pub use self::triangle_soup::{MeshFile, MeshReading, Up};
use self::{error::MOST_BYTES, triangle_soup::TriangleSoup};
use crate::input_file;

/// Reads the mesh of a file by its extension, and turns what is up to z.
///
/// Data that the file does not give are computed: normals by the angles of the triangles around a point that are no crease
/// apart, tangents along ∂P/∂u. Triangles without area are left out. Texture coordinates are scaled so that their
/// unit is a unit of length, in the mean over the surface.
pub fn open(path: &Path, reading: MeshReading) -> Result<MeshFile, MeshFileError> {
    let format = Format::of(path).ok_or(MeshFileError::UnknownExtension)?;
    let bytes = input_file::read(path, MOST_BYTES).map_err(|error| MeshFileError::Unreadable { error })?;
    decode(format, &bytes, path.parent().unwrap_or(Path::new("")), reading)
}

/// The formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Obj,
    Ply,
    Stl,
    /// In one file or with its buffers beside it.
    Gltf,
}

impl Format {
    /// That of a file by its extension.
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

/// [`open`] for the bytes of a file, beside which others are in `folder`.
pub fn decode(
    format: Format,
    bytes: &[u8],
    folder: &Path,
    reading: MeshReading,
) -> Result<MeshFile, MeshFileError> {
    let gltf = |bytes: &[u8]| gltf::parse(bytes, folder);
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
