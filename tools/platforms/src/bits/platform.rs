//! The platforms on which the bit probe runs: this machine, an emulator, or Node.js.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::report::Report;
use crate::failure::Result;
use crate::toolchain::{CORTEX_M4, Toolchain, is_there, rust_lld};
use asperity_output::cargo::{cargo, run};

/// A platform with its digests, or the reason why there are none.
pub(super) struct Column {
    pub(super) title: &'static str,
    pub(super) how: String,
    pub(super) report: Result<Report, String>,
}

/// Widths of x86-64 SIMD in increasing order: display name, crate name, and an emulated processor.
const LANES: [(&str, &str, Option<&str>); 4] = [
    ("x86-64, SSE2", "sse2", Some("qemu64")),
    ("x86-64, SSE4.2", "sse2", Some("Nehalem")),
    ("x86-64, AVX2", "avx2", Some("Haswell")),
    ("x86-64, AVX-512", "avx512", None),
];
const X86: &str = "qemu-x86_64";

/// A platform of a cross compiler.
struct Foreign {
    title: &'static str,
    target: &'static str,
    level: &'static str,
    flags: &'static str,
    linker: Linker,
    /// Program and arguments before the probe.
    runner: &'static str,
    /// Folder of its builds.
    folder: &'static str,
    /// Whether the CI check runs this platform.
    often: bool,
}

