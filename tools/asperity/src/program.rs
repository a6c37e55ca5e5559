//! Runs a command line of `asperity`.

use std::io::Write;
use std::sync::atomic::AtomicBool;

use clap::error::ErrorKind;
use rayon::ThreadPoolBuilder;

pub use crate::bake::arrays::Array;
use crate::cli::{Cli, Command};
use crate::failure::{Failure, Interrupted};
use crate::invocation::Invocation;
use crate::output::Output;
use crate::{bake, check, filter, fractal, manual, noise, progress, render, shader, tables};

/// Runs the command line, reports an error in one line, and returns the exit code.
///
/// Work stops soon after `interrupted` is set.
pub fn run(invocation: &Invocation, interrupted: &AtomicBool) -> u8 {
    let fail = |said: &str, code| {
        let _ = writeln!(std::io::stderr(), "error: {}", progress::one_line(said));
        code
    };
    let cli = match Cli::of_words(&invocation.words) {
        Ok(cli) => cli,
        Err(error) => match line_of(&error) {
            Some(line) => return fail(&line, 2),
            None => {
                let _ = error.print();
                return u8::try_from(error.exit_code()).unwrap_or(2);
            }
        },
    };
    let done = match cli.jobs.map(|jobs| ThreadPoolBuilder::new().num_threads(jobs as usize).build()) {
        None => perform(cli.command, invocation, interrupted),
        // A host, such as Python, has its own pool.
        Some(Ok(pool)) => pool.install(|| perform(cli.command, invocation, interrupted)),
        Some(Err(error)) => Err(error.into()),
    };
    match done {
        Ok(()) => 0,
        Err(error) => fail(&error.to_string(), 1),
    }
}

/// Bakes to arrays, given the options of `bake` as words.
///
/// Work stops soon after `interrupted` is set.
pub fn bake_arrays(options: &[String], interrupted: &AtomicBool) -> Result<Vec<Array>, Failure> {
    let words = ["asperity", "bake"].into_iter().chain(options.iter().map(String::as_str));
    match Cli::of_words(words) {
        Ok(Cli { command: Command::Bake(wanted), .. }) => bake::arrays::arrays(&wanted, interrupted),
        Ok(_) => Err("expected the options of `bake`".into()),
        Err(error) => Err(line_of(&error).unwrap_or_default().into()),
    }
}

/// The line of an error in the arguments; `None` for help and the version.
fn line_of(error: &clap::Error) -> Option<String> {
    if !error.use_stderr() || error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return None;
    }
    let said = error.render().to_string();
    let mut line = String::new();
    for part in said.lines().map(str::trim).take_while(|part| !part.starts_with("Usage:")) {
        if part.is_empty() || part.starts_with("For more information") {
            continue;
        }
        if !line.is_empty() {
            line += if part.starts_with('[') || line.ends_with(':') { " " } else { "; " };
        }
        line += part;
    }
    Some(line.trim_start_matches("error: ").into())
}

/// Replaces the error of an interrupted command that cannot resume.
fn whole(result: Result<(), Failure>) -> Result<(), Failure> {
    result.map_err(
        |error| if error.is::<Interrupted>() { "interrupted: nothing was written".into() } else { error },
    )
}

