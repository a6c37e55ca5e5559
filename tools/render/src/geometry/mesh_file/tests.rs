//! Valid, truncated and corrupted files: each gives a valid mesh or a one-line error.

use std::{fs, path::Path};

use approx::assert_abs_diff_eq;
use base64::{Engine, prelude::BASE64_STANDARD};
use serde_json::{Value, json};

use crate::geometry::mesh::Mesh;
use crate::geometry::mesh_file::*;
use crate::{
    geometry::{
        checks::{self, volume},
        mesh::TracedMesh,
    },
    sampling::random::Random,
};

/// The cube of side 2, with faces counterclockwise from outside.
const CUBE_OBJ: &str = include_str!("../../../tests/data/cube.obj");
const CUBE_PLY: &str = include_str!("../../../tests/data/cube.ply");
/// Six faces of four corners each, v down; two primitives of three faces, under two nodes.
pub(super) const CUBE_GLB: &[u8] = include_bytes!("../../../tests/data/cube.glb");

/// Returns the cube in a binary encoding.
fn cube_ply(big_endian: bool) -> Vec<u8> {
    let number = |kind: &str, word: &str| -> Vec<u8> {
        let mut bytes = match kind {
            "float" => word.parse::<f32>().unwrap().to_le_bytes().to_vec(),
            "double" => word.parse::<f64>().unwrap().to_le_bytes().to_vec(),
            "int" => word.parse::<i32>().unwrap().to_le_bytes().to_vec(),
            _ => vec![word.parse().unwrap()],
        };
        if big_endian {
            bytes.reverse();
        }
        bytes
    };
    let (head, body) = CUBE_PLY.split_once("end_header\n").unwrap();
    let name = if big_endian { "binary_big_endian" } else { "binary_little_endian" };
    let mut bytes = format!("{}end_header\n", head.replace("ascii", name)).into_bytes();
    for (k, row) in body.lines().enumerate() {
        let kinds: &[&str] = match k {
            ..8 => &["float", "double", "float", "uchar"],
            8 => &["int"],
            _ => &["uchar", "int", "int", "int", "int"],
        };
        assert_eq!(kinds.len(), row.split_whitespace().count());
        bytes.extend(kinds.iter().zip(row.split_whitespace()).flat_map(|(kind, word)| number(kind, word)));
    }
    bytes
}

pub(super) fn glb(json: &Value, bin: &[u8]) -> Vec<u8> {
    let chunk = |kind: &[u8; 4], data: &[u8], blank: u8| {
        let mut chunk = data.to_vec();
        chunk.resize(data.len().next_multiple_of(4), blank);
        [&(chunk.len() as u32).to_le_bytes(), &kind[..], &chunk].concat()
    };
    let chunks = [chunk(b"JSON", json.to_string().as_bytes(), b' '), chunk(b"BIN\0", bin, 0)].concat();
    [b"glTF", &2_u32.to_le_bytes()[..], &(12 + chunks.len() as u32).to_le_bytes(), &chunks].concat()
}

/// Returns the cube's JSON and its binary chunk.
pub(super) fn cube_gltf() -> (Value, Vec<u8>) {
    let length = |at: usize| u32::from_le_bytes(CUBE_GLB[at..at + 4].try_into().unwrap()) as usize;
    let (json, behind) = CUBE_GLB[20..].split_at(length(12));
    (serde_json::from_slice(json).unwrap(), behind[8..8 + length(20 + length(12))].to_vec())
}

