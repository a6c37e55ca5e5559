//! Filters small models: levels, references, errors.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::slice;

use ktx2::Reader;
use serde_json::json;

use super::*;
use crate::cli::filter::FilteredFormat;

/// Encodes an RGB image.
fn png(size: [u32; 2], texel: impl Fn(u32, u32) -> [u8; 3]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size[0], size[1]);
    encoder.set_color(png::ColorType::Rgb);
    let texels: Vec<u8> =
        (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))).flat_map(|(x, y)| texel(x, y)).collect();
    encoder.write_header().unwrap().write_image_data(&texels).unwrap();
    bytes
}

/// Encodes the normal of a slope along u.
fn normal(slope: f64) -> [u8; 3] {
    let length = slope.hypot(1.0);
    [slope / length, 0.0, 1.0 / length].map(|n| (127.5 + 127.5 * n).round() as u8)
}

/// Columns with slopes of ±0.4.
fn stripes() -> Vec<u8> {
    png([16, 16], |x, _| normal(if x % 2 == 0 { 0.4 } else { -0.4 }))
}

/// Encodes a container with these images, a line of JSON each for the other lists.
fn glb(images: &[Vec<u8>], rest: &str) -> Vec<u8> {
    let (mut bin, mut views) = (b"mesh".to_vec(), Vec::new());
    for image in images {
        views.push(json!({ "buffer": 0, "byteOffset": bin.len(), "byteLength": image.len() }));
        bin.extend(image);
    }
    let list: Vec<_> =
        (0..images.len()).map(|k| json!({ "mimeType": "image/png", "bufferView": k })).collect();
    let textures: Vec<_> = (0..images.len()).map(|k| json!({ "source": k })).collect();
    let mut json = format!(
        "{{\"asset\": {{\"version\":\"2.0\", \"x\":1.50e0}},\"buffers\":[{{\"byteLength\":{}}}],\"bufferViews\":{},\"images\":{},{}{rest}}}",
        bin.len(),
        json!(views),
        json!(list),
        if rest.contains("\"textures\"") {
            String::new()
        } else {
            format!("\"textures\":{},", json!(textures))
        },
    );
    json += &" ".repeat(json.len().next_multiple_of(4) - json.len());
    bin.resize(bin.len().next_multiple_of(4), 0);
    let word = |n: usize| (n as u32).to_le_bytes();
    let all = 28 + json.len() + bin.len();
    [
        b"glTF",
        &word(2)[..],
        &word(all),
        &word(json.len()),
        b"JSON",
        json.as_bytes(),
        &word(bin.len()),
        b"BIN\0",
        &bin,
    ]
    .concat()
}

fn options(model: &Path, out: &Path) -> Filter {
    Filter {
        model: model.into(),
        out: out.into(),
        format: FilteredFormat::Zstd,
        anisotropy: false,
        png: None,
        report: false,
    }
}

/// Filters a container, and returns the summary and the result.
fn filtered(bytes: &[u8], change: impl Fn(&mut Filter)) -> (Summary, Container) {
    let folder = tempfile::tempdir().unwrap();
    let [model, out] = ["in.glb", "out.glb"].map(|name| folder.path().join(name));
    fs::write(&model, bytes).unwrap();
    let mut wanted = options(&model, &out);
    change(&mut wanted);
    let summary = filter(&wanted, &AtomicBool::new(false)).unwrap();
    (summary, Container::open(&out).unwrap())
}

/// Returns the levels of an image: size and RGBA.
fn levels(gltf: &Container, image: usize) -> Vec<(usize, Vec<u8>)> {
    let file = gltf.image(image).unwrap();
    let reader = Reader::new(&file[..]).unwrap();
    let width = reader.header().pixel_width as usize;
    let level = |(k, level): (usize, ktx2::Level<'_>)| {
        let mut texels = Vec::new();
        let mut decoder = ruzstd::decoding::StreamingDecoder::new(level.data).unwrap();
        decoder.read_to_end(&mut texels).unwrap();
        assert_eq!(texels.len() as u64, level.uncompressed_byte_length);
        ((width >> k).max(1), texels)
    };
    reader.levels().enumerate().map(level).collect()
}