/// The linker, and when it is required.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Linker {
    /// Toolchains with target libraries include a linker. With sources only, this one is required.
    Lld(&'static str),
    /// The linker included in rustup toolchains.
    RustLld,
    /// Always this one, with another system's C library.
    Gcc(&'static str),
}

/// Linked with the C library of the linker.
const HOSTED: &str = "-C default-linker-libraries=yes";

const FOREIGN: [Foreign; 5] = [
    Foreign {
        title: "Cortex-M4",
        target: CORTEX_M4.target,
        level: "scalar",
        flags: "-C link-arg=-Tlink.x",
        linker: Linker::Lld("ld.lld"),
        runner: CORTEX_M4.runner,
        folder: "target/cortex-m4",
        often: false,
    },
    Foreign {
        title: "AArch64",
        target: "aarch64-unknown-linux-gnu",
        level: "neon",
        flags: HOSTED,
        linker: Linker::Gcc("aarch64-linux-gnu-gcc"),
        runner: "qemu-aarch64 -L /usr/aarch64-linux-gnu",
        folder: "target/aarch64",
        often: false,
    },
    Foreign {
        // Not s390x: qemu 7.2 computes the product of two single-precision numbers to double
        // precision incorrectly there (MDEBR).
        title: "PowerPC, big-endian",
        target: "powerpc64-unknown-linux-gnu",
        level: "scalar",
        flags: HOSTED,
        linker: Linker::Gcc("powerpc64-linux-gnu-gcc"),
        runner: "qemu-ppc64 -L /usr/powerpc64-linux-gnu",
        folder: "target/powerpc64",
        often: false,
    },
    Foreign {
        title: "wasm32",
        target: "wasm32-unknown-unknown",
        level: "scalar",
        flags: "",
        linker: Linker::RustLld,
        runner: "node run.mjs",
        folder: "target/wasm",
        often: false,
    },
    Foreign {
        title: "wasm32, SIMD128",
        target: "wasm32-unknown-unknown",
        level: "wasm128",
        flags: "-C target-feature=+simd128",
        linker: Linker::RustLld,
        runner: "node run.mjs",
        folder: "target/wasm128",
        often: true,
    },
];

/// Runs every platform in order, or only those of the CI check. A missing tool is noted in its
/// column. A failure of an available platform is an error.
pub(super) fn columns(folder: &Path, all: bool) -> Result<Vec<Column>> {
    let mut columns = here(folder)?;
    for platform in FOREIGN.iter().filter(|platform| all || platform.often) {
        columns.push(platform.column(folder)?);
    }
    Ok(columns)
}

/// Runs this machine at its SIMD width and at smaller widths.
fn here(folder: &Path) -> Result<Vec<Column>> {
    let mut build = cargo(folder, "build --quiet --release --locked --bin bits --features std,libm");
    build.args(["--target-dir", "target/libm"]).env_remove("RUSTFLAGS");
    run(&mut build).map_err(|error| format!("the probe of bits: {error}"))?;
    let program = folder.join(format!("target/libm/release/bits{}", std::env::consts::EXE_SUFFIX));
    let own = said("here", &mut Command::new(&program))?;
    let emulated = is_there(X86);
    let mut columns = Vec::new();
    for (title, level, processor) in LANES {
        let (how, report) = match processor {
            _ if cfg!(not(target_arch = "x86_64")) => {
                (String::new(), Err("this machine is not x86-64".to_owned()))
            }
            _ if own.level == level => ("on this machine".into(), Ok(own.clone())),
            Some(processor) if emulated => {
                let report = said(title, Command::new(X86).args(["-cpu", processor]).arg(&program))?;
                expect(title, &report, level)?;
                (format!("{X86} as a {processor}"), Ok(report))
            }
            Some(_) => (String::new(), Err(format!("{X86} is not installed"))),
            None => (String::new(), Err("not available on this machine or in an emulator".to_owned())),
        };
        columns.push(Column { title, how, report });
    }
    if !LANES.iter().any(|(_, level, _)| own.level == *level) {
        let how = format!("on this machine, {}", std::env::consts::ARCH);
        columns.push(Column { title: "this machine", how, report: Ok(own) });
    }
    Ok(columns)
}

impl Foreign {
    fn column(&self, folder: &Path) -> Result<Column> {
        let mut runner = self.runner.split(' ');
        let program = runner.next().unwrap_or_default();
        let report = match self.missing(program) {
            Some(why) => Err(why),
            None => {
                let built = self.build(folder)?;
                let report =
                    said(self.title, Command::new(program).args(runner).arg(built).current_dir(folder))?;
                expect(self.title, &report, self.level)?;
                Ok(report)
            }
        };
        let how = format!("{program}, {}, without std", self.target);
        Ok(Column { title: self.title, how, report })
    }

    fn toolchain(&self) -> Option<Toolchain> {
        let has_linker = match self.linker {
            Linker::Lld(name) | Linker::Gcc(name) => is_there(name),
            Linker::RustLld => rust_lld().is_some(),
        };
        Toolchain::of(self.target, has_linker)
    }

    /// Returns the first missing tool, for display.
    fn missing(&self, program: &str) -> Option<String> {
        if self.toolchain().is_none() {
            let target = self.target;
            return Some(format!("no toolchain for {target} (install with `rustup target add {target}`)"));
        }
        let gcc = if let Linker::Gcc(name) = self.linker { Some(name) } else { None };
        if let Some(name) = [Some(program), gcc].into_iter().flatten().find(|name| !is_there(name)) {
            return Some(format!("{name} is not installed"));
        }
        gcc.filter(|name| !has_c_library(name)).map(|name| format!("{name} has no C library to link with"))
    }

    fn build(&self, folder: &Path) -> Result<PathBuf> {
        let fail = |error: &dyn std::fmt::Display| format!("the probe of bits on {}: {error}", self.title);
        let toolchain = self.toolchain().ok_or_else(|| fail(&"no toolchain"))?;
        let mut build = toolchain.build(folder, self.target, "core,alloc");
        build.args(["--bin", "bits", "--features", "freestanding", "--target-dir", self.folder]);
        let mut flags = self.flags.to_owned();
        match self.linker {
            Linker::Lld(name) if toolchain.builds_core => {
                flags += &format!(" -C linker={name} -C linker-flavor={name}");
            }
            Linker::RustLld if toolchain.builds_core => {
                flags += &format!(" -C linker={}", rust_lld().unwrap_or_default().display());
            }
            Linker::Gcc(name) => flags += &format!(" -C linker={name}"),
            Linker::Lld(_) | Linker::RustLld => {}
        }
        run(build.env("RUSTFLAGS", flags.trim())).map_err(|error| fail(&error))?;
        let ending = if self.target.starts_with("wasm") { ".wasm" } else { "" };
        Ok(folder.join(self.folder).join(self.target).join(format!("release/bits{ending}")))
    }
}

/// Whether a C compiler finds the startup file, which is packaged separately.
fn has_c_library(gcc: &str) -> bool {
    let said = Command::new(gcc).arg("-print-file-name=crt1.o").output();
    said.is_ok_and(|said| is_found(&String::from_utf8_lossy(&said.stdout)))
}

/// For a file that a compiler does not find, it prints only the name.
fn is_found(said: &str) -> bool {
    let path = Path::new(said.trim());
    path.is_absolute() && path.is_file()
}

/// Returns the output of the probe.
fn said(title: &str, command: &mut Command) -> Result<Report> {
    let output = command.output()?;
    if !output.status.success() {
        let why = String::from_utf8_lossy(&output.stderr);
        let last = why.trim().lines().last().unwrap_or("no output").to_owned();
        return Err(format!("the probe of bits on {title} ended with {}: {last}", output.status).into());
    }
    Report::read(&String::from_utf8_lossy(&output.stdout))
}

/// Checks that a platform has the SIMD width of its column.
fn expect(title: &str, report: &Report, level: &str) -> Result<()> {
    if report.level == level {
        return Ok(());
    }
    Err(format!("the probe of bits on {title} reported SIMD level {} (expected {level})", report.level)
        .into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_c_library_is_detected() {
        let own = std::env::current_exe().unwrap();
        assert!(is_found(&format!("{}\n", own.display())));
        assert!(!is_found("crt1.o\n") && !is_found("") && !has_c_library("no-such-compiler"));
    }
}
