//! Materials of glTF files.

use std::{fs, path::Path, sync::Arc};

use approx::assert_abs_diff_eq;
use asperity_shading::StandardMaterialParameters;
use base64::{Engine, engine::general_purpose::STANDARD};
use glam::{Vec2, Vec3};
use serde_json::{Value, json};

use super::materials::{Coverage, MeshMaterials};
use super::tests::{CUBE_GLB, cube_gltf, glb, gltf_alone, reading, soup_of};
use super::*;
use crate::{
    geometry::{camera::Camera, mesh::TracedMesh, shape::Shape},
    image::{Format as ImageFormat, Image},
    integrator::pixels::{Sampling, Watch},
    scene::{Backdrop, Light, Object, Scene},
};

fn painted(json: &Value, bin: &[u8], folder: &Path) -> Result<MeshFile, MeshFileError> {
    let reading = MeshReading { materials: true, ..reading(Up::Y) };
    decode(Format::Gltf, &glb(json, bin), folder, reading)
}

fn primitives(json: &mut Value) -> impl Iterator<Item = &mut Value> {
    json["meshes"][0]["primitives"].as_array_mut().expect("primitives").iter_mut()
}

/// Returns the cube with these materials, the first of which covers it.
fn cube(materials: &Value) -> (Value, Vec<u8>) {
    let (mut json, bin) = cube_gltf();
    json["materials"] = materials.clone();
    primitives(&mut json).for_each(|primitive| primitive["material"] = json!(0));
    (json, bin)
}

fn materials(json: &Value, bin: &[u8]) -> MeshMaterials {
    painted(json, bin, Path::new("/nowhere"))
        .unwrap_or_else(|error| panic!("{error}"))
        .materials
        .expect("materials")
}

fn refusal(json: &Value, bin: &[u8]) -> String {
    let error = painted(json, bin, Path::new("/nowhere")).err().expect("must be refused").to_string();
    assert!(!error.contains('\n'), "{error}");
    error
}

#[test]
fn gltf_images_of_the_same_bytes_share_a_limit() {
    // Many images of 2048 × 2048 in the bytes of one.
    let image = Image { width: 2048, height: 2048, pixels: vec![Vec3::ZERO; 2048 * 2048] };
    let image = image.encode(ImageFormat::Png).unwrap();
    let material = |k: usize| json!({ "normalTexture": { "index": k } });
    let read = |count: usize| {
        let (mut json, mut bin) = cube(&(0..count).map(material).collect());
        json["bufferViews"].as_array_mut().unwrap().push(json!({
            "buffer": 0, "byteOffset": bin.len(), "byteLength": image.len()
        }));
        let view = json["bufferViews"].as_array().unwrap().len() - 1;
        bin.extend(&image);
        json["textures"] = (0..count).map(|k| json!({ "source": k })).collect();
        json["images"] = (0..count).map(|_| json!({ "bufferView": view })).collect();
        painted(&json, &bin, Path::new("")).err().map(|error| error.to_string())
    };
    assert_eq!(read(16), None);
    let error = read(60).expect("must be refused");
    assert!(error.starts_with("the glTF's images exceed "), "{error}");
}

/// Returns the data URI of a PNG with pixels that cannot be decoded.
fn large_header(image: &Value) -> Value {
    let (_, base64) = image["uri"].as_str().unwrap().split_once(',').unwrap();
    let mut bytes = STANDARD.decode(base64).unwrap();
    let begin = bytes.windows(4).position(|name| name == b"IDAT").unwrap() + 4;
    let end = bytes.len() - 16;
    bytes[begin..end].fill(0xff);
    data_uri(&bytes)
}

/// Returns a PNG of one color.
fn png(color: Vec3) -> Vec<u8> {
    Image::from_fn(2, 2, |_, _| color).encode(ImageFormat::Png).unwrap()
}

fn data_uri(bytes: &[u8]) -> Value {
    json!({ "uri": format!("data:image/png;base64,{}", STANDARD.encode(bytes)) })
}