/// Returns the KTX2 image of a material's roughness, and its factor.
fn roughness(gltf: &Container, material: usize) -> (usize, f64) {
    let pbr = &gltf.list("materials")[material]["pbrMetallicRoughness"];
    let texture = pbr["metallicRoughnessTexture"]["index"].as_u64().unwrap() as usize;
    let image = gltf.list("textures")[texture].pointer("/extensions/KHR_texture_basisu/source");
    (image.unwrap().as_u64().unwrap() as usize, pbr["roughnessFactor"].as_f64().unwrap_or(1.0))
}

const SLOPED: &str =
    r#""materials":[{"normalTexture":{"index":0},"pbrMetallicRoughness":{"roughnessFactor":2e-1}}]"#;

#[test]
fn levels_have_the_variance_of_the_slopes() {
    let (summary, gltf) = filtered(&glb(&[stripes()], SLOPED), |_| {});
    let (image, factor) = roughness(&gltf, 0);
    let levels = levels(&gltf, image);
    assert_eq!(levels.len(), 5);
    for (k, (side, texels)) in levels.iter().enumerate() {
        assert_eq!(texels.len(), 4 * side * side);
        // Between ±0.4 the slopes are linear: their variance is 0.4²/3.
        let alpha2 = 0.2_f64.powi(4) + if k == 0 { 0.0 } else { 0.16 / 3.0 };
        for texel in texels.as_chunks::<4>().0 {
            let got = factor * f64::from(texel[1]) / 255.0;
            assert!((got - alpha2.powf(0.25)).abs() < 3e-3, "level {k}: {got}");
            assert_eq!([texel[0], texel[2], texel[3]], [255; 3]);
        }
    }
    let done = summary.materials[0].outcome.as_ref().unwrap();
    assert!((done[4].after - 0.4841).abs() < 2e-3 && (done[4].before - 0.2).abs() < 1e-6, "{done:?}");
    // The fallback shows the first level.
    let texture = &gltf.list("textures")[1];
    let fallback = gltf.image(texture["source"].as_u64().unwrap() as usize).unwrap();
    assert!(fallback.starts_with(b"\x89PNG"));
    assert_eq!(gltf.list("extensionsUsed"), ["KHR_texture_basisu"]);
    assert!(gltf.list("extensionsRequired").is_empty());
}

#[test]
fn few_steep_texels_leave_the_highlight() {
    // One steep texel in 49, to either side.
    let steep = |x: u32, y: u32| match (x % 7, y % 7) {
        (3, 3) if (x / 7 + y / 7).is_multiple_of(2) => 0.8,
        (3, 3) => -0.8,
        _ => 0.0,
    };
    let map = png([128, 128], |x, y| normal(steep(x, y)));
    let (summary, gltf) = filtered(&glb(&[map], SLOPED), |wanted| wanted.report = true);
    // With all of the variance it is 0.64.
    let [_, error] = summary.materials[0].error.unwrap();
    assert!(error < 0.15, "{error}");
    // The square of a bilinear texel integrates to 2/3 along each axis.
    let (image, factor) = roughness(&gltf, 0);
    let all = (0.0016_f64 + 0.64 * 4.0 / 9.0 / 49.0).powf(0.25);
    for (side, texels) in &levels(&gltf, image)[5..] {
        for texel in texels.as_chunks::<4>().0 {
            let got = factor * f64::from(texel[1]) / 255.0;
            assert!(got > 0.2 && got < 0.25 && got < 0.9 * all, "{side}: {got} {all}");
        }
    }
}

#[test]
fn other_bytes_are_unchanged() {
    let rest = r#""extras":{"b":[1.0e3 , 2],"a":"é"}, "materials":[ {"extras":{"z":1,"a":0.10},"normalTexture" : {"index":0}, "doubleSided":true, "pbrMetallicRoughness":{"roughnessFactor":2e-1, "metallicFactor":0}} ]"#;
    let bytes = glb(&[stripes()], rest);
    let before = Container::parse(bytes.clone(), "".into()).unwrap();
    let (_, after) = filtered(&bytes, |_| {});
    for kept in [
        r#"{"version":"2.0", "x":1.50e0}"#,
        r#""extras":{"b":[1.0e3 , 2],"a":"é"}, "materials":[ {"extras":{"z":1,"a":0.10},"normalTexture" : {"index":0}, "doubleSided":true, "#,
        r#", "metallicFactor":0,"metallicRoughnessTexture":{"index":1}}} ]"#,
    ] {
        assert!(after.json().contains(kept), "{kept} in {}", after.json());
    }
    for name in ["buffers", "asset", "images"] {
        assert!(before.json().find(name) <= after.json().find(name));
    }
    assert_eq!(before.image(0).unwrap(), after.image(0).unwrap());
    let length = before.bin_len().unwrap();
    assert!(after.bin_len().unwrap() > length);
}

