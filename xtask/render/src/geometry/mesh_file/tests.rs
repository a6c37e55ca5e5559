//! Files that are right, cut off, and spoilt: each gives a right mesh or one clear line.

use std::{fmt::Write, fs};

use approx::assert_abs_diff_eq;
use glam::Vec3;
use serde_json::{Value, json};

use crate::geometry::mesh_file::*;
use crate::{geometry::mesh::TracedMesh, sampling::random::Random};

/// Corners of the cube of side 2, x fastest.
fn corner(k: usize) -> [f32; 3] {
    [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { 1.0 } else { -1.0 })
}

/// The faces of the cube, turning to the left from outside.
const FACES: [[usize; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// Texture coordinates of each face's corners.
const UV: [[f32; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

fn cube_obj() -> String {
    let mut text = String::from("# a cube\nmtllib none.mtl\no cube\n");
    for k in 0..8 {
        let [x, y, z] = corner(k);
        writeln!(text, "v {x} {y} {z}").unwrap();
    }
    UV.iter().for_each(|[u, v]| writeln!(text, "vt {u} {v}").unwrap());
    for [a, b, c, d] in FACES.map(|face| face.map(|k| k + 1)) {
        writeln!(text, "f {a}/1 {b}/2 {c}/-2 {d}/4").unwrap();
    }
    text + "l 1 2 3\np 4\n"
}

#[derive(Clone, Copy, PartialEq)]
enum Encoding {
    Ascii,
    Little,
    Big,
}

fn cube_ply(encoding: Encoding) -> Vec<u8> {
    let name = match encoding {
        Encoding::Ascii => "ascii",
        Encoding::Little => "binary_little_endian",
        Encoding::Big => "binary_big_endian",
    };
    let mut bytes = format!(
        "ply\nformat {name} 1.0\ncomment a cube\nelement vertex 8\nproperty float x\nproperty double y\n\
         property float z\nproperty uchar red\nelement edge 1\nproperty int a\nelement face 6\n\
         property list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    let put = |bytes: &mut Vec<u8>, little: &[u8], value: f64| match encoding {
        Encoding::Ascii => bytes.extend(format!("{value} ").bytes()),
        Encoding::Little => bytes.extend(little),
        Encoding::Big => bytes.extend(little.iter().rev()),
    };
    let end = |bytes: &mut Vec<u8>| {
        if encoding == Encoding::Ascii {
            bytes.push(b'\n');
        }
    };
    for k in 0..8 {
        let [x, y, z] = corner(k);
        put(&mut bytes, &x.to_le_bytes(), x.into());
        put(&mut bytes, &f64::from(y).to_le_bytes(), y.into());
        put(&mut bytes, &z.to_le_bytes(), z.into());
        put(&mut bytes, &[200], 200.0);
        end(&mut bytes);
    }
    put(&mut bytes, &7_i32.to_le_bytes(), 7.0);
    end(&mut bytes);
    for face in FACES {
        put(&mut bytes, &[4], 4.0);
        face.iter().for_each(|&k| put(&mut bytes, &(k as i32).to_le_bytes(), k as f64));
        end(&mut bytes);
    }
    bytes
}

fn glb(json: &Value, bin: &[u8]) -> Vec<u8> {
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((12 + 8 + text.len() as u32 + 8 + bin.len() as u32).to_le_bytes());
    bytes.extend((text.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(text);
    bytes.extend((bin.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(bin);
    bytes
}

/// Six faces of four corners each, two primitives of three faces, under two nodes.
fn cube_gltf() -> (Value, Vec<u8>) {
    let mut bin = Vec::new();
    for face in FACES {
        let normal = face.iter().fold(Vec3::ZERO, |sum, &k| sum + Vec3::from(corner(k))).normalize();
        for (&k, uv) in face.iter().zip(UV) {
            // Downwards, as glTF has v.
            let numbers = [corner(k).as_slice(), &normal.to_array(), &[uv[0], 1.0 - uv[1]]].concat();
            bin.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        }
    }
    let indices = (0..3_u16).flat_map(|f| [0, 1, 2, 0, 2, 3].map(|k| 4 * f + k));
    bin.extend(indices.flat_map(u16::to_le_bytes));
    let half = |first: usize| {
        let accessor = |offset: usize, kind: &str| {
            json!({"bufferView": 0, "byteOffset": first * 128 + offset, "componentType": 5126, "count": 12,
                   "type": kind, "min": [-1, -1, -1], "max": [1, 1, 1]})
        };
        [accessor(0, "VEC3"), accessor(12, "VEC3"), accessor(24, "VEC2")]
    };
    let primitive = |first: usize| json!({"attributes": {"POSITION": first, "NORMAL": first + 1, "TEXCOORD_0": first + 2}, "indices": 6});
    let [a, b, c] = half(0);
    let [d, e, f] = half(3);
    let json = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"children": [1], "translation": [5, 6, 7]}, {"mesh": 0, "scale": [2, 2, 2]}],
        "meshes": [{"primitives": [primitive(0), primitive(3)]}],
        "accessors": [a, b, c, d, e, f,
            {"bufferView": 1, "componentType": 5123, "count": 18, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 768, "byteStride": 32},
            {"buffer": 0, "byteOffset": 768, "byteLength": 36}],
        "buffers": [{"byteLength": 804}],
    });
    (json, bin)
}

fn cube_glb() -> Vec<u8> {
    let (json, bin) = cube_gltf();
    glb(&json, &bin)
}

fn good() -> [(&'static str, Parser, Vec<u8>); 5] {
    [
        ("obj", obj::parse, cube_obj().into_bytes()),
        ("ascii ply", ply::parse, cube_ply(Encoding::Ascii)),
        ("little-endian ply", ply::parse, cube_ply(Encoding::Little)),
        ("big-endian ply", ply::parse, cube_ply(Encoding::Big)),
        ("glb", glb::parse, cube_glb()),
    ]
}

/// Properties of every mesh.
fn check(name: &str, mesh: &Mesh) {
    assert!(!mesh.triangles.is_empty(), "{name}");
    for triangle in &mesh.triangles {
        assert!(triangle.iter().all(|&i| (i as usize) < mesh.vertices.len()), "{name}: {triangle:?}");
    }
    for v in &mesh.vertices {
        assert!(v.position.length() < 1.0 + 1e-6 && v.uv.is_finite(), "{name}: {v:?}");
        assert_abs_diff_eq!(v.normal.length(), 1.0, epsilon = 1e-5);
        assert_abs_diff_eq!(v.tangent.length(), 1.0, epsilon = 1e-5);
        assert_abs_diff_eq!(v.normal.dot(v.tangent), 0.0, epsilon = 1e-5);
    }
}

fn volume(mesh: &Mesh) -> f32 {
    let six = mesh.triangles.iter().map(|t| {
        let [a, b, c] = t.map(|i| mesh.vertices[i as usize].position);
        a.dot(b.cross(c))
    });
    six.sum::<f32>() / 6.0
}

fn refusal(parse: Parser, bytes: &[u8]) -> String {
    let error = mesh(parse, bytes, Up::Y).err().expect("must be refused");
    let text = error.to_string();
    assert!(text.lines().count() == 1 && !text.chars().any(char::is_control), "{text:?}");
    text
}

#[test]
fn a_cube_is_the_same_in_every_format() {
    for (name, parse, bytes) in good() {
        for up in [Up::Y, Up::Z] {
            let mesh = mesh(parse, &bytes, up).unwrap();
            check(name, &mesh);
            assert_eq!(mesh.triangles.len(), 12, "{name}");
            // Side 2/√3 in the unit ball, seen from outside.
            assert_abs_diff_eq!(volume(&mesh), (4.0_f32 / 3.0).powf(1.5), epsilon = 1e-5);
            for v in &mesh.vertices {
                let along = v.normal.dot(v.position.normalize());
                // Given: of the face. Computed: of the three faces about the corner.
                let expected = if name == "glb" { 1.0 / 3.0_f32.sqrt() } else { 1.0 };
                assert_abs_diff_eq!(along, expected, epsilon = 1e-5);
            }
            TracedMesh::new(mesh);
        }
    }
}

#[test]
fn tangents_follow_u_and_v_goes_upwards() {
    let quad = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    let plain = format!("{quad}f 1/1 2/2 3/3 4/4\n").into_bytes();
    let mirrored = format!("{quad}f 1/2 2/1 3/4 4/3\n").into_bytes();
    for (parse, bytes, hand) in
        [(obj::parse as Parser, plain, 1.0), (obj::parse, mirrored, -1.0), (glb::parse, cube_glb(), 1.0)]
    {
        let mesh = mesh(parse, &bytes, Up::Z).unwrap();
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|i| mesh.vertices[i as usize]);
            for [p, q] in [[a, b], [b, c], [c, a]] {
                let (edge, uv) = (q.position - p.position, q.uv - p.uv);
                if uv.y == 0.0 {
                    let along = (edge / uv.x).normalize();
                    assert_abs_diff_eq!(p.tangent, along, epsilon = 1e-5);
                }
                if uv.x == 0.0 {
                    let across = (edge / uv.y).normalize();
                    assert_abs_diff_eq!((p.normal * hand).cross(p.tangent), across, epsilon = 1e-5);
                }
            }
        }
    }
}

#[test]
fn files_that_are_cut_off_are_refused_or_smaller() {
    for (name, parse, bytes) in good() {
        for n in 0..bytes.len() {
            match mesh(parse, &bytes[..n], Up::Y) {
                Ok(mesh) => {
                    check(name, &mesh);
                    // Text may end early without a trace, or in the middle of a number.
                    assert!(name == "obj" || name == "ascii ply" && n + 4 > bytes.len(), "{name}: {n}");
                }
                Err(_) => drop(refusal(parse, &bytes[..n])),
            }
        }
    }
}

#[test]
fn spoilt_bytes_never_panic() {
    const ROUNDS: usize = 4000;
    let mut random = Random(20_261_121);
    for (name, parse, bytes) in good() {
        let mut right = 0;
        for _ in 0..ROUNDS {
            let mut spoilt = bytes.clone();
            for _ in 0..=(random.uniform() * 3.0) as usize {
                let at = (random.uniform() * spoilt.len() as f64) as usize;
                spoilt[at] = match (random.uniform() * 3.0) as u32 {
                    0 => (random.uniform() * 256.0) as u8,
                    1 => b"0123456789-/. e\n"[(random.uniform() * 16.0) as usize],
                    _ => spoilt[at] ^ 1 << (random.uniform() * 8.0) as u32,
                };
            }
            match mesh(parse, &spoilt, Up::Y) {
                Ok(mesh) => {
                    check(name, &mesh);
                    TracedMesh::new(mesh);
                    right += 1;
                }
                Err(_) => drop(refusal(parse, &spoilt)),
            }
        }
        assert!(right > 0 && right < ROUNDS, "{name}: {right}");
    }
}

#[test]
fn texts_that_break_a_rule_are_told_so() {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (text, message) in [
        ("", "the file is empty"),
        ("# nothing\n", "no triangle has an area"),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no triangle has an area"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4: vertex 4 does not exist, there are 3"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "line 4: vertex 0 does not exist, there are 3"),
        ("v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n", "line 3: vertex -3 does not exist, there are 2"),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//-6148914691236517205\n",
            "line 5: normal -6148914691236517205 does not exist, there are 1",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/9223372036854775807\n",
            "line 5: texture coordinate 9223372036854775807 does not exist, there are 1",
        ),
        ("v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n", "line 2: position parse error"),
        ("v 0 0 0\n\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n", "vertex 2, counted from 0, is not finite"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 1e39\nf 1 2 3\n", "vertex 2, counted from 0, is not finite"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 two 3", "line 4: face parse error"),
    ] {
        assert_eq!(refusal(obj::parse, text.as_bytes()), message);
    }
    let far = triangle.replace('1', "1e-38");
    check("tiny", &mesh(obj::parse, (far + "f 1 2 3").as_bytes(), Up::Y).unwrap());
    let far = triangle.replace('1', "3e38");
    check("huge", &mesh(obj::parse, (far + "f 1 2 3").as_bytes(), Up::Y).unwrap());
}

#[test]
fn vertices_without_a_direction_get_one() {
    // A zero normal, a normal of tiny length, degenerate texture coordinates, two sheets back to back.
    for text in [
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nf 1//1 2//1 3//1\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1e-40\nf 1//1 2//1 3//1\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.5\nf 1/1 2/1 3/1\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nvn 0 0 1\nvt 0 0\nf 1//1 2 3/1/1\nf 1 2 2\nf 1 4 2 3\n",
    ] {
        let mesh = mesh(obj::parse, text.as_bytes(), Up::Z).unwrap();
        check(text, &mesh);
        assert!(mesh.vertices.iter().all(|v| v.normal.z.abs() > 0.999), "{text}");
    }
}

#[test]
fn headers_that_promise_too_much_are_refused_before_anything_is_allocated() {
    let text = String::from_utf8(cube_ply(Encoding::Ascii)).unwrap();
    for (from, to, message) in [
        ("vertex 8", "vertex 4000000000", "cannot hold the 4000000000 of `vertex`"),
        ("face 6", "face 18446744073709551615", "cannot hold the 18446744073709551615 of `face`"),
        ("edge 1\nproperty int a", "edge 18446744073709551615", "of `edge`"),
        ("vertex 8", "vertices 8", "the PLY header has no element `vertex`"),
        ("face 6", "faces 6", "the PLY header has no element `face`"),
        ("double y", "double w", "the PLY header has no property `y`"),
        ("vertex_indices", "corners", "the PLY header has no property `vertex_indices`"),
        ("uchar int vertex", "uchar float vertex", "unsupported"),
        ("4 0 4 6 2", "4 0 4 6 8", "a face has corner 8, counted from 0, but there are 8 vertices"),
        ("4 0 4 6 2", "4 0 4 6 -2", "unsupported"),
        ("4 0 4 6 2", "4000000000 0 4 6 2", "the PLY cannot be read"),
    ] {
        assert!(text.contains(from), "{from}");
        let got = refusal(ply::parse, text.replacen(from, to, 1).as_bytes());
        assert!(got.contains(message), "{from} -> {to}: {got}");
    }
    assert!(refusal(ply::parse, b"solid cube").contains("PLY cannot be read"));
}

#[test]
fn scenes_that_break_a_rule_are_told_so() {
    let (json, bin) = cube_gltf();
    for (pointer, value, message) in [
        ("/scenes", json!([]), "standard at scene: Index out of bounds"),
        ("/nodes/1/children", json!([0]), "node 0 of the glTF is in the scene more than once"),
        ("/nodes/0/children", json!([1, 1]), "node 1 of the glTF is in the scene more than once"),
        ("/nodes/1/scale", json!([2, 0, 0]), "no triangle has an area"),
        ("/nodes/1/mesh", json!(3), "Index out of bounds"),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(77), "Index out of bounds"),
        (
            "/meshes/0/primitives/0/attributes/POSITION",
            json!(2),
            "accessor 2 of the glTF must be vectors of three",
        ),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(6), "min: Missing data"),
        (
            "/meshes/0/primitives/0/attributes/NORMAL",
            json!(2),
            "accessor 2 of the glTF must be vectors of three",
        ),
        ("/meshes/0/primitives/0/indices", json!(0), "accessor 0 of the glTF must be unsigned integers"),
        ("/meshes/0/primitives/0/mode", json!(0), "no triangle"),
        ("/accessors/6/count", json!(17), "17 corners do not make whole triangles"),
        ("/accessors/6/count", json!(19), "accessor 6 of the glTF reaches beyond its buffer"),
        ("/accessors/6/count", json!(0), "accessor 6 of the glTF reaches beyond its buffer"),
        ("/accessors/0/count", json!(u64::MAX), "accessor 0 of the glTF reaches beyond its buffer"),
        ("/accessors/0/byteOffset", json!(u64::MAX), "accessor 0 of the glTF reaches beyond its buffer"),
        ("/accessors/0/count", json!(11), "a face has corner 11, counted from 0, but there are 11 vertices"),
        ("/accessors/0/bufferView", json!(null), "accessors[0].bufferView: Missing data"),
        (
            "/accessors/0/sparse",
            json!({"count": 1, "indices": {"bufferView": 1, "componentType": 5123},
            "values": {"bufferView": 0}}),
            "accessor 0 of the glTF must be dense, with a buffer view",
        ),
        ("/bufferViews/0/byteStride", json!(4), "reaches beyond its buffer"),
        ("/bufferViews/0/byteLength", json!(u64::MAX), "reaches beyond its buffer"),
        ("/bufferViews/0/byteOffset", json!(900), "reaches beyond its buffer"),
        ("/buffers/0/uri", json!("cube.bin"), "buffer 0 of the glTF is not in the file's own binary chunk"),
        ("/extensionsRequired", json!(["KHR_draco_mesh_compression"]), "Unsupported extension"),
        ("/asset", json!(null), "the glTF cannot be read"),
    ] {
        let mut broken = json.clone();
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        let parent = broken.pointer_mut(parent).unwrap();
        match parent {
            Value::Object(map) => drop(map.insert(key.into(), value)),
            _ => panic!("{pointer}"),
        }
        if pointer.ends_with("mode") {
            broken["meshes"][0]["primitives"][1]["mode"] = json!(1);
        }
        let got = refusal(glb::parse, &glb(&broken, &bin));
        assert!(got.contains(message), "{pointer}: {got}");
    }
    // Read as infinity or refused as a number: other packages that are built along decide on serde_json's features.
    let mut broken = json.clone();
    broken["nodes"][1]["scale"] = json!([1e39, 1, 1]);
    let got = refusal(glb::parse, &glb(&broken, &bin));
    assert!(got.contains("is not finite") || got.contains("out of range"), "{got}");
    // A container that is shorter than its own header, and other magic.
    let mut bytes = cube_glb();
    bytes[8..12].copy_from_slice(&3_u32.to_le_bytes());
    assert!(refusal(glb::parse, &bytes).contains("glTF container cannot be read"));
    assert!(refusal(glb::parse, json.to_string().as_bytes()).contains("glTF container cannot be read"));
}

