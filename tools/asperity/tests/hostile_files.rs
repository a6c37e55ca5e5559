//! Malicious input files: each fails with one error line, within limits of memory and time enforced
//! by the system.
#![cfg(unix)]
#![expect(clippy::unwrap_used, reason = "a test that cannot write its own file has failed")]

use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use asperity_render::image::{Format, Image, formats::exr};
use serde_json::{Value, json};

/// Address space in KiB: the program, its threads, and 256 MiB. No file here is larger than 8 MiB.
const MEMORY: u64 = 640 << 10;
/// Seconds of CPU time for an unoptimized program.
const SECONDS: u64 = 10;

/// Wall-clock seconds, for waits that use no CPU time; far more than any file here needs.
const WAITED: u64 = 120;

/// The program under these limits.
fn limited(folder: &Path, words: &[&str]) -> Output {
    let limits = format!("ulimit -v {MEMORY} && ulimit -t {SECONDS} && exec \"$0\" \"$@\"");
    let builder = env!("CARGO_BIN_EXE_asperity");
    let mut command = Command::new("sh");
    command.current_dir(folder).env("MALLOC_ARENA_MAX", "1").args(["-c", &limits, builder, "--jobs", "1"]);
    let mut child = command.args(words).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let begun = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begun.elapsed().as_secs() > WAITED {
            child.kill().unwrap();
            panic!("{words:?} does not end");
        }
        sleep(Duration::from_millis(5));
    }
    child.wait_with_output().unwrap()
}

/// Asserts that the command fails with one error line that contains `said`.
fn refused(folder: &Path, words: &[&str], said: &str) {
    let output = limited(folder, words);
    let line = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{words:?}: {:?} {line}", output.status);
    assert_eq!(line.trim_end().lines().count(), 1, "{words:?}: {line}");
    assert!(line.starts_with("error: ") && line.contains(said) && line.len() < 600, "{words:?}: {line}");
}

/// Asserts an error for each file: name, bytes, expected message.
fn all_refused(command: &[&str], files: &[(&str, Vec<u8>, &str)]) {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes, said) in files {
        std::fs::write(folder.path().join(name), bytes).unwrap();
        refused(folder.path(), &[command, &[*name]].concat(), said);
    }
    let left = std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, files.len(), "a file was written");
}

fn light(files: &[(&str, Vec<u8>, &str)]) {
    all_refused(&["render", "--scene", "sphere", "--material", "chrome", "--light"], files);
}

fn mesh(files: &[(&str, Vec<u8>, &str)]) {
    all_refused(&["render", "--mesh"], files);
}

/// Encodes a PNG chunk.
fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let crc = [kind, data].concat().iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 * (crc & 1)))
    });
    [&(data.len() as u32).to_be_bytes(), &kind[..], data, &(!crc).to_be_bytes()].concat()
}

/// Encodes a gray PNG of this size with these chunks after its header.
fn png(width: u32, height: u32, chunks: &[u8]) -> Vec<u8> {
    let header = [&width.to_be_bytes()[..], &height.to_be_bytes(), &[8, 0, 0, 0, 0]].concat();
    [b"\x89PNG\r\n\x1a\n", &*chunk(b"IHDR", &header), chunks, &chunk(b"IEND", &[])].concat()
}

/// Encodes a chunk of this many black pixel bytes.
fn black(bytes: usize) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 4096, (bytes / 4096) as u32);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().unwrap().write_image_data(&vec![0; bytes]).unwrap();
    let at = file.windows(4).position(|name| name == b"IDAT").unwrap();
    let end = file.windows(4).position(|name| name == b"IEND").unwrap() - 4;
    // A single chunk.
    let (mut data, mut rest) = (Vec::new(), &file[at - 4..end]);
    while let Some((length, behind)) = rest.split_first_chunk::<4>() {
        let length = u32::from_be_bytes(*length) as usize;
        data.extend(&behind[4..4 + length]);
        rest = &behind[8 + length..];
    }
    data
}

