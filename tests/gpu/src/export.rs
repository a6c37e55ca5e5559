//! Exports every case in every language, and every part.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::{Mutex, PoisonError};

use asperity::cli::shader::Language;
use asperity::shader::language::Checked;
use asperity_shader_tests::case::Case;
use asperity_wgsl::{Bindings, Part, compose, ndf, noise, ordered};
use rayon::prelude::*;

use crate::dialect::{DIALECTS, file};
use crate::entry;

/// A validator and the files it reads.
struct Tool {
    program: &'static str,
    /// Debian package.
    package: &'static str,
    reads: &'static [(Language, &'static [&'static str])],
}

const TOOLS: [Tool; 2] = [
    Tool {
        program: "spirv-val",
        package: "spirv-tools",
        reads: &[(Language::Spirv, &["--target-env", "vulkan1.1"])],
    },
    Tool {
        program: "glslangValidator",
        package: "glslang-tools",
        reads: &[
            (Language::Glsl450, &[]),
            (Language::GlslEs300, &[]),
            (Language::GlslEs310, &[]),
            (Language::Hlsl, &["-D", "-V", "-S", "frag", "--auto-map-bindings", "-o", "/dev/null", "-e"]),
        ],
    },
];

/// The output folder, or the folder to compare.
struct Folder<'a> {
    out: &'a Path,
    /// Compare with existing files instead of writing.
    check: bool,
    refusals: Mutex<Vec<String>>,
}

/// A module, its entry point, and its folder.
type Shader = (String, String, &'static str);

impl Folder<'_> {
    fn refuse(&self, what: String) {
        self.refusals.lock().unwrap_or_else(PoisonError::into_inner).push(what);
    }

    fn put(&self, file: &str, data: &[u8]) -> Result<(), String> {
        let path = self.out.join(file);
        if self.check {
            match fs::read(&path) {
                Ok(there) if there == data => {}
                Ok(_) => self.refuse(format!("{} is stale", path.display())),
                Err(_) => self.refuse(format!("{} is missing", path.display())),
            }
            return Ok(());
        }
        crate::write(&path, data)
    }

    /// Writes a shader in the given languages, and validates the output with the installed
    /// validators.
    fn shader(&self, (folder, wgsl, entry): &Shader, dialects: &[Language]) -> Result<(), String> {
        let checked = match Checked::shader(wgsl, entry) {
            Ok(checked) => checked,
            Err(error) => {
                self.refuse(format!("{folder}: {error}"));
                return Ok(());
            }
        };
        for &dialect in dialects {
            match checked.write(dialect) {
                Ok(data) => self.put(&format!("{folder}/{}", file(dialect)), &data)?,
                Err(error) => self.refuse(format!("{folder}: {dialect:?}: {error}")),
            }
        }
        if !self.check {
            for tool in &TOOLS {
                let refused = tool.refusals(&self.out.join(folder), entry, dialects);
                refused.into_iter().for_each(|what| self.refuse(what));
            }
        }
        Ok(())
    }
}