#[test]
fn shared_images_become_one_texture_for_each_normal_map() {
    let orm = png([16, 16], |x, y| [(16 * x) as u8, 60, (16 * y) as u8]);
    let flat = png([4, 4], |_, _| [128, 128, 255]);
    let steep = png([16, 16], |_, y| normal(if y % 4 < 2 { 0.2 } else { -0.2 }));
    let material = |normal: usize| {
        json!({
            "normalTexture": { "index": normal },
            "occlusionTexture": { "index": 0, "strength": 0.5 },
            "pbrMetallicRoughness": { "metallicRoughnessTexture": { "index": 0 } }
        })
    };
    let rest = format!("\"materials\":{}", json!([material(1), material(2), material(1), material(3), {}]));
    let (summary, gltf) = filtered(&glb(&[orm, stripes(), steep, flat], &rest), |_| {});
    let texture = |k: usize, pointer| gltf.list("materials")[k].pointer(pointer).unwrap().as_u64().unwrap();
    let rough = |k| texture(k, "/pbrMetallicRoughness/metallicRoughnessTexture/index");
    assert_eq!([rough(0), rough(1), rough(2), rough(3)], [4, 5, 4, 0]);
    assert_eq!([0, 1, 2, 3].map(|k| texture(k, "/occlusionTexture/index")), [4, 5, 4, 0]);
    assert_eq!(summary.materials.len(), 4);
    assert!(summary.materials[3].outcome.as_ref().unwrap_err().contains("flat"));
    // Occlusion and metallic are plain means.
    let (image, factor) = roughness(&gltf, 0);
    assert_eq!(factor, 1.0);
    let all = levels(&gltf, image);
    let mean = |channel: usize| {
        let sum: u32 = (0..256).map(|k| u32::from(all[0].1[4 * k + channel])).sum();
        (f64::from(sum) / 256.0).round() as u8
    };
    assert_eq!([all[4].1[0], all[4].1[2]], [mean(0), mean(2)]);
    assert!(all[0].1.as_chunks::<4>().0.iter().all(|texel| texel[1] == 60));
    // The original image is the fallback.
    assert_eq!(gltf.list("textures")[4]["source"], 0);
}

