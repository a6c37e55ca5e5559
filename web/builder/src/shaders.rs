//! The programs as page data: WGSL by parts, GLSL ES 3.00 by pieces, without duplicates.

use std::collections::{BTreeMap, BTreeSet};

use asperity_wgsl::{Binding, Bindings, Element, Part, compose, ordered};
use naga::ShaderStage;
use naga::back::glsl;
use naga::compact::{KeepUnused, compact};
use naga::proc::BoundsCheckPolicies;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use serde_json::{Value, json};

use crate::glsl::{pieces_of, renamed, shortened, words_of};
use crate::programs::{COPIED, Program};

/// Deduplicated pieces of text, in order of first use.
#[derive(Default)]
struct Pieces {
    texts: Vec<String>,
    known: BTreeMap<String, usize>,
}

impl Pieces {
    fn number(&mut self, text: &str) -> usize {
        *self.known.entry(text.to_owned()).or_insert_with(|| {
            self.texts.push(text.to_owned());
            self.texts.len() - 1
        })
    }
}

/// Returns the sources of all parts, pieces of GLSL, and each program's parts, bindings and stages.
pub(crate) fn data(programs: impl Iterator<Item = &'static Program>) -> Result<Value, String> {
    let mut sources = BTreeMap::new();
    let mut heads = Pieces::default();
    let mut pieces = Pieces::default();
    let mut described = serde_json::Map::new();
    let programs: Vec<_> = programs.collect();
    let short = short_names(&programs);
    for (name, part, entries) in COPIED {
        let Composed { parts, head, .. } = composed(part);
        sources.extend(parts.iter().map(|part| (part.name(), uncommented(part.source()))));
        let parts: Vec<_> = parts.iter().map(|part| part.name()).collect();
        let value = json!({ "parts": parts, "head": heads.number(&head), "entries": entries });
        described.insert((*name).into(), value);
    }
    for program in programs {
        let Composed { parts, head, wgsl } = composed(program.part);
        for part in &parts {
            let source = uncommented(part.source());
            if ["ptr<", "var<private>", "var<workgroup>"].iter().any(|word| source.contains(word)) {
                return Err(format!(
                    "{}: functions must have no side effects (see `put_in_place`)",
                    part.name()
                ));
            }
            sources.insert(part.name(), source);
        }
        let bindings: Vec<&Binding> = parts.iter().flat_map(|part| part.bindings()).collect();
        let named = |error: String| format!("{}: {error}", program.name);
        let [vertex, fragment] = stages(program, &wgsl).map_err(named)?;
        let mut numbers = |text: &str| {
            pieces_of(text)
                .map(|piece| pieces.number(&renamed(&shortened(piece), &short)))
                .collect::<Vec<_>>()
        };
        let value = json!({
            "parts": parts.iter().map(|part| part.name()).collect::<Vec<_>>(),
            "head": heads.number(&head),
            "bindings": bindings.iter().map(|binding| described_binding(binding)).collect::<Vec<_>>(),
            "entries": [program.vertex, program.fragment],
            "glsl": [numbers(&vertex), numbers(&fragment)],
        });
        described.insert(program.name.into(), value);
    }
    let entries = described.values().flat_map(|program| program["entries"].as_array().into_iter().flatten());
    let called = called(&sources, entries.filter_map(Value::as_str));
    let sources: BTreeMap<_, _> = sources
        .iter()
        .map(|(name, source)| {
            (name, items(source).filter(|item| item.name().is_none_or(|f| called.contains(f))))
        })
        .map(|(name, items)| (name, without_gaps(&items.map(|item| item.0).collect::<String>())))
        .collect();
    Ok(json!({ "parts": sources, "heads": heads.texts, "glsl": pieces.texts, "programs": described }))
}

/// A part with all its dependencies: as parts, as one text, and the text before the first part.
struct Composed {
    parts: Vec<&'static Part>,
    head: String,
    wgsl: String,
}

