//! Meshes compressed by Draco, by `draco-core`.

use draco_core::{DecodeLimits, DecoderBuffer, Mesh, MeshDecoder};
use serde_json::Value;

use crate::geometry::mesh_file::error::{MOST_BYTES, MOST_TRIANGLES, MeshFileError};

/// Data of a primitive.
pub(super) struct Arrays {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) normals: Option<Vec<[f32; 3]>>,
    pub(super) uv: Option<Vec<[f32; 2]>>,
    pub(super) corners: Vec<u32>,
}

/// The name by which glTF has them.
pub(super) const EXTENSION: &str = "KHR_draco_mesh_compression";

/// The arrays of a compressed mesh, by the numbers that glTF's attributes have in it.
pub(super) fn decode(bytes: &[u8], attributes: &Value) -> Result<Arrays, MeshFileError> {
    let limits = DecodeLimits::default()
        .with_max_points(3 * MOST_TRIANGLES as u64)
        .with_max_faces(MOST_TRIANGLES as u64)
        .with_max_decoded_bytes(MOST_BYTES);
    let mut mesh = Mesh::new();
    let decoded = MeshDecoder::new().decode(&mut DecoderBuffer::new(bytes).with_limits(limits), &mut mesh);
    decoded.map_err(|error| MeshFileError::broken("Draco mesh", error))?;
    let count = mesh.num_points();
    let values = |name: &str, components| {
        let id = u32::try_from(attributes[name].as_u64()?).ok()?;
        Some(mesh.attribute_by_unique_id(id)?.read_f32s(count, components))
    };
    let by_threes = |name: &str| values(name, 3).map(|all| all.as_chunks().0.to_vec());
    Ok(Arrays {
        positions: by_threes("POSITION")
            .ok_or(MeshFileError::Lacks { what: "positions in its Draco mesh" })?,
        normals: by_threes("NORMAL"),
        uv: values("TEXCOORD_0", 2).map(|all| all.as_chunks().0.to_vec()),
        corners: mesh.faces().iter().flatten().map(|point| point.0).collect(),
    })
}