#[test]
fn gltf_materials_are_read_with_their_extensions() {
    let (json, bin) = cube(&json!([
        {
            "pbrMetallicRoughness": {
                "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.6
            },
            "emissiveFactor": [0.1, 0.2, 0.3],
            "alphaMode": "MASK",
            "alphaCutoff": 0.25,
            "doubleSided": true,
            "extensions": {
                "KHR_materials_anisotropy": { "anisotropyStrength": 0.15, "anisotropyRotation": 7.0 },
                "KHR_materials_clearcoat": { "clearcoatFactor": 0.7, "clearcoatRoughnessFactor": 0.8 },
                "KHR_materials_emissive_strength": { "emissiveStrength": 10.0 },
                "KHR_materials_ior": { "ior": 1.33 },
                "KHR_materials_sheen": { "sheenColorFactor": [0.9, 0.8, 0.7], "sheenRoughnessFactor": 0.35 },
                "KHR_materials_specular": { "specularFactor": 0.45, "specularColorFactor": [1.5, 1, 0.5] },
                "KHR_materials_transmission": { "transmissionFactor": 0.55 },
                "KHR_materials_volume": {
                    "thicknessFactor": 0.65, "attenuationDistance": 2.0, "attenuationColor": [0.25, 0.5, 1]
                },
                "KHR_materials_iridescence": { "iridescenceFactor": 1.0 }
            }
        },
        { "alphaMode": "BLEND", "extensions": { "KHR_materials_unlit": {} } }
    ]));
    let read = materials(&json, &bin);
    let [first, second, usual] = &read.materials[..] else { panic!("{}", read.materials.len()) };
    let expected = StandardMaterialParameters {
        base_color: Vec3::new(0.1, 0.2, 0.3),
        metallic: 0.5,
        roughness: 0.6,
        emissive: Vec3::new(1.0, 2.0, 3.0),
        ior: 1.33,
        specular: 0.45,
        specular_color: Vec3::new(1.5, 1.0, 0.5),
        clearcoat: 0.7,
        clearcoat_roughness: 0.8,
        sheen_color: Vec3::new(0.9, 0.8, 0.7),
        sheen_roughness: 0.35,
        transmission: 0.55,
        thickness: 0.65,
        anisotropy: 0.15,
        anisotropy_rotation: 7.0 % std::f32::consts::TAU,
    };
    assert_eq!(first.parameters, expected);
    assert_eq!((first.alpha, first.coverage), (0.4, Coverage::Mask(0.25)));
    assert!(first.double_sided && !first.unlit);
    // In units of the cube's half diagonal.
    let half = 3.0_f32.sqrt() / 2.0 * cube_side();
    let absorbed = Vec3::new(4.0_f32.ln(), 2.0_f32.ln(), 0.0) / 2.0 * half;
    assert_abs_diff_eq!(first.absorption.coefficient(), absorbed, epsilon = 1e-4 * half);
    assert_eq!((second.coverage, second.unlit), (Coverage::Blend, true));
    assert_eq!((usual.parameters, usual.coverage), (StandardMaterialParameters::default(), Coverage::Opaque));
    assert!(read.corners.iter().all(|corner| corner.material == 0));
    assert_eq!(read.triangles.len(), 12);
}

/// Returns the side of the cube in its file.
fn cube_side() -> f32 {
    let cube = soup_of(&gltf_alone, CUBE_GLB);
    let x = || cube.corners.iter().map(|corner| corner.position.x);
    (x().fold(f64::MIN, f64::max) - x().fold(f64::MAX, f64::min)) as f32
}

#[test]
fn gltf_files_without_materials_have_none() {
    let (mut json, bin) = cube_gltf();
    json["materials"] = json!([]);
    assert!(painted(&json, &bin, Path::new("")).unwrap().materials.is_none());
    // Without the wish, materials may be anything.
    json["materials"] = json!("none");
    json["textures"] = json!([7]);
    assert!(decode(Format::Gltf, &glb(&json, &bin), Path::new(""), reading(Up::Y)).is_ok());
}