/// Returns the cube as STL: text, or binary with a header that begins like text.
pub(super) fn cube_stl(binary: bool) -> Vec<u8> {
    let cube = soup_of(&obj::parse, CUBE_OBJ.as_bytes());
    let corner = |i: &u32| cube.corners[*i as usize].position.as_vec3();
    if binary {
        let triangle = |t: &[u32; 3]| {
            let numbers = [[0.0; 3]].into_iter().chain(t.iter().map(|i| corner(i).to_array()));
            numbers.flatten().flat_map(f32::to_le_bytes).chain([0, 0]).collect::<Vec<u8>>()
        };
        let mut header = b"solid cube".to_vec();
        header.resize(80, b' ');
        let count = (cube.triangles.len() as u32).to_le_bytes();
        return [header, count.into(), cube.triangles.iter().flat_map(triangle).collect()].concat();
    }
    let vertex = |i: &u32| format!("vertex {:e} {:e} {:e}\n", corner(i).x, corner(i).y, corner(i).z);
    let facet = |t: &[u32; 3]| {
        format!(
            "facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n",
            t.iter().map(vertex).collect::<String>()
        )
    };
    format!("solid\n{}endsolid\n", cube.triangles.iter().map(facet).collect::<String>()).into()
}

/// Returns the cube as a `.gltf` with an embedded buffer.
pub(super) fn cube_gltf_text() -> Vec<u8> {
    let (mut json, bin) = cube_gltf();
    json["buffers"][0]["uri"] = data_uri(&bin).into();
    json.to_string().into_bytes()
}

pub(super) fn data_uri(bytes: &[u8]) -> String {
    format!("data:application/octet-stream;base64,{}", BASE64_STANDARD.encode(bytes))
}

