//! Whole bakes of small sets: bytes, seams, levels compared with references, interruption.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use clap::Parser;
use glam::Vec3;
use serde_json::Value;

use super::*;
use crate::bake::maps::Plane;
use crate::bake::source::Source;
use crate::bake::texel::Texel;
use crate::cli::{Cli, Command};

static GO: AtomicBool = AtomicBool::new(false);

fn planned(line: &str) -> Result<Plan> {
    let cli = Cli::try_parse_from(["asperity", "bake"].into_iter().chain(line.split_whitespace())).unwrap();
    let Command::Bake(wanted) = cli.command else { panic!("not a bake command") };
    options::plan(&wanted, options::parts(&wanted)?[0])
}

/// Returns the files of a set, without its tiles.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries
        .filter(|path| path.is_file())
        .map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), fs::read(&path).unwrap()))
        .filter(|(name, _)| !name.starts_with(".tiles-"))
        .collect()
}

/// Bakes what is missing, writes the set, and returns the fraction that was missing.
fn whole(plan: &Plan, output: &Output, flag: &AtomicBool) -> Result<f64> {
    let scratch = Scratch::new(plan, output, b"program")?;
    let fresh = fill(plan, &scratch, plan.some(None)?, flag)?;
    write(plan, scratch, output, &ALL, flag).map(|()| fresh)
}

fn baked(line: &str, folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let output = Output::new(folder).unwrap();
    whole(&planned(line).unwrap(), &output, &GO).unwrap();
    files(folder)
}

const ALL: [BakedFormat; 3] = [BakedFormat::Png, BakedFormat::Exr, BakedFormat::Ktx2];

/// Decodes a PNG to its size, channel count and texels.
fn png(bytes: &[u8]) -> (usize, usize, Vec<u16>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut data = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut data).unwrap();
    assert_eq!(info.bit_depth, png::BitDepth::Sixteen);
    let texels = data.chunks_exact(2).map(|b| u16::from_be_bytes([b[0], b[1]])).collect();
    (info.width as usize, info.color_type.samples(), texels)
}

const SMALL: &str =
    "--size 128 --noise perlin --cells 4 --octaves 3 --height 0.02 --low-tint 204060 --tileable";

#[test]
fn bake_is_independent_of_tiles_and_threads() {
    let scratch = tempfile::tempdir().unwrap();
    let whole = baked(&format!("{SMALL} --tile 128"), &scratch.path().join("whole"));
    let tiles = baked(&format!("{SMALL} --tile 64"), &scratch.path().join("tiles"));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    let threads = pool.install(|| baked(&format!("{SMALL} --tile 64"), &scratch.path().join("threads")));
    assert!(whole.len() >= 10, "{:?}", whole.keys());
    for (name, bytes) in &whole {
        assert!(tiles[name] == *bytes && threads[name] == *bytes, "{name} differs");
    }
    assert_eq!(whole.len(), tiles.len());
    // Nothing else remains.
    assert_eq!(fs::read_dir(scratch.path().join("tiles")).unwrap().count(), tiles.len());
}