#[test]
fn transforms_and_wrap_modes() {
    let orm = png([8, 8], |x, _| [255, 30 + (x * 4) as u8, 255]);
    let material = |normal: &str, rough: &str| {
        let place = |scale: &str| format!(r#""extensions":{{"KHR_texture_transform":{{"scale":{scale}}}}}"#);
        format!(
            r#""materials":[{{"normalTexture":{{"index":0,{}}},"pbrMetallicRoughness":{{"metallicRoughnessTexture":{{"index":1,{}}}}}}}]"#,
            place(normal),
            place(rough)
        )
    };
    let size = |normal, rough| {
        let (summary, gltf) = filtered(&glb(&[stripes(), orm.clone()], &material(normal, rough)), |_| {});
        let texture = gltf.list("materials")[0]
            .pointer("/pbrMetallicRoughness/metallicRoughnessTexture")
            .unwrap()
            .clone();
        summary.materials[0].outcome.clone().map(|levels| {
            let alpha2 = levels.last().unwrap().after.powi(4);
            // The mean of (30 + 4 x)⁴ and the variance of the slopes, at every scale.
            let exact =
                (0..8).map(|x| (f64::from(30 + 4 * x) / 255.0).powi(4)).sum::<f64>() / 8.0 + 0.16 / 3.0;
            assert!((alpha2 / exact - 1.0).abs() < 0.02, "{alpha2} {exact}");
            (
                [levels[0].width, levels[0].height],
                texture.pointer("/extensions/KHR_texture_transform/scale").cloned(),
            )
        })
    };
    assert_eq!(size("[1,1]", "[1,1]").unwrap(), ([16, 16], Some(json!([1, 1]))));
    assert_eq!(size("[4,2]", "[2,1]").unwrap(), ([32, 32], Some(json!([2, 1]))));
    // The roughness repeats within the normal map, whose place the new texture has.
    assert_eq!(size("[1,1]", "[4,1]").unwrap(), ([32, 16], Some(json!([1, 1]))));
    assert!(size("[1,1]", "[1.5,1]").unwrap_err().contains("common period"));
    // Slopes that change at the border of the map.
    let ramp = png([8, 8], |x, _| normal(0.1 * f64::from(x)));
    let edge = |wrap: u32| {
        let rest = format!(
            r#""samplers":[{{"wrapS":{wrap},"wrapT":{wrap},"minFilter":9729}}],"textures":[{{"source":0,"sampler":0}}],{SLOPED}"#
        );
        let (_, gltf) = filtered(&glb(slice::from_ref(&ramp), &rest), |_| {});
        // The copy has mip levels, the original none.
        let [plain, copy] = [0, 1].map(|k| gltf.list("samplers")[k].clone());
        assert_eq!(
            (&plain["minFilter"], &copy["minFilter"], &copy["wrapS"]),
            (&json!(9729), &json!(9987), &json!(wrap))
        );
        assert_eq!(gltf.list("textures")[1]["sampler"], 1);
        let (image, factor) = roughness(&gltf, 0);
        let row = levels(&gltf, image)[1]
            .1
            .as_chunks::<4>()
            .0
            .iter()
            .take(4)
            .map(|t| (factor * f64::from(t[1])) as u32)
            .collect::<Vec<_>>();
        (row[0], row[1])
    };
    for wrap in [33_071, 33_648] {
        let (outer, inner) = edge(wrap);
        assert!(outer <= inner, "{wrap}: {outer} {inner}");
    }
    let (outer, inner) = edge(10_497);
    assert!(outer > inner + 4, "{outer} {inner}");
}

#[test]
fn anisotropy_is_along_the_slopes() {
    let (_, gltf) = filtered(&glb(&[stripes()], SLOPED), |wanted| wanted.anisotropy = true);
    let value = gltf.list("materials")[0].pointer("/extensions/KHR_materials_anisotropy").unwrap();
    let texture = value["anisotropyTexture"]["index"].as_u64().unwrap() as usize;
    let image = gltf.list("textures")[texture].pointer("/extensions/KHR_texture_basisu/source");
    let all = levels(&gltf, image.unwrap().as_u64().unwrap() as usize);
    let [x, y, strength, _] = <[u8; 4]>::try_from(&all[2].1[..4]).unwrap();
    assert_eq!((x, y.abs_diff(128) <= 1, all[0].1[2]), (255, true, 0));
    // α_t = α + (1 − α) strength², along u, where the variance is 0.4²/3 and not half of it.
    let alpha = 0.04 + 0.96 * (f64::from(strength) / 255.0).powi(2);
    assert!((alpha * alpha - 0.0016 - 0.32 / 3.0).abs() < 3e-3, "{alpha}");
    let (image, factor) = roughness(&gltf, 0);
    let across = factor * f64::from(levels(&gltf, image)[2].1[1]) / 255.0;
    assert!((across - 0.2).abs() < 3e-3, "{across}");
}

#[test]
fn directions_of_neighbors_do_not_cancel() {
    // Steep along v, with a little noise along u, so that the axis is to both sides of v.
    let texel = |x: u32, y: u32| {
        let noise = f64::from((x * 7_919 + y * 104_729 + x * y * 31) % 97) / 96.0 - 0.5;
        let slopes = [0.4 * noise, if (x / 3 + y).is_multiple_of(2) { 0.7 } else { -0.7 }];
        let up = 1.0 / (1.0 + slopes[0] * slopes[0] + slopes[1] * slopes[1]).sqrt();
        let code = |n: f64| (127.5 + 127.5 * n).round() as u8;
        [code(-slopes[0] * up), code(-slopes[1] * up), code(up)]
    };
    let (_, gltf) = filtered(&glb(&[png([64, 64], texel)], SLOPED), |wanted| wanted.anisotropy = true);
    let value = gltf.list("materials")[0].pointer("/extensions/KHR_materials_anisotropy").unwrap();
    let texture = value["anisotropyTexture"]["index"].as_u64().unwrap() as usize;
    let image = gltf.list("textures")[texture].pointer("/extensions/KHR_texture_basisu/source");
    let all = levels(&gltf, image.unwrap().as_u64().unwrap() as usize);
    let up = all[0].1[1] > 127;
    for (side, texels) in &all {
        assert!(
            texels.chunks(4).all(|texel| (texel[1] > 127) == up && texel[1].abs_diff(127) > 80),
            "{side}"
        );
    }
}

#[test]
fn files_without_normal_maps_are_copied() {
    let bytes = glb(&[stripes()], r#""materials":[{"name":"plain"}]"#);
    let (summary, gltf) = filtered(&bytes, |_| {});
    assert_eq!(gltf.bytes(), bytes);
    assert!(summary.lines(true)[0].contains("no material has a normal map"));
}

#[test]
fn references_of_a_moved_gltf_are_copied() {
    let folder = tempfile::tempdir().unwrap();
    let [model, out] = ["a.gltf", "b/c d.gltf"].map(|name| folder.path().join(name));
    fs::create_dir(folder.path().join("maps")).unwrap();
    fs::write(folder.path().join("maps/n 1.png"), stripes()).unwrap();
    let json = format!(
        "\u{feff}{{\"asset\":{{\"version\":\"2.0\"}},\"images\":[{{\"uri\":\"maps/n%201.png\"}}],\"textures\":[{{\"source\":0}}],{SLOPED}}}\n"
    );
    fs::write(&model, json).unwrap();
    let summary = filter(&options(&model, &out), &AtomicBool::new(false)).unwrap();
    assert_eq!(summary.files.len(), 4);
    assert_eq!(fs::read(folder.path().join("b/maps/n 1.png")).unwrap(), stripes());
    let gltf = Container::open(&out).unwrap();
    let (image, _) = roughness(&gltf, 0);
    assert_eq!(levels(&gltf, image).len(), 5);
    assert!(gltf.bytes().starts_with("\u{feff}".as_bytes()) && gltf.bytes().ends_with(b"\n"));
}

#[test]
fn files_of_others_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("out")).unwrap();
    fs::write(path("m_roughness_0.png"), stripes()).unwrap();
    let json = format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"images\":[{{\"uri\":\"m_roughness_0.png\"}}],\"textures\":[{{\"source\":0}}],{SLOPED}}}"
    );
    fs::write(path("m.gltf"), &json).unwrap();
    let run = |out: &str, change: &dyn Fn(&mut Filter)| {
        let mut wanted = options(&path("m.gltf"), &path(out));
        change(&mut wanted);
        filter(&wanted, &AtomicBool::new(false)).map_err(|error| error.to_string())
    };
    let files = |name: &str| {
        let entries = fs::read_dir(path(name)).unwrap().map(|entry| entry.unwrap().file_name());
        entries.collect::<std::collections::BTreeSet<_>>()
    };
    // A copy that would replace another file, a level that would, and a model that cannot be written.
    fs::write(path("out/m_roughness_0.png"), b"other").unwrap();
    fs::write(path("material0_roughness_0.png"), b"other").unwrap();
    fs::create_dir(path("full")).unwrap();
    fs::create_dir(path("full/m_roughness_1.ktx2")).unwrap();
    let before = [files(""), files("out"), files("full")];
    let refused = run("out/m.gltf", &|_| {}).unwrap_err();
    assert!(refused.contains("m_roughness_0.png` exists with other contents"), "{refused}");
    let refused = run("n.gltf", &|wanted| wanted.png = Some(path(""))).unwrap_err();
    assert!(refused.contains("material0_roughness_0.png` exists"), "{refused}");
    assert_eq!([files(""), files("out"), files("full")], before);
    // New textures take other names.
    run("m.gltf", &|_| {}).unwrap();
    assert_eq!(fs::read(path("m_roughness_0.png")).unwrap(), stripes());
    assert_eq!(levels(&Container::open(&path("m.gltf")).unwrap(), 2).len(), 5);
}

