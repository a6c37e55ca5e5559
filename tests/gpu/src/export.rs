//! Files of every case in every language.

use std::fs;
use std::path::Path;
use std::process::Command;

use asperity_shader_tests::case::Case;
use clap::ValueEnum;

use crate::dialect::{Checked, Dialect};
use crate::entry;

/// A validator and the files that it reads.
struct Tool {
    program: &'static str,
    /// Debian's package.
    package: &'static str,
    reads: &'static [(Dialect, &'static [&'static str])],
}

const TOOLS: [Tool; 2] = [
    Tool {
        program: "spirv-val",
        package: "spirv-tools",
        reads: &[
            (Dialect::Spirv, &["--target-env", "vulkan1.1"]),
            (Dialect::SpirvNoContraction, &["--target-env", "vulkan1.1"]),
        ],
    },
    Tool {
        program: "glslangValidator",
        package: "glslang-tools",
        reads: &[
            (Dialect::Glsl450, &[]),
            (Dialect::GlslEs300, &[]),
            (Dialect::GlslEs310, &[]),
            (
                Dialect::Hlsl,
                &["-D", "-V", "-S", "frag", "-e", "show_case", "--auto-map-bindings", "-o", "/dev/null"],
            ),
        ],
    },
];

/// Writes the cases in the languages, and has what is written read by the validators that are installed.
pub(crate) fn run(cases: &[Case], dialects: &[Dialect], out: &Path) -> Result<(), String> {
    let all = Dialect::value_variants();
    let dialects = if dialects.is_empty() { all } else { dialects };
    let mut refusals = vec![];
    for case in cases {
        let folder = out.join(folder_of(&case.name));
        let write = |file: &Path, data: &[u8]| {
            fs::write(file, data).map_err(|error| format!("cannot write {}: {error}", file.display()))
        };
        fs::create_dir_all(&folder).map_err(|error| format!("cannot write {}: {error}", folder.display()))?;
        let wgsl = case.wgsl() + entry::FRAGMENT;
        let checked = match Checked::new(&wgsl) {
            Ok(checked) => checked,
            Err(error) => {
                refusals.push(format!("{}: {error}", case.name));
                continue;
            }
        };
        for &dialect in dialects {
            match dialect.write(&checked) {
                Ok(data) => write(&folder.join(dialect.file()), &data)?,
                Err(error) => refusals.push(format!("{}: {dialect:?}: {error}", case.name)),
            }
        }
        for tool in &TOOLS {
            refusals.extend(tool.refusals(&folder, dialects));
        }
    }
    println!("{} functions in {} languages: {}", cases.len(), dialects.len(), out.display());
    for tool in &TOOLS {
        let read: Vec<&str> = tool
            .reads
            .iter()
            .filter(|(dialect, _)| dialects.contains(dialect))
            .map(|(dialect, _)| dialect.file())
            .collect();
        if !read.is_empty() {
            let Tool { program, package, .. } = tool;
            let files = read.join(", ");
            if tool.is_here() {
                println!("{program} read {files}");
            } else {
                println!("skipped: {program} is not installed (Debian's {package}); nothing read {files}");
            }
        }
    }
    if dialects.contains(&Dialect::Msl) {
        println!("{} is read by no validator: Apple's compiler only", Dialect::Msl.file());
    }
    refusals.iter().for_each(|line| println!("{line}"));
    if refusals.is_empty() { Ok(()) } else { Err(format!("{} shaders are refused", refusals.len())) }
}

/// A path of letters, digits, `_` and `/`; hyphens for all else.
fn folder_of(name: &str) -> String {
    let words = name.split(|c: char| !(c.is_ascii_alphanumeric() || "_/".contains(c)));
    words.filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
}

impl Tool {
    fn is_here(&self) -> bool {
        Command::new(self.program).arg("--version").output().is_ok()
    }

    /// Complaints about files that it does not accept; none where it is not installed.
    fn refusals(&self, folder: &Path, dialects: &[Dialect]) -> Vec<String> {
        let mut refusals = vec![];
        for (dialect, options) in self.reads.iter().filter(|(dialect, _)| dialects.contains(dialect)) {
            let file = folder.join(dialect.file());
            let Ok(output) = Command::new(self.program).args(*options).arg(&file).output() else { continue };
            if file.is_file() && !output.status.success() {
                let said = [output.stdout, output.stderr].concat();
                let said = String::from_utf8_lossy(&said);
                refusals.push(format!("{} refuses {}: {said}", self.program, file.display()));
            }
        }
        refusals
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_have_plain_names() {
        assert_eq!(folder_of("noise/sums/octaves, zoom 1 and 10⁴"), "noise/sums/octaves-zoom-1-and-10");
    }
}