#[test]
fn bake_resumes_to_the_same_bytes() {
    let scratch = tempfile::tempdir().unwrap();
    let line = format!("{SMALL} --tile 64");
    let expected = baked(&line, &scratch.path().join("whole"));
    let (plan, output) = (planned(&line).unwrap(), Output::new(scratch.path().join("stopped")).unwrap());
    let tiles = Scratch::new(&plan, &output, b"program").unwrap();
    assert_eq!(tiles.missing([1, 4]).len(), 4);
    // Like the tasks of a job: the second and the third tile.
    assert_eq!(fill(&plan, &tiles, [2, 3], &GO).unwrap(), 1.0);
    assert_eq!(fill(&plan, &tiles, [3, 3], &GO).unwrap(), 0.0);
    let stopped = whole(&plan, &output, &AtomicBool::new(true)).unwrap_err().to_string();
    assert_eq!(stopped, "interrupted: 2 of 4 tiles are done (run the same command to resume)");
    assert!(files(&scratch.path().join("stopped")).is_empty(), "a file of an unfinished set");
    // A truncated tile is baked again.
    let cut = output.path(&format!(".tiles-{}", plan.key(b"program"))).join("1-0.tile");
    let bytes = fs::read(&cut).unwrap();
    fs::write(&cut, &bytes[..bytes.len() / 2]).unwrap();
    assert_eq!(tiles.missing([1, 4]), [[0, 0], [1, 0], [1, 1]]);
    assert_eq!(whole(&plan, &output, &GO).unwrap(), 0.75);
    assert!(files(&scratch.path().join("stopped")) == expected);
    // The last run that uses the tiles removes them.
    assert!(cut.exists());
    tiles.remove();
    assert!(!cut.exists());
    // Leftover tiles are listed.
    let left = Scratch::new(&plan, &output, b"older").unwrap();
    fill(&plan, &left, [1, 1], &GO).unwrap();
    let own = Scratch::new(&plan, &output, b"program").unwrap();
    let said = own.others(&output).unwrap();
    own.remove();
    assert!(
        said.starts_with("found 0.1 MB of unfinished tiles from other bakes") && said.contains("/.tiles-"),
        "{said}"
    );
    assert_eq!((said.lines().count(), left.others(&output)), (1, None));
    left.remove();
    // Other parameters or another program use different tiles.
    let other = planned(&line.replace("0.02", "0.03")).unwrap();
    assert!(other.key(b"program") != plan.key(b"program") && plan.key(b"newer") != plan.key(b"program"));
}

#[test]
fn parts_equal_the_whole_texture() {
    let scratch = tempfile::tempdir().unwrap();
    for (k, all) in [SMALL.replace(" --tileable", ""), SMALL.to_owned()].iter().enumerate() {
        let folder = scratch.path().join(k.to_string());
        // The same distance in texels.
        let together = baked(&format!("{all} --occlusion 0.0625"), &folder.join("together"));
        let record = |set: &BTreeMap<String, Vec<u8>>| -> Value {
            serde_json::from_slice(&set["provenance.json"]).unwrap()
        };
        let line = all.replace("--size 128", "--size 64 --parts 2 --occlusion 0.125");
        for number in 1..=4_u32 {
            let cli =
                Cli::try_parse_from(["asperity", "bake"].into_iter().chain(line.split_whitespace())).unwrap();
            let Command::Bake(wanted) = cli.command else { panic!("not a bake command") };
            let plan = options::plan(&wanted, number).unwrap();
            let [column, row] = [(number - 1) % 2, (number - 1) / 2].map(|k| k as usize);
            assert_eq!(plan.part.folder().unwrap(), format!("u{}_v{}", column + 1, 2 - row));
            let folder = folder.join(number.to_string());
            whole(&plan, &Output::new(&folder).unwrap(), &GO).unwrap();
            let set = files(&folder);
            for map in ["base_color", "normal_opengl", "roughness", "ambient_occlusion"] {
                let file = format!("{map}.png");
                let ((side, channels, part), (_, _, of)) = (png(&set[&file]), png(&together[&file]));
                let width = side * channels;
                for (k, texels) in part.chunks_exact(width).enumerate() {
                    let at = (row * side + k) * 2 * width + column * width;
                    assert!(texels == &of[at..at + width], "{map}, part {number}, row {k}");
                }
            }
            // Heights of all parts are scaled to one range that contains them all.
            let range = |of: &Value| [0, 1].map(|end| of["height_range_in_sides"][end].as_f64().unwrap());
            let ([low, high], [lowest, highest]) = (range(&record(&set)), range(&record(&together)));
            assert!(low == -high && low < lowest && highest < high, "{low} to {high}");
        }
    }
    for (line, said) in [
        ("--fractal periodic --parts 2", "`--parts`: not supported for this surface, "),
        (
            "--size 65536 --parts 32",
            "`--parts`: 32 × 65536 texels along a side are too many (at most 1048576)",
        ),
        ("--size 64 --parts 3 --part 9-10", "part 10 is out of range (expected 1 to 9)"),
    ] {
        let error = planned(line).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(error.starts_with(said) && error.lines().count() == 1, "{line}: {error}");
    }
}