#[test]
fn image_with_excessive_size_is_an_error() {
    let zeros = black(1 << 24);
    let text = [b"Comment\0\0", &*zeros].concat();
    light(&[
        ("claim.png", png(0x7fff_ffff, 0x7fff_ffff, &chunk(b"IDAT", &[])), "limits are exceeded"),
        ("empty.png", png(16_384, 8192, &chunk(b"IDAT", &[])), "cannot hold the 16384 × 8192 pixels"),
        ("text.png", png(8, 8, &chunk(b"zTXt", &text).repeat(64)), "cannot decode the PNG"),
        ("claim.hdr", b"#?RGBE\n\n-Y 2147483647 +X 2147483647\n".into(), "an image must have 1 to"),
        (
            // A color, then its repeat count in four digits.
            "run.hdr",
            b"#?RGBE\n\n-Y 1 +X 134217728\n\x80\x80\x80\x80\x01\x01\x01\xff\x01\x01\x01\xff\x01\x01\x01\xff\x01\x01\x01\x07".into(),
            "cannot hold the 134217728 × 1 pixels",
        ),
        (
            // A lossless file, which could repeat one color indefinitely.
            "claim.webp",
            b"RIFF\x16\0\0\0WEBPVP8L\x0a\0\0\0\x2f\xfe\xff\xff\x07\0\0\0\0\0".into(),
            "cannot hold the 16383 × 8192 pixels",
        ),
        ("claim.jpg", jpeg(16_000, 8000), "cannot hold the 16000 × 8000 pixels"),
    ]);
}

/// Encodes zeros in minimal deflate blocks of 12 bytes with 1549 zeros each. The header states the
/// count.
fn deflated_zeros(at_least: usize) -> Vec<u8> {
    let matched = [1, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0];
    // Non-final blocks with fixed codes: the literal 0, six copies of 258 bytes at distance 1, end
    // of block.
    let bits = [&[0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0][..], &matched.repeat(6), &[0; 7]].concat();
    let block: Vec<u8> =
        bits.chunks(8).map(|byte| byte.iter().rev().fold(0, |all, bit| all << 1 | bit)).collect();
    let blocks = at_least.div_ceil(1549);
    let sum = (((blocks * 1549) % 65_521) as u32) << 16 | 1;
    [&[0x78, 0x01][..], &block.repeat(blocks), &[0x03, 0x00], &sum.to_be_bytes()].concat()
}

#[test]
fn image_that_inflates_beyond_its_size() {
    let folder = tempfile::tempdir().unwrap();
    let zeros = deflated_zeros(700 << 20);
    // Two rows of 16 bytes, each after its number and its length. The second row grows.
    let mut rows = exr(4, 2, [("Y", vec![0.5; 8])]).unwrap();
    let name = b"compression\0compression\0";
    let at = rows.windows(name.len()).position(|bytes| bytes == name).unwrap() + name.len() + 4;
    // Deflated, one row per block. A row that would not shrink is stored unchanged.
    rows[at] = 2;
    rows.truncate(rows.len() - 20);
    rows.extend((zeros.len() as u32).to_le_bytes());
    rows.extend(&zeros);
    std::fs::write(folder.path().join("row.exr"), rows).unwrap();
    let words =
        |name: &'static str| ["render", "--scene", "sphere", "--size", "16", "--spp", "1", "--light", name];
    refused(folder.path(), &words("row.exr"), "cannot decode the OpenEXR file");
    // PNG data beyond the last row is not inflated.
    std::fs::write(folder.path().join("pixels.png"), png(8, 8, &chunk(b"IDAT", &zeros))).unwrap();
    let output = limited(folder.path(), &words("pixels.png"));
    assert!(output.status.success(), "{:?}: {}", output.status, String::from_utf8_lossy(&output.stderr));
}

/// Encodes the header and the required tables of a JPEG without pixels.
fn jpeg(width: u16, height: u16) -> Vec<u8> {
    let mut file = Image::from_fn(16, 16, |_, _| glam::Vec3::ONE).encode(Format::Jpeg).unwrap();
    let at =
        file.windows(2).position(|marker| marker[0] == 0xff && (0xc0..0xc3).contains(&marker[1])).unwrap();
    file[at + 5..at + 7].copy_from_slice(&height.to_be_bytes());
    file[at + 7..at + 9].copy_from_slice(&width.to_be_bytes());
    file
}

#[test]
fn texture_with_excessive_size_is_an_error() {
    let channels: Vec<_> = (0..64).map(|k| (format!("c{k}"), vec![0.5; 8])).collect();
    let named: Vec<_> = channels.iter().map(|(name, samples)| (name.as_str(), samples.clone())).collect();
    let good = exr(4, 2, named).unwrap();
    let claiming = |width: i32, height: i32| {
        let mut bytes = good.clone();
        for name in [&b"dataWindow\0box2i\0"[..], b"displayWindow\0box2i\0"] {
            let at = bytes.windows(name.len()).position(|w| w == name).unwrap() + name.len() + 12;
            bytes[at..at + 4].copy_from_slice(&(width - 1).to_le_bytes());
            bytes[at + 4..at + 8].copy_from_slice(&(height - 1).to_le_bytes());
        }
        bytes
    };
    light(&[
        ("terabytes.exr", claiming(i32::MAX, i32::MAX), "cannot"),
        ("gigabytes.exr", claiming(1 << 13, 1 << 13), "cannot hold the 8192 × 8192 pixels"),
        ("row.exr", claiming(1 << 26, 2), "cannot hold the 67108864 × 2 pixels"),
    ]);
}

