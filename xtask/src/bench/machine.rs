//! The machine that times were taken on.

use std::{fs, path::Path, process::Command, thread};

use serde::{Deserialize, Serialize};

/// The machine and the compilers, as far as they can be told.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Machine {
    pub(crate) processor: String,
    pub(crate) cores: usize,
    /// Families of instructions that matter here.
    pub(crate) features: Vec<String>,
    pub(crate) platform: String,
    pub(crate) rustc: String,
    /// Compiler of FastNoise2; `None` where it was not measured.
    pub(crate) fastnoise2: Option<String>,
}

impl Machine {
    /// This machine; `library` is the static library of FastNoise2, if it is measured.
    pub(crate) fn here(library: Option<&Path>) -> Self {
        let cpuinfo = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        Self {
            processor: processor(&cpuinfo).unwrap_or("unknown processor").to_owned(),
            cores: thread::available_parallelism().map_or(1, usize::from),
            features: features(),
            platform: format!("{}, {}", std::env::consts::ARCH, std::env::consts::OS),
            rustc: rustc(),
            fastnoise2: library.map(|path| {
                let bytes = fs::read(path).unwrap_or_default();
                compiler(&bytes).unwrap_or_else(|| "unknown compiler".to_owned())
            }),
        }
    }

    /// Lines of a list.
    pub(crate) fn lines(&self) -> Vec<String> {
        let mut lines = vec![
            format!("Processor: {}, {} cores; {}", self.processor, self.cores, self.platform),
            format!("Instructions: {}", self.features.join(", ")),
            format!("Rust: {}, for the target's baseline unless the code asks for more", self.rustc),
        ];
        lines.push(match &self.fastnoise2 {
            Some(compiler) => format!("FastNoise2: compiled with {compiler}"),
            None => "FastNoise2: not measured".to_owned(),
        });
        lines
    }
}

/// The processor's name in `/proc/cpuinfo`.
fn processor(cpuinfo: &str) -> Option<&str> {
    cpuinfo
        .lines()
        .find_map(|line| line.strip_prefix("model name")?.split_once(':'))
        .map(|(_, name)| name.trim())
}

#[cfg(target_arch = "x86_64")]
fn features() -> Vec<String> {
    let all = [
        ("sse4.1", is_x86_feature_detected!("sse4.1")),
        ("sse4.2", is_x86_feature_detected!("sse4.2")),
        ("avx2", is_x86_feature_detected!("avx2")),
        ("fma", is_x86_feature_detected!("fma")),
        ("avx512f", is_x86_feature_detected!("avx512f")),
        ("avx512bw", is_x86_feature_detected!("avx512bw")),
        ("avx512dq", is_x86_feature_detected!("avx512dq")),
        ("avx512vl", is_x86_feature_detected!("avx512vl")),
    ];
    let there = all.iter().filter(|(_, there)| *there).map(|(name, _)| (*name).to_owned());
    std::iter::once("sse2".to_owned()).chain(there).collect()
}

#[cfg(not(target_arch = "x86_64"))]
fn features() -> Vec<String> {
    vec!["the baseline".to_owned()]
}

fn rustc() -> String {
    let program = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(program).arg("--version").output();
    let text = output.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    text.ok().filter(|text| !text.is_empty()).unwrap_or_else(|| "unknown rustc".to_owned())
}

/// The mark that GCC and Clang leave in every object file.
fn compiler(library: &[u8]) -> Option<String> {
    const MARKS: [&[u8]; 2] = [b"clang version ", b"GCC: ("];
    let found =
        MARKS.iter().find_map(|mark| library.windows(mark.len()).position(|window| window == *mark))?;
    let printed = |byte: &u8| byte.is_ascii_graphic() || *byte == b' ';
    String::from_utf8(library[found..].iter().copied().take_while(printed).take(80).collect()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processor_is_named_once() {
        let text = "processor\t: 0\nvendor_id\t: X\nmodel name\t: Some CPU @ 3 GHz\nprocessor\t: 1\nmodel name\t: other\n";
        assert_eq!(processor(text), Some("Some CPU @ 3 GHz"));
        assert_eq!(processor("Features : neon"), None);
    }

    #[test]
    fn a_library_tells_its_compiler() {
        let library = b"\x7fELF\0\0Debian clang version 19.1.7 (3)\0\x01";
        assert_eq!(compiler(library).unwrap(), "clang version 19.1.7 (3)");
        assert_eq!(
            compiler(b"\0GCC: (Debian 12.2.0-14) 12.2.0\0").unwrap(),
            "GCC: (Debian 12.2.0-14) 12.2.0"
        );
        assert_eq!(compiler(b"nothing"), None);
    }
}
