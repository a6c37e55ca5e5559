//! The part of a glTF document that locates triangles and their materials.
//!
//! Field names follow the glTF 2.0 specification, section 5.

use std::collections::BTreeMap;

use glam::{DMat4, DQuat, DVec3};
use serde::{Deserialize, de::DeserializeOwned};
use serde_json::Value;

use crate::geometry::mesh_file::error::MeshFileError;

#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase", expecting = "a glTF document")]
pub(super) struct Document {
    pub(super) accessors: Vec<Accessor>,
    pub(super) buffer_views: Vec<BufferView>,
    pub(super) buffers: Vec<Buffer>,
    /// Lists about appearance are any JSON, because the triangles do not need them.
    pub(super) images: Value,
    pub(super) materials: Value,
    pub(super) meshes: Vec<Mesh>,
    pub(super) nodes: Vec<Node>,
    pub(super) samplers: Value,
    pub(super) scene: Option<usize>,
    pub(super) scenes: Vec<Scene>,
    pub(super) skins: Vec<Skin>,
    pub(super) textures: Value,
}

/// Version and required extensions, read first because other versions have other fields.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase", expecting = "a glTF document")]
struct Head {
    asset: Option<Asset>,
    #[serde(default)]
    extensions_required: Vec<String>,
}

#[derive(Deserialize)]
#[serde(expecting = "an object `asset`")]
struct Asset {
    version: Option<Value>,
}

#[derive(Default, Deserialize)]
#[serde(default, expecting = "a scene")]
pub(super) struct Scene {
    pub(super) nodes: Vec<usize>,
}

#[derive(Default, Deserialize)]
#[serde(default, expecting = "a node")]
pub(super) struct Node {
    pub(super) children: Vec<usize>,
    pub(super) mesh: Option<usize>,
    pub(super) skin: Option<usize>,
    pub(super) weights: Option<Vec<f64>>,
    matrix: Option<[f64; 16]>,
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
    pub(super) extensions: NodeExtensions,
}

#[derive(Default, Deserialize)]
#[serde(default, expecting = "extensions of a node")]
pub(super) struct NodeExtensions {
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub(super) instancing: Option<Instancing>,
    #[serde(rename = "KHR_node_visibility")]
    pub(super) visibility: Option<Visibility>,
}

#[derive(Deserialize)]
#[serde(expecting = "instances")]
pub(super) struct Instancing {
    #[serde(default)]
    pub(super) attributes: BTreeMap<String, usize>,
}

#[derive(Deserialize)]
#[serde(expecting = "a visibility")]
pub(super) struct Visibility {
    pub(super) visible: Option<bool>,
}

#[derive(Default, Deserialize)]
#[serde(default, expecting = "a mesh")]
pub(super) struct Mesh {
    pub(super) primitives: Vec<Primitive>,
    pub(super) weights: Option<Vec<f64>>,
}

#[derive(Default, Deserialize)]
#[serde(default, expecting = "a primitive")]
pub(super) struct Primitive {
    pub(super) attributes: BTreeMap<String, usize>,
    pub(super) indices: Option<usize>,
    pub(super) material: Value,
    pub(super) mode: Option<u8>,
    pub(super) targets: Vec<BTreeMap<String, usize>>,
    pub(super) extensions: PrimitiveExtensions,
}

#[derive(Default, Deserialize)]
#[serde(default, expecting = "extensions of a primitive")]
pub(super) struct PrimitiveExtensions {
    #[serde(rename = "KHR_draco_mesh_compression")]
    pub(super) draco: Option<DracoMesh>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", expecting = "a Draco mesh")]
pub(super) struct DracoMesh {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) attributes: BTreeMap<String, u32>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", expecting = "a skin")]
pub(super) struct Skin {
    pub(super) inverse_bind_matrices: Option<usize>,
    #[serde(default)]
    pub(super) joints: Vec<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", expecting = "an accessor")]
pub(super) struct Accessor {
    pub(super) buffer_view: Option<usize>,
    #[serde(default)]
    pub(super) byte_offset: usize,
    pub(super) component_type: u32,
    pub(super) count: usize,
    #[serde(default)]
    pub(super) normalized: bool,
    #[serde(rename = "type")]
    pub(super) dimensions: String,
    pub(super) sparse: Option<SparseConvolution>,
}

#[derive(Deserialize)]
#[serde(expecting = "sparse values")]
pub(super) struct SparseConvolution {
    pub(super) count: usize,
    pub(super) indices: SparsePart,
    pub(super) values: SparsePart,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", expecting = "indices or values")]
pub(super) struct SparsePart {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
    #[serde(default)]
    pub(super) component_type: u32,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", expecting = "a buffer view")]
pub(super) struct BufferView {
    pub(super) buffer: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
    pub(super) byte_length: usize,
    pub(super) byte_stride: Option<usize>,
    #[serde(default)]
    pub(super) extensions: BTreeMap<String, Value>,
}

#[derive(Deserialize)]
#[serde(expecting = "a buffer")]
pub(super) struct Buffer {
    pub(super) uri: Option<String>,
}

/// Supported extensions.
const READ: [&str; 4] =
    ["EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression", "KHR_mesh_quantization", "KHR_node_visibility"];

/// Name prefixes of extensions that do not affect triangles.
const OF_APPEARANCE: [&str; 23] = [
    "AGI_",
    "ADOBE_materials_",
    "CESIUM_primitive_outline",
    "EXT_feature_metadata",
    "EXT_instance_features",
    "EXT_lights_",
    "EXT_mesh_features",
    "EXT_mesh_manifold",
    "EXT_structural_metadata",
    "EXT_texture_",
    "GODOT_",
    "KHR_animation_",
    "KHR_audio",
    "KHR_interactivity",
    "KHR_lights_",
    "KHR_materials_",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_technique",
    "KHR_texture_",
    "KHR_xmp",
    "MSFT_packing_",
    "MSFT_texture_",
];

impl Document {
    /// Parses a glTF 2 document, and returns an error if it requires unsupported extensions.
    pub(super) fn parse(json: &[u8]) -> Result<Self, MeshFileError> {
        let Head { asset, extensions_required } = read(json)?;
        let version = match asset.and_then(|asset| asset.version) {
            Some(Value::String(version)) => version,
            other => other.map(|other| other.to_string()).unwrap_or_default(),
        };
        if version != "2" && !version.starts_with("2.") {
            return Err(MeshFileError::GltfVersion { version: shown(&version) });
        }
        for name in extensions_required {
            if name.ends_with("_meshopt_compression") {
                return Err(MeshFileError::Compressed { extension: shown(&name) });
            }
            let of_appearance = OF_APPEARANCE.iter().any(|prefix| name.starts_with(prefix));
            if !READ.contains(&&*name) && !of_appearance {
                return Err(MeshFileError::Extension { extension: shown(&name) });
            }
        }
        read(json)
    }

