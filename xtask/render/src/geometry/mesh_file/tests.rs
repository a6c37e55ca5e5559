//! Files that are right, cut off, and spoilt: each gives a right mesh or one clear line.

use std::fs;

use approx::assert_abs_diff_eq;
use gltf::binary::{Glb, Header};
use ply_rs_bw::{
    parser,
    ply::{DefaultElement, Encoding},
    writer::Writer,
};
use serde_json::{Value, json};

use crate::geometry::mesh_file::*;
use crate::{
    geometry::{
        checks::{self, volume},
        mesh::TracedMesh,
    },
    sampling::random::Random,
};

/// The cube of side 2 with its faces turning to the left from outside.
const CUBE_OBJ: &str = include_str!("../../../tests/data/cube.obj");
const CUBE_PLY: &str = include_str!("../../../tests/data/cube.ply");
/// Six faces of four corners each, v downwards; two primitives of three faces, under two nodes.
const CUBE_GLB: &[u8] = include_bytes!("../../../tests/data/cube.glb");

/// The cube in another of the encodings.
fn cube_ply(encoding: Encoding) -> Vec<u8> {
    let mut ply = parser::Parser::<DefaultElement>::new().read_ply(&mut CUBE_PLY.as_bytes()).unwrap();
    ply.header.encoding = encoding;
    let mut bytes = Vec::new();
    Writer::new().write_ply(&mut bytes, &mut ply).unwrap();
    bytes
}

fn glb(json: &Value, bin: &[u8]) -> Vec<u8> {
    let header = Header { magic: *b"glTF", version: 2, length: 0 };
    Glb { header, json: json.to_string().into_bytes().into(), bin: Some(bin.into()) }.to_vec().unwrap()
}

/// The cube's JSON and its binary chunk.
fn cube_gltf() -> (Value, Vec<u8>) {
    let Glb { json, bin, .. } = Glb::from_slice(CUBE_GLB).unwrap();
    (serde_json::from_slice(&json).unwrap(), bin.unwrap().into_owned())
}

