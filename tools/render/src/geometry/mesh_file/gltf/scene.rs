//! The triangles of a glTF scene, transformed by its nodes.

use glam::{DMat3, DMat4, DQuat, DVec3, Vec3, Vec4};

use crate::geometry::mesh_file::{
    error::{MOST_TRIANGLES, MeshFileError},
    gltf::{
        buffers::Gltf,
        document::{Document, Node, item, trs},
        materials::Materials,
        primitive::{Geometry, geometry, is_thin},
    },
    triangle_soup::{Corner, TriangleSoup},
};

pub(super) fn soup(gltf: &Gltf, materials: Option<Materials>) -> Result<TriangleSoup, MeshFileError> {
    let document = &gltf.document;
    let placed = Placed::of(document)?;
    let mut soup = TriangleSoup::default();
    for &index in &placed.drawn {
        let node = &document.nodes[index];
        let Some(mesh) = node.mesh.map(|mesh| item(&document.meshes, "mesh", mesh)).transpose()? else {
            continue;
        };
        // The node's weights replace the mesh's weights, as far as there are any.
        let mut weights = mesh.weights.clone().unwrap_or_default();
        let own = node.weights.as_deref().unwrap_or_default();
        weights.resize(weights.len().max(own.len()), 0.0);
        weights[..own.len()].copy_from_slice(own);
        let joints = node.skin.map(|skin| joints(gltf, skin, &placed)).transpose()?;
        let instances = instances(gltf, node)?;
        for primitive in &mesh.primitives {
            if is_thin(primitive) {
                soup.thin = true;
                continue;
            }
            let Some(geometry) = geometry(gltf, primitive, materials.as_ref(), &weights, joints.is_some())?
            else {
                continue;
            };
            soup.left_out |= geometry.left_out;
            if let Some(joints) = &joints {
                check_joints(joints.len(), &geometry)?;
            }
            for instance in &instances {
                let place = placed.world[index] * *instance;
                append(&mut soup, &geometry, |vertex| match &joints {
                    // The transform of a skinned node is ignored: glTF 2.0, section 3.7.3.3.
                    Some(joints) => skinned(joints, &geometry, vertex).unwrap_or(place),
                    None => place,
                })?;
            }
        }
    }
    if let Some(materials) = materials {
        (soup.materials, soup.ignored) = (Some(materials.list), materials.ignored);
    }
    Ok(soup)
}

/// The nodes of a scene and the transforms of all nodes.
struct Placed {
    /// Visible nodes of the scene, parents first.
    drawn: Vec<usize>,
    /// From each node to the world. Joints of a skin may be outside the scene.
    world: Vec<DMat4>,
}

impl Placed {
    fn of(document: &Document) -> Result<Self, MeshFileError> {
        let nodes = &document.nodes;
        let mut placed = Self { drawn: Vec::new(), world: vec![DMat4::IDENTITY; nodes.len()] };
        let mut seen = vec![false; nodes.len()];
        let roots = document.roots()?.iter().map(|&node| (node, DMat4::IDENTITY, true));
        placed.descend(nodes, roots.rev().collect(), &mut seen)?;
        // Nodes outside the scene matter only as joints.
        let mut is_child = vec![false; nodes.len()];
        for &child in nodes.iter().flat_map(|node| &node.children) {
            if let Some(is_child) = is_child.get_mut(child) {
                *is_child = true;
            }
        }
        for node in (0..nodes.len()).filter(|&node| !is_child[node]) {
            if !seen[node] {
                // An error there does not affect visible nodes.
                let _ = placed.descend(nodes, vec![(node, DMat4::IDENTITY, false)], &mut seen);
            }
        }
        Ok(placed)
    }

    /// Transforms descendants, given each parent's transform and visibility.
    fn descend(
        &mut self,
        nodes: &[Node],
        mut open: Vec<(usize, DMat4, bool)>,
        seen: &mut [bool],
    ) -> Result<(), MeshFileError> {
        while let Some((index, above, drawn)) = open.pop() {
            let node = nodes.get(index).ok_or_else(|| no_node(index, nodes.len()))?;
            // A node has at most one parent. Without this rule the traversal could be infinite.
            if std::mem::replace(&mut seen[index], true) {
                return Err(MeshFileError::NodeTwice { node: index });
            }
            let visible = node.extensions.visibility.as_ref().and_then(|v| v.visible).unwrap_or(true);
            let (place, drawn) = (above * node.transform(), drawn && visible);
            self.world[index] = place;
            if drawn {
                self.drawn.push(index);
            }
            open.extend(node.children.iter().map(|&child| (child, place, drawn)));
        }
        Ok(())
    }
}

fn no_node(index: usize, count: usize) -> MeshFileError {
    MeshFileError::NoSuchItem { what: "node", index, count }
}

/// For each joint, returns the transform from the bind pose to the world.
fn joints(gltf: &Gltf, skin: usize, placed: &Placed) -> Result<Vec<DMat4>, MeshFileError> {
    let skin = item(&gltf.document.skins, "skin", skin)?;
    let binds = skin.inverse_bind_matrices.map(|accessor| gltf.floats::<16>(accessor)).transpose()?;
    let bind = |k: usize| {
        let bind = binds.as_ref().and_then(|all| all.get(k));
        bind.map_or(DMat4::IDENTITY, |bind| DMat4::from_cols_array(&bind.map(f64::from)))
    };
    let world = |&joint: &usize| item(&placed.world, "node", joint).copied();
    skin.joints.iter().enumerate().map(|(k, joint)| Ok(world(joint)? * bind(k))).collect()
}