    /// Returns the nodes of the default scene, or of the first scene.
    pub(super) fn roots(&self) -> Result<&[usize], MeshFileError> {
        let scene = match self.scene {
            Some(index) => item(&self.scenes, "scene", index)?,
            None => self.scenes.first().ok_or(MeshFileError::Lacks { what: "scene" })?,
        };
        Ok(&scene.nodes)
    }
}

impl Node {
    /// Returns the transform relative to the parent.
    pub(super) fn transform(&self) -> DMat4 {
        if let Some(matrix) = &self.matrix {
            return DMat4::from_cols_array(matrix);
        }
        trs(
            DVec3::from(self.translation.unwrap_or_default()),
            DQuat::from_array(self.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0])),
            DVec3::from(self.scale.unwrap_or([1.0; 3])),
        )
    }
}

/// Returns the matrix that scales, rotates and translates. A rotation of length 0 is the identity.
pub(super) fn trs(translation: DVec3, rotation: DQuat, scale: DVec3) -> DMat4 {
    let length = rotation.length();
    let rotation = if length > 0.0 { rotation / length } else { DQuat::IDENTITY };
    DMat4::from_scale_rotation_translation(scale, rotation, translation)
}

/// Returns an item of a list of the document.
pub(super) fn item<'a, T>(list: &'a [T], what: &'static str, index: usize) -> Result<&'a T, MeshFileError> {
    list.get(index).ok_or(MeshFileError::NoSuchItem { what, index, count: list.len() })
}

/// Parses JSON, also in the form that JavaScript loaders accept: null for absent values, and
/// integers with a fraction of 0.
fn read<T: DeserializeOwned>(json: &[u8]) -> Result<T, MeshFileError> {
    serde_json::from_slice(json).or_else(|error| {
        let loose = || serde_json::from_value(tidied(serde_json::from_slice(json).ok()?)).ok();
        loose().ok_or_else(|| broken(&error))
    })
}

/// Removes nulls from objects and converts whole numbers to integers.
fn tidied(value: Value) -> Value {
    match value {
        Value::Object(fields) => {
            fields.into_iter().filter(|(_, v)| !v.is_null()).map(|(name, v)| (name, tidied(v))).collect()
        }
        Value::Array(items) => items.into_iter().map(tidied).collect(),
        Value::Number(number) => match number.as_f64() {
            Some(x) if number.is_f64() && x.fract() == 0.0 && (0.0..1e15).contains(&x) => (x as u64).into(),
            _ => number.into(),
        },
        other => other,
    }
}

/// Converts the JSON parser's message to JSON type names.
fn broken(error: &serde_json::Error) -> MeshFileError {
    let named = [
        ("expected usize", "expected an index"),
        ("expected u32", "expected an integer"),
        ("expected u8", "expected an integer"),
        ("expected f64", "expected a number"),
        ("expected a sequence", "expected an array"),
        ("expected a map", "expected an object"),
        ("invalid type: sequence", "invalid type: an array"),
        ("invalid type: map", "invalid type: an object"),
    ];
    let words = named.into_iter().fold(error.to_string(), |words, (from, to)| words.replace(from, to));
    MeshFileError::broken("glTF", words)
}

/// Returns the beginning of a name.
pub(super) fn shown(name: &str) -> String {
    name.chars().filter(|c| !c.is_control()).take(100).collect()
}
