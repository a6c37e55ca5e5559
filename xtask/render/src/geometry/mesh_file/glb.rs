//! glTF 2.0, in one file or with its buffers beside it, by `gltf`.

use std::{
    borrow::Cow,
    cell::Cell,
    path::{Component, Path},
};

use base64::{Engine, prelude::BASE64_STANDARD};
use glam::{DMat3, DMat4, Vec2, Vec3};
use gltf::{
    Accessor, Document, Glb, Node, Primitive, Semantic,
    accessor::{DataType, Dimensions},
    buffer::{Source, View},
    json::{
        Root,
        validation::{Checked, Error},
    },
    mesh::Mode,
};
use serde_json::{Value, json};

use crate::{
    geometry::mesh_file::{
        draco::{self, Arrays},
        error::{MOST_BYTES, MOST_TRIANGLES, MeshFileError},
        triangle_soup::{Corner, TriangleSoup},
    },
    input_file,
};

/// All triangles of the default scene, or else of the first, where its nodes put them. Skins, morph targets and
/// materials are passed over; v goes upwards.
pub(super) fn parse(bytes: &[u8], folder: &Path) -> Result<TriangleSoup, MeshFileError> {
    let scene = Scene::read(bytes, folder)?;
    scene.soup()
}

/// The document, checked by the rules of the library, and its buffers.
struct Scene {
    document: Document,
    buffers: Vec<Vec<u8>>,
    /// Accessors that have no buffer view: their items are zero.
    empty: Vec<bool>,
    /// Bytes of the document and its buffers: no accessor has as many items, be they zero.
    bytes: usize,
    /// Bytes that may still be read: any number of primitives may name the same accessor.
    left: Cell<usize>,
}

impl Scene {
    fn read(bytes: &[u8], folder: &Path) -> Result<Self, MeshFileError> {
        let container = |error| MeshFileError::broken("glTF container", error);
        let broken = |path: &str, error| MeshFileError::broken("glTF", format!("{path}: {error}"));
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let (json, bin) = if text.trim_ascii_start().starts_with(b"{") {
            (Cow::Borrowed(text), None)
        } else {
            // The library takes the header's own length off the one in the header, however short that is.
            let length =
                bytes.get(8..12).and_then(|field| field.try_into().ok()).map_or(0, u32::from_le_bytes);
            if length < 20 {
                return Err(container(
                    gltf::binary::Error::Length { length, length_read: bytes.len() }.into(),
                ));
            }
            let Glb { json, bin, .. } = Glb::from_slice(bytes).map_err(container)?;
            (json, bin)
        };
        let mut json: Value =
            serde_json::from_slice(&json).map_err(|error| MeshFileError::broken("glTF", error))?;
        let empty = geometry_alone(&mut json)?;
        let root: Root =
            serde_json::from_value(json).map_err(|error| MeshFileError::broken("glTF", error))?;
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
        let mut bin = bin.map(Cow::into_owned);
        let (mut buffers, mut all) = (Vec::new(), bytes.len());
        for buffer in document.buffers() {
            let buffer = match buffer.source() {
                Source::Bin => bin.take().unwrap_or_default(),
                Source::Uri(uri) => fetched(uri, folder)?,
            };
            all += buffer.len();
            if all as u64 > MOST_BYTES {
                return Err(MeshFileError::BuffersTooLong);
            }
            buffers.push(buffer);
        }
        Ok(Self { document, buffers, empty, bytes: all, left: Cell::new(MOST_BYTES as usize) })
    }