#[test]
fn gltf_textures_are_found_embedded_and_beside() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("red one.png"), png(Vec3::X)).unwrap();
    let info = json!({
        "index": 0, "texCoord": 1,
        "extensions": { "KHR_texture_transform": { "offset": [0.25, 0.5], "rotation": 0.5, "scale": [2, 4], "texCoord": 0 } }
    });
    let (mut json, mut bin) = cube(&json!([{
        "pbrMetallicRoughness": { "baseColorTexture": info, "metallicRoughnessTexture": { "index": 1 } },
        "normalTexture": { "index": 2, "scale": 0.5, "texCoord": 1 },
    }]));
    json["textures"] = json!([
        { "source": 0, "sampler": 0 }, { "source": 1 }, { "extensions": { "EXT_texture_webp": { "source": 2 } } }
    ]);
    json["samplers"] = json!([{ "wrapS": 33071, "wrapT": 33648, "magFilter": 9728 }]);
    let inside = png(Vec3::Y);
    json["bufferViews"].as_array_mut().unwrap().push(json!({
        "buffer": 0, "byteOffset": bin.len(), "byteLength": inside.len()
    }));
    let view = json["bufferViews"].as_array().unwrap().len() - 1;
    bin.extend(&inside);
    json["images"] = json!([{ "uri": "red%20one.png" }, data_uri(&png(Vec3::Z)), { "bufferView": view, "mimeType": "image/png" }]);
    let read =
        painted(&json, &bin, folder.path()).unwrap_or_else(|error| panic!("{error}")).materials.unwrap();
    let textures = &read.materials[0].textures;
    let [color, rough, normal] = [&textures.base_color, &textures.metallic_roughness, &textures.normal]
        .map(|map| map.as_ref().expect("a texture"));
    let at = [Vec2::splat(0.4); 2];
    for (map, expected) in [(color, Vec3::X), (rough, Vec3::Z), (normal, Vec3::Y)] {
        assert_eq!(map.data(at).truncate(), expected);
    }
    assert_eq!((color.set, rough.set, normal.set, color.nearest, rough.nearest), (0, 0, 1, true, false));
    assert_eq!(read.materials[0].normal_scale, 0.5);
    // T R S of the specification, with the rotation counterclockwise on the screen, where v points
    // down: (u, v) = (1, 0) moves up.
    let (sin, cos) = 0.5_f32.sin_cos();
    let moved = [Vec2::X, Vec2::Y].map(|p| color.transform.transform_point2(p));
    assert_abs_diff_eq!(moved[0], Vec2::new(0.25 + 2.0 * cos, 0.5 - 2.0 * sin), epsilon = 1e-6);
    assert_abs_diff_eq!(moved[1], Vec2::new(0.25 + 4.0 * sin, 0.5 + 4.0 * cos), epsilon = 1e-6);
}

#[test]
fn gltf_vertices_have_colors_and_two_sets_of_coordinates() {
    let (mut json, mut bin) = cube(&json!([{}]));
    // Of each primitive.
    let count = 12;
    let mut accessor = |name: &str, dimensions: &str, component: u32, value: &[u8]| {
        let at = bin.len();
        bin.extend((0..count).flat_map(|_| value));
        let views = json["bufferViews"].as_array_mut().unwrap();
        views.push(json!({ "buffer": 0, "byteOffset": at, "byteLength": bin.len() - at }));
        let view = views.len() - 1;
        let accessors = json["accessors"].as_array_mut().unwrap();
        accessors.push(json!({
            "bufferView": view, "componentType": component, "count": count, "type": dimensions, "normalized": component != 5126
        }));
        let index = accessors.len() - 1;
        primitives(&mut json).for_each(|primitive| primitive["attributes"][name] = json!(index));
    };
    accessor("COLOR_0", "VEC4", 5121, &[255, 51, 0, 102]);
    accessor("TEXCOORD_1", "VEC2", 5126, &[0.25_f32.to_le_bytes(), 0.75_f32.to_le_bytes()].concat());
    let read = materials(&json, &bin);
    for corner in &read.corners {
        assert_abs_diff_eq!(corner.color, glam::Vec4::new(1.0, 0.2, 0.0, 0.4), epsilon = 1e-6);
        assert_eq!(corner.uv[1], Vec2::new(0.25, 0.75));
    }
    // A color without alpha is opaque.
    let last = json["accessors"].as_array().unwrap().len() - 2;
    json["accessors"][last]["type"] = json!("VEC3");
    json["accessors"][last]["count"] = json!(count);
    assert!(materials(&json, &bin).corners.iter().all(|corner| corner.color.w == 1.0));
}