fn good() -> [(&'static str, Parser, Vec<u8>); 5] {
    [
        ("obj", obj::parse, CUBE_OBJ.into()),
        ("ascii ply", ply::parse, CUBE_PLY.into()),
        ("little-endian ply", ply::parse, cube_ply(Encoding::BinaryLittleEndian)),
        ("big-endian ply", ply::parse, cube_ply(Encoding::BinaryBigEndian)),
        ("glb", glb::parse, CUBE_GLB.into()),
    ]
}

/// Properties of every mesh from a file, whatever the file gives for normals.
fn check(name: &str, mesh: &Mesh) {
    checks::check(name, mesh, -1.1);
    assert!(mesh.vertices.iter().all(|v| v.position.length() < 1.0 + 1e-6), "{name}");
}

/// The mesh, if it is one and right, or else one clear line.
fn judged(name: &str, parse: Parser, bytes: &[u8]) -> Result<Mesh, String> {
    let mesh = mesh(parse, bytes, Up::Y).map_err(|_| refusal(parse, bytes))?;
    check(name, &mesh);
    Ok(mesh)
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
    let [.., (_, _, cube_glb)] = good();
    let quad = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    let plain = format!("{quad}f 1/1 2/2 3/3 4/4\n").into_bytes();
    let mirrored = format!("{quad}f 1/2 2/1 3/4 4/3\n").into_bytes();
    for (parse, bytes, hand) in
        [(obj::parse as Parser, plain, 1.0), (obj::parse, mirrored, -1.0), (glb::parse, cube_glb, 1.0)]
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
            // Text may end early without a trace, or in the middle of a number.
            let early = name == "obj" || name == "ascii ply" && n + 4 > bytes.len();
            assert!(judged(name, parse, &bytes[..n]).is_err() || early, "{name}: {n}");
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
            if let Ok(mesh) = judged(name, parse, &spoilt) {
                TracedMesh::new(mesh);
                right += 1;
            }
        }
        assert!(right > 0 && right < ROUNDS, "{name}: {right}");
    }
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn texts_that_break_a_rule_are_told_so() {
    for (text, message) in [
        ("", "the file is empty"),
        ("# nothing\n", "no triangle has an area"),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no triangle has an area"),
        ("TRIANGLE f 1 2 4\n", "line 4: vertex 4 does not exist, there are 3"),
        ("TRIANGLE f 1 2 0\n", "line 4: vertex 0 does not exist, there are 3"),
        ("v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n", "line 3: vertex -3 does not exist, there are 2"),
        (
            "TRIANGLE vn 0 0 1\nf 1//1 2//1 3//-6148914691236517205\n",
            "line 5: normal -6148914691236517205 does not exist, there are 1",
        ),
        (
            "TRIANGLE vt 0 0\nf 1/1 2/1 3/9223372036854775807\n",
            "line 5: texture coordinate 9223372036854775807 does not exist, there are 1",
        ),
        ("v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n", "the OBJ cannot be read: line 2: position parse error"),
        ("v 0 0 0\n\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n", "vertex 2, counted from 0, is not finite"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 1e39\nf 1 2 3\n", "vertex 2, counted from 0, is not finite"),
        ("TRIANGLE f 1 two 3", "the OBJ cannot be read: line 4: face parse error"),
    ] {
        assert_eq!(refusal(obj::parse, text.replace("TRIANGLE ", TRIANGLE).as_bytes()), message);
    }
}

#[test]
fn vertices_without_a_direction_get_one() {
    for (name, corners, rest) in [
        ("tiny", TRIANGLE.replace('1', "1e-38"), "f 1 2 3"),
        ("huge", TRIANGLE.replace('1', "3e38"), "f 1 2 3"),
        ("zero normal", TRIANGLE.into(), "vn 0 0 0\nf 1//1 2//1 3//1\n"),
        ("normal of tiny length", TRIANGLE.into(), "vn 0 0 1e-40\nf 1//1 2//1 3//1\n"),
        ("degenerate texture coordinates", TRIANGLE.into(), "vt 0.5 0.5\nf 1/1 2/1 3/1\n"),
        ("sheets back to back", TRIANGLE.into(), "f 1 2 3\nf 3 2 1\n"),
        ("mixed", TRIANGLE.into(), "v 0 0 0\nvn 0 0 1\nvt 0 0\nf 1//1 2 3/1/1\nf 1 2 2\nf 1 4 2 3\n"),
    ] {
        let mesh = mesh(obj::parse, (corners + rest).as_bytes(), Up::Z).unwrap();
        check(name, &mesh);
        assert!(mesh.vertices.iter().all(|v| v.normal.z.abs() > 0.999), "{name}");
    }
}

#[test]
fn headers_that_promise_too_much_are_refused_before_anything_is_allocated() {
    for (from, to, message) in [
        ("vertex 8", "vertex 4000000000", "cannot hold the 4000000000 of `vertex`"),
        ("face 6", "face 18446744073709551615", "cannot hold the 18446744073709551615 of `face`"),
        ("edge 1\nproperty int a", "edge 18446744073709551615", "of `edge`"),
        ("vertex 8", "vertices 8", "the file has no element `vertex`"),
        ("face 6", "faces 6", "the file has no element `face`"),
        ("double y", "double w", "the file has no property `y`"),
        ("vertex_indices", "corners", "the file has no property `vertex_indices`"),
        ("uchar int vertex", "uchar float vertex", "unsupported"),
        ("4 0 4 6 2", "4 0 4 6 8", "a face has corner 8, counted from 0, but there are 8 vertices"),
        ("4 0 4 6 2", "4 0 4 6 -2", "unsupported"),
        ("4 0 4 6 2", "4000000000 0 4 6 2", "the PLY cannot be read"),
    ] {
        assert!(CUBE_PLY.contains(from), "{from}");
        let got = refusal(ply::parse, CUBE_PLY.replacen(from, to, 1).as_bytes());
        assert!(got.contains(message), "{from} -> {to}: {got}");
    }
    assert!(refusal(ply::parse, b"solid cube").contains("PLY cannot be read"));
}

const POSITION: &str = "/meshes/0/primitives/0/attributes/POSITION";
const NORMAL: &str = "/meshes/0/primitives/0/attributes/NORMAL";

#[test]
fn scenes_that_break_a_rule_are_told_so() {
    let (json, bin) = cube_gltf();
    let sparse =
        json!({"count": 1, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}});
    for (pointer, value, message) in [
        ("/scenes", json!([]), "scene: Index out of bounds"),
        ("/nodes/1/children", json!([0]), "node 0 of the glTF is in the scene more than once"),
        ("/nodes/0/children", json!([1, 1]), "node 1 of the glTF is in the scene more than once"),
        ("/nodes/1/scale", json!([2, 0, 0]), "no triangle has an area"),
        ("/nodes/1/mesh", json!(3), "Index out of bounds"),
        (POSITION, json!(77), "Index out of bounds"),
        (POSITION, json!(2), "accessor 2 of the glTF must be vectors of three"),
        (POSITION, json!(6), "min: Missing data"),
        (NORMAL, json!(2), "accessor 2 of the glTF must be vectors of three"),
        ("/meshes/0/primitives/0/indices", json!(0), "accessor 0 of the glTF must be unsigned integers"),
        ("/meshes/0/primitives/0/mode", json!(0), "no triangle"),
        ("/accessors/6/count", json!(17), "17 corners do not make whole triangles"),
        ("/accessors/6/count", json!(19), "accessor 6 of the glTF must be within its buffer"),
        ("/accessors/6/count", json!(0), "accessor 6 of the glTF must be within its buffer"),
        ("/accessors/0/count", json!(u64::MAX), "accessor 0 of the glTF must be within its buffer"),
        ("/accessors/0/byteOffset", json!(u64::MAX), "accessor 0 of the glTF must be within its buffer"),
        ("/accessors/0/count", json!(11), "a face has corner 11, counted from 0, but there are 11 vertices"),
        ("/accessors/0/bufferView", json!(null), "accessors[0].bufferView: Missing data"),
        ("/accessors/0/sparse", sparse, "accessor 0 of the glTF must be dense, with a buffer view"),
        ("/bufferViews/0/byteStride", json!(4), "must be within its buffer"),
        ("/bufferViews/0/byteLength", json!(u64::MAX), "must be within its buffer"),
        ("/bufferViews/0/byteOffset", json!(900), "must be within its buffer"),
        (
            "/buffers/0/uri",
            json!("cube.bin"),
            "accessor 0 of the glTF must be in the file's own binary chunk",
        ),
        ("/extensionsRequired", json!(["KHR_draco_mesh_compression"]), "Unsupported extension"),
        ("/asset", json!(null), "the glTF cannot be read"),
    ] {
        let mut broken = json.clone();
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        broken.pointer_mut(parent).unwrap()[key] = value;
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
    let mut bytes = glb(&json, &bin);
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
    for v in &flat.vertices {
        assert_abs_diff_eq!(v.normal.abs().max_element(), 1.0, epsilon = 1e-5);
    }
    let quad = [0_u32, 1, 2, 3];
    assert_eq!(glb::triangles(gltf::mesh::Mode::TriangleStrip, &quad).unwrap(), [[0, 1, 2], [2, 1, 3]]);
    assert_eq!(glb::triangles(gltf::mesh::Mode::TriangleFan, &quad).unwrap(), [[1, 2, 0], [2, 3, 0]]);
    assert!(glb::triangles(gltf::mesh::Mode::TriangleFan, &[]).unwrap().is_empty());
}

#[test]
fn files_are_told_by_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let cube = folder.path().join("Cube.OBJ");
    fs::write(&cube, CUBE_OBJ).unwrap();
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