    fn soup(&self) -> Result<TriangleSoup, MeshFileError> {
        let document = &self.document;
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
                self.append(&mut soup, &primitive, place)?;
            }
            open.extend(node.children().map(|child| (child, place)));
        }
        Ok(soup)
    }

    fn append(
        &self,
        soup: &mut TriangleSoup,
        primitive: &Primitive<'_>,
        place: DMat4,
    ) -> Result<(), MeshFileError> {
        if matches!(primitive.mode(), Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
            return Ok(());
        }
        let Some(positions) = primitive.get(&Semantic::Positions) else { return Ok(()) };
        let Arrays { positions, normals, uv, corners } = match primitive.extension_value(draco::EXTENSION) {
            Some(compressed) => {
                let view =
                    compressed["bufferView"].as_u64().and_then(|k| self.document.views().nth(k as usize));
                let bytes = view.and_then(|view| self.within(&view));
                let arrays = draco::decode(
                    bytes.ok_or(MeshFileError::Lacks { what: "buffer of its Draco mesh" })?,
                    &compressed["attributes"],
                )?;
                self.charge(12 * arrays.positions.len())?;
                arrays
            }
            None => {
                let positions = self.floats::<3>(&positions)?;
                let normals = primitive.get(&Semantic::Normals).map(|a| self.floats::<3>(&a)).transpose()?;
                let uv = primitive.get(&Semantic::TexCoords(0)).map(|a| self.floats::<2>(&a)).transpose()?;
                let corners = match primitive.indices() {
                    Some(accessor) => self.indices(&accessor)?,
                    None => (0..positions.len() as u32).collect(),
                };
                Arrays { positions, normals, uv, corners }
            }
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

    fn floats<const N: usize>(&self, accessor: &Accessor<'_>) -> Result<Vec<[f32; N]>, MeshFileError> {
        let dimensions = if N == 3 { Dimensions::Vec3 } else { Dimensions::Vec2 };
        if accessor.dimensions() != dimensions {
            let wanted = if N == 3 { "vectors of three numbers" } else { "vectors of two numbers" };
            return Err(must_be(accessor, wanted));
        }
        let top = if accessor.normalized() { 1.0 } else { 0.0 };
        // Integers are shares of their range where they are normalised, as meshes have them that are quantised.
        let component = |bits: u32| match accessor.data_type() {
            DataType::F32 => f32::from_bits(bits),
            DataType::U8 => bits as f32 / (1.0 + 254.0 * top),
            DataType::U16 => bits as f32 / (1.0 + 65_534.0 * top),
            DataType::I8 => (f32::from(bits as u8 as i8) / (1.0 + 126.0 * top)).max(-1.0 / top),
            DataType::I16 => (f32::from(bits as u16 as i16) / (1.0 + 32_766.0 * top)).max(-1.0 / top),
            DataType::U32 => bits as f32,
        };
        let size = accessor.data_type().size();
        let item = |bytes: &[u8]| std::array::from_fn(|k| component(number(&bytes[k * size..][..size])));
        Ok(self.items(accessor)?.chunks_exact(accessor.size()).map(item).collect())
    }

    fn indices(&self, accessor: &Accessor<'_>) -> Result<Vec<u32>, MeshFileError> {
        let known = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
        if accessor.dimensions() != Dimensions::Scalar || !known {
            return Err(must_be(accessor, "unsigned integers"));
        }
        Ok(self.items(accessor)?.chunks_exact(accessor.size()).map(number).collect())
    }

    /// The bytes of all items, one behind the other.
    fn items(&self, accessor: &Accessor<'_>) -> Result<Vec<u8>, MeshFileError> {
        let outside = || must_be(accessor, "within its buffer");
        let (size, count) = (accessor.size(), accessor.count());
        let mut items = match accessor.view().filter(|_| !self.empty[accessor.index()]) {
            Some(view) => self.run(&view, accessor.offset(), size, count).ok_or_else(outside)?,
            None if count <= self.bytes => vec![0; count * size],
            None => return Err(MeshFileError::TooLarge),
        };
        self.charge(items.len())?;
        if let Some(sparse) = accessor.sparse() {
            let (at, values) = (sparse.indices(), sparse.values());
            let width = at.index_type().size();
            let places = self.run(&at.view(), at.offset(), width, sparse.count()).ok_or_else(outside)?;
            let values =
                self.run(&values.view(), values.offset(), size, sparse.count()).ok_or_else(outside)?;
            for (place, value) in places.chunks_exact(width).zip(values.chunks_exact(size)) {
                let item = items.chunks_exact_mut(size).nth(number(place) as usize).ok_or_else(outside)?;
                item.copy_from_slice(value);
            }
        }
        Ok(items)
    }

    /// Takes so many bytes off those that may still be read.
    fn charge(&self, bytes: usize) -> Result<(), MeshFileError> {
        self.left.set(self.left.get().checked_sub(bytes).ok_or(MeshFileError::TooLarge)?);
        Ok(())
    }

    /// So many items of this size from an offset in a view.
    fn run(&self, view: &View<'_>, offset: usize, size: usize, count: usize) -> Option<Vec<u8>> {
        let stride = view.stride().unwrap_or(size);
        let length = stride.checked_mul(count.checked_sub(1)?)?.checked_add(size)?;
        let bytes = self.within(view)?.get(offset..)?.get(..length).filter(|_| stride >= size)?;
        Some(bytes.chunks(stride).flat_map(|item| &item[..size]).copied().collect())
    }

    /// The bytes of a view.
    fn within(&self, view: &View<'_>) -> Option<&[u8]> {
        let end = view.offset().checked_add(view.length())?;
        self.buffers.get(view.buffer().index())?.get(view.offset()..end)
    }
}

/// Leaves out of a document what is passed over, so that nothing of it can be wrong, and says which accessors have no buffer view.
fn geometry_alone(json: &mut Value) -> Result<Vec<bool>, MeshFileError> {
    let compressed = |name: &&Value| name.as_str().is_some_and(|name| name.ends_with("_meshopt_compression"));
    let required = json["extensionsRequired"].as_array().and_then(|all| all.iter().find(compressed));
    if let Some(extension) = required.and_then(Value::as_str) {
        return Err(MeshFileError::Compressed { extension: extension.into() });
    }
    let leave = |value: &mut Value, names: &[&str]| {
        if let Some(fields) = value.as_object_mut() {
            fields.retain(|name, _| !names.contains(&name.as_str()));
        }
    };
    leave(
        json,
        &[
            "animations",
            "cameras",
            "images",
            "materials",
            "samplers",
            "skins",
            "textures",
            "extensionsRequired",
        ],
    );
    let each = |value: &mut Value, name: &str, change: &mut dyn FnMut(&mut Value)| {
        value.get_mut(name).and_then(Value::as_array_mut).into_iter().flatten().for_each(change);
    };
    each(json, "nodes", &mut |node| leave(node, &["camera", "skin", "weights"]));
    each(json, "meshes", &mut |mesh| {
        leave(mesh, &["weights"]);
        each(mesh, "primitives", &mut |primitive| leave(primitive, &["material", "targets"]));
    });
    let mut empty = Vec::new();
    each(json, "accessors", &mut |accessor| {
        let Some(fields) = accessor.as_object_mut() else { return };
        // The library asks for bounds and a view, which a Draco mesh has not.
        for bound in ["min", "max"] {
            fields.entry(bound).or_insert_with(|| json!([0, 0, 0]));
        }
        let view = fields.entry("bufferView").or_insert(Value::Null);
        empty.push(view.is_null());
        if view.is_null() {
            *view = json!(0);
            fields.remove("byteOffset");
        }
    });
    if empty.contains(&true) && json["bufferViews"].as_array().is_none_or(Vec::is_empty) {
        json["bufferViews"] = json!([{ "buffer": 0, "byteLength": 1 }]);
        if json["buffers"].as_array().is_none_or(Vec::is_empty) {
            json["buffers"] = json!([{ "byteLength": 1, "uri": "data:,AA==" }]);
        }
    }
    Ok(empty)
}

/// The bytes that a URI stands for: in itself, or a file beside the document.
fn fetched(uri: &str, folder: &Path) -> Result<Vec<u8>, MeshFileError> {
    let shown = || uri.chars().filter(|c| !c.is_control()).take(100).collect::<String>();
    if let Some((_, data)) = uri.strip_prefix("data:").and_then(|data| data.split_once(',')) {
        return BASE64_STANDARD
            .decode(data)
            .map_err(|error| MeshFileError::broken("glTF", format!("data URI: {error}")));
    }
    let name = String::from_utf8(unescaped(uri))
        .ok()
        .filter(|name| !name.contains(':') && Path::new(name).components().all(is_below));
    let file = name.map(|name| folder.join(name)).ok_or_else(|| MeshFileError::Elsewhere { uri: shown() })?;
    input_file::read(&file, MOST_BYTES).map_err(|error| MeshFileError::Buffer { uri: shown(), error })
}

/// Whether a step of a path leads nowhere but to what is below.
fn is_below(step: Component<'_>) -> bool {
    matches!(step, Component::Normal(_) | Component::CurDir)
}

/// The bytes of a URI, `%20` being a space.
fn unescaped(uri: &str) -> Vec<u8> {
    let mut rest = uri.as_bytes();
    let mut bytes = Vec::new();
    while let [first, behind @ ..] = rest {
        let digits =
            behind.first_chunk::<2>().filter(|_| *first == b'%').and_then(|d| std::str::from_utf8(d).ok());
        match digits.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) => (bytes.push(byte), rest = &behind[2..]),
            None => (bytes.push(*first), rest = behind),
        };
    }
    bytes
}

/// The little-endian number of up to four bytes.
fn number(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |sum, &byte| sum << 8 | u32::from(byte))
}

fn must_be(accessor: &Accessor<'_>, wanted: &'static str) -> MeshFileError {
    MeshFileError::Accessor { accessor: accessor.index(), wanted }
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