#[test]
fn gltf_material_errors() {
    let texture = |pointer: &str| {
        let mut material = json!({});
        material[pointer] = json!({ "index": 0 });
        json!([material])
    };
    let factor = |value: Value| json!([{}, { "pbrMetallicRoughness": { "baseColorFactor": value } }]);
    for (materials, textures, images, message) in [
        (
            factor(json!([1, 2])),
            json!([]),
            json!([]),
            "material 1 of the glTF has an invalid `baseColorFactor`",
        ),
        (factor(json!(["a", 0, 0, 1])), json!([]), json!([]), "has an invalid `baseColorFactor`"),
        (
            json!([{ "extensions": { "KHR_materials_ior": { "ior": "glass" } } }]),
            json!([]),
            json!([]),
            "material 0 of the glTF has an invalid `ior`",
        ),
        (json!([{ "normalTexture": 3 }]), json!([]), json!([]), "has an invalid `normalTexture`"),
        (
            json!([{ "normalTexture": { "index": -1 } }]),
            json!([]),
            json!([]),
            "has an invalid `normalTexture`",
        ),
        (
            json!([{ "normalTexture": { "index": 0, "texCoord": 9 } }]),
            json!([{ "source": 0 }]),
            json!([data_uri(&png(Vec3::Z))]),
            "material 0 of the glTF has `texCoord` 9 in `normalTexture` (at most 1: two sets are read)",
        ),
        (
            json!([{ "normalTexture": { "index": 0, "texCoord": -1 } }]),
            json!([{ "source": 0 }]),
            json!([{}]),
            "material 0 of the glTF has an invalid `texCoord`",
        ),
        (
            texture("normalTexture"),
            json!([]),
            json!([]),
            "the glTF has no texture 0 (it has 0, counted from 0)",
        ),
        (
            texture("normalTexture"),
            json!("x"),
            json!([]),
            "the glTF has no texture 0 (it has 0, counted from 0)",
        ),
        (
            texture("emissiveTexture"),
            json!([{ "source": 4 }]),
            json!([{}]),
            "the glTF has no image 4 (it has 1",
        ),
        (
            texture("emissiveTexture"),
            json!([{ "source": 0, "sampler": 2 }]),
            json!([{}]),
            "the glTF has no sampler 2 (it has 0",
        ),
        (
            texture("emissiveTexture"),
            json!([{ "source": 0 }]),
            json!([{}]),
            "the file has no buffer of its image",
        ),
        (
            texture("emissiveTexture"),
            json!([{ "source": 0 }]),
            json!([{ "bufferView": 999 }]),
            "the glTF has no buffer view 999",
        ),
        (
            texture("emissiveTexture"),
            json!([{ "source": 0 }]),
            json!([{ "uri": "../secret.png" }]),
            "glTF buffers and images must be embedded or in the glTF's folder, got `../secret.png`",
        ),
        (
            texture("emissiveTexture"),
            json!([{ "source": 0 }]),
            json!([{ "uri": "missing.png" }]),
            "cannot read the glTF's image `missing.png`: ",
        ),
        (
            texture("emissiveTexture"),
            json!([{ "source": 0 }]),
            json!([data_uri(b"GIF89a")]),
            "cannot read image 0 of the glTF: unsupported texture format",
        ),
        (
            texture("emissiveTexture"),
            json!([{ "source": 0 }]),
            json!([data_uri(&png(Vec3::X)[..40])]),
            "cannot read image 0 of the glTF: cannot decode the PNG",
        ),
        (
            texture("emissiveTexture"),
            json!([{ "extensions": { "KHR_texture_basisu": { "source": 0 } } }]),
            json!([{}]),
            "the glTF requires the unsupported extension KHR_texture_basisu",
        ),
    ] {
        let (mut json, bin) = cube(&materials);
        (json["textures"], json["images"]) = (textures, images);
        let got = refusal(&json, &bin);
        assert!(got.contains(message), "{got}\nexpected: {message}");
    }
    let (mut json, bin) = cube(&json!([{}]));
    for index in [json!(1), json!("first"), json!(u64::MAX)] {
        json["meshes"][0]["primitives"][0]["material"] = index;
        assert!(refusal(&json, &bin).starts_with("the glTF has no material "));
    }
}

