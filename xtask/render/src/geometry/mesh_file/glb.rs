//! Binary glTF 2.0, by `gltf`.

use glam::{DMat3, DMat4, Vec2, Vec3};
use gltf::{
    Accessor, Document, Glb, Node, Primitive, Semantic,
    accessor::{DataType, Dimensions},
    buffer::Source,
    json::{
        Root,
        validation::{Checked, Error},
    },
    mesh::Mode,
};

use crate::geometry::mesh_file::{
    error::{MOST_TRIANGLES, MeshFileError},
    triangle_soup::{Corner, TriangleSoup},
};

/// All triangles of the default scene, or else of the first, where its nodes put them. Skins, morph targets and
/// materials are passed over; v goes upwards.
pub(super) fn parse(bytes: &[u8]) -> Result<TriangleSoup, MeshFileError> {
    let (document, blob) = read(bytes)?;
    let scene = document
        .default_scene()
        .or_else(|| document.scenes().next())
        .ok_or(MeshFileError::Lacks { what: "scene" })?;
    let mut soup = TriangleSoup::default();
    let mut seen = vec![false; document.nodes().count()];
    let mut open: Vec<(Node<'_>, DMat4)> = scene.nodes().map(|node| (node, DMat4::IDENTITY)).collect();
    open.reverse();
    while let Some((node, above)) = open.pop() {
        // By the standard a node has at most one parent; without that rule the scene could be endless.
        if std::mem::replace(&mut seen[node.index()], true) {
            return Err(MeshFileError::NodeTwice { node: node.index() });
        }
        let columns = node.transform().matrix().map(|column| column.map(f64::from));
        let place = above * DMat4::from_cols_array_2d(&columns);
        for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
            append(&mut soup, &primitive, place, &blob)?;
        }
        open.extend(node.children().map(|child| (child, place)));
    }
    Ok(soup)
}

/// The document, checked by the rules of the library, and the binary chunk.
fn read(bytes: &[u8]) -> Result<(Document, Vec<u8>), MeshFileError> {
    let container = |error| MeshFileError::broken("glTF container", error);
    // The library takes the header's own length off the one in the header, however short that is.
    let length = bytes.get(8..12).and_then(|field| field.try_into().ok()).map_or(0, u32::from_le_bytes);
    if length < 20 {
        return Err(container(gltf::binary::Error::Length { length, length_read: bytes.len() }.into()));
    }
    let Glb { json, bin, .. } = Glb::from_slice(bytes).map_err(container)?;
    let broken = |path: &str, error| MeshFileError::broken("glTF", format!("{path}: {error}"));
    let root = Root::from_slice(&json).map_err(|error| MeshFileError::broken("glTF", error))?;
    // The library's own check looks up positions before it has checked that they are there.
    for (m, mesh) in root.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let positions = primitive.attributes.get(&Checked::Valid(Semantic::Positions));
            if positions.is_some_and(|accessor| accessor.value() >= root.accessors.len()) {
                let path = format!("meshes[{m}].primitives[{p}].attributes[\"POSITION\"]");
                return Err(broken(&path, Error::IndexOutOfBounds));
            }
        }
    }
    let document = Document::from_json(root).map_err(|error| match error {
        gltf::Error::Validation(mut all) if !all.is_empty() => {
            let (path, error) = all.swap_remove(0);
            broken(path.as_str(), error)
        }
        error => container(error),
    })?;
    Ok((document, bin.unwrap_or_default().into_owned()))
}

fn append(
    soup: &mut TriangleSoup,
    primitive: &Primitive<'_>,
    place: DMat4,
    blob: &[u8],
) -> Result<(), MeshFileError> {
    if matches!(primitive.mode(), Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
        return Ok(());
    }
    let Some(positions) = primitive.get(&Semantic::Positions) else { return Ok(()) };
    let positions = floats::<3>(&positions, blob)?;
    let normals = primitive.get(&Semantic::Normals).map(|a| floats::<3>(&a, blob)).transpose()?;
    let uv = primitive.get(&Semantic::TexCoords(0)).map(|a| floats::<2>(&a, blob)).transpose()?;
    let corners = match primitive.indices() {
        Some(accessor) => indices(&accessor, blob)?,
        None => (0..positions.len() as u32).collect(),
    };
    let mut triangles = triangles(primitive.mode(), &corners)?;
    let linear = DMat3::from_mat4(place);
    if linear.determinant() < 0.0 {
        // A mirrored triangle turns the other way.
        triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }
    // The inverse transpose, but for its length and sign, is the matrix of cofactors.
    let cofactors = DMat3::from_cols(
        linear.y_axis.cross(linear.z_axis),
        linear.z_axis.cross(linear.x_axis),
        linear.x_axis.cross(linear.y_axis),
    ) * linear.determinant().signum();
    if let Some(&index) = triangles.iter().flatten().find(|&&i| i as usize >= positions.len()) {
        return Err(MeshFileError::NoSuchVertex { index: index.into(), count: positions.len() });
    }
    let (first, count) =
        (soup.corners.len(), if normals.is_some() { positions.len() } else { 3 * triangles.len() });
    // Any number of primitives may name the same accessor.
    if first + count > 3 * MOST_TRIANGLES {
        return Err(MeshFileError::TooLarge);
    }
    let turned = |given: Vec3| {
        let turned = (cofactors * given.as_dvec3()).normalize_or_zero().as_vec3();
        if given.is_finite() { turned } else { given }
    };
    let corner = |i: usize| Corner {
        position: place.transform_point3(Vec3::from(positions[i]).as_dvec3()),
        normal: normals.as_ref().and_then(|all| all.get(i)).map_or(Vec3::ZERO, |&n| turned(n.into())),
        uv: uv.as_ref().and_then(|all| all.get(i)).map_or(Vec2::ZERO, |&[u, v]| Vec2::new(u, 1.0 - v)),
    };
    if normals.is_some() {
        soup.corners.extend((0..count).map(corner));
    } else {
        // By the standard, triangles without normals are flat: each has corners of its own.
        for (k, triangle) in (0..).step_by(3).zip(&mut triangles) {
            let corners = triangle.map(|i| corner(i as usize));
            let [a, b, c] = corners.map(|c| c.position);
            let normal = (b - a).cross(c - a).normalize_or_zero().as_vec3();
            soup.corners.extend(corners.map(|corner| Corner { normal, ..corner }));
            *triangle = [k, k + 1, k + 2];
        }
    }
    triangles.into_iter().try_for_each(|triangle| soup.push(triangle.map(|i| first as u32 + i)))
}

