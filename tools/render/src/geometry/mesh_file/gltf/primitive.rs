//! The vertices and triangles of a glTF primitive, in local coordinates.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3, Vec4};

use crate::geometry::mesh_file::materials::Painted;
use crate::geometry::mesh_file::{
    draco::DracoArrays,
    error::MeshFileError,
    gltf::{
        buffers::Gltf,
        document::{DracoMesh, Primitive, item},
        materials::Materials,
    },
    polygon::{fan, strip},
};

/// A primitive of triangles.
pub(super) struct Geometry {
    pub(super) positions: Vec<Vec3>,
    pub(super) normals: Option<Vec<Vec3>>,
    pub(super) uv: Option<Vec<Vec2>>,
    /// What materials read, if they are wanted.
    pub(super) paint: Option<Paint>,
    /// Joints and weights of the skin, four per set.
    pub(super) influences: Vec<Influences>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Whether corners were left over, or referred to missing vertices.
    pub(super) left_out: bool,
}

/// The attributes of a primitive that its material reads.
pub(super) struct Paint {
    material: u32,
    uv: [Option<Vec<[f32; 2]>>; 2],
    colors: Option<Vec<Vec4>>,
}

impl Paint {
    /// Returns the values of a vertex; missing texture coordinates are 0 and colors white.
    pub(super) fn at(&self, vertex: usize) -> Painted {
        let uv = |set: &Option<Vec<[f32; 2]>>| set.as_ref().and_then(|all| all.get(vertex)).copied();
        Painted {
            uv: [0, 1].map(|set: usize| uv(&self.uv[set]).unwrap_or_default().into()),
            color: self.colors.as_ref().and_then(|all| all.get(vertex)).copied().unwrap_or(Vec4::ONE),
            material: self.material,
        }
    }
}

/// An attribute set `JOINTS_n`, `WEIGHTS_n`.
pub(super) struct Influences {
    pub(super) joints: Vec<[f32; 4]>,
    pub(super) weights: Vec<[f32; 4]>,
}

/// Whether the primitive consists of points or lines.
pub(super) fn is_thin(primitive: &Primitive) -> bool {
    primitive.mode.is_some_and(|mode| mode < 4)
}

/// Reads a primitive, morphed by these weights. Returns `None` without positions.
pub(super) fn geometry(
    gltf: &Gltf,
    primitive: &Primitive,
    materials: Option<&Materials>,
    weights: &[f64],
    skinned: bool,
) -> Result<Option<Geometry>, MeshFileError> {
    let compressed = match &primitive.extensions.draco {
        Some(mesh) => Some(draco(gltf, mesh)?),
        None => None,
    };
    let source = Source { gltf, attributes: &primitive.attributes, compressed: compressed.as_ref() };
    let Some(positions) = source.attribute::<3>("POSITION")? else { return Ok(None) };
    let normals = source.attribute::<3>("NORMAL")?;
    let uv = source.attribute::<2>("TEXCOORD_0")?;
    let paint = materials.map(|materials| source.paint(materials, primitive, uv.clone())).transpose()?;
    // Tangents follow the coordinates of the normal map.
    let second =
        paint.as_ref().filter(|paint| materials.is_some_and(|all| all.normal_set(paint.material) == 1));
    let uv = second.map_or(uv, |paint| paint.uv[1].clone());
    let mut geometry = Geometry {
        positions: positions.into_iter().map(Vec3::from).collect(),
        normals: normals.map(|all| all.into_iter().map(Vec3::from).collect()),
        uv: uv.map(|all| all.into_iter().map(Vec2::from).collect()),
        paint,
        influences: Vec::new(),
        triangles: Vec::new(),
        left_out: false,
    };
    for (target, &weight) in primitive.targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
        morph(gltf, &mut geometry, target, weight as f32)?;
    }
    for set in (0..).take_while(|_| skinned) {
        let joints = source.attribute(&format!("JOINTS_{set}"))?;
        let Some((joints, weights)) = joints.zip(source.attribute(&format!("WEIGHTS_{set}"))?) else { break };
        geometry.influences.push(Influences { joints, weights });
    }
    let count = geometry.positions.len();
    let corners = match (&compressed, primitive.indices) {
        (Some((arrays, _)), _) => arrays.corners(),
        (None, Some(accessor)) => gltf.indices(accessor)?,
        (None, None) => (0..count as u32).collect(),
    };
    geometry.triangles = match primitive.mode {
        Some(5) if compressed.is_none() => strip(&corners),
        Some(6) if compressed.is_none() => fan(&corners),
        Some(mode @ 7..) => {
            return Err(MeshFileError::broken("glTF", format!("invalid primitive mode {mode}")));
        }
        _ => {
            let (triangles, rest) = corners.as_chunks::<3>();
            geometry.left_out = !rest.is_empty();
            triangles.to_vec()
        }
    };
    let read = geometry.triangles.len();
    geometry.triangles.retain(|triangle| triangle.iter().all(|&i| (i as usize) < count));
    geometry.left_out |= geometry.triangles.len() < read;
    if geometry.triangles.is_empty() && read > 0 {
        let index = corners.into_iter().find(|&i| i as usize >= count).unwrap_or_default().into();
        return Err(MeshFileError::NoSuchVertex { index, count });
    }
    Ok(Some(geometry))
}