#[test]
fn gltf_features_that_are_not_rendered_are_listed_once() {
    let (json, bin) = cube(&json!([
        { "occlusionTexture": { "index": 7 }, "extensions": { "KHR_materials_iridescence": {} } },
        {
            "occlusionTexture": { "index": 7 },
            "extensions": {
                "KHR_materials_volume": { "thicknessTexture": { "index": 7 } },
                "KHR_materials_clearcoat": { "clearcoatNormalTexture": { "index": 7 } },
                "KHR_materials_unlit": {}
            }
        }
    ]));
    let ignored = painted(&json, &bin, Path::new("")).unwrap().ignored;
    let expected =
        ["KHR_materials_iridescence", "clearcoatNormalTexture", "occlusionTexture", "thicknessTexture"];
    assert_eq!(ignored, expected);
    let (json, bin) = cube(&json!([{ "extensions": { "KHR_materials_ior": { "ior": 1.4 } } }]));
    assert!(painted(&json, &bin, Path::new("")).unwrap().ignored.is_empty());
}

#[test]
fn gltf_image_errors_name_the_files() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("broken one.png"), &png(Vec3::X)[..40]).unwrap();
    fs::write(folder.path().join("good.png"), png(Vec3::X)).unwrap();
    let error = |uris: &[&str]| {
        let material = |k: usize| json!({ "normalTexture": { "index": k } });
        let (mut json, bin) = cube(&(0..uris.len()).map(material).collect());
        json["textures"] = (0..uris.len()).map(|k| json!({ "source": k })).collect();
        json["images"] = uris.iter().map(|uri| json!({ "uri": uri })).collect();
        let error = painted(&json, &bin, folder.path()).err().expect("must be refused").to_string();
        assert_eq!(error.lines().count(), 1);
        error
    };
    let got = error(&["good.png", "broken%20one.png"]);
    assert!(
        got.starts_with("cannot read image `broken%20one.png` of the glTF: cannot decode the PNG"),
        "{got}"
    );
    assert_eq!(
        error(&["b.png", "good.png", "a.png", "c.png"]),
        "images of the glTF are missing: `b.png`, `a.png`, `c.png`"
    );
    let many: Vec<_> = (0..30).map(|k| format!("{k}.png")).collect();
    let got = error(&many.iter().map(String::as_str).collect::<Vec<_>>());
    assert!(got.contains("`0.png`") && got.ends_with("`19.png` and 10 more"), "{got}");
}