fn good() -> [(&'static str, &'static Parser<'static>, Vec<u8>); 8] {
    [
        ("obj", &obj::parse, CUBE_OBJ.into()),
        ("ascii ply", &ply::parse, CUBE_PLY.into()),
        ("little-endian ply", &ply::parse, cube_ply(false)),
        ("big-endian ply", &ply::parse, cube_ply(true)),
        ("glb", &gltf_alone, CUBE_GLB.into()),
        ("gltf", &gltf_alone, cube_gltf_text()),
        ("ascii stl", &stl::parse, cube_stl(false)),
        ("binary stl", &stl::parse, cube_stl(true)),
    ]
}

pub(super) fn gltf_alone(bytes: &[u8]) -> Result<TriangleSoup, MeshFileError> {
    gltf::parse(bytes, Path::new("/nowhere"), false)
}

pub(super) fn soup_of(parse: &Parser<'_>, bytes: &[u8]) -> TriangleSoup {
    parse(bytes).unwrap()
}

pub(super) fn reading(up: Up) -> MeshReading {
    MeshReading { up, crease: 40.0, materials: false }
}

/// Checks the properties of every mesh from a file, independent of the file's normals.
fn check(name: &str, mesh: &Mesh) {
    checks::check(name, mesh, -1.1);
    assert!(mesh.vertices.iter().all(|v| v.position.length() < 1.0 + 1e-6), "{name}");
}

/// Returns the valid mesh, or a one-line error.
fn judged(name: &str, parse: &Parser<'_>, bytes: &[u8]) -> Result<Mesh, String> {
    let MeshFile { mesh, .. } = mesh(parse, bytes, reading(Up::Y)).map_err(|_| refusal(parse, bytes))?;
    check(name, &mesh);
    Ok(mesh)
}

pub(super) fn refusal(parse: &Parser<'_>, bytes: &[u8]) -> String {
    let error = mesh(parse, bytes, reading(Up::Y)).err().expect("must be refused");
    let text = error.to_string();
    assert!(text.lines().count() == 1 && !text.chars().any(char::is_control), "{text:?}");
    text
}

#[test]
fn cube_is_equal_in_every_format() {
    for (name, parse, bytes) in good() {
        for up in [Up::Y, Up::Z] {
            let MeshFile { mesh, normals, .. } = mesh(parse, &bytes, reading(up)).unwrap();
            check(name, &mesh);
            assert_eq!(normals, name.starts_with("gl"), "{name}");
            assert_eq!(mesh.triangles.len(), 12, "{name}");
            // Side 2/√3 in the unit ball, seen from outside.
            assert_abs_diff_eq!(volume(&mesh), (4.0_f32 / 3.0).powf(1.5), epsilon = 1e-5);
            for v in &mesh.vertices {
                let along = v.normal.dot(v.position.normalize());
                // From the file or computed: the normal of the face, whose neighbors are 90 degrees
                // apart.
                assert_abs_diff_eq!(along, 1.0 / 3.0_f32.sqrt(), epsilon = 1e-5);
            }
            TracedMesh::new(mesh);
        }
    }
}

#[test]
fn tangents_follow_u_and_v_points_up() {
    let quad = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    let plain = format!("{quad}f 1/1 2/2 3/3 4/4\n").into_bytes();
    let mirrored = format!("{quad}f 1/2 2/1 3/4 4/3\n").into_bytes();
    for (parse, bytes, hand) in [
        (&obj::parse as &Parser<'_>, plain, 1.0),
        (&obj::parse, mirrored, -1.0),
        (&gltf_alone, CUBE_GLB.into(), 1.0),
    ] {
        let MeshFile { mesh, uv, .. } = mesh(parse, &bytes, reading(Up::Z)).unwrap();
        assert!(uv);
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|i| mesh.vertices[i as usize]);
            for [p, q] in [[a, b], [b, c], [c, a]] {
                let (edge, uv) = (q.position - p.position, q.uv - p.uv);
                // Two sides of the quad and the cube's faces: a unit of the coordinates is a unit
                // of length.
                if uv.x == 0.0 || uv.y == 0.0 {
                    assert_abs_diff_eq!(uv.length(), edge.length(), epsilon = 1e-5);
                }
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
fn truncated_files_are_an_error_or_smaller() {
    for (name, parse, bytes) in good() {
        for n in 0..bytes.len() {
            // Text may end early without a trace, or in the middle of a number.
            let early = ["obj", "ascii stl"].contains(&name) || name == "ascii ply" && n + 4 > bytes.len();
            assert!(judged(name, parse, &bytes[..n]).is_err() || early, "{name}: {n}");
        }
    }
}

#[test]
fn corrupted_bytes_never_panic() {
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
fn obj_errors() {
    for (text, message) in [
        ("", "the file is empty"),
        ("# nothing\n", "the file has no vertices"),
        ("v 0 0 0\nv 1 0 0\n", "the file has no triangles, only points or lines"),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "all triangles have zero area"),
        ("TRIANGLE f 1 2 4\n", "line 4: vertex 4 does not exist (there are 3)"),
        ("TRIANGLE f 1 2 0\n", "line 4: vertex 0 does not exist (there are 3)"),
        ("v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n", "line 3: vertex -3 does not exist (there are 2)"),
        (
            "TRIANGLE f 1 2 9223372036854775807\n",
            "line 4: vertex 9223372036854775807 does not exist (there are 3)",
        ),
        ("v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n", "invalid OBJ: line 2: a vertex must have 3 numbers, got 2"),
        ("v 0 0 0\nv 1 0 x\nv 0 1 0\nf 1 2 3\n", "invalid OBJ: line 2: `x` is not a number"),
        (
            "TRIANGLE surf 0 1 0 1 1 2 3\nf 1 2 3\n",
            "invalid OBJ: line 4: `surf` is not supported (polygons only)",
        ),
        ("TRIANGLE l 1 2 3\np 1\n", "the file has no triangles, only points or lines"),
        ("v 0 0 0\n\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n", "vertex 2 (counted from 0) is not finite"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 1e39\nf 1 2 3\n", "vertex 2 (counted from 0) is not finite"),
        ("TRIANGLE f 1 two 3", "invalid OBJ: line 4: invalid face corner `two`"),
    ] {
        assert_eq!(refusal(&obj::parse, text.replace("TRIANGLE ", TRIANGLE).as_bytes()), message);
    }
}

#[test]
fn degenerate_vertices_get_a_normal() {
    for (name, corners, rest) in [
        ("tiny", TRIANGLE.replace('1', "1e-38"), "f 1 2 3"),
        ("huge", TRIANGLE.replace('1', "3e38"), "f 1 2 3"),
        ("zero normal", TRIANGLE.into(), "vn 0 0 0\nf 1//1 2//1 3//1\n"),
        ("normal of tiny length", TRIANGLE.into(), "vn 0 0 1e-40\nf 1//1 2//1 3//1\n"),
        ("degenerate texture coordinates", TRIANGLE.into(), "vt 0.5 0.5\nf 1/1 2/1 3/1\n"),
        ("sheets back to back", TRIANGLE.into(), "f 1 2 3\nf 3 2 1\n"),
        ("mixed", TRIANGLE.into(), "v 0 0 0\nvn 0 0 1\nvt 0 0\nf 1//1 2 3/1/1\nf 1 2 2\nf 1 4 2 3\n"),
    ] {
        let MeshFile { mesh, .. } = mesh(&obj::parse, (corners + rest).as_bytes(), reading(Up::Z)).unwrap();
        check(name, &mesh);
        assert!(mesh.vertices.iter().all(|v| v.normal.z.abs() > 0.999), "{name}");
    }
}

#[test]
fn ply_headers_are_checked_before_allocation() {
    for (from, to, message) in [
        ("vertex 8", "vertex 4000000000", "cannot hold the 4000000000 rows of `vertex`"),
        ("face 6", "face 18446744073709551615", "cannot hold the 18446744073709551615 rows of `face`"),
        ("edge 1\nproperty int a", "edge 18446744073709551615", "of `edge`"),
        ("vertex 8", "vertices 8", "the file has no element `vertex`"),
        ("face 6", "faces 6", "the file has no element `face`"),
        ("double y", "double w", "the file has no property `y`"),
        ("vertex_indices", "corners", "the file has no property `vertex_indices`"),
        ("4 0 4 6 2", "4 0 4 6 8", "a face refers to vertex 8, but there are 8 vertices (counted from 0)"),
        ("4 0 4 6 2", "4 0 4 6 -2", "invalid PLY: a face has the invalid vertex index -2"),
        ("4 0 4 6 2", "4 0 4 6 0.5", "invalid PLY: a face has the invalid vertex index 0.5"),
        ("4 0 4 6 2", "4000000000 0 4 6 2", "`vertex_indices` of `face` 1 of 6 is missing"),
        ("-1 -1 -1 200", "-1 -1 x 200", "`z` of `vertex` 1 of 8 is missing"),
        ("format ascii", "format octal", "invalid PLY: unknown format `octal`"),
        ("format ascii 1.0\n", "", "invalid PLY: header has no line `format`"),
        ("double y", "real y", "invalid PLY: unknown type `real` in the header"),
        ("vertex 8", "vertex eight", "invalid PLY: invalid number of rows `eight` of `vertex`"),
        ("vertex 8", "vertex", "invalid PLY: invalid header line `element vertex`"),
        ("element vertex 8\n", "", "invalid PLY: property `x` precedes every element"),
        ("end_header", "end_head", "invalid PLY: header has no line `end_header`"),
    ] {
        assert!(CUBE_PLY.contains(from), "{from}");
        let got = refusal(&ply::parse, CUBE_PLY.replacen(from, to, 1).as_bytes());
        assert!(got.contains(message), "{from} -> {to}: {got}");
    }
    assert_eq!(refusal(&ply::parse, b"solid cube"), "invalid PLY: file does not begin with `ply`");
}

const POSITION: &str = "/meshes/0/primitives/0/attributes/POSITION";
const NORMAL: &str = "/meshes/0/primitives/0/attributes/NORMAL";

#[test]
fn gltf_errors() {
    let (json, bin) = cube_gltf();
    // Six indices remain after the offset.
    let sparse = |count: u32| {
        let indices = json!({"bufferView": 1, "byteOffset": 24, "componentType": 5123});
        json!({"count": count, "indices": indices, "values": {"bufferView": 0}})
    };
    for (pointer, value, message) in [
        ("/scenes", json!([]), "the glTF has no scene 0 (it has 0, counted from 0)"),
        ("/nodes/1/children", json!([0]), "node 0 of the glTF is in the scene more than once"),
        ("/nodes/0/children", json!([1, 1]), "node 1 of the glTF is in the scene more than once"),
        ("/nodes/1/scale", json!([2, 0, 0]), "all triangles have zero area"),
        ("/nodes/1/mesh", json!(3), "the glTF has no mesh 3 (it has 1, counted from 0)"),
        ("/nodes/1/children", json!([7]), "the glTF has no node 7 (it has 2, counted from 0)"),
        ("/nodes/1/skin", json!(3), "the glTF has no skin 3 (it has 0, counted from 0)"),
        (POSITION, json!(77), "the glTF has no accessor 77 (it has"),
        (POSITION, json!(2), "accessor 2 of the glTF must be vectors of three"),
        (POSITION, json!(6), "accessor 6 of the glTF must be vectors of three"),
        (NORMAL, json!(2), "accessor 2 of the glTF must be vectors of three"),
        ("/meshes/0/primitives/0/indices", json!(0), "accessor 0 of the glTF must be unsigned integers"),
        ("/meshes/0/primitives/0/mode", json!(0), "the file has no triangles, only points or lines"),
        ("/accessors/6/count", json!(19), "accessor 6 of the glTF must be within its buffer"),
        ("/accessors/6/count", json!(0), "the file has no triangles"),
        ("/accessors/0/count", json!(u64::MAX), "accessor 0 of the glTF must be within its buffer"),
        ("/accessors/0/byteOffset", json!(u64::MAX), "accessor 0 of the glTF must be within its buffer"),
        (
            "/accessors/0/count",
            json!(1),
            "a face refers to vertex 1, but there are 1 vertices (counted from 0)",
        ),
        ("/accessors/6/bufferView", json!(null), "all triangles have zero area"),
        ("/accessors/0/sparse", sparse(12), "accessor 0 of the glTF must be within its buffer"),
        ("/accessors/0/sparse", sparse(900), "accessor 0 of the glTF must be within its buffer"),
        ("/bufferViews/0/byteStride", json!(4), "must be within its buffer"),
        ("/bufferViews/0/byteLength", json!(u64::MAX), "must be within its buffer"),
        ("/bufferViews/0/byteOffset", json!(900), "must be within its buffer"),
        ("/buffers/0/uri", json!("cube.bin"), "cannot read the glTF's buffer `cube.bin`: "),
        (
            "/buffers/0/uri",
            json!("https://x/y"),
            "must be embedded or in the glTF's folder, got `https://x/y`",
        ),
        ("/buffers/0/uri", json!("/etc/hosts"), "must be embedded or in the glTF's folder, got `/etc/hosts`"),
        ("/buffers/0/uri", json!("data:;base64,%%%"), "invalid glTF: invalid Base64 in a data URI: "),
        (
            "/extensionsRequired",
            json!(["EXT_meshopt_compression"]),
            "unsupported compression EXT_meshopt_compression (export the glTF uncompressed",
        ),
        (
            "/extensionsRequired",
            json!(["KHR_materials_unlit", "ACME_fur"]),
            "the glTF requires the unsupported extension ACME_fur",
        ),
        ("/asset", json!(null), "the JSON has no `asset.version`, so it is not a glTF 2.0"),
        ("/asset", json!({"version": 1}), "glTF 1 is not supported: convert the file to glTF 2.0"),
        ("/scene", json!("first"), "invalid type: string \"first\", expected an index"),
        ("/asset", json!({"version": "1.1"}), "glTF 1.1 is not supported: convert the file to glTF 2.0"),
    ] {
        let mut broken = json.clone();
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        broken.pointer_mut(parent).unwrap()[key] = value;
        if pointer.ends_with("mode") {
            broken["meshes"][0]["primitives"][1]["mode"] = json!(1);
        }
        let got = refusal(&gltf_alone, &glb(&broken, &bin));
        assert!(got.contains(message), "{pointer}: {got}");
    }
    // Parsed as infinity or an error, depending on serde_json's features, which other packages in
    // the build select.
    let mut broken = json.clone();
    broken["nodes"][1]["scale"] = json!([1e39, 1, 1]);
    let got = refusal(&gltf_alone, &glb(&broken, &bin));
    assert!(got.contains("is not finite") || got.contains("out of range"), "{got}");
    // A container shorter than its header, and another magic number.
    let mut bytes = glb(&json, &bin);
    bytes[8..12].copy_from_slice(&3_u32.to_le_bytes());
    assert!(refusal(&gltf_alone, &bytes).contains("invalid glTF container"));
    assert!(refusal(&gltf_alone, json.to_string().as_bytes()).contains("must be within its buffer"));
    let head = r#"{"asset": {"version": "2.0"}"#;
    for (text, message) in [
        (
            format!("{head}, \"meshes\": [3]}}"),
            "invalid type: integer `3`, expected a mesh at line 1 column 42",
        ),
        (
            format!("{head}, \"nodes\": {{}}}}"),
            "invalid type: an object, expected an array at line 1 column 39",
        ),
        (format!("{head}}}"), "the file has no scene"),
        ("{}".into(), "the JSON has no `asset.version`"),
        ("ply".into(), "neither JSON nor a binary container"),
    ] {
        let got = refusal(&gltf_alone, text.as_bytes());
        assert!(got.contains(message), "{text}: {got}");
    }
    bytes = glb(&json, &bin);
    bytes[4] = 1;
    assert_eq!(refusal(&gltf_alone, &bytes), "glTF 1 is not supported: convert the file to glTF 2.0");
}

#[test]
fn gltf_strips_fans_mirrors_and_flat_triangles() {
    let (mut json, bin) = cube_gltf();
    json["nodes"][1]["scale"] = json!([2, 2, -2]);
    let mirrored = mesh(&gltf_alone, &glb(&json, &bin), reading(Up::Y)).unwrap().mesh;
    check("mirrored", &mirrored);
    assert_abs_diff_eq!(volume(&mirrored), (4.0_f32 / 3.0).powf(1.5), epsilon = 1e-5);
    assert!(mirrored.vertices.iter().all(|v| v.normal.dot(v.position) > 0.5), "inwards");
    for first in [0, 1] {
        json["meshes"][0]["primitives"][first]["attributes"].as_object_mut().unwrap().remove("NORMAL");
    }
    let flat = mesh(&gltf_alone, &glb(&json, &bin), reading(Up::Y)).unwrap().mesh;
    check("flat", &flat);
    assert_eq!((flat.vertices.len(), flat.triangles.len()), (36, 12));
    for v in &flat.vertices {
        assert_abs_diff_eq!(v.normal.abs().max_element(), 1.0, epsilon = 1e-5);
    }
    let quad = [0_u32, 1, 2, 3];
    assert_eq!(polygon::strip(&quad), [[0, 1, 2], [2, 1, 3]]);
    assert_eq!(polygon::fan(&quad), [[1, 2, 0], [2, 3, 0]]);
    assert!(polygon::fan(&[]).is_empty());
}

#[test]
fn gltf_variants_of_other_programs_are_the_same_cube() {
    let (json, bin) = cube_gltf();
    let cube = soup_of(&gltf_alone, CUBE_GLB);
    let same = |name: &str, json: &Value, bin: &[u8], tolerance: f64| {
        let got = soup_of(&gltf_alone, &glb(json, bin));
        assert_eq!(got.triangles, cube.triangles, "{name}");
        for (got, expected) in got.corners.iter().zip(&cube.corners) {
            assert_abs_diff_eq!(got.position, expected.position, epsilon = tolerance);
        }
    };
    // Without bounds, and with materials, skins and required extensions irrelevant to meshes.
    let mut plain = json.clone();
    for accessor in plain["accessors"].as_array_mut().unwrap() {
        accessor.as_object_mut().unwrap().retain(|name, _| name != "min" && name != "max");
    }
    plain["extensionsRequired"] = json!(["KHR_texture_basisu", "KHR_materials_clearcoat"]);
    plain["extensionsUsed"] = json!(["ACME_shiny"]);
    plain["meshes"][0]["primitives"][0]["material"] = json!(7);
    plain["materials"] = json!([{ "alphaMode": "ODD" }]);
    same("foreign", &plain, &bin, 0.0);
    // Positions as normalized 16-bit integers, as quantized meshes have them.
    let shares: Vec<u8> = (0..24)
        .flat_map(|k| [0, 4, 8].map(|at| f32::from_le_bytes(bin[32 * k + at..][..4].try_into().unwrap())))
        .flat_map(|x| ((x * 32_767.0).round() as i16).to_le_bytes())
        .collect();
    let mut quantised = json.clone();
    quantised["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    quantised["buffers"][0]["byteLength"] = json!(bin.len() + shares.len());
    let view = json!({"buffer": 0, "byteOffset": bin.len(), "byteLength": shares.len()});
    quantised["bufferViews"].as_array_mut().unwrap().push(view);
    for (accessor, offset) in [(0, 0), (3, 72)] {
        quantised["accessors"][accessor] = json!({
            "bufferView": 2, "byteOffset": offset, "componentType": 5122, "count": 12, "normalized": true, "type": "VEC3",
        });
    }
    // A 32767th of the range that the node scales to 2.
    same("quantised", &quantised, &[&bin[..], &shares[..]].concat(), 1e-4);
    // A corner moved by a sparse accessor, to its own position.
    let mut sparse = json.clone();
    let indices = json!({"bufferView": 1, "byteOffset": 0, "componentType": 5123});
    sparse["accessors"][0]["sparse"] = json!({"count": 1, "indices": indices, "values": {"bufferView": 0}});
    same("sparse", &sparse, &bin, 0.0);
}

#[test]
fn gltf_draco_mesh() {
    // Four corners of a tetrahedron, encoded by npm `draco3d` 1.5.9 with its defaults.
    let tetrahedron = include_bytes!("../../../tests/data/tetrahedron.drc");
    let json = json!({
        "asset": {"version": "2.0"}, "extensionsRequired": ["KHR_draco_mesh_compression"],
        "buffers": [{"byteLength": tetrahedron.len()}],
        "bufferViews": [{"buffer": 0, "byteLength": tetrahedron.len()}],
        "accessors": [{"componentType": 5126, "count": 4, "type": "VEC3"}, {"componentType": 5123, "count": 12, "type": "SCALAR"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "extensions": {
            "KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
        "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}],
    });
    let MeshFile { mesh, .. } = mesh(&gltf_alone, &glb(&json, tetrahedron), reading(Up::Z)).unwrap();
    check("draco", &mesh);
    assert_eq!(mesh.triangles.len(), 4);
    // Corners at every other corner of a cube of side 2/√3. Floats are not quantized by default.
    assert_abs_diff_eq!(volume(&mesh).abs(), (2.0_f32 / 3.0_f32.sqrt()).powi(3) / 3.0, epsilon = 1e-5);
    // A container is padded to a multiple of four bytes.
    for n in 1..tetrahedron.len() - 4 {
        let got = refusal(&gltf_alone, &glb(&json, &tetrahedron[..n]));
        assert!(got.contains("buffer of its Draco mesh"), "{n}: {got}");
    }
    let mut spoilt = tetrahedron.to_vec();
    for at in 0..spoilt.len() {
        spoilt[at] ^= 0x5a;
        judged("spoilt draco", &gltf_alone, &glb(&json, &spoilt)).ok();
        spoilt[at] ^= 0x5a;
    }
}

#[test]
fn stl_binary_starting_as_text_and_text_without_name() {
    let [text, binary] = [false, true].map(cube_stl);
    assert!(text.starts_with(b"solid\n") && binary.starts_with(b"solid cube"));
    let [text, binary] = [text, binary].map(|bytes| soup_of(&stl::parse, &bytes).corners);
    assert!(text.iter().zip(&binary).all(|(a, b)| a.position == b.position) && text.len() == 36);
    for (bytes, message) in [
        (&b"solid\nvertex 1 2\n"[..], "vertex 0 (counted from 0) does not have three numbers"),
        (b"solid\nvertex 1 2 x\n", "vertex 0 (counted from 0) does not have three numbers"),
        (b"solid\nvertex 1 2 3\n", "1 corners are not a multiple of 3"),
        (b"solid\n", "the file has no triangles"),
        (b"PK\x03\x04", "invalid STL: file neither begins with `solid` nor has a header of 84 bytes"),
    ] {
        assert!(refusal(&stl::parse, bytes).contains(message), "{}", refusal(&stl::parse, bytes));
    }
}

#[test]
fn ply_triangle_strips() {
    let strips = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
                  element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
                  0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 2 0\n8 0 1 2 3 -1 1 4 3\n";
    assert_eq!(soup_of(&ply::parse, strips.as_bytes()).triangles, [[0, 1, 2], [2, 1, 3], [1, 4, 3]]);
    assert!(
        refusal(&ply::parse, strips.replace("-1", "-2").as_bytes())
            .contains("a face has the invalid vertex index -2")
    );
}

#[test]
fn crease_angle_splits_normals() {
    // Two squares along the x axis, one of them rotated up by 30 degrees.
    let fold =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 -0.8660254 0.5\nv 1 -0.8660254 0.5\nf 1 2 3 4\nf 5 6 2 1\n";
    let normals = |crease| {
        let MeshFile { mesh, normals, uv, .. } =
            mesh(&obj::parse, fold.as_bytes(), MeshReading { up: Up::Z, crease, materials: false }).unwrap();
        assert!(!normals && !uv);
        check("fold", &mesh);
        let mut kinds: Vec<f32> =
            mesh.vertices.iter().map(|v| v.normal.z.acos().to_degrees().round()).collect();
        kinds.sort_by(f32::total_cmp);
        (mesh.vertices.len(), kinds)
    };
    assert_eq!(normals(29.0), (8, [[0.0; 4], [30.0; 4]].concat()));
    assert_eq!(normals(31.0), (6, vec![0.0, 0.0, 15.0, 15.0, 30.0, 30.0]));
}

#[test]
fn gltf_external_buffers_are_found() {
    let folder = tempfile::tempdir().unwrap();
    let (mut json, bin) = cube_gltf();
    json["buffers"][0]["uri"] = json!("my%20parts/cube.bin");
    fs::create_dir(folder.path().join("my parts")).unwrap();
    fs::write(folder.path().join("my parts/cube.bin"), &bin).unwrap();
    let file = folder.path().join("cube.gltf");
    fs::write(&file, json.to_string()).unwrap();
    assert_eq!(open(&file, reading(Up::Y)).unwrap().mesh.triangles.len(), 12);
}

#[test]
fn file_format_is_chosen_by_extension() {
    let folder = tempfile::tempdir().unwrap();
    let cube = folder.path().join("Cube.OBJ");
    fs::write(&cube, CUBE_OBJ).unwrap();
    assert!(open(&cube, reading(Up::Y)).is_ok());
    for (name, message) in [
        ("missing.ply", "cannot read the file"),
        ("cube.3ds", "unsupported file extension (expected .obj, .ply, .stl, .glb or .gltf)"),
        ("cube", "unsupported file extension (expected .obj, .ply, .stl, .glb or .gltf)"),
    ] {
        let error =
            open(&folder.path().join(name), reading(Up::Y)).err().expect("must be refused").to_string();
        assert!(error.contains(message), "{name}: {error}");
    }
    let folder_by_name = folder.path().join("folder.glb");
    fs::create_dir(&folder_by_name).unwrap();
    let error = open(&folder_by_name, reading(Up::Y)).err().unwrap().to_string();
    assert_eq!(error, "cannot read the file: not a regular file");
}