#[test]
fn maps_in_unknown_formats_are_left() {
    let materials = r#""materials":[{"normalTexture":{"index":0},"pbrMetallicRoughness":{"roughnessFactor":0.3}},
        {"normalTexture":{"index":1}}],
        "textures":[{"source":0},{"extensions":{"MSFT_texture_dds":{"source":0}}}],"extra":0"#;
    let (summary, _) = filtered(&glb(&[stripes()], materials), |_| {});
    assert!(summary.materials[0].outcome.is_ok());
    let left = summary.materials[1].outcome.as_ref().unwrap_err();
    assert_eq!(left, "its normal map has no image in a known format");
}

#[test]
fn null_is_a_missing_member() {
    let nulls = r#""extensionsUsed":null,"materials":[{"normalTexture":{"index":0},"extensions":null,
        "pbrMetallicRoughness":null}]"#;
    let (summary, gltf) = filtered(&glb(&[stripes()], nulls), |wanted| wanted.anisotropy = true);
    // Its roughness is 1.
    assert!(summary.materials[0].outcome.is_err());
    let rough = nulls.replace("null}", r#"{"roughnessFactor":0.2,"metallicRoughnessTexture":null}}"#);
    let (summary, changed) = filtered(&glb(&[stripes()], &rough), |wanted| wanted.anisotropy = true);
    assert!(summary.materials[0].outcome.is_ok());
    let used = ["KHR_texture_basisu", "KHR_materials_anisotropy"];
    assert!(used.iter().all(|name| changed.list("extensionsUsed").iter().any(|used| used == name)));
    assert!(changed.list("materials")[0]["extensions"]["KHR_materials_anisotropy"].is_object());
    assert_eq!(gltf.list("extensionsUsed").len(), 0);
}

