//! The page of all parts: source, bindings with what fills them, files, and a use in every engine.

mod demo;
mod json;
mod parts;

use asperity_shader_tests::case::Case;
use asperity_shaders::{Binding, Bindings, Element, Part, compose, ordered};

use crate::dialect::{Checked, Dialect};
use demo::Demo;
use json::Json;

/// The entry of a part's fragment shader.
pub(crate) const ENTRY: &str = "show_part";

/// All that is written of a part.
pub(crate) struct PartFiles {
    /// Under the folder of all.
    pub(crate) folder: String,
    /// A module for `naga_oil`, whole.
    pub(crate) bevy: String,
    /// A fragment and a compute shader of one of its functions.
    pub(crate) shaders: Option<[String; 2]>,
    /// Words of its bindings, by their names.
    pub(crate) words: Vec<(&'static str, Vec<u32>)>,
    fields: Vec<(&'static str, Json)>,
}

/// All parts whose names contain a text.
pub(crate) fn parts(cases: &[Case], only: Option<&str>) -> Result<Vec<PartFiles>, String> {
    let chosen = parts::PARTS.iter().filter(|(_, part)| only.is_none_or(|text| part.name().contains(text)));
    chosen.map(|(path, part)| files(path, part, cases)).collect()
}

fn files(path: &str, part: &'static Part, cases: &[Case]) -> Result<PartFiles, String> {
    let name = part.name();
    let calling = calling(part, cases);
    let needing = cases.iter().filter(|case| needs(case, part)).take(8);
    let demo = Demo::new(part, &calling.iter().copied().chain(needing).collect::<Vec<_>>())
        .map_err(|error| format!("{name}: {error}"))?;
    let joined = demo.as_ref().map_or_else(|| vec![part], |demo| demo.parts.clone());
    // Of a case alone do the words of uniforms and tables belong together.
    let bindings: Vec<(&Part, &Binding)> =
        ordered(&joined).iter().flat_map(|part| part.bindings().iter().map(move |of| (*part, of))).collect();
    let has_all = |case: &&&Case| {
        bindings.iter().all(|(_, of)| case.resources.iter().any(|(name, _)| *name == of.name()))
    };
    let case = calling.iter().chain(&cases.iter().collect::<Vec<_>>()).find(has_all).copied();
    let words: Vec<_> = bindings
        .iter()
        .filter_map(|(_, of)| {
            let mut from = case.into_iter().chain(cases).flat_map(|case| &case.resources);
            from.find(|(name, _)| *name == of.name())
        })
        .map(|(name, words)| (*name, words.clone()))
        .collect();
    let shaders = demo.as_ref().map(|demo| [demo::FRAGMENT, demo::COMPUTE].map(|entry| demo.wgsl() + entry));
    let glsl = match &shaders {
        Some([fragment, _]) => {
            let checked = Checked::new(fragment, ENTRY).map_err(|error| format!("{name}: {error}"))?;
            String::from_utf8_lossy(&Dialect::GlslEs300.write(&checked)?).into_owned()
        }
        None => String::new(),
    };
    let mut slots = Slots::default();
    let bindings = (0..).zip(&bindings).map(|(index, (owner, of))| {
        let words = words.iter().find(|(name, _)| *name == of.name()).map(|(_, words)| words.len());
        Json::Object(binding(index, owner, of, words.unwrap_or(0), slots.take(of), &glsl))
    });
    let bindings = Json::List(bindings.collect());
    let texts = |names: &[String]| Json::texts(names.iter().map(String::as_str));
    let needs: Vec<String> = part.needs().iter().map(|part| part.name().to_owned()).collect();
    let fields = vec![
        ("name", Json::text(name)),
        ("rust", Json::text(path)),
        ("summary", Json::text(summary(part.source()))),
        ("source", Json::text(part.source())),
        ("needs", texts(&needs)),
        ("names", Json::texts(part.names())),
        ("bindings", bindings),
        ("called", Json::texts(calling.iter().map(|case| case.name.as_str()))),
        ("function", Json::text(demo.as_ref().map_or("", |demo| &demo.function))),
        ("call", Json::text(demo.as_ref().map_or("", |demo| &demo.call))),
        ("colour", Json::text(demo.as_ref().map_or("", |demo| &demo.colour))),
        ("own", Json::texts(joined.iter().filter(|of| of.name() != name).map(|of| of.name()))),
    ];
    // Whole, and so in the numbers of the bindings that the page has.
    let bevy = format!("#define_import_path asperity::{}\n", name.replace('/', "::"))
        + &compose(&joined, Bindings::Textures { group: 0 })
            .replace("@group(0)", "@group(#{MATERIAL_BIND_GROUP})");
    Ok(PartFiles { folder: format!("parts/{name}"), bevy, shaders, words, fields })
}

fn needs(case: &Case, part: &Part) -> bool {
    ordered(&case.parts).iter().any(|of| of.name() == part.name())
}

/// Cases whose bodies call a function of a part.
fn calling<'a>(part: &'static Part, cases: &'a [Case]) -> Vec<&'a Case> {
    let names: Vec<String> = part.names().map(|name| format!("{name}(")).collect();
    let called =
        |case: &&Case| needs(case, part) && names.iter().any(|name| case.body.contains(name.as_str()));
    cases.iter().filter(called).collect()
}

/// Comment at the head of a source, as one paragraph.
fn summary(source: &str) -> String {
    let lines = source.lines().take_while(|line| line.starts_with("//"));
    let text: Vec<&str> = lines.map(|line| line.trim_start_matches('/').trim()).collect();
    text.join(" ")
}

/// Metal's numbers: each kind of resource counts from 0.
#[derive(Default)]
struct Slots([u8; 3]);

impl Slots {
    fn take(&mut self, binding: &Binding) -> u8 {
        let kind = match binding {
            Binding::Uniform { .. } => 0,
            Binding::Sampler { .. } => 2,
            _ => 1,
        };
        self.0[kind] += 1;
        self.0[kind] - 1
    }
}

fn binding(
    index: u64,
    owner: &Part,
    of: &Binding,
    words: usize,
    slot: u8,
    glsl: &str,
) -> Vec<(&'static str, Json)> {
    let (kind, holds, width) = match *of {
        Binding::Uniform { of, .. } => ("uniform", of, 0),
        Binding::Table { element: Element::Float, width, .. } => ("table", "r32float", width),
        Binding::Table { element: Element::Word, width, .. } => ("table", "r32uint", width),
        Binding::Texture { .. } => ("texture", "rg16float", 0),
        _ => ("sampler", "", 0),
    };
    let number = |x: u64| Json::Number(x);
    vec![
        ("name", Json::text(of.name())),
        ("part", Json::text(owner.name())),
        ("binding", number(index)),
        ("kind", Json::text(kind)),
        ("holds", Json::text(holds)),
        ("width", number(width.into())),
        ("height", number((words as u64).div_ceil(u64::from(width.max(1))))),
        ("words", number(words as u64)),
        ("metal", number(slot.into())),
        ("block", Json::text(block(glsl, index).unwrap_or_default())),
        ("fill", Json::text(parts::fill(of.name()).unwrap_or_default())),
    ]
}

/// Name of the uniform block that holds the variable of a binding.
fn block(glsl: &str, binding: u64) -> Option<&str> {
    let variable = format!("_group_0_binding_{binding}_fs");
    let before = &glsl[..glsl.find(&variable)?];
    let line = before.lines().rev().find(|line| line.contains("uniform "))?;
    line.split("uniform ").nth(1)?.split(' ').next()
}

/// The page, with the languages and the entries that are written beside it.
pub(crate) fn html(parts: Vec<PartFiles>, cases: &[(String, &Case)], dialects: &[Dialect]) -> String {
    let parts = Json::List(parts.into_iter().map(|part| Json::Object(part.fields)).collect());
    let entries = cases.iter().map(|(folder, case)| {
        let fields = vec![
            ("name", Json::text(&case.name)),
            ("folder", Json::text(folder)),
            ("body", Json::text(&case.body)),
        ];
        Json::Object(fields)
    });
    let entries = Json::List(entries.collect());
    let dialects = dialects.iter().map(|of| Json::texts([of.label(), of.file()]));
    let data = Json::Object(vec![
        ("parts", parts),
        ("entries", entries),
        ("dialects", Json::List(dialects.collect())),
    ]);
    let mut text = String::new();
    data.write(&mut text);
    include_str!("page.html")
        .replace("/*STYLE*/", include_str!("page.css"))
        .replace("/*SAMPLES*/", include_str!("samples.js"))
        .replace("/*SCRIPT*/", include_str!("page.js"))
        .replace("/*DATA*/", &text)
}

#[cfg(test)]
mod tests {
    use asperity_shader_tests::cases;

    use super::*;

    #[test]
    fn nearly_every_part_is_shown_in_every_language_with_the_words_of_its_bindings() {
        let cases = cases::all();
        let parts = parts(&cases, None).expect("parts");
        let without: Vec<&str> =
            parts.iter().filter(|part| part.shaders.is_none()).map(|part| part.folder.as_str()).collect();
        assert!(without.len() <= 8, "{without:?}");
        for part in &parts {
            let Some(shaders) = &part.shaders else { continue };
            let fragment = Checked::new(&shaders[0], ENTRY).expect(&part.folder);
            for dialect in [Dialect::Glsl450, Dialect::GlslEs300, Dialect::Hlsl, Dialect::Msl, Dialect::Spirv]
            {
                dialect.write(&fragment).unwrap_or_else(|error| panic!("{}: {error}", part.folder));
            }
            Dialect::Spirv
                .write(&Checked::new(&shaders[1], "main").expect(&part.folder))
                .expect(&part.folder);
        }
    }

    #[test]
    fn blocks_of_uniforms_are_found() {
        let glsl = "layout(std140) uniform Sum_block_0Fragment { Sum _group_0_binding_1_fs; };\n\
                    uniform highp sampler2D _group_0_binding_0_fs;\n";
        assert_eq!(block(glsl, 1), Some("Sum_block_0Fragment"));
        assert_eq!(block(glsl, 2), None);
    }

    #[test]
    fn a_summary_is_the_comment_at_the_head() {
        assert_eq!(summary("// One\n// two.\n\n// three\n"), "One two.");
    }
}
