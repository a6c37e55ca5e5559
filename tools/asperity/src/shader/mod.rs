//! `asperity shader`: parts of shaders in a shading language.

pub mod language;

use asperity_wgsl::{Bindings, Imports, Part, compose, module, ordered, parts};

use crate::cli::shader::{Language, Shader, Tables};
use crate::failure::Result;
use crate::output::{Output, split};
use crate::progress;

/// Writes the parts, or lists all parts.
pub fn shader(wanted: &Shader) -> Result<()> {
    if wanted.parts.is_empty() {
        list();
        return Ok(());
    }
    let chosen = wanted.parts.iter().map(|name| found(name)).collect::<Result<Vec<_>>>()?;
    let group = wanted.group;
    let bindings = match wanted.tables {
        Tables::Textures => Bindings::Textures { group },
        Tables::Buffers => Bindings::Buffers { group },
    };
    let text = text(&chosen, wanted.language, bindings)?;
    let Some(file) = &wanted.out else {
        let text = String::from_utf8(text).map_err(|_| "SPIR-V is binary and needs --out FILE")?;
        return Ok(progress::print(&format!("{}\n", text.trim_end()))?);
    };
    let (folder, name) = split(file)?;
    let output = Output::new(folder)?;
    output.write(&name, &text)?;
    progress::say(&format!("shader written to {} ({} parts)", output.place(&name), ordered(&chosen).len()));
    Ok(())
}

/// Returns the parts and all they need in a language.
fn text(chosen: &[&'static Part], language: Language, bindings: Bindings) -> Result<Vec<u8>> {
    let imports = match language {
        Language::NagaOil => Imports::NagaOil,
        Language::Wesl => Imports::Wesl,
        _ => {
            let wgsl = compose(chosen, bindings);
            return language::Checked::library(&wgsl)?.write(language);
        }
    };
    let modules = ordered(chosen).into_iter().map(|part| {
        let path = part.name().replace('/', "::");
        format!("// asperity::{path}\n{}\n", module(part, imports, bindings))
    });
    Ok(modules.collect::<String>().into_bytes())
}

/// Returns the part of a name, the end of a name, or a function.
fn found(name: &str) -> Result<&'static Part> {
    let ends = |part: &&Part| part.name().strip_suffix(name).is_some_and(|rest| rest.ends_with('/'));
    let exact = |part: &&Part| part.name() == name || part.names().any(|function| function == name);
    let mut fitting: Vec<&Part> = parts().filter(|part| exact(part)).collect();
    if fitting.is_empty() {
        fitting = parts().filter(ends).collect();
    }
    let names = |parts: &[&Part]| parts.iter().map(|part| part.name()).collect::<Vec<_>>().join(", ");
    match fitting.as_slice() {
        [part] => Ok(part),
        [] => {
            let near: Vec<&Part> = parts().filter(|part| part.name().contains(name)).take(6).collect();
            Err(match near.is_empty() {
                true => format!("part `{name}` does not exist (`asperity shader` lists all parts)"),
                false => format!("part `{name}` does not exist (similar: {})", names(&near)),
            }
            .into())
        }
        several => Err(format!("part `{name}` is one of several: {}", names(several)).into()),
    }
}

/// Prints every part with its functions.
fn list() {
    for part in parts() {
        let functions: Vec<&str> = part.source().lines().filter_map(function).collect();
        progress::say(&format!("{:<44} {}", part.name(), functions.join(" ")));
    }
}

/// Returns the name of a function that a line defines.
fn function(line: &'static str) -> Option<&'static str> {
    line.strip_prefix("fn ")?.split_once('(').map(|(name, _)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_found_by_name_end_and_function() {
        for name in ["noise/kinds/perlin", "kinds/perlin", "perlin_noise_2d"] {
            assert_eq!(found(name).unwrap().name(), "noise/kinds/perlin", "{name}");
        }
        let error = |name| found(name).unwrap_err().to_string();
        assert!(error("perlim").starts_with("part `perlim` does not exist"), "{}", error("perlim"));
        assert!(error("perlin").starts_with("part `perlin` is one of several: "), "{}", error("perlin"));
        assert!(error("carp").contains("shading/material/carpet/carpet"), "{}", error("carp"));
    }

    #[test]
    fn every_part_is_written_in_every_text_language() {
        let all: Vec<&Part> = parts().collect();
        for part in all.iter().step_by(7) {
            let language = Language::GlslEs300;
            let glsl = text(&[part], language, Bindings::Textures { group: 0 });
            let glsl =
                String::from_utf8(glsl.unwrap_or_else(|error| panic!("{}: {error}", part.name()))).unwrap();
            let defined = part.source().lines().filter_map(function);
            for name in defined {
                assert!(glsl.contains(&format!(" {name}(")), "{}: {name} is missing", part.name());
            }
            assert!(!glsl.contains("void main(") && !glsl.contains("#version"), "{}", part.name());
        }
        for (language, mark) in [
            (Language::Hlsl, "float4"),
            (Language::Msl, "#include <metal_stdlib>"),
            (Language::NagaOil, "#import asperity::noise::"),
            (Language::Wesl, "import package::asperity::noise::"),
        ] {
            let carpet = text(&[found("carpet").unwrap()], language, Bindings::Buffers { group: 1 }).unwrap();
            assert!(String::from_utf8(carpet).unwrap().contains(mark), "{language:?}");
        }
        let spirv = text(&[found("kinds/perlin").unwrap()], Language::Spirv, Bindings::Textures { group: 0 })
            .unwrap();
        assert_eq!(spirv[..4], 0x0723_0203_u32.to_le_bytes());
    }
}
