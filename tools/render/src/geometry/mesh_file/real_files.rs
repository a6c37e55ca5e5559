//! File variants from public bug reports of other loaders: each must give the same mesh as its
//! plain form.

use std::fmt::Write as _;

use approx::assert_abs_diff_eq;
use glam::{DVec3, Vec2};
use serde_json::{Value, json};

use super::tests::{cube_gltf, cube_stl, glb, gltf_alone, reading, refusal};
use super::*;

/// A cube of side 1 at the origin.
const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn read(parse: &Parser<'_>, bytes: &[u8]) -> MeshFile {
    mesh(parse, bytes, reading(Up::Z)).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the corners of all triangles.
fn triangles(file: &MeshFile) -> Vec<[[f32; 3]; 3]> {
    let place = |&i: &u32| file.mesh.vertices[i as usize].position.to_array();
    file.mesh.triangles.iter().map(|t| [place(&t[0]), place(&t[1]), place(&t[2])]).collect()
}

/// Asserts that both files have the same triangles.
fn same(name: &str, got: &MeshFile, expected: &MeshFile, tolerance: f32) {
    let (got, expected) = (triangles(got), triangles(expected));
    assert_eq!(got.len(), expected.len(), "{name}");
    for (got, expected) in
        got.as_flattened().as_flattened().iter().zip(expected.as_flattened().as_flattened())
    {
        assert!((got - expected).abs() <= tolerance, "{name}: {got} {expected}");
    }
}

fn obj(name: &str, text: impl Into<Vec<u8>>) -> MeshFile {
    let (got, plain) = (read(&obj::parse, &text.into()), read(&obj::parse, CUBE.as_bytes()));
    same(name, &got, &plain, 0.0);
    got
}

#[test]
fn obj_vertex_colors_and_weights_are_ignored() {
    let first = |end: &str| CUBE.replacen("v 0 0 0", &format!("v 0 0 0 {end}"), 1);
    for end in ["1 0 0", "0.5", "1 0.5 0.5 0.5", "0.1 0.2 0.3 0.4", "1 red"] {
        obj(end, first(end));
    }
    obj("all", CUBE.replace("\nv ", " 0.5 0.5 0.5\nv "));
}

#[test]
fn obj_statements_without_arguments_are_ignored() {
    for statement in
        ["usemtl", "usemtl ", "mtllib", "o", "g", "s", "vp 1 2", "maplib x", "f", "F 1 2 3", "\u{c}"]
    {
        obj(statement, CUBE.replacen("f ", &format!("{statement}\nf "), 1));
    }
}

#[test]
fn obj_comments_may_follow_every_statement() {
    obj("faces", CUBE.replace("\nf", " # face 1 2\nf"));
    obj("vertices", CUBE.replace("\nv", "#vertex\nv"));
    obj("backslash", CUBE.replace("\nf", " # C:\\\nf"));
}

#[test]
fn obj_lines_may_be_continued() {
    for joint in ["\\\n", " \\\n ", "\\\r\n", "\\\n\\\n"] {
        obj(joint, CUBE.replace("f 1 4 ", &format!("f 1 4 {joint}")));
        obj(joint, CUBE.replace("v 1 1 ", &format!("v 1 1 {joint}")));
    }
    for statement in ["mtllib", "maplib", "shadow_obj"] {
        obj(statement, CUBE.replacen("f ", &format!("{statement} C:\\models\\\nf "), 1));
    }
}

#[test]
fn obj_text_encodings_and_line_ends() {
    let utf16: Vec<u8> = CUBE.encode_utf16().flat_map(u16::to_le_bytes).collect();
    obj("utf-8", format!("\u{feff}{CUBE}"));
    obj("utf-16 mark", [&[0xff, 0xfe], &utf16[..]].concat());
    obj("utf-16", utf16);
    obj("classic Mac OS", CUBE.replace('\n', "\r"));
    obj("Windows", CUBE.replace('\n', "\r\n"));
    obj("mixed", CUBE.replacen("\nv", "\rv", 3).replacen("\nf", "\r\nf", 3));
    obj("classic Mac OS and a line feed", format!("{}\n", CUBE.replace('\n', "\r")));
    obj("joined files", format!("# a\n\u{feff}{CUBE}"));
    obj("zero bytes", format!("{}\0\0\0\n", CUBE.trim_end()));
    obj("latin-1", [b"o caf\xe9\n", CUBE.as_bytes()].concat());
    // With an unused vertex, a lost vertex would shift all indices by one.
    let one_more = CUBE.replacen("f ", "v 9 9 9\nf ", 1);
    obj("mark and unused vertex", format!("\u{feff}{one_more}"));
}

#[test]
fn obj_texture_coordinates_may_have_one_number() {
    let file = obj("vt u", CUBE.replacen("f 1 4 3 2", "vt 0.25\nvt 0.75\nf 1/1 4/1 3/2 2/2", 1));
    assert!(file.mesh.vertices.iter().all(|v| v.uv.y == 0.0));
}

#[test]
fn obj_indices_of_absent_lists_are_ignored() {
    obj("vt and vn", CUBE.replace("f 1 4 3 2", "f 1/7/9 4/-1/2 3//5 2/3/"));
    obj("empty", CUBE.replace("f 1 4 3 2", "f 1/ 4/ 3// 2"));
    obj("zero", CUBE.replace("f 1 4 3 2", "f 1/0/0 4/0/0 3/0/0 2/0/0"));
    obj("beyond", CUBE.replace("f 1 4 3 2", "vt 0 0\nvn 0 0 1\nf 1/9/9 4/-7/-7 3/1 2/1"));
    for statement in ["vt", "vn", "vn 0 1", "vt abc 1", "vn x y z"] {
        obj(statement, CUBE.replacen("f ", &format!("{statement}\nf "), 1));
    }
}

#[test]
fn obj_unused_vertices_may_be_broken() {
    for vertex in ["v nan 0 0", "v -nan(ind) 1.#QNAN inf", "v 1 2 3.1+e2", "v 1 2"] {
        obj(vertex, CUBE.replacen("f ", &format!("{vertex}\nf "), 1));
    }
    let normals = CUBE.replace("f 1 4 3 2", "vn nan nan nan\nf 1//1 4//1 3//1 2//1");
    assert!(!obj("vn nan", normals).normals);
}

/// A cube in map coordinates must have edges of equal length, and the shape given by the doubles in
/// the file.
#[test]
fn map_coordinates_keep_precision() {
    let expected = read(&ply::parse, include_bytes!("../../../tests/data/meshes/utm.ply"));
    let got = read(&obj::parse, include_bytes!("../../../tests/data/meshes/utm.obj"));
    same("utm.obj", &got, &expected, 1e-6);
    // Binary STL cannot represent such coordinates of a triangle of side 1, but text can.
    let text = "solid\nfacet normal 0 0 1\nouter loop\nvertex 5000000.25 4000000 100\nvertex 5000001.25 4000000 100\nvertex 5000000.25 4000001 100\nendloop\nendfacet\nendsolid\n";
    let plain = text
        .replace("5000000.25", "0")
        .replace("5000001.25", "1")
        .replace("4000000", "0")
        .replace("4000001", "1");
    same("stl", &read(&stl::parse, text.as_bytes()), &read(&stl::parse, plain.as_bytes()), 1e-6);
}

fn stl_as_cube(name: &str, bytes: &[u8]) {
    same(name, &read(&stl::parse, bytes), &read(&stl::parse, &cube_stl(false)), 0.0);
}

#[test]
fn stl_keywords_in_any_case_and_names_of_any_words() {
    let text = String::from_utf8(cube_stl(false)).unwrap();
    stl_as_cube("upper", text.to_uppercase().as_bytes());
    stl_as_cube("mark", format!("\u{feff}{text}").as_bytes());
    stl_as_cube("one line", text.replace('\n', " ").as_bytes());
    for name in ["vertex 1 2 3", "facet", "a facet normal", "endloop vertex", "caf\u{e9}", "solid"] {
        let named = text.replacen("solid", &format!("Solid {name}"), 1);
        stl_as_cube(name, named.replace("endsolid", &format!("endsolid {name}")).as_bytes());
    }
    for name in ["my facet normal 1 vertex x", "a\0b"] {
        stl_as_cube(name, text.replacen("solid", &format!("solid {name}"), 1).as_bytes());
    }
    stl_as_cube("padded", format!("{text}\0\0\0").as_bytes());
    assert!(!read(&stl::parse, text.as_bytes()).left_out);
    assert!(read(&stl::parse, text.replace("endsolid", "").as_bytes()).left_out);
    for text in ["v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".repeat(9), format!("; made\n{text}")] {
        assert!(refusal(&stl::parse, text.as_bytes()).contains("text does not begin with `solid`"));
    }
    stl_as_cube("color", text.replacen("solid", "solid name\ncolor 1 0 0", 1).as_bytes());
    let twice = read(&stl::parse, format!("{text}\n{text}").as_bytes());
    assert_eq!(twice.mesh.triangles.len(), 24);
}

#[test]
fn stl_facets_may_be_polygons() {
    let facet = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n";
    assert_eq!(read(&stl::parse, facet.as_bytes()).mesh.triangles.len(), 2);
}

#[test]
fn stl_binary_that_begins_with_solid() {
    let binary = cube_stl(true);
    assert!(binary.starts_with(b"solid"));
    stl_as_cube("blanks", &[&binary, &b"  \n"[..]].concat());
    let mut streamed = binary.clone();
    streamed[80..84].fill(0);
    stl_as_cube("count of a stream", &streamed);
    let mut fewer = binary.clone();
    fewer[80] = 3;
    let fewer = read(&stl::parse, &fewer);
    assert!(fewer.left_out && fewer.mesh.triangles.len() == 3);
    let got = refusal(&stl::parse, &binary[..binary.len() - 10]);
    assert!(got.contains("header claims 12 triangles, but 674 bytes hold 11"), "{got}");
    let file = include_bytes!("../../../tests/data/meshes/binary-solid-trailing.stl");
    assert_eq!(read(&stl::parse, file).mesh.triangles.len(), 12);
}

const CUBE_PLY: &str = include_str!("../../../tests/data/cube.ply");

fn ply_as_cube(name: &str, bytes: &[u8]) {
    same(name, &read(&ply::parse, bytes), &read(&ply::parse, CUBE_PLY.as_bytes()), 0.0);
}

#[test]
fn ply_unknown_header_lines_are_ignored() {
    for line in ["comment caf\u{e9}", "obj_info 1", "Created by hand", "", "comment"] {
        ply_as_cube(line, CUBE_PLY.replacen("comment a cube", line, 1).as_bytes());
    }
    ply_as_cube("latin-1", &[b"ply\ncomment caf\xe9", &CUBE_PLY.as_bytes()[3..]].concat());
    ply_as_cube("Windows", CUBE_PLY.replace('\n', "\r\n").as_bytes());
    ply_as_cube("classic Mac OS", CUBE_PLY.replace('\n', "\r").as_bytes());
    ply_as_cube("mark", format!("\u{feff}{CUBE_PLY}").as_bytes());
    same(
        "file",
        &read(&ply::parse, include_bytes!("../../../tests/data/meshes/comment-latin1.ply")),
        &read(&obj::parse, CUBE.as_bytes()),
        1.0,
    );
}

#[test]
fn ply_names_and_elements_of_other_programs() {
    for [x, y, z] in [["px", "py", "pz"], ["posx", "posy", "posz"]] {
        let named =
            CUBE_PLY.replace("float x", &format!("float {x}")).replace("double y", &format!("double {y}"));
        ply_as_cube(x, named.replace("float z", &format!("float {z}")).as_bytes());
    }
    ply_as_cube("mixed line ends", CUBE_PLY.replacen('\n', "\r\n", 1).as_bytes());
    let empty = CUBE_PLY
        .replace("element face", "element tristrips 0\nproperty list int int vertex_indices\nelement face");
    ply_as_cube("empty strips", empty.as_bytes());
    let strips = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 0\nproperty list uchar int vertex_indices\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    assert_eq!(read(&ply::parse, strips.as_bytes()).mesh.triangles.len(), 1);
    let short = CUBE_PLY.replace("vertex 8", "vertex 9");
    let got = refusal(&ply::parse, short.as_bytes());
    assert!(got.contains("header claims 16 rows, but there are 15 lines"), "{got}");
    let negative = CUBE_PLY.replace("4 0 4 6 2", "4 0 4 6 -1");
    assert!(refusal(&ply::parse, negative.as_bytes()).contains("a face has the invalid vertex index -1"));
}

#[test]
fn non_finite_texture_coordinates_are_0() {
    let file = obj("vt nan", CUBE.replace("f 1 4 3 2", "vt nan inf\nf 1/1 4/1 3/1 2/1"));
    assert!(!file.uv && file.mesh.vertices.iter().all(|v| v.uv == Vec2::ZERO));
}

#[test]
fn ply_rows_of_text_may_have_more_columns_or_be_wrapped() {
    let (head, body) = CUBE_PLY.split_once("end_header\n").unwrap();
    ply_as_cube("more", format!("{head}end_header\n{}", body.replace(" 200", " 200 7 8")).as_bytes());
    ply_as_cube(
        "more and a last line",
        format!("{head}end_header\n{}\nend\n", body.replace(" 200", " 200 7 8")).as_bytes(),
    );
    ply_as_cube("wrapped", format!("{head}end_header\n{}", body.replace(" 200", "\n200")).as_bytes());
}

#[test]
fn ply_unused_vertices_may_be_nan() {
    let file = read(&ply::parse, include_bytes!("../../../tests/data/meshes/nan-vertex.ply"));
    assert_eq!(file.mesh.triangles.len(), 12);
    let used = CUBE_PLY.replacen("-1 -1 -1 200", "-1 nan -1 200", 1);
    assert_eq!(refusal(&ply::parse, used.as_bytes()), "vertex 0 (counted from 0) is not finite");
}

#[test]
fn ply_texture_coordinates_of_faces() {
    let file = read(&ply::parse, include_bytes!("../../../tests/data/meshes/wedge.ply"));
    assert!(file.uv);
    // Each of six faces shows the whole square.
    let uv: Vec<Vec2> =
        file.mesh.triangles.iter().flatten().map(|&i| file.mesh.vertices[i as usize].uv).collect();
    let largest = uv.iter().map(|uv| uv.max_element()).fold(0.0, f32::max);
    for face in uv.chunks(6) {
        for corner in [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE] {
            assert!(face.iter().any(|uv| (*uv / largest - corner).length() < 1e-6), "{corner} {face:?}");
        }
    }
}

/// The cube of the glTF files.
fn plain() -> MeshFile {
    read(&gltf_alone, include_bytes!("../../../tests/data/meshes/plain.glb"))
}

/// Returns JSON and buffer of `plain.glb`.
fn parts(bytes: &[u8]) -> (Value, Vec<u8>) {
    let length = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    let (json, behind) = bytes[20..].split_at(length(12));
    (serde_json::from_slice(json).unwrap(), behind[8..].to_vec())
}

#[test]
fn gltf_skinned_mesh_ignores_the_transform_of_its_node() {
    let file = include_bytes!("../../../tests/data/meshes/skinned.glb");
    same("skinned.glb", &read(&gltf_alone, file), &plain(), 1e-6);
    // The joint rotates the cube by a quarter turn about z, which gives the same cube with permuted
    // corners.
    let (mut json, bin) = parts(file);
    let joint = json["skins"][0]["joints"][0].as_u64().unwrap() as usize;
    json["nodes"][joint] = json!({"translation": [3, 4, 5], "scale": [2, 2, 2]});
    same("moved joint", &read(&gltf_alone, &glb(&json, &bin)), &plain(), 1e-6);
    let count = json["skins"][0]["joints"].as_array().unwrap().len();
    let joints = json["skins"][0]["joints"].take();
    json["skins"][0]["joints"] = json!([]);
    let got = refusal(&gltf_alone, &glb(&json, &bin));
    assert_eq!(got, "the glTF has no joint 0 (it has 0, counted from 0)", "of {count}");
    json["skins"][0]["joints"] = joints;
    json["nodes"][joint] = json!({"scale": [1, 1, 4]});
    let tall = read(&gltf_alone, &glb(&json, &bin));
    let height = tall.mesh.vertices.iter().map(|v| v.position.z.abs()).fold(0.0, f32::max);
    assert_abs_diff_eq!(height, 4.0 / 18.0_f32.sqrt(), epsilon = 1e-5);
}

#[test]
fn gltf_instances_are_all_drawn() {
    for name in ["used", "required"] {
        let (mut json, bin) = parts(include_bytes!("../../../tests/data/meshes/instancing.glb"));
        if name == "required" {
            json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
        }
        let file = read(&gltf_alone, &glb(&json, &bin));
        assert_eq!(file.mesh.triangles.len(), 36, "{name}");
        let cubes: Vec<DVec3> = file
            .mesh
            .triangles
            .chunks(12)
            .map(|cube| {
                let all = cube.iter().flatten().map(|&i| file.mesh.vertices[i as usize].position.as_dvec3());
                all.sum::<DVec3>() / 36.0
            })
            .collect();
        assert!(cubes[0].distance(cubes[1]) > 0.3 && cubes[1].distance(cubes[2]) > 0.3, "{cubes:?}");
    }
}

#[test]
fn gltf_instances_rotate_and_scale() {
    let (mut json, mut bin) = parts(include_bytes!("../../../tests/data/meshes/plain.glb"));
    let offset = bin.len();
    // A quarter turn about y as normalized shorts, and a scale of 1, 1, 3: along x after the
    // rotation.
    let half = (0.5_f64.sqrt() * 32_767.0).round() as i16;
    bin.extend([0, half, 0, half].into_iter().flat_map(i16::to_le_bytes));
    bin.extend([1.0_f32, 1.0, 3.0].into_iter().flat_map(f32::to_le_bytes));
    let views = json["bufferViews"].as_array_mut().unwrap();
    views.push(json!({"buffer": 0, "byteOffset": offset, "byteLength": 8}));
    views.push(json!({"buffer": 0, "byteOffset": offset + 8, "byteLength": 12}));
    let view = views.len() - 2;
    let accessors = json["accessors"].as_array_mut().unwrap();
    accessors.push(
        json!({"bufferView": view, "componentType": 5122, "normalized": true, "count": 1, "type": "VEC4"}),
    );
    accessors.push(json!({"bufferView": view + 1, "componentType": 5126, "count": 1, "type": "VEC3"}));
    let first = accessors.len() - 2;
    json["buffers"][0]["byteLength"] = json!(bin.len());
    json["nodes"][0]["extensions"] =
        json!({"EXT_mesh_gpu_instancing": {"attributes": {"ROTATION": first, "SCALE": first + 1}}});
    let file = read(&gltf_alone, &glb(&json, &bin));
    let size = |axis: usize| file.mesh.vertices.iter().map(|v| v.position[axis].abs()).fold(0.0, f32::max);
    assert_abs_diff_eq!(size(0) / size(1), 3.0, epsilon = 1e-3);
    assert_abs_diff_eq!(size(2) / size(1), 1.0, epsilon = 1e-3);
}

#[test]
fn gltf_unknown_required_extensions_are_an_error() {
    let (mut json, bin) = parts(include_bytes!("../../../tests/data/meshes/plain.glb"));
    json["extensionsRequired"] = json!(["KHR_texture_transform", "KHR_node_selectability"]);
    same("harmless", &read(&gltf_alone, &glb(&json, &bin)), &plain(), 0.0);
    json["extensionsRequired"] = json!([]);
    json["extensionsUsed"] = json!(["ACME_fur"]);
    same("used", &read(&gltf_alone, &glb(&json, &bin)), &plain(), 0.0);
    json["extensionsRequired"] = json!(["ACME_fur"]);
    let got = refusal(&gltf_alone, &glb(&json, &bin));
    assert_eq!(got, "the glTF requires the unsupported extension ACME_fur");
}

#[test]
fn gltf_default_morph_weights_apply() {
    let file = include_bytes!("../../../tests/data/meshes/morph-weights.glb");
    let (mut json, bin) = parts(file);
    let morphed = triangles(&read(&gltf_alone, file));
    assert_ne!(morphed, triangles(&plain()));
    // Weights of the node replace weights of the mesh.
    json["nodes"][0]["weights"] = json!([0.0]);
    same("node", &read(&gltf_alone, &glb(&json, &bin)), &plain(), 0.0);
    json["nodes"][0]["weights"] = json!([1.0]);
    json["meshes"][0]["weights"] = json!([0.0]);
    assert_eq!(triangles(&read(&gltf_alone, &glb(&json, &bin))), morphed);
    json["meshes"][0]["weights"] = json!([1.0]);
    json["nodes"][0]["weights"] = json!([]);
    assert_eq!(triangles(&read(&gltf_alone, &glb(&json, &bin))), morphed);
}

#[test]
fn gltf_hidden_nodes_are_skipped() {
    let (mut json, bin) = parts(include_bytes!("../../../tests/data/meshes/plain.glb"));
    json["scenes"][0]["nodes"] = json!([0, 1]);
    let hidden = json!({"KHR_node_visibility": {"visible": false}});
    json["nodes"] =
        json!([{"mesh": 0}, {"extensions": hidden, "children": [2]}, {"mesh": 0, "translation": [9, 0, 0]}]);
    same("hidden", &read(&gltf_alone, &glb(&json, &bin)), &plain(), 0.0);
}

#[test]
fn gltf_json_in_javascript_form() {
    let (json, bin) = parts(include_bytes!("../../../tests/data/meshes/plain.glb"));
    let with = |pointer: &str, name: &str, value: Value| {
        let mut json = json.clone();
        json.pointer_mut(pointer).unwrap()[name] = value;
        read(&gltf_alone, &glb(&json, &bin))
    };
    let count = json["accessors"][0]["count"].as_f64().unwrap();
    for (pointer, name, value) in [
        ("/nodes/0", "children", json!(null)),
        ("/nodes/0", "extensions", json!(null)),
        ("/accessors/0", "byteOffset", json!(null)),
        ("/accessors/0", "count", json!(count)),
        ("/meshes/0/primitives/0", "mode", json!(4.0)),
        ("", "extensionsRequired", json!(null)),
    ] {
        same(name, &with(pointer, name, value), &plain(), 0.0);
    }
    let mut marked = json.clone();
    marked["buffers"][0]["uri"] = json!(tests::data_uri(&bin));
    for text in [format!("\u{feff}{marked}"), format!("{marked}\0\0"), format!("{marked} \n")] {
        same(&text, &read(&gltf_alone, text.as_bytes()), &plain(), 0.0);
    }
}

#[test]
fn gltf_unused_parts_may_be_invalid() {
    let (json, bin) = parts(include_bytes!("../../../tests/data/meshes/plain.glb"));
    let with = |nodes: Value| {
        let mut json = json.clone();
        json["nodes"] = nodes;
        read(&gltf_alone, &glb(&json, &bin))
    };
    for nodes in [
        json!([{"mesh": 0}, {"children": [0]}]),
        json!([{"mesh": 0}, {"children": [7]}]),
        json!([{"mesh": 0}, {"children": [3]}, {"children": [3]}, {}]),
    ] {
        same("nodes", &with(nodes), &plain(), 0.0);
    }
    // A primitive without vertices next to the cube.
    let mut empty = json.clone();
    let accessors = empty["accessors"].as_array_mut().unwrap();
    accessors.push(json!({"bufferView": 0, "componentType": 5126, "count": 0, "type": "VEC3"}));
    let last = accessors.len() - 1;
    empty["meshes"][0]["primitives"].as_array_mut().unwrap().push(json!({"attributes": {"POSITION": last}}));
    same("empty", &read(&gltf_alone, &glb(&empty, &bin)), &plain(), 0.0);
    let mut mode = json.clone();
    mode["meshes"][0]["primitives"][0]["mode"] = json!(9);
    assert!(refusal(&gltf_alone, &glb(&mode, &bin)).contains("invalid primitive mode 9"));
    let mut meshopt = json.clone();
    meshopt["bufferViews"][0]["byteLength"] = json!(1 << 20);
    meshopt["bufferViews"][0]["extensions"] = json!({"EXT_meshopt_compression": {}});
    assert!(
        refusal(&gltf_alone, &glb(&meshopt, &bin))
            .contains("unsupported compression EXT_meshopt_compression")
    );
}

#[test]
fn gltf_data_uris_of_rfc_2397() {
    let file = include_bytes!("../../../tests/data/meshes/uri-escaped.gltf");
    same("escaped", &read(&gltf_alone, file), &plain(), 0.0);
    let (mut json, bin) = parts(include_bytes!("../../../tests/data/meshes/plain.glb"));
    let escaped = bin.iter().fold(String::from("data:,"), |mut all, byte| {
        write!(all, "%{byte:02x}").unwrap();
        all
    });
    let base64 = tests::data_uri(&bin);
    let other_alphabet =
        base64.replace('+', "-").replace('/', "_").replacen("application_", "application/", 1);
    for uri in [
        escaped,
        base64.replace("data:", "DATA:").replace("base64", "Base64"),
        base64.trim_end_matches('=').to_owned(),
        other_alphabet,
        base64.replacen("AAAA", "AA%0AAA", 1),
    ] {
        json["buffers"][0]["uri"] = json!(uri);
        same(&uri, &read(&gltf_alone, json.to_string().as_bytes()), &plain(), 0.0);
    }
}

#[test]
fn gltf_triangles_that_do_not_exist_are_left_out() {
    let (json, mut bin) = cube_gltf();
    let accessor = &json["accessors"][6];
    let view = &json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let offset = [view, accessor].map(|of| of["byteOffset"].as_u64().unwrap_or(0) as usize);
    bin[offset[0] + offset[1]..][..2].copy_from_slice(&900_u16.to_le_bytes());
    let file = read(&gltf_alone, &glb(&json, &bin));
    assert!(file.left_out);
    // Two primitives refer to the accessor.
    assert_eq!(file.mesh.triangles.len(), 10);
}

#[test]
fn faces_without_area_do_not_enlarge_the_frame() {
    let file = include_bytes!("../../../tests/data/meshes/hidden-by-zero-scale.glb");
    same("scale 0", &read(&gltf_alone, file), &plain(), 0.0);
    for (name, faces) in [
        ("point", "v 900 0 0\nf 9 9 9\n"),
        ("line", "v 900 0 0\nv 900.1 0.3 0.7\nv 900.3 0.9 2.1\nf 9 10 11\n"),
        ("twice", "v 900 0 0\nv 900 1 0\nf 9 10 9\n"),
        ("collapsed", "v 900 0 0\nv 900.000000001 0 0\nv 900 0.000000001 0\nf 9 10 11\n"),
    ] {
        obj(name, format!("{CUBE}{faces}"));
    }
    let facet = |x: &str| {
        format!(
            "facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n",
            format!("vertex {x} 0 0\n").repeat(3)
        )
    };
    let text = String::from_utf8(cube_stl(false)).unwrap();
    stl_as_cube("facet", text.replacen("endsolid", &format!("{}endsolid", facet("900")), 1).as_bytes());
    let ply = CUBE_PLY
        .replace("vertex 8", "vertex 9")
        .replace("face 6", "face 7")
        .replace("\n7\n", "\n900 0 0 0\n7\n");
    ply_as_cube("face", format!("{ply}3 8 8 8\n").as_bytes());
}
