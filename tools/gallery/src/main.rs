//! The program behind `cargo xtask gallery`: renders ten figures and a page, then the tables, the
//! other figures and the complete pages.

mod captions;
mod cli;
mod draw;
mod figure;
mod figures;
mod page;
mod panels;
mod plot;
mod power_spectrum;

use std::io::Write;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use asperity::failure::Failure;
use asperity::output::Output;
use asperity::{progress, tables};
use clap::Parser;

use cli::Gallery;
use figures::figures;

fn main() -> ExitCode {
    match run(&Gallery::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "error: {}", progress::one_line(&error.to_string()));
            ExitCode::FAILURE
        }
    }
}

fn run(wanted: &Gallery) -> Result<(), Failure> {
    if let Some(jobs) = wanted.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed))?;
    perform(wanted, &interrupted)
}

fn perform(wanted: &Gallery, interrupted: &AtomicBool) -> Result<(), Failure> {
    if wanted.list {
        return draw::list(&figures(), &wanted.only);
    }
    let [first, rest] = draw::first_ten(draw::chosen(&figures(), &wanted.only)?);
    let output = Output::new(&wanted.out)?;
    let gallery = output.inside("gallery")?;
    if !first.is_empty() {
        draw::draw(&first, wanted, &gallery, interrupted)?;
        draw::write_pages(&figures(), &gallery)?;
    }
    if wanted.only.is_empty() {
        tables::build(&tables::default_sets()?, &output.inside("tables")?, interrupted)?;
    }
    draw::draw(&rest, wanted, &gallery, interrupted)?;
    draw::write_pages(&figures(), &gallery)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_one_line_with_the_cause() {
        for (line, said) in [
            ("--only nowhere", "no figure matches `nowhere` (available: "),
            ("--only kautz --out Cargo.toml/x", "cannot write Cargo.toml/x: "),
        ] {
            let wanted = Gallery::try_parse_from(["gallery"].into_iter().chain(line.split(' '))).unwrap();
            let error = perform(&wanted, &AtomicBool::new(false)).unwrap_err().to_string();
            assert!(error.starts_with(said) && error.lines().count() == 1, "{line}: {error}");
        }
        for line in ["--size 3", "--jobs 0"] {
            let error = Gallery::try_parse_from(["gallery"].into_iter().chain(line.split(' '))).unwrap_err();
            assert_eq!(error.exit_code(), 2, "{line}");
        }
    }
}