#[test]
fn mesh_with_excessive_size_is_an_error() {
    let head = |vertices: u64, faces: u64, format: &str| {
        let xyz = "property float x\nproperty float y\nproperty float z";
        let list = "property list uint int vertex_indices";
        format!(
            "ply\nformat {format} 1.0\nelement vertex {vertices}\n{xyz}\nelement face {faces}\n{list}\nend_header\n"
        )
    };
    let list = [head(3, 1, "binary_little_endian").as_bytes(), &[0; 36], &[0xff; 4], &[1; 64]].concat();
    let mut star = String::from("f");
    let mut corners = String::new();
    for k in 0..100_000 {
        let (angle, r) = (f64::from(k) * 6.283e-5, f64::from(1 + k % 2));
        writeln!(corners, "v {} {} 0", r * angle.cos(), r * angle.sin()).unwrap();
        write!(star, " {}", k + 1).unwrap();
    }
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    mesh(&[
        (
            "vertices.ply",
            head(4_000_000_000, 1, "ascii").into(),
            "cannot hold the 4000000000 rows of `vertex`",
        ),
        ("faces.ply", head(0, u64::MAX / 2, "binary_big_endian").into(), "cannot hold the"),
        ("list.ply", list, "invalid PLY"),
        (
            "count.stl",
            [&[0; 80], &[0xff; 4][..], &[0; 50]].concat(),
            "header claims 4294967295 triangles, but 134 bytes hold 1",
        ),
        (
            "index.obj",
            format!("{triangle}f 1 2 9223372036854775807\n").into(),
            "does not exist (there are 3)",
        ),
        ("digits.obj", format!("{triangle}f 1 2 {}\n", "9".repeat(100_000)).into(), "invalid OBJ"),
        ("star.obj", format!("{corners}{star}\n").into(), "a concave polygon has too many corners"),
    ]);
}

/// Encodes a glTF with these nodes, the first of which is in the scene, and a mesh of one triangle.
fn gltf(nodes: &Value, change: impl FnOnce(&mut Value)) -> Vec<u8> {
    let mut file = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    });
    change(&mut file);
    file.to_string().into()
}

#[test]
fn gltf_with_cycles_or_external_buffers_is_an_error() {
    let one = json!([{"mesh": 0}]);
    let buffer = |uri: &'static str| gltf(&one, move |file| file["buffers"][0]["uri"] = uri.into());
    let deep: Vec<Value> = (0..100_000).map(|k| json!({"children": [k + 1]})).chain([json!({})]).collect();
    let primitive = json!({"attributes": {"POSITION": 0}, "indices": 1});
    let many = vec![primitive; 2000];
    let zeros = gltf(&one, |file| {
        file["meshes"][0]["primitives"] = many.into();
        file["accessors"] = json!([
            {"componentType": 5126, "count": 50_000_000, "type": "VEC3"},
            {"componentType": 5121, "count": 3, "type": "SCALAR"},
        ]);
    });
    let image = |file: &mut Value, uri: String| {
        file["materials"] = json!([{"emissiveTexture": {"index": 0}}]);
        file["textures"] = json!([{"source": 0}]);
        file["images"] = json!([{"uri": uri}]);
    };
    let escaped = |bytes: Vec<u8>| bytes.iter().map(|byte| format!("%{byte:02x}")).collect::<String>();
    let huge = format!("data:image/png,{}", escaped(png(16_384, 8192, &chunk(b"IDAT", &[]))));
    let elsewhere = "glTF buffers and images must be embedded or in the glTF's folder";
    mesh(&[
        (
            "circle.gltf",
            gltf(&json!([{"children": [1]}, {"children": [0]}]), |_| {}),
            "node 0 of the glTF is in the scene more than once",
        ),
        ("deep.gltf", gltf(&deep.into(), |_| {}), "the file has no triangles"),
        ("nested.gltf", [vec![b'['; 100_000], vec![b']'; 100_000]].concat(), "invalid glTF"),
        (
            "nested-nodes.gltf",
            format!(
                "{{\"asset\": {{\"version\": \"2.0\"}}, \"nodes\":{}{}}}",
                "[".repeat(100_000),
                "]".repeat(100_000)
            )
            .into(),
            "invalid glTF",
        ),
        ("up.gltf", buffer("../../../../../../etc/passwd"), elsewhere),
        ("below-and-up.gltf", buffer("a/../../secret"), elsewhere),
        ("hidden.gltf", buffer("%2e%2e/secret"), elsewhere),
        ("absolute.gltf", buffer("/etc/passwd"), elsewhere),
        ("file.gltf", buffer("file:///etc/passwd"), elsewhere),
        ("web.gltf", buffer("https://127.0.0.1/a.bin"), elsewhere),
        ("folder.gltf", buffer("."), "not a regular file"),
        (
            "claim.gltf",
            gltf(&one, |file| file["bufferViews"][0]["byteLength"] = json!(1_u64 << 62)),
            "within its buffer",
        ),
        (
            "items.gltf",
            gltf(&one, |file| file["accessors"][0]["count"] = json!(4_000_000_000_u64)),
            "within its buffer",
        ),
        ("zeros.gltf", zeros, "the mesh is too large"),
        ("image.gltf", gltf(&one, |file| image(file, "%2e%2e/secret.png".into())), elsewhere),
        ("huge-image.gltf", gltf(&one, |file| image(file, huge)), "cannot read image 0 of the glTF: "),
    ]);
}