#[test]
fn strips_fans_mirrors_and_flat_triangles_of_gltf() {
    let (mut json, bin) = cube_gltf();
    json["nodes"][1]["scale"] = json!([2, 2, -2]);
    let mirrored = mesh(glb::parse, &glb(&json, &bin), Up::Y).unwrap();
    check("mirrored", &mirrored);
    assert_abs_diff_eq!(volume(&mirrored), (4.0_f32 / 3.0).powf(1.5), epsilon = 1e-5);
    assert!(mirrored.vertices.iter().all(|v| v.normal.dot(v.position) > 0.5), "inwards");
    for first in [0, 1] {
        json["meshes"][0]["primitives"][first]["attributes"].as_object_mut().unwrap().remove("NORMAL");
    }
    let flat = mesh(glb::parse, &glb(&json, &bin), Up::Y).unwrap();
    check("flat", &flat);
    assert_eq!((flat.vertices.len(), flat.triangles.len()), (36, 12));
    assert!(flat.vertices.iter().all(|v| (v.normal.abs().max_element() - 1.0).abs() < 1e-5));
    let quad = [0_u32, 1, 2, 3];
    assert_eq!(glb::triangles(gltf::mesh::Mode::TriangleStrip, &quad).unwrap(), [[0, 1, 2], [2, 1, 3]]);
    assert_eq!(glb::triangles(gltf::mesh::Mode::TriangleFan, &quad).unwrap(), [[1, 2, 0], [2, 3, 0]]);
    assert!(glb::triangles(gltf::mesh::Mode::TriangleFan, &[]).unwrap().is_empty());
}

#[test]
fn files_are_told_by_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let cube = folder.path().join("Cube.OBJ");
    fs::write(&cube, cube_obj()).unwrap();
    assert!(open(&cube, Up::Y).is_ok());
    for (name, message) in [
        ("missing.ply", "the file cannot be read"),
        ("cube.stl", "the name of a mesh file ends in .obj, .ply or .glb"),
        ("cube", "the name of a mesh file ends in .obj, .ply or .glb"),
    ] {
        let error = open(&folder.path().join(name), Up::Y).err().expect("must be refused").to_string();
        assert!(error.contains(message), "{name}: {error}");
    }
    let folder_by_name = folder.path().join("folder.glb");
    fs::create_dir(&folder_by_name).unwrap();
    assert!(matches!(open(&folder_by_name, Up::Y), Err(MeshFileError::NotAFile)));
}