#[test]
fn tileable_edges_match() {
    for line in [
        SMALL,
        "--size 64 --noise gaussian --tileable",
        "--size 64 --noise value --tileable --cells 5",
        "--size 64 --noise sparse --tileable --octaves 2",
        "--size 64 --noise cellular --tileable --octaves 1",
        "--size 64 --noise simplex --tileable --cells 6 --octaves 3",
        "--size 64 --fractal periodic --tileable --cells 4",
        "--size 64 --ndf ggx:0.2,0.4 --tileable",
    ] {
        let plan = planned(line).unwrap();
        assert_eq!(plan.seam(), [0.0; 2], "{line}");
        // Texels beyond the edge, which horizons sample, equal the texels of the opposite side bit
        // for bit.
        let around = tile::surroundings(&plan, [0, 0]);
        let (size, before) = (plan.size as usize, around.margin.min(plan.size as usize));
        for row in around.heights.chunks_exact(around.side) {
            assert_eq!(row[..before], row[size..size + before], "{line}");
        }
        // Occlusion at an edge includes the surface beyond it: compare with a shifted surface.
        let mut here = vec![Texel::default(); 8];
        plan.source.texels(&plan.row(3, 0), &mut here);
        let mut there = here.clone();
        plan.source.texels(&plan.row(3, i64::from(plan.size)), &mut there);
        for (here, there) in here.iter().zip(&there) {
            assert!(
                (here.height - there.height).abs() < 1e-5
                    && here.slopes.mean.distance(there.slopes.mean) < 2e-2
            );
        }
    }
    let seam = planned(&SMALL.replace("--tileable", "")).unwrap().seam();
    assert!(seam[0] > 1e-3 && seam[1] > 1e-2, "{seam:?}");
}

/// Returns mean slopes and variance in a square of texels, from `side`² samples.
fn reference(source: &dyn Source, plan: &Plan, level: u32, at: [i64; 2], side: u32) -> (glam::Vec2, f32) {
    let texel = f64::from(1 << level) / f64::from(plan.size);
    let (mut mean, mut square) = (glam::DVec2::ZERO, 0.0);
    for k in 0..side * side {
        let [x, y] = [k % side, k / side].map(|i| (f64::from(i) + 0.5) / f64::from(side));
        let p = [(at[0] as f64 + x) * texel, 1.0 - (at[1] as f64 + y) * texel];
        let slope = source.point(p).slopes.mean.as_dvec2();
        mean += slope / f64::from(side * side);
        square += slope.length_squared() / f64::from(side * side);
    }
    (mean.as_vec2(), (square - mean.length_squared()) as f32)
}

#[test]
fn roughness_of_every_level_matches_a_thousand_samples() {
    let plan =
        planned("--size 256 --tile 256 --noise gaussian --cells 4 --octaves 3 --height 0.03 --roughness 0.3")
            .unwrap();
    let side = 256;
    let mut texels = vec![Texel::default(); side * side];
    for (k, row) in texels.chunks_mut(side).enumerate() {
        plan.source.texels(&plan.row(k as i64, 0), row);
    }
    let mut worst = 0.0_f32;
    for level in 1..=8_u32 {
        let (before, width) = (side >> (level - 1), side >> level);
        texels = texel::halved(&texels, before);
        let steps = width.min(8);
        for k in 0..steps * steps {
            let at = [k % steps, k / steps].map(|i| i * width / steps);
            let texel = texels[at[1] * width + at[0]];
            let (mean, variance) = reference(plan.source.as_ref(), &plan, level, at.map(|i| i as i64), 32);
            let (normal, alpha2) = plan.source.shown(&texel);
            let expected = (0.3_f32.powi(4) + variance).sqrt().sqrt();
            worst = worst.max((alpha2.sqrt().sqrt() / expected - 1.0).abs());
            let flat = Vec3::new(mean.x, mean.y, 1.0).normalize();
            assert!(normal.distance(flat) < 4e-3, "level {level}, {at:?}: {normal} and {flat}");
        }
    }
    assert!(worst < 0.01, "{worst}");
}

