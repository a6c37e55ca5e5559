//! `cargo xtask coverage`: the lines of every crate that its tests and those of the workspace run, and what none of them runs.

mod lcov;
mod page;

use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

use cargo_metadata::Message;

use super::ci::CRATES;
use crate::cargo::{cargo, run};
use crate::cli::Coverage;
use crate::failure::Result;
use crate::report::{say, write};
use crate::toolchain::{output, rustc, tools};

/// The folder of its builds and counts, apart from others.
const TARGET: &str = "target/coverage";
/// Folder of the checked-in table.
const SHIPPED: &str = "docs/trust";
const PAGE: &str = "coverage.md";

/// Runs the tests of `wanted`, and prints or ships the table.
pub(crate) fn report(wanted: &Coverage, root: &Path) -> Result<()> {
    let tools = llvm()?;
    let packages = if wanted.tests_of.is_empty() {
        CRATES.into_iter().chain(["asperity-shaders", "asperity-tests"]).map(str::to_owned).collect()
    } else {
        wanted.tests_of.clone()
    };
    let profiles = root.join(TARGET).join("profiles");
    // What an earlier run counted would be taken for this one's.
    if profiles.is_dir() {
        std::fs::remove_dir_all(&profiles)?;
    }
    let compiler = std::env::current_exe()?;
    let tests = |more: &str| {
        let mut test = cargo(root, &format!("test --locked --tests {more}"));
        test.args(packages.iter().flat_map(|package| ["--package", package]))
            .env("RUSTC_WORKSPACE_WRAPPER", &compiler)
            .env("CARGO_TARGET_DIR", root.join(TARGET))
            .env("LLVM_PROFILE_FILE", profiles.join("%m-%p.profraw"));
        test
    };
    let programs = built(&mut tests("--no-run --message-format json-render-diagnostics"))?;
    run(&mut tests("--quiet"))?;
    let lcov = counted(&tools, &profiles, &programs)?;
    let crates = root.join("crates");
    let files =
        lcov::read(&lcov).into_iter().filter_map(|file| lcov::of_sources(&file, &crates)).collect::<Vec<_>>();
    let text = page::markdown(&packages, &files);
    say(&text);
    if wanted.ship {
        write(&root.join(SHIPPED).join(PAGE), text.as_bytes())?;
    }
    Ok(())
}

/// Compiles with counters where cargo runs this program in place of the compiler, as it does for the workspace's own packages.
///
/// With counters in the small functions of the packages beneath too, of lanes above all, the golden tests of the noise took more than 110 s
/// in place of 32.
pub(crate) fn compiled() -> Option<ExitCode> {
    let mut words = std::env::args_os().skip(1);
    let rustc =
        words.next().filter(|word| Path::new(word).file_stem().is_some_and(|name| name == "rustc"))?;
    let ended = Command::new(rustc).args(words).args(["-C", "instrument-coverage"]).status();
    Some(if ended.is_ok_and(|status| status.success()) { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// `llvm-profdata` and `llvm-cov` that read what this rustc's programs write.
fn llvm() -> Result<[PathBuf; 2]> {
    let version = output(Command::new(rustc()).arg("-vV")).ok_or("rustc does not run")?;
    let major = version.lines().find_map(|line| line.strip_prefix("LLVM version: ")?.split('.').next());
    let major = major.ok_or("rustc does not tell its version of LLVM")?;
    let find = |name: &str| {
        let own = tools().map(|folder| folder.join(format!("{name}{}", std::env::consts::EXE_SUFFIX)));
        let candidates = own.into_iter().chain([format!("{name}-{major}").into(), name.into()]);
        candidates.into_iter().find(|program: &PathBuf| {
            output(Command::new(program).arg("--version"))
                .is_some_and(|said| said.contains(&format!("LLVM version {major}.")))
        })
    };
    match ["llvm-profdata", "llvm-cov"].map(find) {
        [Some(profdata), Some(cov)] => Ok([profdata, cov]),
        _ => Err(format!(
            "coverage needs llvm-profdata and llvm-cov of LLVM {major}: `rustup component add llvm-tools`, or Debian's llvm-{major}"
        )
        .into()),
    }
}

/// Builds and returns the programs of the tests.
fn built(build: &mut Command) -> Result<Vec<PathBuf>> {
    let mut child = build.stdout(Stdio::piped()).spawn()?;
    let lines = BufReader::new(child.stdout.take().ok_or("cargo has no output")?);
    let mut programs = Vec::new();
    for message in Message::parse_stream(lines) {
        if let Message::CompilerArtifact(artifact) = message? {
            programs.extend(artifact.executable.map(PathBuf::from));
        }
    }
    if child.wait()?.success() { Ok(programs) } else { Err("the tests cannot be built".into()) }
}

/// The counts of all programs in the format of lcov.
fn counted([profdata, cov]: &[PathBuf; 2], profiles: &Path, programs: &[PathBuf]) -> Result<String> {
    let merged = profiles.join("merged.profdata");
    let raw = std::fs::read_dir(profiles)?.filter_map(|entry| Some(entry.ok()?.path()));
    run(Command::new(profdata).args(["merge", "-sparse", "-o"]).arg(&merged).args(raw))?;
    let mut export = Command::new(cov);
    export
        .args(["export", "--format=lcov", "--skip-branches", "--skip-functions", "--instr-profile"])
        .arg(&merged);
    export.args(programs.iter().flat_map(|program| ["--object".as_ref(), program.as_os_str()]));
    let exported = export.stderr(Stdio::inherit()).output()?;
    if exported.status.success() {
        Ok(String::from_utf8(exported.stdout)?)
    } else {
        Err("llvm-cov fails; what stands above says why".into())
    }
}