#[test]
fn systems_and_devices_are_an_error() {
    let nested = format!("{{\"knots\":{}{}}}", "[".repeat(100_000), "]".repeat(100_000));
    all_refused(
        &["tables", "--out", "tables", "--fif"],
        &[
            ("nested.json", nested.into(), "recursion limit exceeded"),
            (
                "huge.json",
                br#"{"knots": [0, 1e999], "alpha": [0.5], "q": [[1]]}"#.into(),
                "system `huge.json`: ",
            ),
        ],
    );
    let folder = tempfile::tempdir().unwrap();
    for words in [
        ["render", "--scene", "sphere", "--light", "/dev/zero"],
        ["tables", "--out", "tables", "--fif", "/dev/zero"],
        ["tables", "--out", "tables", "--ndf", "/dev/zero"],
        ["tables", "--out", "tables", "--normal-map", "/dev/zero"],
    ] {
        refused(folder.path(), &words, "not a regular file");
    }
    // A named pipe without a writer would block forever.
    for name in
        ["pipe.png", "pipe.exr", "pipe.json", "pipe.obj", "pipe.ply", "pipe.stl", "pipe.gltf", "buffer"]
    {
        assert!(Command::new("mkfifo").arg(folder.path().join(name)).status().unwrap().success());
    }
    let beside = gltf(&json!([{"mesh": 0}]), |file| file["buffers"][0]["uri"] = "buffer".into());
    std::fs::write(folder.path().join("beside.gltf"), beside).unwrap();
    for words in [
        &["render", "--scene", "sphere", "--light", "pipe.exr"][..],
        &["render", "--mesh", "pipe.obj"],
        &["render", "--mesh", "pipe.ply"],
        &["render", "--mesh", "pipe.stl"],
        &["render", "--mesh", "pipe.gltf"],
        &["render", "--mesh", "beside.gltf"],
        &["tables", "--out", "tables", "--fif", "pipe.json"],
        &["tables", "--out", "tables", "--ndf", "pipe.png"],
        &["tables", "--out", "tables", "--normal-map", "pipe.png"],
        &["check-ndf", "--ndf", "pipe.png"],
        &["bake", "--ndf", "pipe.png"],
    ] {
        refused(folder.path(), words, "not a regular file");
    }
}

#[test]
fn filter_with_excessive_images_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let image = png(16_384, 8192, &chunk(b"IDAT", &[]));
    std::fs::write(folder.path().join("n.png"), image).unwrap();
    let model = json!({
        "asset": { "version": "2.0" },
        "images": [{ "uri": "n.png" }],
        "textures": [{ "source": 0 }],
        "materials": [{ "normalTexture": { "index": 0 } }],
    });
    std::fs::write(folder.path().join("a.gltf"), model.to_string()).unwrap();
    let said = "cannot read image 0 of the glTF: ";
    refused(folder.path(), &["filter", "a.gltf", "--out", "b.gltf"], said);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2, "a file was written");
}
