//! glTF 2.0, in one file or with its buffers next to it.

mod buffers;
mod document;
mod primitive;
mod scene;

use std::path::Path;

use crate::geometry::mesh_file::{error::MeshFileError, gltf::buffers::Gltf, triangle_soup::TriangleSoup};

/// Reads all triangles of the default scene, or of the first scene. Meshes are morphed by their
/// default weights, skinned in the pose of the nodes, and instanced. Animations, cameras and
/// materials are ignored. The v coordinate is flipped to point up.
pub(super) fn parse(bytes: &[u8], folder: &Path) -> Result<TriangleSoup, MeshFileError> {
    scene::soup(&Gltf::read(bytes, folder)?)
}