/// Writes the cases in the languages with the words of their bindings, and the parts as modules for
/// Bevy, and runs the installed validators. With `check`, compares with the files on disk.
pub(crate) fn run(cases: &[Case], dialects: &[Language], out: &Path, check: bool) -> Result<(), String> {
    let dialects = if dialects.is_empty() { &DIALECTS } else { dialects };
    let folder = Folder { out, check, refusals: Mutex::default() };
    cases.par_iter().try_for_each(|case| {
        let (place, wgsl) = (folder_of(&case.name), case.wgsl());
        for (name, words) in &case.resources {
            folder.put(&format!("{place}/{name}.bin"), bytemuck::cast_slice(words))?;
        }
        // Engines that load compute SPIR-V expect this name.
        let compute = wgsl.clone() + &entry::COMPUTE.replace("run_case", "main");
        let compute = Checked::shader(&compute, "main").and_then(|checked| checked.write(Language::Spirv));
        match compute {
            Ok(compute) => folder.put(&format!("{place}/compute.spv"), &compute)?,
            Err(error) => folder.refuse(format!("{place}: {error}")),
        }
        folder.shader(&(place, wgsl + entry::FRAGMENT, "show_case"), dialects)
    })?;
    let parts: BTreeMap<&str, &'static Part> = cases
        .iter()
        .flat_map(|case| ordered(&case.parts))
        // The interpreter does not support their samplers.
        .chain([&noise::MIP_MAPPED, &ndf::NORMAL_TABLE_FILTERED])
        .map(|part| (part.name(), part))
        // Parts used only by a case are not exported.
        .filter(|(name, part)| !part.source().is_empty() && !name.starts_with("case/"))
        .collect();
    for (name, part) in &parts {
        folder.put(&format!("parts/{name}/bevy.wgsl"), bevy(part).as_bytes())?;
    }
    let count = parts.len();
    let mut refusals = folder.refusals.into_inner().unwrap_or_else(PoisonError::into_inner);
    refusals.sort_unstable();
    if check {
        refusals.iter().for_each(|line| println!("{line}"));
        return match refusals.len() {
            0 => {
                println!("{} functions and {count} parts are up to date in {}", cases.len(), out.display());
                Ok(())
            }
            faults => {
                Err(format!("{faults} files are missing or stale (run `cargo xtask shaders` to write them)"))
            }
        };
    }
    println!(
        "{} functions and {count} parts in {} languages: {}",
        cases.len(),
        dialects.len(),
        out.display()
    );
    say_who_read(dialects);
    refusals.iter().for_each(|line| println!("{line}"));
    if refusals.is_empty() { Ok(()) } else { Err(format!("{} shaders are invalid", refusals.len())) }
}

/// Returns a part with its dependencies as a module for `naga_oil`, which Bevy imports.
fn bevy(part: &'static Part) -> String {
    let import = format!("#define_import_path asperity::{}\n", part.name().replace('/', "::"));
    let module = compose(&[part], Bindings::Textures { group: 0 });
    import + &module.replace("@group(0)", "@group(#{MATERIAL_BIND_GROUP})")
}

/// Prints a line for each validator, and for each language without one.
fn say_who_read(dialects: &[Language]) {
    for tool in &TOOLS {
        let read: Vec<&str> = tool
            .reads
            .iter()
            .filter(|(dialect, _)| dialects.contains(dialect))
            .map(|(dialect, _)| file(*dialect))
            .collect();
        if !read.is_empty() {
            let Tool { program, package, .. } = tool;
            let files = read.join(", ");
            if tool.is_here() {
                println!("{program} read {files}");
            } else {
                println!("skipped {files}: {program} is not installed (Debian package {package})");
            }
        }
    }
    if dialects.contains(&Language::Msl) {
        println!("untested: {} requires Apple's compiler", file(Language::Msl));
    }
}

/// Returns a path of letters, digits, `_` and `/`; other characters become hyphens.
fn folder_of(name: &str) -> String {
    let words = name.split(|c: char| !(c.is_ascii_alphanumeric() || "_/".contains(c)));
    words.filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
}

impl Tool {
    fn is_here(&self) -> bool {
        Command::new(self.program).arg("--version").output().is_ok()
    }

    /// Returns errors for files that the validator rejects, or nothing if it is not installed.
    fn refusals(&self, folder: &Path, entry: &str, dialects: &[Language]) -> Vec<String> {
        let mut refusals = vec![];
        for (dialect, options) in self.reads.iter().filter(|(dialect, _)| dialects.contains(dialect)) {
            let path = folder.join(file(*dialect));
            // The last HLSL option takes the entry point's name.
            let entry = (*dialect == Language::Hlsl).then_some(entry);
            let mut read = Command::new(self.program);
            let Ok(output) = read.args(*options).args(entry).arg(&path).output() else { continue };
            if path.is_file() && !output.status.success() {
                let said = [output.stdout, output.stderr].concat();
                let said = String::from_utf8_lossy(&said);
                refusals.push(format!("{} rejects {}: {said}", self.program, path.display()));
            }
        }
        refusals
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folder_names_are_plain() {
        assert_eq!(folder_of("noise/sums/octaves, zoom 1 and 10⁴"), "noise/sums/octaves-zoom-1-and-10");
    }
}