/// A file of more texels is filtered in part.
#[test]
fn materials_beyond_the_largest_size_are_left() {
    let bytes = glb(&[stripes()], SLOPED);
    let folder = tempfile::tempdir().unwrap();
    let gltf = Container::parse(bytes, folder.path().into()).unwrap();
    let wanted = options(&folder.path().join("in.glb"), &folder.path().join("out.glb"));
    let (mut edits, mut files) = (Edits::new(&gltf), Files::new(&wanted).unwrap());
    let mut materials = Materials::new(&gltf, &wanted);
    materials.texels = material::MOST_TEXELS - 255;
    let filtered = materials.filter(0, &mut edits, &mut files, &AtomicBool::new(false)).unwrap().unwrap();
    assert_eq!(filtered.outcome.unwrap_err(), "the file would have more than 1073741824 new texels");
}

#[test]
fn png_lists_every_level() {
    let folder = tempfile::tempdir().unwrap();
    let png = folder.path().join("levels");
    filtered(&glb(&[stripes()], SLOPED), |wanted| wanted.png = Some(png.clone()));
    let list: serde_json::Value =
        serde_json::from_slice(&fs::read(png.join("levels.json")).unwrap()).unwrap();
    let names = list[0]["levels"].as_array().unwrap();
    assert_eq!(names.len(), 5);
    for name in names {
        assert!(fs::read(png.join(name.as_str().unwrap())).unwrap().starts_with(b"\x89PNG"));
    }
}