/// Corners by threes, as the mode has them.
pub(super) fn triangles(mode: Mode, corners: &[u32]) -> Result<Vec<[u32; 3]>, MeshFileError> {
    let strip = |(i, &[a, b, c]): (usize, &[u32; 3])| if i % 2 == 0 { [a, b, c] } else { [b, a, c] };
    match mode {
        Mode::TriangleStrip => Ok(corners.array_windows().enumerate().map(strip).collect()),
        Mode::TriangleFan => Ok(match corners {
            [first, others @ ..] => others.array_windows().map(|&[b, c]| [b, c, *first]).collect(),
            [] => Vec::new(),
        }),
        _ => match corners.as_chunks::<3>() {
            (whole, []) => Ok(whole.to_vec()),
            _ => Err(MeshFileError::CornersLeft { corners: corners.len() }),
        },
    }
}

fn floats<const N: usize>(accessor: &Accessor<'_>, blob: &[u8]) -> Result<Vec<[f32; N]>, MeshFileError> {
    let dimensions = if N == 3 { Dimensions::Vec3 } else { Dimensions::Vec2 };
    let (right, shares) = (accessor.dimensions() == dimensions, N == 2 && accessor.normalized());
    let component: fn(u32) -> f32 = match accessor.data_type() {
        DataType::F32 if right => f32::from_bits,
        DataType::U8 if right && shares => |n| n as f32 / 255.0,
        DataType::U16 if right && shares => |n| n as f32 / 65_535.0,
        _ if N == 3 => return Err(must_be(accessor, "vectors of three floats")),
        _ => return Err(must_be(accessor, "vectors of two floats or shares")),
    };
    let size = accessor.data_type().size();
    let item = |bytes: &[u8]| std::array::from_fn(|k| component(number(&bytes[k * size..][..size])));
    Ok(items(accessor, blob)?.map(item).collect())
}

fn indices(accessor: &Accessor<'_>, blob: &[u8]) -> Result<Vec<u32>, MeshFileError> {
    let known = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
    if accessor.dimensions() != Dimensions::Scalar || !known {
        return Err(must_be(accessor, "unsigned integers"));
    }
    Ok(items(accessor, blob)?.map(number).collect())
}

/// The little-endian number of up to four bytes.
fn number(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |sum, &byte| sum << 8 | u32::from(byte))
}

/// The bytes of each item.
fn items<'a>(
    accessor: &Accessor<'_>,
    blob: &'a [u8],
) -> Result<impl Iterator<Item = &'a [u8]>, MeshFileError> {
    let (Some(view), None) = (accessor.view(), accessor.sparse()) else {
        return Err(must_be(accessor, "dense, with a buffer view"));
    };
    if !matches!(view.buffer().source(), Source::Bin) || view.buffer().index() != 0 {
        return Err(must_be(accessor, "in the file's own binary chunk"));
    }
    let size = accessor.size();
    let stride = view.stride().unwrap_or(size);
    let bytes = || {
        let end = view.offset().checked_add(view.length())?;
        let last = stride.checked_mul(accessor.count().checked_sub(1)?)?.checked_add(size)?;
        blob.get(view.offset()..end)?.get(accessor.offset()..)?.get(..last)
    };
    let bytes = bytes().filter(|_| stride >= size).ok_or(must_be(accessor, "within its buffer"))?;
    Ok(bytes.chunks(stride).map(move |item| &item[..size]))
}

fn must_be(accessor: &Accessor<'_>, wanted: &'static str) -> MeshFileError {
    MeshFileError::Accessor { accessor: accessor.index(), wanted }
}
