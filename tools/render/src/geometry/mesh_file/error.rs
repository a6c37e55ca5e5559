//! Why a file is no mesh.

use std::io;

use crate::failure::Failure;

/// A mesh of this size takes about 2 GB, and as much again for its hierarchy.
pub(super) const MOST_TRIANGLES: usize = 1 << 24;
pub(super) const MOST_BYTES: u64 = 1 << 31;
/// The most corners of a polygon that is not convex: finding ears takes the square of it, or worse.
pub(super) const MOST_CORNERS: usize = 512;

/// The rule that a mesh file breaks. Each message is one line.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshFileError {
    #[error("the file cannot be read: {error}")]
    Unreadable {
        #[source]
        error: io::Error,
    },
    #[error("the name of a mesh file ends in .obj, .ply, .stl, .glb or .gltf")]
    UnknownExtension,
    #[error("the file is empty")]
    Empty,
    /// The file breaks its format, as the library that reads it has it.
    #[error("the {format} cannot be read: {}", one_line(error))]
    Broken {
        format: &'static str,
        #[source]
        error: Failure,
    },
    /// A face of an OBJ file names something that is not there.
    #[error("line {line}: vertex {index} does not exist, there are {count}")]
    NoSuchIndex { line: usize, index: i64, count: usize },
    /// The PLY header lacks an element or property, or the glTF a scene.
    #[error("the file has no {what}")]
    Lacks { what: &'static str },
    #[error("{bytes} bytes cannot hold the {count} of `{element}` that the header claims")]
    PlyTruncated { element: String, count: usize, bytes: usize },
    /// Perhaps in itself.
    #[error("node {node} of the glTF is in the scene more than once")]
    NodeTwice { node: usize },
    /// A list of the glTF is shorter than an index into it.
    #[error("the glTF has no {what} {index}, counted from 0, there are {count}")]
    NoSuchItem { what: &'static str, index: usize, count: usize },
    /// Without a version the file is not a glTF.
    #[error("{}", if version.is_empty() { "the JSON has no `asset.version`, so it is not a glTF 2.0".into() } else {
        format!("glTF {version} is not supported: convert the file to glTF 2.0")
    })]
    GltfVersion { version: String },
    #[error("the glTF requires the extension {extension}, which is not supported")]
    Extension { extension: String },
    /// Each names all that there are, again and again.
    #[error("the glTF's buffers have more than {MOST_BYTES} bytes")]
    BuffersTooLong,
    /// The glTF accessor is of a kind that is not read, or its data are not in the file.
    #[error("accessor {accessor} of the glTF must be {wanted}")]
    Accessor { accessor: usize, wanted: &'static str },
    /// The glTF names a file that is not there.
    #[error("the glTF's buffer `{uri}`, beside it, cannot be read: {error}")]
    Buffer {
        uri: String,
        #[source]
        error: io::Error,
    },
    #[error("the buffers of a glTF must be in it or beside it, got `{uri}`")]
    Elsewhere { uri: String },
    #[error(
        "the glTF is compressed by {extension}, which is not supported: export it uncompressed or with Draco"
    )]
    Compressed { extension: String },
    #[error("{corners} corners do not make whole triangles")]
    CornersLeft { corners: usize },
    #[error("a face has corner {index}, counted from 0, but there are {count} vertices")]
    NoSuchVertex { index: u64, count: usize },
    /// A number is NaN, infinite, or beyond single precision.
    #[error("vertex {index}, counted from 0, is not finite")]
    NotFinite { index: usize },
    #[error("a polygon that is not convex has at most {MOST_CORNERS} corners, got {corners}")]
    PolygonTooLarge { corners: usize },
    #[error("a mesh has at most {MOST_TRIANGLES} triangles, and three times as many vertices")]
    TooLarge,
    #[error("no triangle has an area")]
    NoTriangles,
    #[error("the file has no triangles, only points or lines")]
    OnlyPointsAndLines,
    #[error("the file has no triangles")]
    Nothing,
}

impl MeshFileError {
    /// The error of a library.
    pub(super) fn broken(format: &'static str, error: impl Into<Failure>) -> Self {
        Self::Broken { format, error: error.into() }
    }
}

/// The words of a library in one line: its quotes of the file may be long, or no text at all.
fn one_line(error: &Failure) -> String {
    let words: Vec<_> = error.to_string().split_whitespace().map(str::to_owned).collect();
    words.join(" ").chars().filter(|c| !c.is_control()).take(300).collect()
}