fn check_joints(count: usize, geometry: &Geometry) -> Result<(), MeshFileError> {
    for set in &geometry.influences {
        let used = set
            .joints
            .iter()
            .flatten()
            .zip(set.weights.iter().flatten())
            .filter(|(_, weight)| **weight != 0.0);
        if let Some((&joint, _)) = used.into_iter().find(|(joint, _)| **joint as usize >= count) {
            return Err(MeshFileError::NoSuchItem { what: "joint", index: joint as usize, count });
        }
    }
    Ok(())
}

/// Blends the joints at a vertex, or returns `None` if no joint has a weight.
fn skinned(joints: &[DMat4], geometry: &Geometry, vertex: usize) -> Option<DMat4> {
    let (mut blend, mut sum) = (DMat4::ZERO, 0.0);
    for set in &geometry.influences {
        let (own, weights) = (set.joints.get(vertex)?, set.weights.get(vertex)?);
        for (&joint, &weight) in own.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
            blend += *joints.get(joint as usize)? * f64::from(weight);
            sum += f64::from(weight);
        }
    }
    (sum != 0.0).then(|| blend * sum.recip())
}

/// Returns the transforms of a node's instances, or one identity without instancing.
fn instances(gltf: &Gltf, node: &Node) -> Result<Vec<DMat4>, MeshFileError> {
    let Some(instancing) = &node.extensions.instancing else { return Ok(vec![DMat4::IDENTITY]) };
    let accessor = |name: &str| instancing.attributes.get(name).copied();
    let vectors = |name: &str| accessor(name).map(|accessor| gltf.floats::<3>(accessor)).transpose();
    let (translations, scales) = (vectors("TRANSLATION")?, vectors("SCALE")?);
    let rotations = accessor("ROTATION").map(|accessor| gltf.floats::<4>(accessor)).transpose()?;
    let counts = [
        translations.as_ref().map(Vec::len),
        rotations.as_ref().map(Vec::len),
        scales.as_ref().map(Vec::len),
    ];
    let mut counts = counts.into_iter().flatten();
    let count = counts.next().unwrap_or(1);
    if let Some(other) = counts.find(|&other| other != count) {
        let error = format!("instance attributes of a node differ in length: {count} and {other}");
        return Err(MeshFileError::broken("glTF", error));
    }
    let vector = |all: &Option<Vec<[f32; 3]>>, k: usize, usual| {
        all.as_ref().map_or(usual, |all| Vec3::from(all[k]).as_dvec3())
    };
    let rotation = |k: usize| {
        rotations.as_ref().map_or(DQuat::IDENTITY, |all| DQuat::from_vec4(Vec4::from(all[k]).as_dvec4()))
    };
    let place = |k| trs(vector(&translations, k, DVec3::ZERO), rotation(k), vector(&scales, k, DVec3::ONE));
    Ok((0..count).map(place).collect())
}

/// Appends a primitive, with vertices transformed by `place`.
fn append(
    soup: &mut TriangleSoup,
    geometry: &Geometry,
    place: impl Fn(usize) -> DMat4,
) -> Result<(), MeshFileError> {
    let Geometry { positions, normals, uv, paint, triangles, .. } = geometry;
    let first = soup.corners.len();
    let count = if normals.is_some() { positions.len() } else { 3 * triangles.len() };
    if first + count > 3 * MOST_TRIANGLES {
        return Err(MeshFileError::TooLarge);
    }
    let corner = |i: usize| {
        let place = place(i);
        let normal = normals.as_ref().and_then(|all| all.get(i));
        Corner {
            position: place.transform_point3(positions[i].as_dvec3()),
            normal: normal.map_or(Vec3::ZERO, |&normal| turned(place, normal)),
            // v points down in the file.
            uv: uv
                .as_ref()
                .and_then(|all| all.get(i))
                .map_or_else(Default::default, |uv| glam::Vec2::new(uv.x, 1.0 - uv.y)),
        }
    };
    // A mirrored triangle reverses its orientation.
    let upright = |&[a, b, c]: &[u32; 3]| {
        let mirrored = DMat3::from_mat4(place(a as usize)).determinant() < 0.0;
        if mirrored { [a, c, b] } else { [a, b, c] }
    };
    let painted = paint.as_ref().map(|paint| move |i: usize| paint.at(i));
    if normals.is_some() {
        soup.corners.extend((0..count).map(corner));
        soup.painted.extend(painted.iter().flat_map(|at| (0..count).map(at)));
        return triangles.iter().map(upright).try_for_each(|t| soup.push(t.map(|i| first as u32 + i)));
    }
    // Triangles without normals are flat by the specification, so each has separate corners.
    for triangle in triangles.iter().map(upright) {
        let corners = triangle.map(|i| corner(i as usize));
        let [a, b, c] = corners.map(|c| c.position);
        let normal = (b - a).cross(c - a).normalize_or_zero().as_vec3();
        let first = soup.corners.len() as u32;
        soup.corners.extend(corners.map(|corner| Corner { normal, ..corner }));
        soup.painted.extend(painted.iter().flat_map(|at| triangle.map(|i| at(i as usize))));
        soup.push([first, first + 1, first + 2])?;
    }
    Ok(())
}

/// Returns a transformed normal.
fn turned(place: DMat4, normal: Vec3) -> Vec3 {
    let linear = DMat3::from_mat4(place);
    // Up to length and sign, the inverse transpose is the cofactor matrix.
    let cofactors = DMat3::from_cols(
        linear.y_axis.cross(linear.z_axis),
        linear.z_axis.cross(linear.x_axis),
        linear.x_axis.cross(linear.y_axis),
    ) * linear.determinant().signum();
    (cofactors * normal.as_dvec3()).normalize_or_zero().as_vec3()
}
