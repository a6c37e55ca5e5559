//! Why a file is no mesh.

use std::{error::Error, fmt, io};

/// A mesh of this size takes about 2 GB, and as much again for its hierarchy.
pub(super) const MOST_TRIANGLES: usize = 1 << 24;
pub(super) const MOST_BYTES: u64 = 1 << 31;
/// The most corners of a polygon that is not convex: finding ears takes the square of it, or worse.
pub(super) const MOST_CORNERS: usize = 512;

/// The rule that a mesh file breaks. Each message is one line.
#[derive(Debug)]
#[non_exhaustive]
pub enum MeshFileError {
    /// The file cannot be read.
    Unreadable(io::Error),
    /// The path names a folder, a pipe or a device.
    NotAFile,
    /// The name ends in none of the known ways.
    UnknownExtension,
    /// The file has no bytes.
    Empty,
    /// The file is longer than any mesh that is read.
    TooLong { bytes: u64 },
    /// A line of an OBJ file does not say what its first word promises.
    Obj { line: usize, error: tobj::LoadError },
    /// A face of an OBJ file names something that is not there.
    NoSuchIndex { line: usize, what: &'static str, index: i64, count: usize },
    /// The PLY file is not as its header or the format has it.
    Ply(ply_rs_bw::parser::ParseError),
    /// The PLY header lacks this element or property.
    PlyLacks(&'static str),
    /// The PLY header promises more than the file has bytes for.
    PlyTruncated { element: String, count: usize, bytes: usize },
    /// The container of the glTF is broken.
    Glb(gltf::Error),
    /// The JSON of the glTF is broken.
    GltfJson(gltf::json::Error),
    /// A glTF property breaks the standard.
    Gltf { path: String, error: gltf::json::validation::Error },
    /// The glTF has no scene.
    NoScene,
    /// A node is in the scene more than once, perhaps in itself.
    NodeTwice { node: usize },
    /// The data are in another file, or in the JSON.
    ExternalBuffer { buffer: usize },
    /// The accessor is of a kind that is not read.
    Accessor { accessor: usize, wanted: &'static str },
    /// The accessor reaches beyond its buffer.
    AccessorTruncated { accessor: usize },
    /// A list of corners that does not go into threes.
    CornersLeft { corners: usize },
    /// A corner of a triangle is no vertex.
    NoSuchVertex { index: u64, count: usize },
    /// A number is NaN, infinite, or beyond single precision.
    NotFinite { what: &'static str, index: usize },
    /// A polygon that is not convex has more corners than are cut into triangles.
    PolygonTooLarge { corners: usize },
    /// More triangles or vertices than are traced.
    TooLarge,
    /// No triangle has an area.
    NoTriangles,
}

impl fmt::Display for MeshFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable(error) => write!(f, "the file cannot be read: {error}"),
            Self::NotAFile => f.write_str("this is not a file"),
            Self::UnknownExtension => f.write_str("the name of a mesh file ends in .obj, .ply or .glb"),
            Self::Empty => f.write_str("the file is empty"),
            Self::TooLong { bytes } => write!(f, "a mesh file has at most {MOST_BYTES} bytes, got {bytes}"),
            Self::Obj { line, error } => write!(f, "line {line}: {error}"),
            Self::NoSuchIndex { line, what, index, count } => {
                write!(f, "line {line}: {what} {index} does not exist, there are {count}")
            }
            Self::Ply(error) => {
                // The library's words, without its parser's state behind them.
                let said = error.to_string();
                write!(
                    f,
                    "the PLY cannot be read: {}",
                    one_line(said.split(" Error: ").next().unwrap_or(&said))
                )
            }
            Self::PlyLacks(what) => write!(f, "the PLY header has no {what}"),
            Self::PlyTruncated { element, count, bytes } => {
                write!(f, "{bytes} bytes cannot hold the {count} of `{element}` that the header claims")
            }
            Self::Glb(error) => {
                write!(f, "the glTF container cannot be read: {}", one_line(&error.to_string()))
            }
            Self::GltfJson(error) => write!(f, "the glTF cannot be read: {}", one_line(&error.to_string())),
            Self::Gltf { path, error } => {
                write!(f, "the glTF breaks the standard at {}: {error}", one_line(path))
            }
            Self::NoScene => f.write_str("the glTF has no scene"),
            Self::NodeTwice { node } => write!(f, "node {node} of the glTF is in the scene more than once"),
            Self::ExternalBuffer { buffer } => {
                write!(f, "buffer {buffer} of the glTF is not in the file's own binary chunk")
            }
            Self::Accessor { accessor, wanted } => {
                write!(f, "accessor {accessor} of the glTF must be {wanted}")
            }
            Self::AccessorTruncated { accessor } => {
                write!(f, "accessor {accessor} of the glTF reaches beyond its buffer")
            }
            Self::CornersLeft { corners } => write!(f, "{corners} corners do not make whole triangles"),
            Self::NoSuchVertex { index, count } => {
                write!(f, "a face has corner {index}, counted from 0, but there are {count} vertices")
            }
            Self::NotFinite { what, index } => write!(f, "{what} {index}, counted from 0, is not finite"),
            Self::PolygonTooLarge { corners } => {
                write!(f, "a polygon that is not convex has at most {MOST_CORNERS} corners, got {corners}")
            }
            Self::TooLarge => {
                write!(f, "a mesh has at most {MOST_TRIANGLES} triangles, and three times as many vertices")
            }
            Self::NoTriangles => f.write_str("no triangle has an area"),
        }
    }
}

impl Error for MeshFileError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Unreadable(error) => Some(error),
            Self::Obj { error, .. } => Some(error),
            Self::Ply(error) => Some(error),
            Self::Glb(error) => Some(error),
            Self::GltfJson(error) => Some(error),
            Self::Gltf { error, .. } => Some(error),
            _ => None,
        }
    }
}

/// A library's message on one line; what it quotes of the file may be long, or no text at all.
fn one_line(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    words.join(" ").chars().filter(|c| !c.is_control()).take(300).collect()
}