#[test]
fn density_at_top_level_has_its_roughness() {
    for (spec, alpha) in [("ggx:0.3", 0.3), ("ggx:0.1,0.4", (0.5_f32 * (0.01 + 0.16)).sqrt())] {
        let plan = planned(&format!("--size 64 --ndf {spec} --cells 64 --tileable")).unwrap();
        let mut row = vec![Texel::default(); 64];
        plan.source.texels(&plan.row(5, 0), &mut row);
        let all = Texel::mixed(row.iter().map(|texel| (1.0 / 64.0, *texel)));
        let (normal, alpha2) = plan.source.shown(&all);
        // A row of 64 cells has a sample mean and variance.
        assert!((alpha2.sqrt() / alpha - 1.0).abs() < 0.1, "{spec}: {} and {alpha}", alpha2.sqrt());
        assert!(normal.z > 0.99, "{normal}");
    }
}

#[test]
fn maps_match_the_surface() {
    let scratch = tempfile::tempdir().unwrap();
    let set = baked(&format!("{SMALL} --tile 64"), scratch.path());
    let plan = planned(&format!("{SMALL} --tile 64")).unwrap();
    let ((side, channels, normals), (_, _, heights)) =
        (png(&set["normal_opengl.png"]), png(&set["height.png"]));
    assert_eq!((side, channels), (128, 3));
    let record: Value = serde_json::from_slice(&set["provenance.json"]).unwrap();
    assert_eq!(record["difference_across_edges"]["value"], 0.0);
    let range: [f32; 2] = [0, 1].map(|k| record["height_range_in_sides"][k].as_f64().unwrap() as f32);
    let (mut row, mut middles) = (vec![Texel::default(); 128], vec![0.0; 128]);
    for j in [0, 63, 64, 127] {
        plan.source.texels(&plan.row(j as i64, 0), &mut row);
        // Occlusion uses the same surface, at texel centers. With 8 texels per wave, as in the last
        // octave, means differ by (2π/8)²/24 per axis, and the last octave is a seventh of the
        // total.
        plan.source.heights(&plan.row(j as i64, 0), &mut middles);
        let apart = row.iter().zip(&middles).map(|(texel, middle)| (texel.height - middle).abs());
        assert!(apart.fold(0.0, f32::max) < 0.02 * (range[1] - range[0]), "{j}");
        for (i, texel) in row.iter().enumerate() {
            let k = j * 128 + i;
            let height = range[0] + f32::from(heights[k]) / 65_535.0 * (range[1] - range[0]);
            assert!((height - texel.height).abs() < (range[1] - range[0]) / 65_535.0, "{i}, {j}");
            let normal = texel.slopes.normal().to_array();
            for axis in 0..3 {
                let word = f32::from(normals[3 * k + axis]) / 65_535.0 * 2.0 - 1.0;
                assert!((word - normal[axis]).abs() < 2e-4, "{i}, {j}: {word} and {}", normal[axis]);
            }
        }
    }
    // Up the image is up: where heights grow from row to row upward, green is below its mean.
    let up = (1..127).flat_map(|j| (0..128).map(move |i| j * 128 + i)).map(|k| {
        let rise = f64::from(heights[k - 128]) - f64::from(heights[k + 128]);
        rise * (f64::from(normals[3 * k + 1]) - 32_767.5)
    });
    assert!(up.sum::<f64>() < 0.0);
    // Uniform: one block.
    assert_eq!(png(&set["metallic.png"]), (4, 1, vec![0; 16]));
    let (_, _, light) = png(&set["ambient_occlusion.png"]);
    let (least, most) = (light.iter().min().unwrap(), light.iter().max().unwrap());
    assert!(*least < 63_000 && *most > 65_000, "{least} to {most}");
    let ((_, _, rough), (_, _, packed)) =
        (png(&set["roughness.png"]), png(&set["occlusion_roughness_metallic.png"]));
    assert!(packed.chunks_exact(3).eq(light.iter().zip(&rough).map(|(&light, &rough)| [light, rough, 0])));
    assert!(!set.contains_key("albedo.png"));
    // A density has no heights.
    let bumps = baked("--size 64 --ndf ggx:0.2 --cells 4", &scratch.path().join("bumps"));
    assert!(!bumps.contains_key("height.png") && bumps.contains_key("normal_directx.png"));
    assert_eq!(Plane::Normal.bytes(), 4);
}

