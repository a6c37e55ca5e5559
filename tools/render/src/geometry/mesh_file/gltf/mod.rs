//! glTF 2.0, in one file or with its buffers next to it.

pub mod buffers;
mod document;
mod materials;
mod primitive;
mod scene;

use std::path::Path;

use crate::geometry::mesh_file::{
    error::MeshFileError, gltf::buffers::Gltf, gltf::materials::Materials, triangle_soup::TriangleSoup,
};

/// Reads all triangles of the default scene, or of the first scene. Meshes are morphed by their
/// default weights, skinned in the pose of the nodes, and instanced. Materials are read if
/// `painted`. Animations and cameras are ignored. The v coordinate is flipped to point up.
pub(super) fn parse(bytes: &[u8], folder: &Path, painted: bool) -> Result<TriangleSoup, MeshFileError> {
    let gltf = Gltf::read(bytes, folder)?;
    let materials = if painted { Materials::read(&gltf, folder)? } else { None };
    scene::soup(&gltf, materials)
}