#[test]
fn report_has_the_error_of_the_highlight() {
    // Slopes of one Gaussian, which one lobe fits.
    let gaussian = |x: u32, y: u32| {
        let hash = |k: u32| {
            let mixed = (x * 7919 + y * 104_729 + k * 31).wrapping_mul(2_654_435_761);
            f64::from(mixed >> 8) / f64::from(1 << 24)
        };
        let [a, b] = [hash(1).max(1e-3), hash(2)];
        normal(0.1 * (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos())
    };
    let map = png([32, 32], gaussian);
    let (summary, _) = filtered(&glb(&[map], SLOPED), |wanted| wanted.report = true);
    let [before, after] = summary.materials[0].error.unwrap();
    assert!(after < 0.5 * before, "{before} {after}");
    assert!(summary.lines(true).iter().any(|line| line.contains("error of the highlight")));
    // Slopes that depend on one axis, which needs a lobe of two widths.
    let columns = png([32, 32], |x, _| gaussian(x, 0));
    let error = |anisotropy| {
        let (summary, _) = filtered(&glb(slice::from_ref(&columns), SLOPED), |wanted| {
            (wanted.report, wanted.anisotropy) = (true, anisotropy);
        });
        summary.materials[0].error.unwrap()[1]
    };
    assert!(error(true) < 0.85 * error(false), "{} {}", error(true), error(false));
}

/// Asserts that a file is refused in one line, and that nothing is written.
fn refused(name: &str, bytes: &[u8], said: &str) {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join(name);
    fs::write(&model, bytes).unwrap();
    let mut wanted = options(&model, &folder.path().join(format!("out-{name}")));
    wanted.png = Some(folder.path().join("levels"));
    let error = filter(&wanted, &AtomicBool::new(false)).unwrap_err().to_string();
    assert!(error.contains(said) && error.lines().count() == 1, "{name}: {error}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "{name}: a file was written");
}

#[test]
fn cut_files_leave_no_file() {
    let bytes = glb(&[stripes()], SLOPED);
    for length in (0..bytes.len()).step_by(13) {
        refused("cut.glb", &bytes[..length], "");
    }
    // An image that is cut within an intact file.
    let cut = stripes();
    refused("image.glb", &glb(&[cut[..cut.len() / 2].to_vec()], SLOPED), "cannot read image 0 of the glTF");
}

#[test]
fn wrong_references_leave_no_file() {
    let sloped = |from: &str, to: &str| glb(&[stripes()], &SLOPED.replace(from, to));
    refused("texture.glb", &sloped("\"index\":0", "\"index\":7"), "the glTF has no item 7 in `textures`");
    refused("index.glb", &sloped("\"index\":0", "\"index\":-1"), "`index` must be a non-negative integer");
    refused("factor.glb", &sloped("2e-1", "\"rough\""), "invalid `roughnessFactor`");
    let text = |rest: &str| format!("{{\"asset\":{{\"version\":\"2.0\"}},{rest}}}").into_bytes();
    let image = |image: &str| text(&format!("\"images\":[{image}],\"textures\":[{{\"source\":0}}],{SLOPED}"));
    refused("up.gltf", &image(r#"{"uri":"../n.png"}"#), "must be embedded or in the glTF's folder");
    refused("missing.gltf", &image(r#"{"uri":"n.png"}"#), "cannot read the glTF's image `n.png`");
    refused("none.gltf", &image("{}"), "image 0 has no data");
    refused("data.gltf", &image(r#"{"uri":"data:image/png;base64,AAAA"}"#), "cannot read image 0");
    let beyond = r#"{"bufferView":0}],"buffers":[{"byteLength":9,"uri":"data:,ab"}],"bufferViews":[{"buffer":0,"byteLength":9}"#;
    refused("view.gltf", &image(beyond), "buffer view 0 extends beyond its buffer");
    refused("circle.gltf", &text(r#""nodes":[{"children":[1]},{"children":[0]}]"#), "node 0 contains itself");
    refused(
        "twice.gltf",
        &text(r#""nodes":[{"children":[2]},{"children":[2]},{}]"#),
        "node 2 has several parents",
    );
    refused("child.gltf", &text(r#""nodes":[{"children":[5]}]"#), "a child that does not exist");
    refused("deep.gltf", &[b"{\"a\":".to_vec(), vec![b'['; 100_000]].concat(), "invalid glTF");
    refused("old.gltf", b"{\"asset\":{\"version\":\"1.0\"}}", "glTF 2.0");
}

#[test]
fn interrupted_run_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let [model, out] = ["in.glb", "out.glb"].map(|name| folder.path().join(name));
    fs::write(&model, glb(&[stripes()], SLOPED)).unwrap();
    let interrupted = AtomicBool::new(true);
    let error = filter(&options(&model, &out), &interrupted).unwrap_err();
    assert!(error.is::<Interrupted>() && !out.exists());
    // Where nothing can be written, nothing is computed.
    let error = filter(&options(&model, &model.join("out.glb")), &interrupted).unwrap_err();
    assert!(error.to_string().starts_with("cannot write "), "{error}");
}