fn perform(command: Command, invocation: &Invocation, interrupted: &AtomicBool) -> Result<(), Failure> {
    match command {
        Command::Render(wanted) => render::render(&wanted, invocation, interrupted),
        Command::Bake(wanted) => bake::bake(&wanted, invocation, interrupted),
        Command::Filter(wanted) => whole(filter::run(&wanted, interrupted)),
        Command::Fractal(wanted) => whole(fractal::fractal(&wanted, interrupted)),
        Command::Completions { shell } => manual::completions(shell),
        Command::Man => manual::man(),
        Command::Shader(wanted) => shader::shader(&wanted),
        Command::Noise(wanted) => whole(noise::noise(&wanted, interrupted)),
        Command::CheckNdf(wanted) => check::check(&wanted),
        Command::Tables(wanted) => {
            let sets = tables::chosen_sets(&wanted.ndf, &wanted.normal_map, wanted.images, &wanted.fif)?;
            if wanted.check {
                tables::compare(&sets, &wanted.out, interrupted)?;
                progress::say(&format!("the tables in {} are up to date", wanted.out.display()));
                return Ok(());
            }
            let output = Output::new(&wanted.out)?;
            tables::build(&sets, &output, interrupted)?;
            progress::say(&format!("tables written to {}", output.place("index.html")));
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests {
    use std::{fs, path::Path};

    use clap::CommandFactory;

    use super::*;

    #[test]
    fn help_lists_every_command() {
        let said = Cli::command().render_help().to_string();
        for command in [
            "render",
            "bake",
            "filter",
            "noise",
            "fractal",
            "shader",
            "tables",
            "check-ndf",
            "completions",
            "man",
        ] {
            assert!(said.contains(&format!("\n  {command} ")), "{command} is missing in:\n{said}");
        }
        // One screen of a terminal.
        assert!(said.lines().count() <= 24 && said.lines().all(|line| line.chars().count() <= 100), "{said}");
        Cli::command().debug_assert();
    }

    #[test]
    fn wrong_arguments_are_reported_in_one_line() {
        for (line, expected) in [
            ("render --zom 2", "unexpected argument '--zom' found; tip: a similar argument exists: '--zoom'"),
            ("rendr", "unrecognized subcommand 'rendr'; tip: a similar subcommand exists: 'render'"),
            ("render --zoom", "a value is required for '--zoom <ZOOM>' but none was supplied"),
            ("render --fov 30", "the following required arguments were not provided: --mesh <FILE>"),
            (
                "render --mesh a.obj --fov -5",
                "invalid value '-5' for '--fov <DEGREES>': must be an angle from 0.1 to 170 degrees",
            ),
            (
                "noise --seed -1",
                "invalid value '-1' for '--seed <SEED>': must be an integer from 0 to 4294967295",
            ),
            ("noise --jobs 0", "invalid value '0' for '--jobs <N>': must be an integer from 1 to 1024"),
            ("shader --group -1", "invalid value '-1' for '--group <GROUP>': must be an integer from 0 to 3"),
        ] {
            let error = Cli::of_words(["asperity"].into_iter().chain(line.split(' '))).err().unwrap();
            assert_eq!(line_of(&error).unwrap(), expected);
        }
        let help = Cli::of_words(["asperity", "--help"]).err().unwrap();
        assert_eq!(line_of(&help), None);
    }

    /// Splits a line as a shell does, but for escapes.
    fn words(line: &str) -> Vec<String> {
        let quoted = line.split('"').enumerate();
        let words = quoted.flat_map(|(index, text)| match index % 2 {
            0 => text.split_whitespace().map(Into::into).collect(),
            _ => vec![text.into()],
        });
        words.collect()
    }

    #[test]
    fn commands_of_readme_and_guide_parse() {
        let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
        let guides = fs::read_dir(root.join("docs/guide")).unwrap().map(|entry| entry.unwrap().path());
        let mut commands = 0;
        for path in guides.chain([root.join("README.md")]) {
            let page = fs::read_to_string(&path).unwrap();
            for line in page.lines().filter_map(|line| line.strip_prefix("asperity ")) {
                let words = words(line.split('#').next().unwrap());
                let parsed = Cli::of_words(["asperity".to_owned()].into_iter().chain(words));
                assert!(parsed.is_ok(), "{}: {line}: {}", path.display(), parsed.unwrap_err());
                commands += 1;
            }
        }
        assert!(commands > 4);
    }

    #[test]
    fn jobs_call_the_command_of_the_invocation() {
        let folder = tempfile::tempdir().unwrap();
        let [job, out] = ["job.json", "out"].map(|name| folder.path().join(name).display().to_string());
        let words = ["asperity", "bake", "--noise", "value", "--size", "64", "--out", &out, "--job", &job];
        let invocation = Invocation {
            words: words.map(Into::into).to_vec(),
            command: "/venv/bin/asperity".into(),
            binary: "/venv/lib/module.so".into(),
        };
        assert_eq!(run(&invocation, &AtomicBool::new(false)), 0);
        let template: serde_json::Value = serde_json::from_slice(&fs::read(&job).unwrap()).unwrap();
        assert_eq!(template["parameterDefinitions"][0]["default"], "/venv/bin/asperity");
        let arguments = template["steps"][1]["script"]["actions"]["onRun"]["args"].to_string();
        assert!(arguments.starts_with(r#"["bake","--noise","value""#), "{arguments}");
    }

    #[test]
    fn errors_are_one_line() {
        let refused = [
            ("tables --ndf velvet", "density `velvet`: expected `ggx:AX[,AY]`, "),
            ("check-ndf --ndf velvet", "density `velvet`: expected `ggx:AX[,AY]`, "),
            ("tables --ndf ggx:0", "density `ggx:0`: `alpha_x` must be "),
            ("tables --normal-map nowhere.png", "density `normal-map:nowhere.png`: cannot read the file: "),
            ("tables --fif nowhere.json", "system `nowhere.json`: "),
            ("tables --fif Cargo.toml", "system `Cargo.toml`: "),
            ("tables --out Cargo.toml/x", "cannot write Cargo.toml/x: "),
            ("render --mesh nowhere.3ds", "mesh `nowhere.3ds`: unsupported file extension "),
            ("render --light nowhere.exr", "light `nowhere.exr`: cannot read the file: "),
            ("render --light lamps --scene car", "`--light lamps` supports "),
            ("render --out src", "`src` is a directory ("),
            (
                "render --out a.gif",
                "image `a.gif`: unsupported file extension (expected .png, .jpg, .webp or .exr)",
            ),
            ("render --out Cargo.toml/a.png", "cannot write "),
            ("bake --out Cargo.toml/x", "cannot write Cargo.toml/x: "),
            ("bake --tiles 2", "tile 2 is out of range (expected 1 to 1)"),
            ("bake --job rock.txt", "job `rock.txt`: unsupported file extension (expected .yaml or .json)"),
            ("bake --size 1000", "`--size` must be a power of two and at least 64, got 1000"),
            ("bake --samples 3", "`--samples` must be 1 or even, got 3"),
            (
                "bake --tileable --lacunarity 2.17",
                "`--tileable`: `--cells` · `lacunarity`^1 must be an integer ",
            ),
            ("bake --tileable --noise simplex", "`--tileable`: `--cells` must be a multiple of 3, got 8"),
            ("bake --ndf velvet", "density `velvet`: expected `ggx:AX[,AY]`, "),
            ("bake --fractal periodic --scaling 0.5", "`scaling` must be under 0.447"),
            ("noise --out a.gif", "noise `a.gif`: unsupported file extension (expected .png, .exr or .npy)"),
            ("noise --gradient", "noise `noise.png`: --gradient needs .exr or .npy"),
            ("noise --metric manhattan", "noise `noise.png`: --output and --metric need `--kind cellular`"),
            ("noise --size 65536x65536", "`--size`: 4294967296 samples are too many ("),
            ("noise --tileable --size 100x33", "`--tileable`: 8 cells along 100 samples are 2.64 along 33 ("),
            (
                "noise --tileable --lacunarity 2.17",
                "`--tileable`: `--cells` · `lacunarity`^1 must be an integer ",
            ),
            ("fractal --out a.png", "function `a.png`: unsupported file extension ("),
            ("fractal --knots 0,0", "`--knots` must have at least "),
            ("fractal --scaling 2", "`--scaling` of map 1 must be in (-1, 1), got 2"),
            ("fractal --over 0,4", "`--over` must be within [0, 1], got [0, 4]"),
            ("fractal --system Cargo.toml", "system `Cargo.toml`: "),
            ("fractal --system nowhere.json", "system `nowhere.json`: cannot read the file: "),
            (
                "fractal --out a.obj --samples 5000",
                "`--samples` must be at most 2049 for a surface, got 5000",
            ),
            ("shader velvet", "part `velvet` does not exist ("),
            ("shader kinds/perlin --language spirv", "SPIR-V is binary and needs --out FILE"),
        ];
        let invocation = Invocation::of_process();
        for (line, said) in refused {
            let cli = Cli::of_words(["asperity"].into_iter().chain(line.split(' '))).unwrap();
            let error = perform(cli.command, &invocation, &AtomicBool::new(false)).unwrap_err().to_string();
            assert!(error.starts_with(said) && error.lines().count() == 1, "{line}: {error}");
        }
    }
}
