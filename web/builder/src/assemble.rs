//! Assembles the page as a folder to host, and as a single file.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use asperity_noise::GaussianNoise;
use asperity_output::Output;
use base64::{Engine, prelude::BASE64_STANDARD};
use flate2::{Compression, write::GzEncoder};
use lzma_rust2::{LzmaOptions, LzmaWriter};
use serde_json::{Value, json};

use crate::{programs, scripts, shaders};

const INDEX: &str = include_str!("../../page/index.html");
const STYLE: &str = include_str!("../../page/style.css");
/// Image for browsers without graphics: the page's first scene, rendered by the page.
const PICTURE: &[u8] = include_bytes!("../../page/bumps.webp");
const TEAPOT: &str = include_str!("../../../tools/render/data/teapot.json");

/// Modules in dependency order. Top-level names are unique, because the single file has one scope.
const MODULES: &[(&str, &str)] = &[
    ("data.mjs", include_str!("../../page/data.mjs")),
    ("rust.mjs", include_str!("../../page/rust.mjs")),
    ("gpu.mjs", include_str!("../../page/gpu.mjs")),
    ("vector.mjs", include_str!("../../page/vector.mjs")),
    ("mesh.mjs", include_str!("../../page/mesh.mjs")),
    ("controls.mjs", include_str!("../../page/controls.mjs")),
    ("painting.mjs", include_str!("../../page/painting.mjs")),
    ("camera.mjs", include_str!("../../page/camera.mjs")),
    ("bumps.mjs", include_str!("../../page/bumps.mjs")),
    ("charts.mjs", include_str!("../../page/charts.mjs")),
    ("plot.mjs", include_str!("../../page/plot.mjs")),
    ("fractals.mjs", include_str!("../../page/fractals.mjs")),
    ("light.mjs", include_str!("../../page/light.mjs")),
    ("scenery.mjs", include_str!("../../page/scenery.mjs")),
    ("materials.mjs", include_str!("../../page/materials.mjs")),
    ("noise.mjs", include_str!("../../page/noise.mjs")),
    ("main.mjs", include_str!("../../page/main.mjs")),
];

/// Script of the single file, which unpacks the others.
const UNPACK: &str = include_str!("../../page/lzma.mjs");

/// Separator that occurs neither in scripts nor in shaders.
const BETWEEN_TEXTS: &str = "\u{1}";
const BETWEEN_PIECES: &str = "\u{2}";

/// Levels of either sign.
const HALF: usize = 2048;

/// Maximum size of the file, compressed with this program. Other gzip programs give up to 1 % more,
/// and the limit is 250,000.
const MOST: usize = 247_500;

/// Writes `index.html`, which contains everything, and the folder `hosted` with separate files.
/// Prints their sizes.
pub(crate) fn build(wasm: &Path, out: &Path) -> Result<(), String> {
    let wasm = fs::read(wasm).map_err(|error| format!("{}: {error}", wasm.display()))?;
    let wasm = without_custom_sections(&wasm).ok_or("the module ends within a section")?;
    let mut data = shaders::data(programs::all())?;
    let teapot: Value = serde_json::from_str(TEAPOT).map_err(|error| error.to_string())?;
    data["teapot"] = serde_json::json!({
        "patches": teapot["patches_16_indices"],
        "vertices": teapot["vertices_xyz_z_up"],
    });

    let told = |error: io::Error| error.to_string();
    let page = Output::new(out).map_err(told)?;
    let hosted = page.inside("hosted").map_err(told)?;
    let data_text = data.to_string();
    let fixed: [(&str, &[u8]); 5] = [
        ("index.html", INDEX.as_bytes()),
        ("style.css", STYLE.as_bytes()),
        ("bumps.webp", PICTURE),
        ("data.json", data_text.as_bytes()),
        ("tables.wasm", &wasm),
    ];
    let modules = MODULES.iter().map(|&(name, source)| (name, source.as_bytes()));
    for (name, bytes) in fixed.into_iter().chain(modules) {
        hosted.write(name, bytes).map_err(told)?;
    }

    let single = single_file(data, &wasm)?;
    let sent = compressed(single.as_bytes())?.len();
    page.write("index.html", single.as_bytes()).map_err(told)?;
    println!(
        "the live page: {} ({} kB, {} kB compressed; module {} kB)",
        page.path("index.html").display(),
        single.len() / 1000,
        sent / 1000,
        wasm.len() / 1000,
    );
    println!("files for hosting: {}", page.path("hosted").display());
    if sent > MOST {
        return Err(format!("the page is too large: {sent} bytes compressed (at most {MOST})"));
    }
    Ok(())
}