fn composed(part: &'static Part) -> Composed {
    let parts = ordered(&[part]);
    let wgsl = compose(&[part], Bindings::Textures { group: 0 });
    let first = parts.first().map_or("", |part| part.name());
    let head = wgsl.split(&format!("\n// {first}\n")).next().unwrap_or_default().to_owned();
    Composed { parts, head, wgsl }
}

/// A function with its attributes, or the lines between functions.
struct Item<'a>(&'a str);

impl<'a> Item<'a> {
    /// Returns the name of a function.
    fn name(&self) -> Option<&'a str> {
        let line = self.0.lines().find(|line| !line.starts_with('@') && !line.is_empty())?;
        line.strip_prefix("fn ")?.split('(').next()
    }
}

/// Returns the functions of a source and the text between them. A function ends with an unindented
/// line that closes a block.
fn items(source: &str) -> impl Iterator<Item = Item<'_>> {
    let ends = source.match_indices("\n}\n").map(|(at, end)| at + end.len()).chain([source.len()]);
    let mut from = 0;
    ends.flat_map(move |end| {
        let piece = &source[from..end];
        from = end;
        // Constants and similar items precede the next function.
        let starts = [piece.find("\n@"), piece.find("\nfn ")].into_iter().flatten().min();
        let begins = piece.starts_with('@') || piece.starts_with("fn ");
        let cut = if begins { 0 } else { starts.map_or(piece.len(), |at| at + 1) };
        let (between, function) = piece.split_at(cut);
        [Item(between), Item(function)]
    })
}

/// Returns functions called by the entry points, transitively. Of interchangeable parts such as
/// densities, all are followed.
fn called<'a>(sources: &BTreeMap<&str, String>, entries: impl Iterator<Item = &'a str>) -> BTreeSet<String> {
    let mut functions: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for item in sources.values().flat_map(|source| items(source)) {
        if let Some(name) = item.name() {
            functions.entry(name).or_default().push(item.0);
        }
    }
    let mut called = BTreeSet::new();
    let mut open: Vec<&str> = entries.collect();
    while let Some(name) = open.pop() {
        let Some((&name, texts)) = functions.get_key_value(name) else { continue };
        if called.insert(name.to_owned()) {
            let words = texts.iter().flat_map(|text| words_of(text));
            open.extend(words.filter_map(|word| functions.get_key_value(word).map(|(&name, _)| name)));
        }
    }
    called
}

/// Describes a binding for the page: `u` uniform; `f` and `w` tables of floats and words, with
/// widths; `t` texture, `s` sampler.
fn described_binding(binding: &Binding) -> Value {
    match *binding {
        Binding::Uniform { name, .. } => json!([name, "u"]),
        Binding::Table { name, element: Element::Float, width } => json!([name, "f", width]),
        Binding::Table { name, element: Element::Word, width } => json!([name, "w", width]),
        Binding::Texture { name } => json!([name, "t"]),
        Binding::Sampler { name } => json!([name, "s"]),
        _ => Value::Null,
    }
}

/// Returns short names of functions, structures and constants, because nobody reads the GLSL.
fn short_names(programs: &[&Program]) -> BTreeMap<&'static str, String> {
    let parts = programs.iter().flat_map(|program| ordered(&[program.part]));
    let entries: Vec<&str> = programs.iter().flat_map(|program| [program.vertex, program.fragment]).collect();
    let names: BTreeSet<&str> =
        parts.flat_map(|part| part.names()).filter(|name| !entries.contains(name)).collect();
    names.into_iter().enumerate().map(|(k, name)| (name, format!("q{k}"))).collect()
}

/// Removes the comments from WGSL. They are in the repository.
fn uncommented(source: &str) -> String {
    let lines = source.lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.map(|line| line.trim_end().to_owned() + "\n").collect::<String>().trim_start().to_owned()
}

