//! The builder of Asperity: `cargo xtask gallery` and its smaller sisters.

mod bake;
mod bench;
mod cargo;
mod check;
mod cli;
mod drivers;
mod failure;
mod gallery;
mod input;
mod job;
mod output;
mod progress;
mod quality;
mod render;
mod shaders;
mod tables;
mod toolchain;
mod web;

use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Parser;

use check::{bits, ci, coverage, firmware, fuzz, no_std, tidy};
use cli::{Cli, Command};
use failure::Failure;
use gallery::figures::figures;
use output::Output;

fn main() -> ExitCode {
    if let Some(ended) = coverage::compiled() {
        return ended;
    }
    let cli = Cli::parse();
    // Gates quote what other programs said.
    let quotes = matches!(
        cli.command,
        Command::Ci(_)
            | Command::Tidy
            | Command::NoStd
            | Command::Bits(_)
            | Command::Coverage(_)
            | Command::Shaders(_)
            | Command::Web(_)
    );
    match run(cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let said = if quotes { error.to_string() } else { progress::one_line(&error.to_string()) };
            let _ = writeln!(std::io::stderr(), "error: {said}");
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
    perform(cli.command, &interrupted)
}

fn perform(command: Command, interrupted: &AtomicBool) -> Result<(), Failure> {
    // The manifest's folder is the builder's own; the workspace is the folder above it.
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("the builder has no workspace")?;
    match command {
        Command::Gallery(wanted) if wanted.list => gallery::list(&figures(), &wanted.only),
        Command::Gallery(wanted) => {
            gallery::chosen(&figures(), &wanted.only)?;
            let output = Output::new(&wanted.out)?;
            if wanted.only.is_empty() {
                tables::build(&tables::default_sets()?, &output.inside("tables")?, interrupted)?;
            }
            let pictures = output.inside("gallery")?;
            gallery::draw(&figures(), &wanted, &pictures, interrupted)
        }
        Command::Tables(wanted) if wanted.check => {
            let sets = tables::chosen_sets(&wanted)?;
            if wanted.makes_the_usual() {
                tables::check(root)?;
                progress::say("the tables that the crates ship are what the builder makes");
            }
            if wanted.makes_the_usual() && !wanted.out.exists() {
                return Ok(());
            }
            tables::compare(&sets, &wanted.out, interrupted)?;
            progress::say(&format!("the tables in {} are what the builder makes", wanted.out.display()));
            Ok(())
        }
        Command::Tables(wanted) if wanted.ship => tables::ship(root),
        Command::Tables(wanted) => {
            let sets = tables::chosen_sets(&wanted)?;
            let output = Output::new(&wanted.out)?;
            tables::build(&sets, &output, interrupted)?;
            progress::say(&format!("the tables: {}", output.place("index.html")));
            Ok(())
        }
        Command::Render(wanted) => render::render(&wanted, interrupted),
        Command::Bake(wanted) => bake::bake(&wanted, interrupted),
        Command::Bench(wanted) => bench::run(&wanted, root, interrupted),
        Command::Shaders(wanted) => shaders::run(&wanted, root, interrupted),
        Command::Web(wanted) => web::run(&wanted, root, interrupted),
        Command::Check(wanted) => check::density::check(&wanted),
        Command::Tidy => {
            let report = tidy::report()?;
            report.lines.iter().for_each(|line| progress::say(line));
            report.verdict().map(|()| progress::say("tidy"))
        }
        Command::Ci(wanted) => ci::gates(&wanted, root, interrupted),
        Command::Fuzz(wanted) => fuzz::fuzz(&wanted, root, interrupted),
        Command::NoStd => no_std::probe(root).map(|line| progress::say(&line)),
        Command::Firmware(wanted) => {
            let drawn = if wanted.ship { firmware::ship } else { firmware::check };
            drawn(root).map(|line| progress::say(&line))
        }
        Command::Bits(wanted) => {
            let table = if wanted.ship { bits::ship } else { bits::table };
            table(root).map(|table| progress::say(&table))
        }
        Command::Coverage(wanted) => coverage::report(&wanted, root),
    }
}

#[cfg(test)]
mod tests {
    use std::{fs, path::Path};

    use clap::CommandFactory;

    use super::*;

    #[test]
    fn every_command_explains_itself() {
        let said = Cli::command().render_help().to_string();
        for command in [
            "gallery", "tables", "render", "bake", "bench", "shaders", "web", "check", "tidy", "ci", "fuzz",
            "no-std", "firmware", "bits", "coverage",
        ] {
            assert!(said.contains(&format!("\n  {command} ")), "{command} is missing in:\n{said}");
        }
        Cli::command().debug_assert();
    }

    #[test]
    fn commands_of_the_readme_and_the_guide_are_understood() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let guides = fs::read_dir(root.join("docs/guide")).unwrap().map(|entry| entry.unwrap().path());
        let mut commands = 0;
        for path in guides.chain([root.join("README.md")]) {
            let page = fs::read_to_string(&path).unwrap();
            for line in page.lines().filter_map(|line| line.strip_prefix("cargo xtask ")) {
                let words = line.split('#').next().unwrap().split_whitespace();
                let parsed = Cli::try_parse_from(["xtask"].into_iter().chain(words));
                assert!(parsed.is_ok(), "{}: {line}: {}", path.display(), parsed.unwrap_err());
                commands += 1;
            }
        }
        assert!(commands > 8);
    }

    #[test]
    fn a_command_that_cannot_be_done_says_in_one_line_why() {
        let unlinked = ("bench --peers --ship", "FastNoise2 is not measured: ");
        let unlinked = std::env::var_os("FASTNOISE2_LIB_DIR").is_none().then_some(unlinked);
        let refused = [
            ("ci --only nowhere", "no gate's name contains `nowhere`; gates are format, tidy, "),
            ("gallery --only nowhere", "no figure is called `nowhere`; there are "),
            ("gallery --only kautz --out Cargo.toml/x", "cannot write Cargo.toml/x: "),
            ("tables --ndf velvet", "density `velvet`: neither `ggx:AX[,AY]`, "),
            ("check --ndf velvet", "density `velvet`: neither `ggx:AX[,AY]`, "),
            ("tables --ndf ggx:0", "density `ggx:0`: alpha_x must be "),
            (
                "tables --normal-map nowhere.png",
                "density `normal-map:nowhere.png`: the file cannot be read: ",
            ),
            ("tables --fif nowhere.json", "system `nowhere.json`: "),
            ("tables --fif Cargo.toml", "system `Cargo.toml`: "),
            ("tables --out Cargo.toml/x", "cannot write Cargo.toml/x: "),
            ("shaders --out Cargo.toml/x", "cannot write Cargo.toml/x: "),
            ("web --out Cargo.toml/x", "cannot write Cargo.toml/x: "),
            ("render --mesh nowhere.3ds", "mesh `nowhere.3ds`: the name of a mesh file ends in "),
            ("render --light nowhere.exr", "light `nowhere.exr`: the file cannot be read: "),
            ("render --light lamps --scene car", "lamps light the teapot, the sphere and the plane only; "),
            ("render --out src", "`src` is a folder; "),
            ("render --out a.gif", "picture `a.gif`: its name must end in .png, .jpg, .webp or .exr"),
            ("render --out Cargo.toml/a.png", "cannot write "),
            ("bake --out Cargo.toml/x", "cannot write Cargo.toml/x: "),
            ("bake --tiles 2", "tile 2: the last one is 1"),
            ("bake --job rock.txt", "job `rock.txt`: its name must end in .yaml or .json"),
            ("bake --size 1000", "`--size` must be a power of two from 64 on, got 1000"),
            ("bake --samples 3", "`--samples` must be 1 or even, got 3"),
            ("bake --tileable --lacunarity 2.17", "`--tileable`: `periods[0]` times `lacunarity` "),
            ("bake --tileable --noise simplex", "`--tileable`: `periods[0]` must be a multiple of 3, got 8"),
            ("bake --ndf velvet", "density `velvet`: neither `ggx:AX[,AY]`, "),
            ("bake --fractal torus --factor 0.5", "`factor` must be under 0.447"),
        ];
        for (line, said) in refused.into_iter().chain(unlinked) {
            let cli = Cli::try_parse_from(["xtask"].into_iter().chain(line.split(' '))).unwrap();
            let error = perform(cli.command, &AtomicBool::new(false)).unwrap_err().to_string();
            assert!(error.starts_with(said) && error.lines().count() == 1, "{line}: {error}");
        }
    }
}