/// Removes sections that are not executed. Function names take as much space as all the code.
fn without_custom_sections(module: &[u8]) -> Option<Vec<u8>> {
    let (head, mut rest) = module.split_at_checked(8)?;
    let mut kept = head.to_vec();
    while let [kind, after @ ..] = rest {
        let digits = after.iter().position(|byte| byte & 0x80 == 0).filter(|&last| last < 5)? + 1;
        let length =
            after[..digits].iter().rev().fold(0_usize, |sum, byte| sum << 7 | usize::from(byte & 0x7f));
        let (section, further) = rest.split_at_checked(1 + digits + length)?;
        if *kind != 0 {
            kept.extend_from_slice(section);
        }
        rest = further;
    }
    Some(kept)
}

/// Replaces a Gaussian variate's levels by second differences and its negative half by 0, and
/// returns their position. Consecutive levels differ little, which byte-oriented compression does
/// not detect. `lzma.mjs` restores the levels.
fn differenced(module: &mut [u8]) -> Option<usize> {
    let levels: Vec<u32> = GaussianNoise::gpu_levels().take(2 * HALF).map(f32::to_bits).collect();
    let bytes: Vec<u8> = levels.iter().flat_map(|level| level.to_le_bytes()).collect();
    let at = module.windows(bytes.len()).position(|window| window == bytes)?;
    let (mut last, mut slope) = (0_u32, 0_u32);
    module[at..][..4 * HALF].fill(0);
    for (place, &level) in module[at + 4 * HALF..].chunks_exact_mut(4).zip(&levels[HALF..]) {
        let step = level.wrapping_sub(last);
        place.copy_from_slice(&step.wrapping_sub(slope).to_le_bytes());
        (last, slope) = (level, step);
    }
    Some(at)
}

/// Builds a single file: style, data and module inline, scripts joined.
fn single_file(mut data: Value, wasm: &[u8]) -> Result<String, String> {
    let mut wasm = wasm.to_vec();
    data["levels"] = json!(differenced(&mut wasm));
    let style = format!("<style>\n{}</style>", without_margins(STYLE));
    let scripts: String = MODULES.iter().map(|(_, source)| without_imports(source)).collect();
    // Base64 prevents further compression, and LZMA compresses more than the encodings of servers.
    let scripts = format!(
        "<script type=\"text/plain\" id=\"asperity-texts\">{}</script>\n\
         <script type=\"text/plain\" id=\"asperity-tables\">{}</script>\n\
         <script type=\"module\">\n{}</script>",
        BASE64_STANDARD.encode(packed(texts(&scripts::minified(&scripts)?, data).as_bytes(), 0)?),
        BASE64_STANDARD.encode(packed(&wasm, 2)?),
        scripts::minified(&without_imports(UNPACK))?,
    );
    let link = "<link rel=\"stylesheet\" href=\"style.css\">";
    let script = "<script type=\"module\" src=\"main.mjs\"></script>";
    let picture = "bumps.webp";
    for wanted in [link, script, picture] {
        if INDEX.matches(wanted).count() != 1 {
            return Err(format!("page/index.html must hold `{wanted}` once"));
        }
    }
    let inline = format!("data:image/webp;base64,{}", BASE64_STANDARD.encode(PICTURE));
    Ok(INDEX.replacen(link, &style, 1).replacen(picture, &inline, 1).replacen(script, &scripts, 1))
}

/// Joins scripts, data without sources, pieces of GLSL and sources of parts in the format that
/// `lzma.mjs` splits. Within JSON they would be longer.
fn texts(scripts: &str, mut data: Value) -> String {
    let [glsl, parts] = ["glsl", "parts"].map(|field| data[field].take());
    let joined = |texts: &mut dyn Iterator<Item = &Value>| {
        texts.filter_map(Value::as_str).collect::<Vec<_>>().join(BETWEEN_PIECES)
    };
    let parts = parts.as_object().cloned().unwrap_or_default();
    data["parts"] = parts.keys().cloned().collect();
    let glsl = joined(&mut glsl.as_array().into_iter().flatten());
    [scripts, &data.to_string(), &glsl, &joined(&mut parts.values())].join(BETWEEN_TEXTS)
}

