//! `cargo xtask fuzz`: runs the libFuzzer targets and writes a table of their results.

use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::{fs, io};

use crate::cargo::{cargo, run};
use crate::cli::Fuzz;
use crate::failure::Failure;
use crate::report::{say, write};

/// Flags for the coverage that libFuzzer uses.
///
/// They are flags of LLVM, so that no nightly toolchain is needed. `fuzzing` makes readers ignore
/// checksums.
const FLAGS: &str = "-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=3 \
                     -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
                     --cfg fuzzing";
/// Flags for the constants that inputs are compared with, for readers only.
///
/// Numeric targets compare with no constants, and would be 1.5 to 8 times slower.
const COMPARES: &str = " -Cllvm-args=-sanitizer-coverage-trace-compares";
/// The fuzz targets that read files or text.
const READERS: [&str; 7] = ["png", "exr", "picture", "mesh", "gltf", "json", "words"];
/// An input that takes this many seconds is a finding. The machine may run other programs.
const TIMEOUT: u32 = 10;
const MIB: u32 = 2048;
const TABLE: &str = "target/asperity/fuzz.md";

/// The results of a fuzz target.
struct Run {
    fuzz_target: String,
    executions: u64,
    per_second: u64,
    seconds: u64,
    slowest: u64,
    memory: u64,
    /// The line of a finding, and the file of the input that reproduces it.
    finding: Option<String>,
}

/// Builds the fuzz targets and runs each for the given time.
pub(crate) fn fuzz(wanted: &Fuzz, root: &Path) -> Result<(), Failure> {
    let (folder, target) = (root.join("tests/fuzz"), host()?);
    let (corpus, findings) = (folder.join("target/corpus"), folder.join("target/findings"));
    fs::create_dir_all(&findings)?;
    let mut fuzz_targets = fuzz_targets(&folder.join("targets"))?;
    fuzz_targets.retain(|fuzz_target| {
        wanted.only.is_empty() || wanted.only.iter().any(|name| fuzz_target.contains(&**name))
    });
    if fuzz_targets.is_empty() {
        return Err(format!("no fuzz target matches `{}`", wanted.only.join("`, `")).into());
    }
    let is_reader = |fuzz_target: &String| READERS.contains(&&**fuzz_target);
    for readers in [true, false] {
        let words = fuzz_targets.iter().filter(|fuzz_target| is_reader(fuzz_target) == readers);
        let words: String = words.map(|fuzz_target| format!(" --bin {fuzz_target}")).collect();
        if !words.is_empty() {
            let words = format!("build --release --locked --features limits --target {target}{words}");
            let flags = FLAGS.to_owned() + if readers { COMPARES } else { "" };
            run(cargo(&folder, &words).env("RUSTFLAGS", flags).env_remove("CARGO_TARGET_DIR"))?;
        }
    }
    let programs = folder.join("target").join(target).join("release");
    let mut runs = Vec::new();
    for fuzz_target in fuzz_targets {
        say(&format!("{fuzz_target}, for {} s", wanted.seconds));
        let (mut program, seeds) = (Command::new(programs.join(&fuzz_target)), corpus.join(&fuzz_target));
        fs::create_dir_all(&seeds)?;
        program
            .env("SEEDS", &seeds)
            .arg(seeds)
            .args([
                format!("-max_total_time={}", wanted.seconds),
                format!("-runs={}", wanted.runs.map_or(-1, i64::from)),
                format!("-artifact_prefix={}/{fuzz_target}-", findings.display()),
                format!("-timeout={TIMEOUT}"),
                format!("-rss_limit_mb={MIB}"),
                "-max_len=4096".into(),
                "-print_final_stats=1".into(),
            ])
            .stdin(Stdio::null());
        let output = program.output()?;
        let output_text = String::from_utf8_lossy(&output.stderr);
        let run = Run::read(fuzz_target, &output_text, !output.status.success());
        say(&run.row());
        runs.push(run);
    }
    if wanted.ship {
        write(&root.join(TABLE), table(&runs).as_bytes())?;
    }
    let found = runs.iter().filter(|run| run.finding.is_some()).count();
    if found > 0 {
        return Err(format!("{found} fuzz targets failed; their inputs are in {}", findings.display()).into());
    }
    Ok(())
}

/// The target of this machine.
fn host() -> Result<String, Failure> {
    let output = Command::new("rustc").args(["--print", "host-tuple"]).output()?;
    Ok(String::from_utf8(output.stdout)?.trim().to_owned())
}

/// Lists the fuzz targets, sorted by name.
fn fuzz_targets(targets: &Path) -> io::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(targets)? {
        names.extend(entry?.path().file_stem().map(|name| name.to_string_lossy().into_owned()));
    }
    names.sort();
    Ok(names)
}

impl Run {
    /// Parses the output of libFuzzer.
    fn read(fuzz_target: String, output_text: &str, failed: bool) -> Self {
        let number = |name: &str| {
            let line = output_text.lines().find_map(|line| line.strip_prefix(name))?;
            line.trim().parse::<u64>().ok()
        };
        let (executions, per_second) =
            (number("stat::number_of_executed_units:"), number("stat::average_exec_per_sec:"));
        let (executions, per_second) = (executions.unwrap_or(0), per_second.unwrap_or(0));
        let markers = ["panicked at", "ERROR: libFuzzer", "memory allocation of"];
        let line = output_text.lines().find(|line| markers.iter().any(|word| line.contains(word)));
        Self {
            fuzz_target,
            executions,
            per_second,
            seconds: executions.checked_div(per_second).unwrap_or(0),
            slowest: number("stat::slowest_unit_time_sec:").unwrap_or(0),
            memory: number("stat::peak_rss_mb:").unwrap_or(0),
            finding: failed.then(|| line.unwrap_or("it ended by itself").trim().replace('|', "/")),
        }
    }

    /// A row of the table.
    fn row(&self) -> String {
        let Self { fuzz_target, executions, per_second, seconds, slowest, memory, finding } = self;
        let finding = finding.as_deref().unwrap_or("none");
        format!(
            "| {fuzz_target} | {executions} | {per_second} | {seconds} | {slowest} | {memory} | {finding} |"
        )
    }
}

fn table(runs: &[Run]) -> String {
    let mut page = String::from(
        "# Fuzzing\n\n\
         | fuzz target | executions | per second | seconds | slowest (s) | memory (MiB) | finding |\n|---|---|---|---|---|---|---|\n",
    );
    for run in runs {
        let _ = writeln!(page, "{}", run.row());
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readers_are_fuzz_targets() {
        let all = fuzz_targets(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/fuzz/targets")).unwrap();
        assert!(READERS.iter().all(|name| all.iter().any(|fuzz_target| fuzz_target == name)), "{all:?}");
    }

    #[test]
    fn what_the_fuzzer_says_becomes_a_row() {
        let good = "stat::number_of_executed_units: 120\nstat::average_exec_per_sec:     40\n\
                    stat::slowest_unit_time_sec:    1\nstat::peak_rss_mb:              77\n";
        assert_eq!(Run::read("png".into(), good, false).row(), "| png | 120 | 40 | 3 | 1 | 77 | none |");
        let bad = format!("thread panicked at src/a.rs:3:4:\n{good}");
        let row = Run::read("png".into(), &bad, true).row();
        assert!(row.ends_with("| thread panicked at src/a.rs:3:4: |"), "{row}");
        assert!(Run::read("png".into(), "", true).row().contains("by itself"));
    }
}
