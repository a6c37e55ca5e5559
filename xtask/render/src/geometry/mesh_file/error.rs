//! Why a file is no mesh.

use std::{error::Error, fmt, io};

use crate::failure::Failure;

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
    Unreadable { error: io::Error },
    /// The path names a folder, a pipe or a device.
    NotAFile,
    /// The name ends in none of the known ways.
    UnknownExtension,
    /// The file has no bytes.
    Empty,
    /// The file is longer than any mesh that is read.
    TooLong { bytes: u64 },
    /// The file breaks its format, as the library that reads it has it.
    Broken { format: &'static str, error: Failure },
    /// A face of an OBJ file names something that is not there.
    NoSuchIndex { line: usize, what: &'static str, index: i64, count: usize },
    /// The PLY header lacks an element or property, or the glTF a scene.
    Lacks { what: &'static str },
    /// The PLY header promises more than the file has bytes for.
    PlyTruncated { element: String, count: usize, bytes: usize },
    /// A node is in the scene more than once, perhaps in itself.
    NodeTwice { node: usize },
    /// The glTF accessor is of a kind that is not read, or its data are not in the file.
    Accessor { accessor: usize, wanted: &'static str },
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

impl MeshFileError {
    /// The error of a library.
    pub(super) fn broken(format: &'static str, error: impl Into<Failure>) -> Self {
        Self::Broken { format, error: error.into() }
    }
}

impl fmt::Display for MeshFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable { error } => write!(f, "the file cannot be read: {error}"),
            Self::NotAFile => f.write_str("this is not a file"),
            Self::UnknownExtension => f.write_str("the name of a mesh file ends in .obj, .ply or .glb"),
            Self::Empty => f.write_str("the file is empty"),
            Self::TooLong { bytes } => write!(f, "a mesh file has at most {MOST_BYTES} bytes, got {bytes}"),
            Self::Broken { format, error } => {
                // What a library quotes of the file may be long, or no text at all.
                let words: Vec<_> = error.to_string().split_whitespace().map(str::to_owned).collect();
                let line: String = words.join(" ").chars().filter(|c| !c.is_control()).take(300).collect();
                write!(f, "the {format} cannot be read: {line}")
            }
            Self::NoSuchIndex { line, what, index, count } => {
                write!(f, "line {line}: {what} {index} does not exist, there are {count}")
            }
            Self::Lacks { what } => write!(f, "the file has no {what}"),
            Self::PlyTruncated { element, count, bytes } => {
                write!(f, "{bytes} bytes cannot hold the {count} of `{element}` that the header claims")
            }
            Self::NodeTwice { node } => write!(f, "node {node} of the glTF is in the scene more than once"),
            Self::Accessor { accessor, wanted } => {
                write!(f, "accessor {accessor} of the glTF must be {wanted}")
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
            Self::Unreadable { error } => Some(error),
            Self::Broken { error, .. } => Some(error.as_ref()),
            _ => None,
        }
    }
}