#[cfg(unix)]
#[test]
fn write_failure_reports_the_path() {
    let scratch = tempfile::tempdir().unwrap();
    let output = Output::new(scratch.path()).unwrap();
    // A directory in place of a file: a file cannot be renamed onto it.
    fs::create_dir_all(scratch.path().join("height.png/in")).unwrap();
    let plan = planned(&format!("{SMALL} --tile 64")).unwrap();
    let said = whole(&plan, &output, &GO).unwrap_err().to_string();
    assert!(
        said.starts_with("cannot write ") && said.contains("height.png: ") && said.lines().count() == 1,
        "{said}"
    );
}

#[test]
fn levels_of_every_format_match_the_surface() {
    let scratch = tempfile::tempdir().unwrap();
    let line = format!("{SMALL} --tile 64");
    let (set, plan) = (baked(&line, scratch.path()), planned(&line).unwrap());
    let mut texels: Vec<Texel> = vec![Texel::default(); 128 * 128];
    for (k, row) in texels.chunks_mut(128).enumerate() {
        plan.source.texels(&plan.row(k as i64, 0), row);
    }
    let (read, heights) =
        (ktx2::Reader::new(set["roughness.ktx2"].as_slice()).unwrap(), channel(&set["height.exr"], "Y"));
    let rough = channel(&set["roughness.exr"], "Y");
    let colors = ["R", "G", "B"].map(|name| channel(&set["base_color.exr"], name));
    let blocks: Vec<Vec<u8>> = read.levels().map(|level| level.data.to_vec()).collect();
    assert_eq!((read.header().level_count, read.header().pixel_width, rough.len()), (8, 128, 8));
    assert_eq!(read.header().format, Some(ktx2::Format::BC4_UNORM_BLOCK));
    let mut side = 128;
    for level in 0..8 {
        for (k, texel) in texels.iter().enumerate() {
            let expected = plan.source.shown(texel).1.sqrt().sqrt();
            // Half a step of half floats below 1.
            assert!(
                (rough[level][k] - expected).abs() < 3e-4,
                "level {level}: {} and {expected}",
                rough[level][k]
            );
            assert!((heights[level][k] - texel.height).abs() < 1e-8, "level {level}");
            let seen = Vec3::from(colors.each_ref().map(|levels| levels[level][k]));
            assert!(seen.abs_diff_eq(texel.color, 3e-4), "level {level}: {seen} and {}", texel.color);
            let block = (k / side / 4) * side.div_ceil(4) + k % side / 4;
            let mut decoded = [0; 16];
            block_compression::decode::decode_block_bc4(
                &blocks[level][8 * block..8 * block + 8],
                &mut decoded,
                4,
            );
            let shown = f32::from(decoded[4 * (k / side % 4) + k % side % 4]) / 255.0;
            assert!((shown - expected).abs() < 0.02, "level {level}: {shown} and {expected}");
        }
        if side > 1 {
            texels = texel::halved(&texels, side);
            side /= 2;
        }
    }
    // Half floats, which web loaders read.
    let height = ktx2::Reader::new(set["height.ktx2"].as_slice()).unwrap();
    assert_eq!(height.header().format, Some(ktx2::Format::R16_SFLOAT));
    let halves = height.levels().next().unwrap().data.chunks_exact(2);
    let halves = halves.map(|bytes| exr::prelude::f16::from_le_bytes([bytes[0], bytes[1]]).to_f32());
    let (low, high) = heights[0].iter().fold((f32::MAX, f32::MIN), |(l, h), &x| (l.min(x), h.max(x)));
    for (half, height) in halves.zip(&heights[0]) {
        // Half a step of half floats below 1, and one 16-bit step.
        assert!((half - (height - low) / (high - low)).abs() < 2.6e-4, "{half}");
    }
    let base = ktx2::Reader::new(set["base_color.ktx2"].as_slice()).unwrap();
    assert_eq!(base.header().format, Some(ktx2::Format::BC7_SRGB_BLOCK));
    let normal = ktx2::Reader::new(set["normal_directx.ktx2"].as_slice()).unwrap();
    assert_eq!(normal.header().format, Some(ktx2::Format::BC5_UNORM_BLOCK));
    assert_eq!(ktx2::Reader::new(set["metallic.ktx2"].as_slice()).unwrap().header().level_count, 3);
}