#[test]
fn gltf_images_of_one_file_share_a_limit() {
    // A PNG of 64 million equal texels is a hundred kilobytes.
    let large = Image { width: 8192, height: 8192, pixels: vec![Vec3::ZERO; 8192 * 8192] };
    let uri = data_uri(&large.encode(ImageFormat::Png).unwrap());
    drop(large);
    let names = ["emissiveTexture", "normalTexture"];
    let material = |k: usize| json!({ names[k % 2]: { "index": k } });
    let (mut json, bin) = cube(&(0..5).map(material).collect());
    json["textures"] = (0..5).map(|k| json!({ "source": k })).collect();
    json["images"] = vec![uri.clone(); 5].into();
    assert_eq!(
        refusal(&json, &bin),
        "the glTF's images exceed 268435456 texels, the limit for a file of this length"
    );
    // The size is in the header. The pixels of this file would be an error.
    let broken = large_header(&uri);
    json["images"] = vec![broken; 5].into();
    json["images"].as_array_mut().unwrap()[..4].fill(uri);
    assert_eq!(
        refusal(&json, &bin),
        "the glTF's images exceed 268435456 texels, the limit for a file of this length"
    );
}

#[test]
fn scene_shows_the_materials_of_a_file() {
    let shown = |material: Value, textures: [&[u8]; 1]| {
        let (mut json, bin) = cube(&json!([material]));
        json["textures"] = json!([{ "source": 0 }]);
        json["images"] = textures.map(data_uri).into_iter().collect();
        let file = painted(&json, &bin, Path::new("")).unwrap_or_else(|error| panic!("{error}"));
        let shape = Arc::new(Shape::Mesh(TracedMesh::new(file.mesh)));
        let object = Object::painted(shape, Arc::new(file.materials.unwrap()));
        let scene = Scene::new(vec![object], Light::Around(&Vec3::ONE), Backdrop::Color(Vec3::splat(0.25)));
        let sampling = Sampling { width: 16, height: 16, samples_per_pixel: 64, seed: 1 };
        let camera = Camera::new(Vec3::new(0.0, -5.0, 0.0), Vec3::ZERO, 0.1, 16, 16);
        let image = scene.draw(sampling, &camera, Watch::unseen()).unwrap();
        image.pixels.iter().sum::<Vec3>() / 256.0
    };
    let blue = png(Vec3::Z);
    let matte = json!({ "metallicFactor": 0, "roughnessFactor": 1, "baseColorFactor": [0.5, 0.25, 1, 1] });
    // A white sky: a matte surface shows its albedo, here with a few percent of gloss.
    let seen = shown(json!({ "pbrMetallicRoughness": matte }), [&blue]);
    assert_abs_diff_eq!(seen, Vec3::new(0.5, 0.25, 1.0), epsilon = 0.06);
    let mut textured = matte.clone();
    textured["baseColorTexture"] = json!({ "index": 0 });
    let seen = shown(json!({ "pbrMetallicRoughness": textured }), [&blue]);
    assert_abs_diff_eq!(seen, Vec3::Z, epsilon = 0.06);
    let glow = json!({
        "pbrMetallicRoughness": { "baseColorFactor": [0, 0, 0, 1] },
        "emissiveFactor": [1, 1, 0.5], "emissiveTexture": { "index": 0 },
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 4 } }
    });
    let seen = shown(glow, [&blue]);
    // A black metal still mirrors at grazing angles.
    assert_abs_diff_eq!(seen, Vec3::new(0.0, 0.0, 2.0), epsilon = 0.06);
    let mut half = json!({ "pbrMetallicRoughness": matte, "alphaMode": "BLEND" });
    half["pbrMetallicRoughness"]["baseColorFactor"] = json!([0.5, 0.25, 1, 0.5]);
    // Behind the front there is only the back, which is single-sided.
    let seen = shown(half, [&blue]);
    assert_abs_diff_eq!(seen, 0.5 * Vec3::new(0.75, 0.5, 1.25), epsilon = 0.06);
    let gone = json!({ "alphaMode": "MASK", "alphaCutoff": 1.5 });
    assert_eq!(shown(gone, [&blue]), Vec3::splat(0.25));
}
