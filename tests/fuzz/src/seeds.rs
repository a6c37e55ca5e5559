//! Seeds: small valid files of every format and arguments of every command, as initial fuzz input.

use std::io::Cursor;
use std::path::PathBuf;
use std::{env, fs};

use exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage,
};
use png::{BitDepth, ColorType};

/// Writes the seeds of a fuzz target into the folder of the variable `SEEDS`, if it is set.
///
/// # Panics
///
/// If the folder is not writable.
pub fn write(attack: &str) {
    let Some(folder) = env::var_os("SEEDS").map(PathBuf::from) else { return };
    fs::create_dir_all(&folder).expect("a folder for seeds");
    for (k, bytes) in of(attack).into_iter().enumerate() {
        fs::write(folder.join(format!("seed-{k}")), bytes).expect("a seed");
    }
}

/// Returns the seeds of a fuzz target.
#[must_use]
pub fn of(attack: &str) -> Vec<Vec<u8>> {
    all().into_iter().filter(|seed| seed.0 == attack).map(|seed| seed.1).collect()
}

/// A seed: fuzz target and bytes.
type Seed = (&'static str, Vec<u8>);

const CUBE_OBJ: &[u8] = include_bytes!("../../../tools/render/tests/data/cube.obj");
const CUBE_PLY: &[u8] = include_bytes!("../../../tools/render/tests/data/cube.ply");
const CUBE_GLB: &[u8] = include_bytes!("../../../tools/render/tests/data/cube.glb");

fn all() -> Vec<Seed> {
    let mut all = Vec::new();
    let mut add = |attack, bytes: Vec<u8>| all.push((attack, bytes));
    for (color, depth, bytes) in [
        (ColorType::Grayscale, BitDepth::Eight, 1),
        (ColorType::Grayscale, BitDepth::One, 1),
        (ColorType::GrayscaleAlpha, BitDepth::Sixteen, 4),
        (ColorType::Rgb, BitDepth::Eight, 3),
        (ColorType::Rgba, BitDepth::Sixteen, 8),
    ] {
        add("png", png_of(color, depth, &[0x5a; 8][..bytes]));
    }
    for compression in [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
        Compression::B44,
    ] {
        add("exr", exr_of(Encoding { compression, ..Encoding::SMALL_LOSSLESS }));
    }
    let mut jpeg = Vec::new();
    let encoder = jpeg_encoder::Encoder::new(&mut jpeg, 90);
    if encoder.encode(&[90; 8 * 8 * 3], 8, 8, jpeg_encoder::ColorType::Rgb).is_ok() {
        add("picture", jpeg);
    }
    let mut webp = Vec::new();
    let encoder = image_webp::WebPEncoder::new(&mut webp);
    if encoder.encode(&[90; 4 * 4 * 3], 4, 4, image_webp::ColorType::Rgb8).is_ok() {
        add("picture", webp);
    }
    add("picture", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 9\n\x02\x02\0\x09\x86\x05\x03\x06\x07\x08\x89\0\x89\x07\x89\x82".to_vec());
    add("picture", b"#?RGBE\nEXPOSURE=2\n\n+X 3 -Y 2\n\x05\0\x07\x82\x01\x01\x01\x02\x05\0\x07\x82\x05\0\x07\x82\x05\0\x07\x82".to_vec());
    for (first, bytes) in [
        (0, CUBE_OBJ),
        (0, b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\no a\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf -1 -2 -3\n"),
        (1, CUBE_PLY),
        (1, &binary_ply()),
        (1, b"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n5 0 1 2 3 -1\n"),
        (2, b"solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n"),
        (2, &binary_stl()),
    ] {
        add("mesh", [&[first], bytes].concat());
    }
    add("gltf", CUBE_GLB.to_vec());
    add("gltf", TRIANGLE.into());
    let painted = TRIANGLE.replacen('{', PAINTED, 1).replace("\"mode\":4", "\"material\":0");
    add("gltf", painted.into());
    JSON.into_iter().for_each(|text| add("json", text.into()));
    LINES.into_iter().for_each(|line| add("words", line.replace(' ', "\n").into()));
    // Targets that take numbers accept any bytes: short, long, and of every class.
    for attack in [
        "table",
        "shader",
        "noise",
        "density",
        "map",
        "fif",
        "surface",
        "reflectance",
        "environment",
        "material",
    ] {
        for k in 0..16_u32 {
            let length = [16, 64, 256, 600][k as usize % 4];
            let byte = |i: u32| ((i * 13 + k).wrapping_mul(2_654_435_761) >> 23) as u8;
            add(attack, (0..length).map(byte).collect());
        }
    }
    all
}

fn png_of(color: ColorType, depth: BitDepth, pixel: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 3, 2);
    encoder.set_color(color);
    encoder.set_depth(depth);
    let row = if depth == BitDepth::One { 1 } else { 3 * pixel.len() };
    let samples: Vec<u8> = pixel.iter().copied().cycle().take(2 * row).collect();
    if let Ok(mut writer) = encoder.write_header() {
        let _ = writer.write_image_data(&samples);
    }
    bytes
}

fn exr_of(encoding: Encoding) -> Vec<u8> {
    let half = FlatSamples::F16((0..12).map(|k| exr::prelude::f16::from_f32(k as f32)).collect());
    let channels =
        [("R", FlatSamples::F32(vec![0.5; 12])), ("G", half), ("A", FlatSamples::U32(vec![7; 12]))];
    let channels = channels.map(|(name, samples)| AnyChannel::new(name, samples));
    let channels = AnyChannels::sort(channels.into_iter().collect());
    let image = Image::from_layer(Layer::new((4, 3), LayerAttributes::named("seed"), encoding, channels));
    let mut bytes = Cursor::new(Vec::new());
    let _ = image.write().non_parallel().to_buffered(&mut bytes);
    bytes.into_inner()
}

fn binary_ply() -> Vec<u8> {
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let vertex = |p: [f32; 3]| p.into_iter().flat_map(f32::to_le_bytes).chain([9]);
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].into_iter().flat_map(vertex);
    let face = [3].into_iter().chain([0_i32, 1, 2].into_iter().flat_map(i32::to_le_bytes));
    header.bytes().chain(vertices).chain(face).collect()
}

fn binary_stl() -> Vec<u8> {
    let numbers = [0.0_f32, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let triangle = numbers.into_iter().flat_map(f32::to_le_bytes).chain([0, 0]);
    [0; 80].into_iter().chain(1_u32.to_le_bytes()).chain(triangle).collect()
}

/// A triangle with an embedded buffer.
const TRIANGLE: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"children":[1],"scale":[1,2,3]},{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":4}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR","sparse":{"count":1,"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":1}}}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3}],
"buffers":[{"byteLength":39,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEC"}]}"#;

/// The beginning of a glTF with a textured material.
const PAINTED: &str = r#"{"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"roughnessFactor":0.5},
"normalTexture":{"index":0,"scale":2},"alphaMode":"BLEND","extensions":{"KHR_materials_transmission":{"transmissionFactor":1}}}],
"textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071}],
"images":[{"uri":"data:;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAFElEQVR4nGM8kWLUwMDAwMDEAAUAHawB4t1+dKgAAAAASUVORK5CYII="}],"#;

