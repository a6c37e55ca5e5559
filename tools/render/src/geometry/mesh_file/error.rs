//! Errors of mesh files.

use std::io;

use crate::{failure::Failure, image::content::ImageFileError};

/// A mesh of this size takes about 2 GB, and its hierarchy takes the same again.
pub(super) const MOST_TRIANGLES: usize = 1 << 24;
pub(super) const MOST_BYTES: u64 = 1 << 31;
/// The textures of a glTF take 4 bytes per texel.
pub(super) const MOST_TEXELS: usize = 1 << 28;
/// Maximum number of corners of a concave polygon. Ear clipping takes quadratic time or worse.
pub(super) const MOST_CORNERS: usize = 512;

/// The reason why a mesh file is invalid. Each message is one line.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshFileError {
    #[error("cannot read the file: {error}")]
    Unreadable {
        #[source]
        error: io::Error,
    },
    #[error("unsupported file extension (expected .obj, .ply, .stl, .glb or .gltf)")]
    UnknownExtension,
    #[error("the file is empty")]
    Empty,
    /// The file violates its format, according to the decoder library.
    #[error("invalid {format}: {}", one_line(error))]
    Broken {
        format: &'static str,
        #[source]
        error: Failure,
    },
    /// A face of an OBJ file refers to a vertex that does not exist.
    #[error("line {line}: vertex {index} does not exist (there are {count})")]
    NoSuchIndex { line: usize, index: i64, count: usize },
    /// The PLY header lacks an element or property, or the glTF lacks a scene.
    #[error("the file has no {what}")]
    Lacks { what: &'static str },
    #[error("{bytes} bytes cannot hold the {count} rows of `{element}` that the header claims")]
    PlyTruncated { element: String, count: usize, bytes: usize },
    /// The node may contain itself.
    #[error("node {node} of the glTF is in the scene more than once")]
    NodeTwice { node: usize },
    /// An index of the glTF exceeds its list.
    #[error("the glTF has no {what} {index} (it has {count}, counted from 0)")]
    NoSuchItem { what: &'static str, index: usize, count: usize },
    /// A file without a version is not a glTF.
    #[error("{}", if version.is_empty() { "the JSON has no `asset.version`, so it is not a glTF 2.0".into() } else {
        format!("glTF {version} is not supported: convert the file to glTF 2.0")
    })]
    GltfVersion { version: String },
    #[error("the glTF requires the unsupported extension {extension}")]
    Extension { extension: String },
    /// Accessors may refer to the same bytes repeatedly.
    #[error("the glTF's buffers exceed {MOST_BYTES} bytes")]
    BuffersTooLong,
    /// The glTF accessor has an unsupported type, or its data is not in the file.
    #[error("accessor {accessor} of the glTF must be {wanted}")]
    Accessor { accessor: usize, wanted: &'static str },
    /// The glTF refers to a missing file.
    #[error("cannot read the glTF's {what} `{uri}`: {error}")]
    Beside {
        what: &'static str,
        uri: String,
        #[source]
        error: io::Error,
    },
    #[error("glTF buffers and images must be embedded or in the glTF's folder, got `{uri}`")]
    Elsewhere { uri: String },
    #[error("cannot read {image} of the glTF: {error}")]
    Image {
        /// The index of an embedded image, or the URI.
        image: String,
        #[source]
        error: ImageFileError,
    },
    #[error("the glTF's images exceed {most} texels, the limit for a file of this length")]
    ImagesTooLarge { most: usize },
    #[error("images of the glTF are missing: {}", quoted(uris))]
    MissingImages { uris: Vec<String> },
    #[error("material {material} of the glTF has an invalid `{field}`")]
    Material { material: usize, field: String },
    #[error(
        "material {material} of the glTF has `texCoord` {set} in `{field}` (at most 1: two sets are read)"
    )]
    TexCoord { material: usize, field: String, set: usize },
    #[error("unsupported compression {extension} (export the glTF uncompressed or with Draco)")]
    Compressed { extension: String },
    #[error("{corners} corners are not a multiple of 3")]
    CornersLeft { corners: usize },
    #[error("a face refers to vertex {index}, but there are {count} vertices (counted from 0)")]
    NoSuchVertex { index: u64, count: usize },
    /// A number is NaN, infinite, or beyond single precision.
    #[error("vertex {index} (counted from 0) is not finite")]
    NotFinite { index: usize },
    #[error("a concave polygon has too many corners: {corners} (at most {MOST_CORNERS})")]
    PolygonTooLarge { corners: usize },
    #[error("the mesh is too large (at most {MOST_TRIANGLES} triangles and three times as many vertices)")]
    TooLarge,
    #[error("all triangles have zero area")]
    NoTriangles,
    #[error("the file has no triangles, only points or lines")]
    OnlyPointsAndLines,
    #[error("the file has no triangles")]
    Nothing,
}

impl MeshFileError {
    /// Wraps the error of a library.
    pub(super) fn broken(format: &'static str, error: impl Into<Failure>) -> Self {
        Self::Broken { format, error: error.into() }
    }
}

/// Joins names in backticks; at most 20, as lists may be long.
fn quoted(names: &[String]) -> String {
    const MOST: usize = 20;
    let shown: Vec<_> = names.iter().take(MOST).map(|name| format!("`{name}`")).collect();
    let more = names.len().saturating_sub(MOST);
    shown.join(", ") + &if more > 0 { format!(" and {more} more") } else { String::new() }
}

/// Shortens a library's message to one line. Messages may quote long or binary parts of the file.
fn one_line(error: &Failure) -> String {
    let words: Vec<_> = error.to_string().split_whitespace().map(str::to_owned).collect();
    words.join(" ").chars().filter(|c| !c.is_control()).take(300).collect()
}
