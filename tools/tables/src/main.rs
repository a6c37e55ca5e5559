//! The program behind `cargo xtask tables`: writes the tables and images committed in the crates,
//! or compares them.

mod albedos;
#[cfg(test)]
mod documented;
mod glass_albedos;
mod noise_cdf;
mod noise_cellular;
mod noise_levels;
mod noise_means;
mod noise_pictures;
mod shipped;
mod spline;
mod visible_normals;

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use asperity_render::failure::Failure;

use shipped::say;

const HELP: &str = "Write the generated tables and images of the crates into the source tree.

Usage: cargo xtask tables [--check]

Options:
      --check  Compare the files in the source tree with newly generated ones without writing
  -h, --help   Print help";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match perform(&words.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(code) => code,
        Err(error) => {
            let _ = writeln!(io::stderr(), "error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn perform(words: &[&str]) -> Result<ExitCode, Failure> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    match words {
        [] => shipped::ship(root)?,
        ["--check"] => {
            shipped::check(root)?;
            say("generated tables are up to date");
        }
        ["-h" | "--help"] => say(HELP),
        _ => {
            let _ = writeln!(io::stderr(), "error: unexpected arguments\n\n{HELP}");
            return Ok(ExitCode::from(2));
        }
    }
    Ok(ExitCode::SUCCESS)
}
