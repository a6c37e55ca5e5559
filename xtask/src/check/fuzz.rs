//! `cargo xtask fuzz`: attacks on every constructor, evaluation and reader, by libFuzzer, and a table of what they found.

use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::{fs, io};

use crate::cargo::{cargo, run};
use crate::cli::Fuzz;
use crate::failure::Failure;
use crate::report::{say, write};

/// Coverage that libFuzzer steers by. The flags are those of LLVM, so that no nightly toolchain is needed; `fuzzing` lets
/// readers pass over checksums.
const FLAGS: &str = "-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=3 \
                     -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
                     --cfg fuzzing";
/// The words that inputs are compared with, too: numbers have none to be found, and take 1.5 to 8 times as long with it.
const COMPARES: &str = " -Cllvm-args=-sanitizer-coverage-trace-compares";
/// The attacks that read files or text.
const READERS: [&str; 7] = ["png", "exr", "picture", "mesh", "gltf", "json", "words"];
/// Seconds from which on an input is a finding, on a machine that does other things beside.
const TIMEOUT: u32 = 10;
const MIB: u32 = 2048;
const TABLE: &str = "target/asperity/fuzz.md";

/// The figures of an attack.
struct Run {
    attack: String,
    executions: u64,
    per_second: u64,
    seconds: u64,
    slowest: u64,
    memory: u64,
    /// The line of a finding, and the file that is told to do it again.
    finding: Option<String>,
}

/// Builds the attacks and lets each run for a while.
pub(crate) fn fuzz(wanted: &Fuzz, root: &Path) -> Result<(), Failure> {
    let (folder, target) = (root.join("tests/fuzz"), host()?);
    let (corpus, findings) = (folder.join("target/corpus"), folder.join("target/findings"));
    fs::create_dir_all(&findings)?;
    let mut attacks = attacks(&folder.join("targets"))?;
    attacks
        .retain(|attack| wanted.only.is_empty() || wanted.only.iter().any(|name| attack.contains(&**name)));
    if attacks.is_empty() {
        return Err(format!("no attack's name contains `{}`", wanted.only.join("`, `")).into());
    }
    let is_reader = |attack: &String| READERS.contains(&&**attack);
    for readers in [true, false] {
        let words = attacks.iter().filter(|attack| is_reader(attack) == readers);
        let words: String = words.map(|attack| format!(" --bin {attack}")).collect();
        if !words.is_empty() {
            let words = format!("build --release --locked --features limits --target {target}{words}");
            let flags = FLAGS.to_owned() + if readers { COMPARES } else { "" };
            run(cargo(&folder, &words).env("RUSTFLAGS", flags).env_remove("CARGO_TARGET_DIR"))?;
        }
    }
    let programs = folder.join("target").join(target).join("release");
    let mut runs = Vec::new();
    for attack in attacks {
        say(&format!("{attack}, for {} s", wanted.seconds));
        let (mut program, seeds) = (Command::new(programs.join(&attack)), corpus.join(&attack));
        fs::create_dir_all(&seeds)?;
        program
            .env("SEEDS", &seeds)
            .arg(seeds)
            .args([
                format!("-max_total_time={}", wanted.seconds),
                format!("-runs={}", wanted.runs.map_or(-1, i64::from)),
                format!("-artifact_prefix={}/{attack}-", findings.display()),
                format!("-timeout={TIMEOUT}"),
                format!("-rss_limit_mb={MIB}"),
                "-max_len=4096".into(),
                "-print_final_stats=1".into(),
            ])
            .stdin(Stdio::null());
        let output = program.output()?;
        let said = String::from_utf8_lossy(&output.stderr);
        let run = Run::read(attack, &said, !output.status.success());
        say(&run.row());
        runs.push(run);
    }
    if wanted.ship {
        write(&root.join(TABLE), table(&runs).as_bytes())?;
    }
    let found = runs.iter().filter(|run| run.finding.is_some()).count();
    if found > 0 {
        return Err(format!("{found} attacks succeeded; {} has their inputs", findings.display()).into());
    }
    Ok(())
}

/// The target of this machine.
fn host() -> Result<String, Failure> {
    let output = Command::new("rustc").args(["--print", "host-tuple"]).output()?;
    Ok(String::from_utf8(output.stdout)?.trim().to_owned())
}

/// The names of all attacks, in order.
fn attacks(targets: &Path) -> io::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(targets)? {
        names.extend(entry?.path().file_stem().map(|name| name.to_string_lossy().into_owned()));
    }
    names.sort();
    Ok(names)
}

impl Run {
    /// From what libFuzzer said.
    fn read(attack: String, said: &str, failed: bool) -> Self {
        let number = |name: &str| {
            let line = said.lines().find_map(|line| line.strip_prefix(name))?;
            line.trim().parse::<u64>().ok()
        };
        let (executions, per_second) =
            (number("stat::number_of_executed_units:"), number("stat::average_exec_per_sec:"));
        let (executions, per_second) = (executions.unwrap_or(0), per_second.unwrap_or(0));
        let told = ["panicked at", "ERROR: libFuzzer", "memory allocation of"];
        let line = said.lines().find(|line| told.iter().any(|word| line.contains(word)));
        Self {
            attack,
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
        let Self { attack, executions, per_second, seconds, slowest, memory, finding } = self;
        let finding = finding.as_deref().unwrap_or("none");
        format!("| {attack} | {executions} | {per_second} | {seconds} | {slowest} | {memory} | {finding} |")
    }
}

fn table(runs: &[Run]) -> String {
    let mut page = String::from(
        "# Fuzzing\n\n\
         | attack | executions | a second | seconds | slowest, whole seconds | memory, MiB | found |\n|---|---|---|---|---|---|---|\n",
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
    fn readers_are_attacks() {
        let all = attacks(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/fuzz/targets")).unwrap();
        assert!(READERS.iter().all(|name| all.iter().any(|attack| attack == name)), "{all:?}");
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
