//! Toolchains for other targets.

use std::{ffi::OsString, path::Path, path::PathBuf, process::Command};

use asperity_output::cargo::cargo_program;

/// An emulated machine.
pub(crate) struct Emulated {
    pub(crate) target: &'static str,
    /// The emulator and its arguments, before the program.
    pub(crate) runner: &'static str,
}

/// Arm's board MPS2 with the image AN386: a Cortex-M4 with a single-precision FPU.
pub(crate) const CORTEX_M4: Emulated = Emulated {
    target: "thumbv7em-none-eabihf",
    runner: "qemu-system-arm -cpu cortex-m4 -machine mps2-an386 -nographic -semihosting-config enable=on,target=native -kernel",
};

/// A cargo and a rustc for a target.
pub(crate) struct Toolchain {
    pub(crate) cargo: OsString,
    rustc: OsString,
    /// Whether core must be built from sources.
    pub(crate) builds_core: bool,
}

impl Toolchain {
    /// Returns the toolchain that runs this program or the system's toolchain, whichever has the
    /// libraries of a target. Otherwise returns a toolchain with the sources, if a linker is
    /// available.
    pub(crate) fn of(target: &str, has_linker: bool) -> Option<Self> {
        let candidates = [own(), ("/usr/bin/cargo".into(), "/usr/bin/rustc".into())];
        candidates.into_iter().find_map(|(cargo, rustc)| {
            let libraries = print(&rustc, &["target-libdir", "--target", target])?;
            let sysroot = print(&rustc, &["sysroot"])?;
            let has_core = Path::new(&libraries).read_dir().is_ok_and(|mut files| {
                files.any(|file| file.is_ok_and(|f| f.file_name().to_string_lossy().starts_with("libcore")))
            });
            let has_sources = Path::new(&sysroot).join("lib/rustlib/src/rust/library/core").is_dir();
            (has_core || has_sources && has_linker).then_some(Self { cargo, rustc, builds_core: !has_core })
        })
    }

    /// Returns a build command in a folder for a target. These Rust libraries are built if only
    /// their sources exist.
    pub(crate) fn build(&self, folder: &Path, target: &str, libraries: &str) -> Command {
        self.command("build", folder, target, libraries)
    }

    /// Returns a check command in a folder for a target, like [`build`](Self::build) without a
    /// linker.
    pub(crate) fn check(&self, folder: &Path, target: &str, libraries: &str) -> Command {
        self.command("check", folder, target, libraries)
    }

    fn command(&self, verb: &str, folder: &Path, target: &str, libraries: &str) -> Command {
        let mut build = Command::new(&self.cargo);
        build
            .args([verb, "--quiet", "--locked", "--release", "--target", target])
            .current_dir(folder)
            .env("RUSTC", &self.rustc)
            .env_remove("RUSTUP_TOOLCHAIN")
            .env_remove("CARGO_TARGET_DIR");
        if self.builds_core {
            build.arg(format!("-Zbuild-std={libraries}")).env("RUSTC_BOOTSTRAP", "1");
        }
        build
    }
}

/// Returns the linker included in rustup toolchains, for targets that need no other.
pub(crate) fn rust_lld() -> Option<PathBuf> {
    let linker = tools()?.join(format!("rust-lld{}", std::env::consts::EXE_SUFFIX));
    linker.is_file().then_some(linker)
}

/// Returns the folder of tools included in this program's toolchain.
pub(crate) fn tools() -> Option<PathBuf> {
    let rustc = rustc();
    let (sysroot, host) = (print(&rustc, &["sysroot"])?, print(&rustc, &["host-tuple"])?);
    Some(Path::new(&sysroot).join(format!("lib/rustlib/{host}/bin")))
}

/// Returns the rustc of the cargo that runs this program.
pub(crate) fn rustc() -> OsString {
    own().1
}

/// Whether a program is installed.
pub(crate) fn is_there(program: &str) -> bool {
    output(Command::new(program).arg("--version")).is_some()
}

/// Returns the output of a command, if it runs and succeeds.
pub(crate) fn output(command: &mut Command) -> Option<String> {
    let output = command.output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// Returns the cargo that runs this program, and its rustc.
fn own() -> (OsString, OsString) {
    let cargo = cargo_program();
    let rustc = Path::new(&cargo).with_file_name("rustc").into_os_string();
    (cargo, rustc)
}

fn print(rustc: &OsString, what: &[&str]) -> Option<String> {
    output(Command::new(rustc).arg("--print").args(what))
}
