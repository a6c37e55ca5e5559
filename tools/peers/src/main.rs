//! Times Asperity's noises and other libraries side by side, and prints a table.

mod arrays;
mod asperity;
#[cfg(feature = "fastnoise2")]
mod fastnoise2;
mod inputs;
mod libraries;
mod machine;
mod measure;
mod row;
mod scalar;
#[cfg(target_arch = "x86_64")]
mod simdnoise_rs;
mod table;
mod times;

use std::{error::Error, fs, io::Write, path::PathBuf, process::ExitCode};

use clap::Parser;

use measure::Contender;
use row::Row;
use times::Times;

/// Measure noises of several libraries side by side and print the ratios.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask peers", bin_name = "cargo xtask peers")]
struct Cli {
    /// Measure only the rows whose names contain NAME. Repeatable.
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// List the rows and exit.
    #[arg(long)]
    list: bool,
    /// Rounds per contender.
    #[arg(long, default_value_t = 21, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    rounds: u32,
    /// Distance of grid points in lattice cells.
    #[arg(long, default_value_t = 0.05)]
    step: f32,
    /// Write all times to this Markdown file.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

fn main() -> ExitCode {
    match run(&Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(cli: &Cli) -> Result<(), Box<dyn Error>> {
    let rows = chosen(&cli.only)?;
    let mut out = std::io::stdout().lock();
    if cli.list {
        for row in rows {
            writeln!(out, "{row}")?;
        }
        return Ok(());
    }
    if !(cli.step.is_finite() && cli.step > 0.0) {
        return Err(format!("step must be a positive number, got {}", cli.step).into());
    }
    let mut measured = Vec::new();
    for (index, &row) in rows.iter().enumerate() {
        writeln!(std::io::stderr(), "{:>2}/{} {row}", index + 1, rows.len())?;
        let mut contenders = contenders(row, cli.step);
        let times = measure::rounds(&mut contenders, cli.rounds);
        let timed = contenders.iter().zip(times).map(|(contender, nanoseconds)| times::Contender {
            library: contender.library.to_owned(),
            version: version(contender.library).to_owned(),
            level: contender.level.to_owned(),
            nanoseconds,
        });
        measured.push(times::Row { name: row.to_string(), contenders: timed.collect() });
    }
    let times = Times { step: cli.step, rounds: cli.rounds, rows: measured };
    writeln!(out, "{}", table::ratios(&times))?;
    if let Some(file) = &cli.out {
        fs::write(file, table::markdown(&machine::facts(library().as_deref()), &times))?;
    }
    Ok(())
}

fn chosen(only: &[String]) -> Result<Vec<Row>, String> {
    let rows = row::all();
    let fits = |word: &String, row: &Row| row.to_string().contains(word.as_str());
    if let Some(word) = only.iter().find(|word| !rows.iter().any(|row| fits(word, row))) {
        let names: Vec<_> = rows.iter().map(Row::to_string).collect();
        return Err(format!("no row matches `{word}` (available: {})", names.join(", ")));
    }
    Ok(rows.into_iter().filter(|row| only.is_empty() || only.iter().any(|word| fits(word, row))).collect())
}

/// Returns every contender that supports a row.
fn contenders(row: Row, step: f32) -> Vec<Contender> {
    let mut all = asperity::contenders(row, step);
    #[cfg(feature = "fastnoise2")]
    all.extend(fastnoise2::contenders(row, step));
    #[cfg(target_arch = "x86_64")]
    all.extend(simdnoise_rs::contenders(row, step));
    all.extend(libraries::ALL.iter().filter_map(|contender| contender(row, step)));
    all
}

/// Returns the static library of FastNoise2, if it is measured.
fn library() -> Option<PathBuf> {
    let folder =
        PathBuf::from(std::env::var_os("FASTNOISE2_LIB_DIR").filter(|_| cfg!(feature = "fastnoise2"))?);
    ["libFastNoise.a", "FastNoise.lib"].map(|name| folder.join(name)).into_iter().find(|file| file.is_file())
}

/// Returns the version in the lockfile.
fn version(library: &str) -> &'static str {
    let package = match library {
        "asperity" => "asperity-noise",
        "fastnoise2" => "fastnoise2-sys",
        other => other,
    };
    let head = format!("name = \"{package}\"\nversion = \"");
    let after = include_str!("../Cargo.lock").split_once(&head).and_then(|(_, rest)| rest.split_once('"'));
    after.map_or("", |(version, _)| version)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn word_selects_rows_that_contain_it() {
        assert_eq!(chosen(&[]).unwrap(), row::all());
        let some = chosen(&["fill_grid/2-d".into()]).unwrap();
        assert_eq!(some.len(), 5, "{some:?}");
        assert!(chosen(&["worley".into()]).unwrap_err().contains("`worley`"));
    }

    #[test]
    fn every_row_has_running_contenders_with_versions() {
        for row in row::all() {
            let mut all = contenders(row, 0.05);
            assert!(all.len() >= 3, "{row}");
            for contender in &mut all {
                assert_ne!(version(contender.library), "", "{}", contender.library);
                (contender.pass)();
            }
        }
        assert_eq!(version("asperity"), env!("CARGO_PKG_VERSION"));
        assert_eq!(version("no-such-library"), "");
    }
}