/// Returns the levels of a channel of an OpenEXR file.
fn channel(bytes: &[u8], name: &str) -> Vec<Vec<f32>> {
    use exr::prelude::{ReadChannels, ReadLayers, read};
    let image =
        read().no_deep_data().all_resolution_levels().all_channels().first_valid_layer().all_attributes();
    let image = image.from_buffered(std::io::Cursor::new(bytes)).unwrap();
    let channel = image.layer_data.channel_data.list.iter().find(|channel| channel.name.eq(name));
    match &channel.unwrap().sample_data {
        exr::image::Levels::Mip { level_data, .. } => {
            level_data.iter().map(|level| level.values_as_f32().collect()).collect()
        }
        _ => panic!("no levels"),
    }
}

#[test]
fn documents_reference_existing_files() {
    let scratch = tempfile::tempdir().unwrap();
    let painted = "--size 64 --material paint --side 0.02";
    for (k, line) in [
        "--size 64 --noise value --octaves 2",
        "--size 64 --ndf ggx:0.2",
        "--size 64 --material chrome",
        painted,
    ]
    .iter()
    .enumerate()
    {
        let set = baked(line, &scratch.path().join(k.to_string()));
        let gltf: Value = serde_json::from_slice(&set["material.gltf"]).unwrap();
        let text = String::from_utf8(set["material.mtlx"].clone()).unwrap();
        let named =
            gltf["images"].as_array().unwrap().iter().map(|image| image["uri"].as_str().unwrap().to_owned());
        let pieces = text.split("type=\"filename\" value=\"").skip(1);
        let named: Vec<String> =
            named.chain(pieces.map(|piece| piece.split('"').next().unwrap().to_owned())).collect();
        assert!(named.len() >= 4, "{line}: {named:?}");
        for name in &named {
            assert!(set.contains_key(name), "{line}: {name} of {:?}", set.keys());
        }
        assert_eq!(text.matches("nodename=\"height_image\"").count(), usize::from(k == 0), "{line}");
        let coat = &gltf["materials"][0]["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"];
        assert_eq!(coat.as_f64(), (k == 3).then_some(1.0), "{line}");
    }
}

#[test]
fn material_heights_match_normals() {
    for (line, occluded) in [
        ("--material brick --side 0.1 --set depth=0.01 --size 256 --occlusion 0.05", true),
        ("--material plastic --side 0.05 --set dent_size=0.02 --set dent_strength=0.4 --size 256", false),
        (
            "--material scratched --side 0.01 --set scratch_size=0.01 --set scratch_width=0.05 --set scratch_cover=4 --size 256",
            false,
        ),
        (
            "--material carpet --side 0.05 --set fiber_bump_strength=0 --set seam_crossover_strength=0 --size 256",
            false,
        ),
    ] {
        let plan = planned(line).unwrap();
        let [low, high] = plan.source.range().unwrap();
        let side = plan.size as usize;
        let rows = [100, 101, 102].map(|row| {
            let mut texels = vec![Texel::default(); side];
            plan.source.texels(&plan.row(row, 0), &mut texels);
            texels
        });
        // The height difference over two texels, compared with the mean slope of the texel between
        // them plus half of each neighbor's.
        let (mut error, mut all) = (0.0, 0.0);
        for (k, texel) in rows[1].iter().enumerate().take(side - 1).skip(1) {
            assert!((low..=high).contains(&texel.height), "{line}: {}", texel.height);
            let slope =
                |a: &Texel, b: &Texel| 0.25 * (a.slopes.mean + b.slopes.mean) + 0.5 * texel.slopes.mean;
            let across = (rows[1][k + 1].height - rows[1][k - 1].height) * 0.5 * side as f32;
            let up = (rows[0][k].height - rows[2][k].height) * 0.5 * side as f32;
            let seen =
                glam::Vec2::new(slope(&rows[1][k - 1], &rows[1][k + 1]).x, slope(&rows[0][k], &rows[2][k]).y);
            error += (glam::Vec2::new(across, up) + seen).length();
            all += seen.length();
        }
        println!("{line}: {error} of {all}");
        assert!(all > 0.0 && error < 0.1 * all, "{line}: {error} of {all}");
        // Occlusion uses the heights of the texels.
        let mut heights = vec![0.0; side];
        plan.source.heights(&plan.row(101, 0), &mut heights);
        let differ = heights.iter().zip(&rows[1]).map(|(height, texel)| (height - texel.height).abs());
        assert!(differ.sum::<f32>() / (side as f32) < 0.1 * (high - low), "{line}");
        if occluded {
            let scratch = tempfile::tempdir().unwrap();
            let set = baked(line, scratch.path());
            let (_, _, light) = png(&set["ambient_occlusion.png"]);
            let (least, most) = (light.iter().min().unwrap(), light.iter().max().unwrap());
            assert!(*least < 50_000 && *most > 65_000, "{line}: {least} to {most}");
            let (_, _, heights) = png(&set["height.png"]);
            assert_eq!([heights.iter().min(), heights.iter().max()], [Some(&0), Some(&u16::MAX)], "{line}");
        }
    }
    let scratch = tempfile::tempdir().unwrap();
    let flat = baked("--material chrome --size 64", scratch.path());
    assert!(!flat.contains_key("height.png"));
    assert_eq!(png(&flat["ambient_occlusion.png"]), (4, 1, vec![u16::MAX; 16]));
}

