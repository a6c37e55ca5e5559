//! The machine on which times were measured.

use std::{fs, path::Path, process::Command, thread};

/// Returns one line per fact about this machine and the compilers; `library` is the static library
/// of FastNoise2, if measured.
pub(crate) fn facts(library: Option<&Path>) -> [String; 4] {
    let cpuinfo = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let cores = thread::available_parallelism().map_or(1, usize::from);
    [
        format!(
            "Processor: {}, {cores} cores; {}, {}",
            processor(&cpuinfo).unwrap_or("unknown processor"),
            std::env::consts::ARCH,
            std::env::consts::OS
        ),
        format!("Instructions: {}", instructions().join(", ")),
        format!("Rust: {}, for the target's baseline unless the code selects more", rustc()),
        library.map_or("FastNoise2: not measured".to_owned(), |path| {
            let compiler = compiler(&fs::read(path).unwrap_or_default());
            format!("FastNoise2: compiled with {}", compiler.as_deref().unwrap_or("unknown compiler"))
        }),
    ]
}

/// Returns the processor's name in `/proc/cpuinfo`.
fn processor(cpuinfo: &str) -> Option<&str> {
    cpuinfo
        .lines()
        .find_map(|line| line.strip_prefix("model name")?.split_once(':'))
        .map(|(_, name)| name.trim())
}

/// Relevant instruction sets.
#[cfg(target_arch = "x86_64")]
fn instructions() -> Vec<&'static str> {
    macro_rules! detected {
        ($($name:tt)*) => { [("sse2", true), $(($name, is_x86_feature_detected!($name))),*] };
    }
    let all = detected!["sse4.1" "sse4.2" "avx2" "fma" "avx512f" "avx512bw" "avx512dq" "avx512vl"];
    all.into_iter().filter(|(_, there)| *there).map(|(name, _)| name).collect()
}

#[cfg(not(target_arch = "x86_64"))]
fn instructions() -> Vec<&'static str> {
    vec!["the baseline"]
}

fn rustc() -> String {
    let program = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(program).arg("--version").output();
    let text = output.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    text.ok().filter(|text| !text.is_empty()).unwrap_or_else(|| "unknown rustc".to_owned())
}

/// Returns the compiler identification that GCC and Clang write to every object file.
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
    fn processor_name_is_read_once() {
        let text = "processor\t: 0\nvendor_id\t: X\nmodel name\t: Some CPU @ 3 GHz\nprocessor\t: 1\nmodel name\t: other\n";
        assert_eq!(processor(text), Some("Some CPU @ 3 GHz"));
        assert_eq!(processor("Features : neon"), None);
    }

    #[test]
    fn library_compiler_is_read() {
        let library = b"\x7fELF\0\0Debian clang version 19.1.7 (3)\0\x01";
        assert_eq!(compiler(library).unwrap(), "clang version 19.1.7 (3)");
        assert_eq!(
            compiler(b"\0GCC: (Debian 12.2.0-14) 12.2.0\0").unwrap(),
            "GCC: (Debian 12.2.0-14) 12.2.0"
        );
        assert_eq!(compiler(b"nothing"), None);
    }
}