/// Returns a module's text without imports, `export` keywords and full-line comments, which remain
/// in the hosted folder.
fn without_imports(source: &str) -> String {
    let is_comment = |line: &str| {
        let line = line.trim_start();
        line.starts_with("/**") || line.starts_with("* ") || line == "*/"
    };
    let lines = source
        .lines()
        .filter(|line| !line.starts_with("import ") && !line.starts_with("// ") && !is_comment(line));
    lines.map(|line| line.strip_prefix("export ").unwrap_or(line).to_owned() + "\n").collect()
}

/// Removes the indentation of all lines.
fn without_margins(text: &str) -> String {
    text.lines().map(|line| line.trim_start().to_owned() + "\n").collect()
}

fn compressed(data: &[u8]) -> Result<Vec<u8>, String> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(data).and_then(|()| encoder.finish()).map_err(|error| error.to_string())
}

/// Compresses bytes with LZMA, with a header that contains their number, as `lzma.mjs` expects.
/// Words of `2^alignment` bytes are aligned.
fn packed(data: &[u8], alignment: u32) -> Result<Vec<u8>, String> {
    let options =
        LzmaOptions { pb: alignment, nice_len: LzmaOptions::NICE_LEN_MAX, ..LzmaOptions::with_preset(9) };
    let mut writer = LzmaWriter::new_use_header(Vec::new(), &options, Some(data.len() as u64))
        .map_err(|error| error.to_string())?;
    writer.write_all(data).and_then(|()| writer.finish()).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_imports_removes_imports_exports_and_comments() {
        let source =
            "import { a } from './a.mjs';\n/** B. */\nexport const b = a;\n// C.\nconst c = 'export ';\n";
        assert_eq!(without_imports(source), "const b = a;\nconst c = 'export ';\n");
    }

    #[test]
    fn texts_are_joined_after_their_description() {
        let data = serde_json::json!({ "glsl": ["a", "b"], "parts": { "p": "c", "q": "d" }, "heads": [] });
        assert_eq!(
            texts("s", data),
            "s\u{1}{\"glsl\":null,\"heads\":[],\"parts\":[\"p\",\"q\"]}\u{1}a\u{2}b\u{1}c\u{2}d"
        );
    }

    #[test]
    fn without_custom_sections_keeps_the_rest() {
        let module = b"\0asm\x01\0\0\0\x01\x01\0\0\x83\0abc\x02\x02xy";
        assert_eq!(
            without_custom_sections(module).as_deref(),
            Some(&b"\0asm\x01\0\0\0\x01\x01\0\x02\x02xy"[..])
        );
        assert_eq!(without_custom_sections(&module[..14]), None);
    }

    #[test]
    fn differenced_levels_are_restored() {
        let levels: Vec<f32> = GaussianNoise::gpu_levels().take(2 * HALF).collect();
        let whole: Vec<u8> = levels.iter().flat_map(|level| level.to_le_bytes()).collect();
        let mut module = [&b"abc"[..], &whole, b"xyz"].concat();
        assert_eq!(differenced(&mut module), Some(3));
        assert!(
            module.starts_with(b"abc")
                && module.ends_with(b"xyz")
                && module[3..][..4 * HALF] == [0; 4 * HALF]
        );
        let (mut level, mut slope) = (0_u32, 0_u32);
        for (k, place) in module[3 + 4 * HALF..].chunks_exact(4).take(HALF).enumerate() {
            slope = slope.wrapping_add(u32::from_le_bytes(place.try_into().expect("four bytes")));
            level = level.wrapping_add(slope);
            assert_eq!(f32::from_bits(level), levels[HALF + k]);
            assert_eq!(-f32::from_bits(level), levels[HALF - 1 - k]);
        }
        assert_eq!(differenced(&mut b"no levels".to_vec()), None);
    }

    #[test]
    fn top_level_names_are_unique() {
        let mut names = std::collections::BTreeMap::new();
        for (module, source) in MODULES {
            for line in without_imports(source).lines() {
                let rest = ["const ", "let ", "function ", "async function ", "class "]
                    .iter()
                    .find_map(|word| line.strip_prefix(word));
                let name = rest.and_then(|rest| {
                    rest.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == '$')).next()
                });
                if let Some(name) = name.filter(|name| !name.is_empty()) {
                    assert_eq!(names.insert(name.to_owned(), module), None, "{module}: {name}");
                }
            }
        }
        assert!(names.len() > 20);
    }
}
