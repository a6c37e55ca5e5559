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
    triangle_soup::TriangleSoup,
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
    // By the standard, triangles without normals are flat: each has corners of its own.
    let vertices: Vec<usize> = match normals {
        Some(_) => (0..positions.len()).collect(),
        None => triangles.iter().flatten().map(|&i| i as usize).collect(),
    };
    let first = soup.positions.len();
    // Any number of primitives may name the same accessor.
    if first + vertices.len() > 3 * MOST_TRIANGLES {
        return Err(MeshFileError::TooLarge);
    }
    soup.positions
        .extend(vertices.iter().map(|&i| place.transform_point3(Vec3::from(positions[i]).as_dvec3())));
    if let Some(uv) = uv {
        let upright = |&[u, v]: &[f32; 2]| Vec2::new(u, 1.0 - v);
        soup.uv.resize(first, Vec2::ZERO);
        soup.uv.extend(vertices.iter().map(|&i| uv.get(i).map_or(Vec2::ZERO, upright)));
    }
    soup.normals.resize(first, Vec3::ZERO);
    match normals {
        Some(normals) => soup.normals.extend(vertices.iter().map(|&i| {
            let given = normals.get(i).copied().map_or(Vec3::ZERO, Vec3::from);
            let turned = (cofactors * given.as_dvec3()).normalize_or_zero().as_vec3();
            if given.is_finite() { turned } else { given }
        })),
        None => {
            let (flat, _) = soup.positions[first..].as_chunks::<3>();
            soup.normals.extend(
                flat.iter().flat_map(|[a, b, c]| [(b - a).cross(c - a).normalize_or_zero().as_vec3(); 3]),
            );
            triangles = (0..triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
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
    let component = |bytes: &[u8]| match *bytes {
        [a, b, c, d] => f32::from_le_bytes([a, b, c, d]),
        [a, b] => f32::from(u16::from_le_bytes([a, b])) / 65_535.0,
        [a] => f32::from(a) / 255.0,
        _ => 0.0,
    };
    let kind = accessor.data_type();
    let whole = N == 2 && accessor.normalized() && matches!(kind, DataType::U8 | DataType::U16);
    if accessor.dimensions() != dimensions || !(kind == DataType::F32 || whole) {
        let wanted = if N == 3 { "vectors of three floats" } else { "vectors of two floats or shares" };
        return Err(must_be(accessor, wanted));
    }
    let item = |bytes: &[u8]| {
        let mut out = [0.0; N];
        out.iter_mut().zip(bytes.chunks_exact(kind.size())).for_each(|(o, bytes)| *o = component(bytes));
        out
    };
    Ok(items(accessor, blob)?.map(item).collect())
}

fn indices(accessor: &Accessor<'_>, blob: &[u8]) -> Result<Vec<u32>, MeshFileError> {
    let known = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
    if accessor.dimensions() != Dimensions::Scalar || !known {
        return Err(must_be(accessor, "unsigned integers"));
    }
    let number = |bytes: &[u8]| bytes.iter().rev().fold(0, |sum, &byte| sum << 8 | u32::from(byte));
    Ok(items(accessor, blob)?.map(number).collect())
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