/// Reduces runs of empty lines to one.
fn without_gaps(text: &str) -> String {
    let lines: Vec<&str> = text.trim_start().lines().collect();
    let kept =
        lines.iter().enumerate().filter(|&(k, line)| !line.is_empty() || k == 0 || !lines[k - 1].is_empty());
    kept.map(|(_, line)| format!("{line}\n")).collect()
}

/// Returns both stages in GLSL ES 3.00. Resources keep their names, and uniform blocks are named
/// after their variables.
fn stages(program: &Program, wgsl: &str) -> Result<[String; 2], String> {
    let module = naga::front::wgsl::parse_str(wgsl).map_err(|error| error.emit_to_string(wgsl))?;
    let stage = |stage: ShaderStage, entry: &str, suffix: &str| -> Result<String, String> {
        let mut module = module.clone();
        module.entry_points.retain(|other| other.name == entry);
        compact(&mut module, KeepUnused::No);
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        let info = validator.validate(&module).map_err(|error| error.emit_to_string(wgsl))?;
        // Clip coordinates are unchanged, because the page handles WebGL's convention.
        let options = glsl::Options {
            version: glsl::Version::Embedded { version: 300, is_webgl: true },
            writer_flags: glsl::WriterFlags::empty(),
            ..Default::default()
        };
        let entry = glsl::PipelineOptions { entry_point: entry.into(), shader_stage: stage, multiview: None };
        let mut text = String::new();
        let policies = BoundsCheckPolicies::default();
        let reflected = glsl::Writer::new(&mut text, &module, &info, &options, &entry, policies)
            .and_then(|mut writer| writer.write())
            .map_err(|error| error.to_string())?;
        for (handle, block) in &reflected.uniforms {
            let name = module.global_variables[*handle].name.as_deref().unwrap_or_default();
            text = text.replace(block.as_str(), &format!("{name}_block"));
        }
        for (_, variable) in module.global_variables.iter() {
            if let (Some(name), Some(at)) = (&variable.name, &variable.binding) {
                let given = format!("_group_{}_binding_{}_{suffix}", at.group, at.binding);
                text = text.replace(&given, &format!("{name}_"));
            }
        }
        Ok(text)
    };
    Ok([
        stage(ShaderStage::Vertex, program.vertex, "vs")?,
        stage(ShaderStage::Fragment, program.fragment, "fs")?,
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn called_follows_all_interchangeable_parts() {
        let part = |callee: &str| format!("fn lobe() {{\n    {callee}();\n}}\n\nfn {callee}() {{\n}}\n");
        let sources = BTreeMap::from([("ggx", part("smooth")), ("beckmann", part("rough"))]);
        let called = called(&sources, ["lobe"].into_iter());
        assert_eq!(called.iter().map(String::as_str).collect::<Vec<_>>(), ["lobe", "rough", "smooth"]);
    }

    #[test]
    fn unused_functions_are_removed() {
        let source = "const LEAST: f32 = 1e-3;\nfn a() -> f32 {\n    return b();\n}\n\nfn unused() {\n}\n\nstruct S {\n    x: f32,\n}\n\n\
                      fn b() -> f32 {\n    return LEAST;\n}\n\n@fragment\nfn entry() {\n    let x = a();\n}\n";
        let sources = BTreeMap::from([("part", source.to_owned())]);
        let called = called(&sources, ["entry"].into_iter());
        assert_eq!(called.iter().map(String::as_str).collect::<Vec<_>>(), ["a", "b", "entry"]);
        let kept = items(source).filter(|item| item.name().is_none_or(|name| called.contains(name)));
        let kept: String = kept.map(|item| item.0).collect();
        assert!(
            !kept.contains("unused") && kept.contains("struct S {") && kept.contains("@fragment\nfn entry()")
        );
        assert!(items(source).map(|item| item.0).collect::<String>() == source);
        assert_eq!(without_gaps("\n\na\n\n\n\nb\nc\n"), "a\n\nb\nc\n");
    }
}
