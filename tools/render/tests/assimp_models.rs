//! Model files of other programs: Debian's package `assimp-testmodels`, if installed.

use std::path::{Path, PathBuf};

use asperity_render::geometry::mesh_file::{MeshReading, Up, open};

const FOLDER: &str = "/usr/share/assimp";

/// Files with errors, each with a part of its message. Assimp 5.2 renders triangles of none of them
/// except glTF 1.0.
const REFUSED: [(&str, &str); 32] = [
    ("OBJ/number_formats.obj", "all triangles have zero area"),
    ("OBJ/point_cloud.obj", "only points or lines"),
    ("OBJ/testline.obj", "only points or lines"),
    ("OBJ/testpoints.obj", "only points or lines"),
    ("PLY/issue623.ply", "the file has no element `face`"),
    ("PLY/points.ply", "the file has no element `face`"),
    ("PLY/pond.0.ply", "the file has no element `face`"),
    ("glTF/BoxTextured-glTF/BoxTextured.gltf", "glTF 1.0 is not supported"),
    ("glTF/BoxTextured-glTF-Binary/BoxTextured.glb", "glTF 1 is not supported"),
    ("glTF/BoxTextured-glTF-Embedded/BoxTextured.gltf", "glTF 1.0 is not supported"),
    ("glTF/BoxTextured-glTF-MaterialsCommon/BoxTextured.gltf", "glTF 1.0 is not supported"),
    ("glTF/CesiumMilkTruck/CesiumMilkTruck.gltf", "glTF 1 is not supported"),
    ("glTF/IncorrectVertexArrays/Cube_v1.gltf", "glTF 1.0 is not supported"),
    ("glTF/TwoBoxes/TwoBoxes.gltf", "glTF 1.0 is not supported"),
    ("BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", "vertex 0 (counted from 0) is not finite"),
    ("IndexOutOfRange/AllIndicesOutOfRange.gltf", "a face refers to vertex 65535, but there are"),
    ("MissingBin/BoxTextured.gltf", "the glTF's buffer `BoxTextured0.bin`"),
    ("RecursiveNodes/RecursiveNodes.gltf", "node 0 of the glTF is in the scene more than once"),
    ("SchemaFailures/sceneWrongType.gltf", "invalid type: string \"hello\", expected an index"),
    ("TestNoRootNode/NoScene.gltf", "the glTF has no scene 0"),
    ("TestNoRootNode/SceneWithoutNodes.gltf", "the file has no triangles"),
    ("Mesh_PrimitiveMode/Mesh_PrimitiveMode_00.gltf", "only points or lines"),
    ("Mesh_PrimitiveMode/Mesh_PrimitiveMode_01.gltf", "only points or lines"),
    ("Mesh_PrimitiveMode/Mesh_PrimitiveMode_02.gltf", "only points or lines"),
    ("Mesh_PrimitiveMode/Mesh_PrimitiveMode_03.gltf", "only points or lines"),
    ("Mesh_PrimitiveMode/Mesh_PrimitiveMode_07.gltf", "only points or lines"),
    ("Mesh_PrimitiveMode/Mesh_PrimitiveMode_08.gltf", "only points or lines"),
    ("Mesh_PrimitiveMode/Mesh_PrimitiveMode_09.gltf", "only points or lines"),
    ("Mesh_PrimitiveMode/Mesh_PrimitiveMode_10.gltf", "only points or lines"),
    ("wrongTypes/badArray.gltf", "invalid type: an object, expected an array"),
    ("invalid/empty", "the file is empty"),
    ("invalid/malformed.obj", "line 28: vertex 0 does not exist (there are 8)"),
];

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|ending| {
            ["obj", "ply", "stl", "glb", "gltf"].iter().any(|known| ending.eq_ignore_ascii_case(known))
        }) {
            found.push(path);
        }
    }
}

#[test]
fn assimp_test_models_render_or_report_their_error() {
    let mut found = Vec::new();
    files(Path::new(FOLDER), &mut found);
    if found.is_empty() {
        eprintln!("skipped: Debian's assimp-testmodels is not installed");
        return;
    }
    let mut drawn = 0;
    for path in &found {
        let name = path.to_string_lossy();
        let expected = REFUSED.iter().find(|(part, _)| name.contains(part));
        match (open(path, MeshReading { up: Up::Y, crease: 40.0, materials: true }), expected) {
            (Ok(_), None) => drawn += 1,
            (Err(error), Some((_, message))) => {
                assert!(error.to_string().contains(message), "{name}: {error}");
            }
            (Ok(_), Some((_, message))) => panic!("{name} must be an error: {message}"),
            (Err(error), None) => panic!("{name} must render: {error}"),
        }
    }
    assert!(drawn > 50, "{drawn} of {} files", found.len());
}