const JSON: [&str; 16] = [
    r#"{"knots": ["0", 1, 2], "alpha": ["17/20", "-17/20"], "q": [["0", "1/2"], [1, -0.5]], "name": "g"}"#,
    r#"{"knots": [0, 1, 2], "y": [0, 1, 0], "alpha": [0.5, 0.5], "q": [[0, 0.5], [1, -0.5]]}"#,
    r#"{"x":[0.0,1.0,2.0],"y":[0.0,1.0,0.0],"alpha":[0.5,0.5],"q":[[0.0,0.5],[1.0,-0.5]]}"#,
    r#"{"lacunarity":2.17,"gain":0.5,"max_octaves":10}"#,
    r#"{"origin":[1.0,0.0,0.0],"step":[0.5,0.5,0.5],"size":[4,3,2]}"#,
    r#"["variance","aligned"]"#,
    r#"{"alpha_x":0.1,"alpha_y":0.3}"#,
    r#"{"alpha_x":0.1,"alpha_y":0.3,"gamma":2.5}"#,
    r#"{"exponent":20.0}"#,
    r#"{"n_u":50.0,"n_v":10.0}"#,
    r#"{"spacing":"warped","chart":"slopes"}"#,
    r#""fractal""#,
    r#"{"roughness":0.3,"seams_pattern":"grid","fibers":{"fiber_length":0.01},"diffuse":[0.1,0.2,0.3]}"#,
    r#"{"flakes":{"counted":{"spacing":0.01,"bin":0.1}},"smart_flake_sparkle":{"adaptive":{"unit":1.0}}}"#,
    r#"{"waves":"noise","body":"solid","index":1.5}"#,
    r#"{"scratch_cover":4.0,"scratch_direction":[0.0,1.0],"seed":7}"#,
];

const LINES: [&str; 14] = [
    "gallery --only teapot --size 768 --spp 16 --quality book",
    "tables --ndf ggx:0.1,0.5 --ndf student-t:0.1,0.2,3 --measure solid-angle --reconstruction bilinear",
    "tables --normal-map bricks.png --tangent-space directx --fif system.json --out my-tables",
    "render --mesh house.obj --up z --material brick --light sky.hdr --noise 0.02 --crease 30",
    "render --scene car --material paint --tint b02a1e --set orange_peel_strength=0.03 --background light",
    "render --frames 24 --out frames/####.png --job job.yaml --zoom-to 10000",
    "bake --noise perlin --tileable --size 4096 --format png,exr,ktx2 --tiles 13-24 --out rock",
    "bake --fractal torus --factor 0.3 --height 0.03 --metallic 1 --low-tint 3a2f28",
    "bench --peers --rounds 41 --step 0.1 --only value/",
    "shaders --part noise/kinds/gaussian --dialect glsl-es-300",
    "web --serve 8000",
    "check --ndf blinn-phong:20 --ndf ashikhmin-shirley:50,10 --ndf beckmann:0.3 --ndf ward:0.1,0.2 --seed 7",
    "ci --only clippy --jobs 4",
    "--help",
];