/// Adds a target's displacements.
fn morph(
    gltf: &Gltf,
    geometry: &mut Geometry,
    target: &BTreeMap<String, usize>,
    weight: f32,
) -> Result<(), MeshFileError> {
    if let Some(&accessor) = target.get("POSITION") {
        let moved = gltf.floats::<3>(accessor)?;
        geometry.positions.iter_mut().zip(moved).for_each(|(p, by)| *p += weight * Vec3::from(by));
    }
    if let (Some(&accessor), Some(normals)) = (target.get("NORMAL"), &mut geometry.normals) {
        let moved = gltf.floats::<3>(accessor)?;
        normals.iter_mut().zip(moved).for_each(|(n, by)| *n += weight * Vec3::from(by));
    }
    if let (Some(&accessor), Some(uv)) = (target.get("TEXCOORD_0"), &mut geometry.uv) {
        let moved = gltf.floats::<2>(accessor)?;
        uv.iter_mut().zip(moved).for_each(|(uv, by)| *uv += weight * Vec2::from(by));
    }
    Ok(())
}

/// The source of a primitive's attributes.
struct Source<'a> {
    gltf: &'a Gltf,
    attributes: &'a BTreeMap<String, usize>,
    compressed: Option<&'a (DracoArrays, &'a DracoMesh)>,
}

fn draco<'a>(gltf: &Gltf, mesh: &'a DracoMesh) -> Result<(DracoArrays, &'a DracoMesh), MeshFileError> {
    let view = item(&gltf.document.buffer_views, "buffer view", mesh.buffer_view)?;
    let bytes = gltf.within(view).ok_or(MeshFileError::Lacks { what: "buffer of its Draco mesh" })?;
    let arrays = DracoArrays::decode(bytes)?;
    gltf.charge(12 * arrays.count())?;
    Ok((arrays, mesh))
}

impl Source<'_> {
    /// Returns what the material reads, given the first set of texture coordinates.
    fn paint(
        &self,
        materials: &Materials,
        primitive: &Primitive,
        uv: Option<Vec<[f32; 2]>>,
    ) -> Result<Paint, MeshFileError> {
        const COLOR: &str = "COLOR_0";
        let opaque = |[r, g, b]: [f32; 3]| Vec4::new(r, g, b, 1.0);
        let colors = self
            .attributes
            .get(COLOR)
            .map(|&accessor| item(&self.gltf.document.accessors, "accessor", accessor));
        let colors = match colors.transpose()? {
            Some(accessor) if accessor.dimensions == "VEC3" => {
                self.attribute(COLOR)?.map(|all| all.into_iter().map(opaque).collect())
            }
            _ => self.attribute::<4>(COLOR)?.map(|all| all.into_iter().map(Vec4::from).collect()),
        };
        let uv = [uv, self.attribute("TEXCOORD_1")?];
        Ok(Paint { material: materials.index(&primitive.material)?, uv, colors })
    }

    /// Returns the vectors of an attribute, if the primitive has it.
    fn attribute<const N: usize>(&self, name: &str) -> Result<Option<Vec<[f32; N]>>, MeshFileError> {
        let accessor = self.attributes.get(name).copied();
        let id = self.compressed.and_then(|(arrays, mesh)| Some((arrays, *mesh.attributes.get(name)?)));
        let Some((arrays, id)) = id else {
            // Attributes missing from the Draco mesh are in their accessor, if it has data.
            return accessor.map(|accessor| self.gltf.floats::<N>(accessor)).transpose();
        };
        let accessor = accessor.and_then(|accessor| self.gltf.document.accessors.get(accessor));
        let values = arrays.values::<N>(id).map(|mut values| {
            if let Some(accessor) = accessor {
                values.as_flattened_mut().iter_mut().for_each(|x| *x = accessor.fraction(*x));
            }
            values
        });
        values.map_or(Err(MeshFileError::Lacks { what: "attribute of its Draco mesh" }), |all| Ok(Some(all)))
    }
}
