//! Meshes compressed with Draco, decoded by `draco-core`.

use draco_core::{DecodeLimits, DecoderBuffer, Mesh, MeshDecoder};

use crate::geometry::mesh_file::error::{MOST_BYTES, MOST_TRIANGLES, MeshFileError};

/// A decoded mesh.
pub(super) struct DracoArrays(Mesh);

impl DracoArrays {
    pub(super) fn decode(bytes: &[u8]) -> Result<Self, MeshFileError> {
        let limits = DecodeLimits::default()
            .with_max_points(3 * MOST_TRIANGLES as u64)
            .with_max_faces(MOST_TRIANGLES as u64)
            .with_max_decoded_bytes(MOST_BYTES);
        let mut mesh = Mesh::new();
        let mut buffer = DecoderBuffer::new(bytes).with_limits(limits);
        let decoded = MeshDecoder::new().decode(&mut buffer, &mut mesh);
        decoded.map_err(|error| MeshFileError::broken("Draco mesh", error))?;
        Ok(Self(mesh))
    }

    /// Returns the number of points.
    pub(super) fn count(&self) -> usize {
        self.0.num_points()
    }

    /// Returns the vectors of the attribute with this id, as stored.
    pub(super) fn values<const N: usize>(&self, id: u32) -> Option<Vec<[f32; N]>> {
        let values = self.0.attribute_by_unique_id(id)?.read_f32s(self.count(), N);
        Some(values.as_chunks().0.to_vec())
    }

    /// Returns the corners of triangles, three per triangle.
    pub(super) fn corners(&self) -> Vec<u32> {
        self.0.faces().iter().flatten().map(|point| point.0).collect()
    }
}