#[test]
fn material_colors_and_tileable_errors() {
    let clay = planned("--material brick --side 0.52 --set variation=0 --set clay=0.4,0.2,0.1").unwrap();
    let (mut row, mut found) = (vec![Texel::default(); 1024], false);
    clay.source.texels(&clay.row(100, 0), &mut row);
    for texel in &row {
        found |= texel.color.abs_diff_eq(Vec3::new(0.4, 0.2, 0.1), 1e-6);
        assert_eq!((texel.metallic, texel.alpha2), (0.0, 1.0));
    }
    assert!(found, "no clay in a row of bricks");
    // Flanks of the mortar have their true slope: 1.5 · 6 mm over half of 5 mm is 3.6, and a
    // texel's mean is slightly less.
    let steep = |side: f32| row.iter().map(|texel| side * texel.slopes.mean.x).fold(0.0, f32::max);
    assert!(
        (steep(1.0) - 3.45).abs() < 0.2 && (steep(-1.0) - 3.45).abs() < 0.2,
        "{} {}",
        steep(1.0),
        steep(-1.0)
    );
    let chrome = planned("--material chrome --roughness 0.3 --tileable").unwrap();
    let texel = chrome.source.point([0.3, 0.4]);
    assert_eq!((texel.metallic, texel.slopes.mean), (1.0, glam::Vec2::ZERO));
    assert!((texel.alpha2 - 0.09).abs() < 1e-6, "{texel:?}");
    for (line, said) in [
        ("--material carpet --tileable", "`--tileable`: opposite edges differ by "),
        ("--material paint --tileable", "`--tileable`: opposite edges differ by "),
        ("--noise gaussian", ""),
        (
            "--material glass",
            "`--material glass` is not supported: transmissive materials have no base color",
        ),
        (
            "--material frosted",
            "`--material frosted` is not supported: transmissive materials have no base color",
        ),
        ("--material bumps", "`--material bumps` is not supported: use `--ndf`"),
        ("--material brick --parts 2 --occlusion 0.1", ""),
        ("--material chrome --occlusion 0.1", "--occlusion has no effect on chrome; see "),
        ("--material chrome --low-tint 000000", "--low-tint has no effect on chrome; see "),
        ("--material brick --height 0.1", "--height has no effect on brick; see "),
        ("--ndf ggx:0.2 --occlusion 0.1", "--occlusion has no effect on bumps of a density"),
        ("--fractal periodic --octaves 3", "--octaves has no effect on a fractal surface"),
        ("--noise perlin --scaling 0.3", "--scaling has no effect on noise"),
    ] {
        match planned(line) {
            Ok(_) => assert_eq!(said, "", "{line}"),
            Err(error) => {
                let error = error.to_string();
                assert!(
                    !said.is_empty() && error.starts_with(said) && error.lines().count() == 1,
                    "{line}: {error}"
                );
            }
        }
    }
}
