//! The builder of Asperity: `cargo xtask gallery` and its smaller sisters.

mod bench;
mod check;
mod cli;
mod failure;
mod gallery;
mod input;
mod output;
mod progress;
mod tables;

use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Parser;

use check::{bare_metal, ci, no_std, tidy};
use cli::{Cli, Command};
use failure::Failure;
use gallery::figures::figures;
use output::Output;

fn main() -> ExitCode {
    let cli = Cli::parse();
    match run(cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(cli: Cli) -> Result<(), Failure> {
    if let Some(jobs) = cli.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed))?;
    // The manifest's folder is the builder's own; the workspace is the folder above it.
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("the builder has no workspace")?;
    match cli.command {
        Command::Gallery(wanted) if wanted.list => gallery::list(&figures(), &wanted.only),
        Command::Gallery(wanted) => {
            gallery::chosen(&figures(), &wanted.only)?;
            let output = Output::new(&wanted.out)?;
            if wanted.only.is_empty() {
                tables::build(&tables::default_sets()?, &output.inside("tables")?, &interrupted)?;
            }
            let pictures = output.inside("gallery")?;
            gallery::draw(&figures(), &wanted, &pictures, &interrupted)?;
            progress::say(&format!("the gallery: {}", pictures.place("index.html")));
            Ok(())
        }
        Command::Tables(wanted) if wanted.check => tables::check(root).map(|()| {
            progress::say("the tables that the crates ship are what the builder makes");
        }),
        Command::Tables(wanted) if wanted.ship => tables::ship(root),
        Command::Tables(wanted) => {
            let sets = tables::chosen_sets(&wanted)?;
            let output = Output::new(&wanted.out)?;
            tables::build(&sets, &output, &interrupted)?;
            progress::say(&format!("the tables: {}", output.place("index.html")));
            Ok(())
        }
        Command::Render(wanted) => gallery::render::render(&wanted, &interrupted),
        Command::Bench(wanted) => bench::run(&wanted, root, &interrupted),
        Command::Tidy => {
            let report = tidy::report()?;
            report.lines.iter().for_each(|line| progress::say(line));
            report.verdict().map(|()| progress::say("tidy"))
        }
        Command::Ci(wanted) => ci::gates(&wanted.only, root, &interrupted),
        Command::NoStd => no_std::probe(root).map(|line| progress::say(&line)),
        Command::BareMetal => bare_metal::probe(root).map(|line| progress::say(&line)),
    }
}
