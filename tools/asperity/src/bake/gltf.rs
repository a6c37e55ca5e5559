//! A glTF scene of a square with the material, for viewers and engines.

use asperity_render::image::tone::linear;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use crate::bake::maps::Map;
use crate::bake::set::Set;
use crate::cli::bake::BakedFormat as Format;
use crate::failure::Result;
use crate::output::Output;

/// Writes `material.gltf`.
pub(super) fn write(set: &Set<'_>, output: &Output) -> Result<()> {
    if !set.formats.contains(&Format::Png) {
        // Core glTF supports no other format of this program.
        return Ok(());
    }
    let text = serde_json::to_vec_pretty(&document(set)?)?;
    Ok(output.write("material.gltf", &text)?)
}

fn document(set: &Set<'_>) -> Result<Value> {
    let (mut images, mut material) = (Vec::new(), json!({ "name": "baked" }));
    let mut texture = |name: &str| {
        images.push(json!({ "uri": name, "mimeType": "image/png" }));
        json!({ "index": images.len() - 1 })
    };
    for map in set.maps() {
        match map.map {
            Map::BaseColor if map.differs() => {
                material["pbrMetallicRoughness"]["baseColorTexture"] = texture(&map.file(Format::Png));
            }
            Map::BaseColor => {
                let unit = |word: &u16| linear(f32::from(*word) / 65_535.0);
                let factor: Vec<f32> = map.uniform()?.iter().map(unit).chain([1.0]).collect();
                material["pbrMetallicRoughness"]["baseColorFactor"] = json!(factor);
            }
            Map::NormalOpenGl => material["normalTexture"] = texture(&map.file(Format::Png)),
            Map::Packed => {
                let packed = texture(&map.file(Format::Png));
                material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = packed.clone();
                if set.plan.source.varies().height {
                    material["occlusionTexture"] = packed;
                }
            }
            _ => {}
        }
    }
    let mut used = Vec::new();
    if let Some(alpha) = set.plan.source.coat() {
        material["extensions"]["KHR_materials_clearcoat"] =
            json!({ "clearcoatFactor": 1.0, "clearcoatRoughnessFactor": alpha.max(0.0).sqrt() });
        used.push("KHR_materials_clearcoat");
    }
    let textures: Vec<Value> = (0..images.len()).map(|k| json!({ "source": k, "sampler": 0 })).collect();
    let wrap = if set.plan.tileable { 10_497 } else { 33_071 };
    let (bytes, accessors, views) = square();
    let mut document = json!({
        "asset": { "version": "2.0", "generator": "asperity bake" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0, "name": "square" }],
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": 0, "NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3 }, "indices": 4, "material": 0,
        }] }],
        "materials": [material],
        "textures": textures,
        "images": images,
        "samplers": [{ "magFilter": 9729, "minFilter": 9987, "wrapS": wrap, "wrapT": wrap }],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{
            "byteLength": bytes.len(),
            "uri": format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes)),
        }],
    });
    if !used.is_empty() {
        document["extensionsUsed"] = json!(used);
    }
    Ok(document)
}

/// Returns the unit square in the plane z = 0: bytes, accessors and views.
fn square() -> (Vec<u8>, Value, Value) {
    const CORNERS: [[f32; 2]; 4] = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    let mut bytes = Vec::new();
    let mut put = |numbers: &[f32]| bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
    CORNERS.iter().for_each(|[x, y]| put(&[*x, *y, 0.0]));
    CORNERS.iter().for_each(|_| put(&[0.0, 0.0, 1.0]));
    CORNERS.iter().for_each(|_| put(&[1.0, 0.0, 0.0, 1.0]));
    // The first row of an image is at v = 0.
    CORNERS.iter().for_each(|[x, y]| put(&[x + 0.5, 0.5 - y]));
    bytes.extend([0_u16, 1, 2, 0, 2, 3].iter().flat_map(|k| k.to_le_bytes()));
    let float = |view: u32, kind: &str| json!({ "bufferView": view, "componentType": 5126, "count": 4, "type": kind });
    let mut position = float(0, "VEC3");
    position["min"] = json!([-0.5, -0.5, 0.0]);
    position["max"] = json!([0.5, 0.5, 0.0]);
    let indices = json!({ "bufferView": 4, "componentType": 5123, "count": 6, "type": "SCALAR" });
    let accessors = json!([position, float(1, "VEC3"), float(2, "VEC4"), float(3, "VEC2"), indices]);
    let view = |offset: u32, length: u32, target: u32| json!({ "buffer": 0, "byteOffset": offset, "byteLength": length, "target": target });
    let views = json!([
        view(0, 48, 34_962),
        view(48, 48, 34_962),
        view(96, 64, 34_962),
        view(160, 32, 34_962),
        view(192, 12, 34_963)
    ]);
    (bytes, accessors, views)
}
