//! Programs for the microcontroller: built, emulated and inspected.

use std::path::{Path, PathBuf};
use std::process::Command;

use object::{Object, ObjectSection, ObjectSymbol};

use crate::failure::Result;
use crate::toolchain::{CORTEX_M4, Toolchain, is_there};
use asperity_output::cargo::run;

/// The toolchain and the emulator of a Cortex-M4.
pub(super) struct Device<'a> {
    folder: &'a Path,
    toolchain: Toolchain,
}

/// The firmware's image, its hash, its stack depth and its program.
pub(super) struct Drawn {
    pub(super) picture: Vec<u8>,
    pub(super) hash: String,
    pub(super) stack: u64,
    pub(super) program: Program,
}

/// The output of a program.
pub(super) struct Said {
    pub(super) picture: Vec<u8>,
    pub(super) errors: String,
}

/// A program's sections in bytes.
pub(super) struct Program {
    pub(super) code: u64,
    pub(super) constants: u64,
    pub(super) statics: u64,
}

/// The sections and the stack of a program with one function.
pub(super) struct Cost {
    pub(super) program: Program,
    pub(super) stack: u64,
}

/// Parts of mangled names of functions that a program contains only if something in it may panic.
/// The handler itself belongs to the program.
const PANICS: [&str; 4] = ["9panicking", "unwrap_failed", "expect_failed", "slice_index_fail"];

impl<'a> Device<'a> {
    /// Returns the device, or the name of a missing tool.
    pub(super) fn find(folder: &'a Path) -> Result<Self, String> {
        let target = CORTEX_M4.target;
        let toolchain = Toolchain::of(target, is_there("ld.lld")).ok_or_else(|| {
            format!("no toolchain for {target} (install with `rustup target add {target}`)")
        })?;
        let emulator = CORTEX_M4.runner.split(' ').next().unwrap_or_default();
        if is_there(emulator) {
            Ok(Self { folder, toolchain })
        } else {
            Err(format!("{emulator} is not installed"))
        }
    }

    /// Builds a program with a feature and returns its path.
    pub(super) fn build(&self, name: &str, feature: &str) -> Result<PathBuf> {
        let mut build = self.toolchain.build(self.folder, CORTEX_M4.target, "core");
        build.args(["--bin", name, "--features", feature]);
        let mut flags = String::from("-C link-arg=-Tlink.x");
        if self.toolchain.builds_core {
            flags += " -C linker=ld.lld -C linker-flavor=ld.lld";
        }
        run(build.env("RUSTFLAGS", flags)).map_err(|error| format!("the firmware: {error}"))?;
        Ok(self.folder.join("target").join(CORTEX_M4.target).join("release").join(name))
    }

    pub(super) fn run(&self, program: &Path) -> Result<Said> {
        let mut words = CORTEX_M4.runner.split(' ');
        let mut emulator = Command::new(words.next().unwrap_or_default());
        let output = emulator.args(words).arg(program).output()?;
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        if !output.status.success() {
            let last = errors.trim().lines().last().unwrap_or("no output");
            return Err(format!("the firmware ended with {}: {last}", output.status).into());
        }
        Ok(Said { picture: output.stdout, errors })
    }

    /// Measures the cost of a feature's function.
    pub(super) fn cost(&self, feature: &str) -> Result<Cost> {
        let program = self.build("cost", feature)?;
        let said = self.run(&program)?;
        let stack = u64::from_str_radix(word(&said.errors, "stack")?, 16)?;
        Ok(Cost { program: Program::read(&program)?, stack })
    }
}

impl Program {
    /// Reads the sections. Returns an error for symbols that only panics need.
    pub(super) fn read(path: &Path) -> Result<Self> {
        let bytes = std::fs::read(path)?;
        let file = object::File::parse(&*bytes).map_err(|error| format!("{}: {error}", path.display()))?;
        let size = |names: &[&str]| -> u64 {
            file.sections()
                .filter(|s| s.name().is_ok_and(|name| names.contains(&name)))
                .map(|s| s.size())
                .sum()
        };
        let mut panics =
            file.symbols().filter_map(|symbol| symbol.name().ok()).filter(|name| is_of_panics(name));
        if let Some(first) = panics.next() {
            let count = 1 + panics.count();
            return Err(format!("{}: {count} panic symbols, first `{first}`", path.display()).into());
        }
        Ok(Self { code: size(&[".text"]), constants: size(&[".rodata"]), statics: size(&[".data", ".bss"]) })
    }
}

fn is_of_panics(symbol: &str) -> bool {
    PANICS.iter().any(|part| symbol.contains(part))
}

/// Returns the word after a name, in lines of names and words.
pub(super) fn word<'a>(lines: &'a str, name: &str) -> Result<&'a str> {
    let words = lines.lines().find_map(|line| line.strip_prefix(name));
    words.map(str::trim).ok_or_else(|| format!("the firmware did not print {name}: {lines}").into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn word_finds_values_by_name() {
        assert_eq!(word("hash  0f\nstack 10\n", "stack").unwrap(), "10");
        assert!(word("hash 0f\n", "stack").is_err());
    }

    #[test]
    fn panic_symbols_are_recognized_except_the_handler() {
        assert!(is_of_panics("_ZN4core9panicking18panic_bounds_check17h0E"));
        assert!(is_of_panics("_RNvNtCs_4core9panicking9panic_fmt"));
        assert!(!is_of_panics("rust_begin_unwind") && !is_of_panics("_ZN8asperity4draw17h0E"));
    }

    #[test]
    fn program_that_may_panic_is_an_error() {
        // This test program panics on failure.
        let error = Program::read(&std::env::current_exe().unwrap()).err().unwrap().to_string();
        assert!(error.contains("panic symbols"), "{error}");
    }
}
