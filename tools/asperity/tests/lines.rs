//! Random command lines, valid and broken. Every run exits with 0, 1 or 2, without a panic, and
//! reports errors in one line.
//!
//! Options and their values are parsed from `--help` of each command. `ASPERITY_LINES=900` tests
//! for 900 seconds instead of a few, and `ASPERITY_SEED` changes the seed. A run that takes long is
//! interrupted as by Ctrl-C and must then exit.
#![cfg(unix)]
#![expect(clippy::unwrap_used, reason = "a test that cannot run a command has failed")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use asperity_render::sampling::random::Random;

/// Commands that compute. The others only build programs.
const COMMANDS: [&str; 4] = ["render", "bake", "tables", "check-ndf"];
/// Options that write into the source tree, or compare with committed files.
const NEVER: [&str; 2] = ["--ship", "--check"];

// Option values, separated by bars.
const NUMBERS: &str = "\
    0|-0|1|-1|2|16|64|100|0.5|0.25|1.5|1e-45|1e-39|1e-7|3e38|1e39|-1e39|1e400|nan|-nan|inf|-inf|\
    16777217|2147483648|4294967295|4294967296|18446744073709551616|1_000|0x10|+1|.5|1.|٣|1e";
const WORDS: &str = "\
    | |-|--|=|a|ggx|ggx:|ggx:,|ggx:0.2|ggx:0.2,0.4|ggx:nan|ggx:1e-30|ward:0.1,1e30|\
    student-t:0.1,0.2,1e9|blinn-phong:1e30|ashikhmin-shirley:0,inf|painted|🫖|a\nb|\u{1b}[31m|\
    \u{202e}x";
const COLORS: &str = "b02a1e|#d9a066|ffffff|12345|+12345|gggggg|#####000000";
const SETS: &str = "\
    depth=0.01|coat_roughness=0.1|color=#b02a1e|color=1,2|depth=nan|depth=-1|=|x=|\
    orange_peel_strength=1e30|no equals";
const RANGES: &str = "1|2-3|1-1|3-2|0|1-|-|1-4294967295";
const PATHS: &str = "\
    gray.png|cut.png|empty.png|triangle.obj|broken.obj|no.stl|system.json|wild.json|folder|folder/|\
    nowhere/a.png|a.png|b.exr|c.jpg|d.webp|e.gif|frame-##.png|/proc/version/x.png|job.yaml|\
    x/../y.png";

/// An option parsed from `--help`.
struct OptionOf {
    name: String,
    /// The name of its value, if it takes one.
    value: Option<String>,
    words: Vec<String>,
}

fn run(folder: &Path, words: &[String]) -> Option<Output> {
    let mut command =
        Command::new(std::env::var("ASPERITY_PROGRAM").unwrap_or(env!("CARGO_BIN_EXE_asperity").into()));
    command.args(words).current_dir(folder).env("RUST_BACKTRACE", "0").stdin(Stdio::null());
    // Files instead of pipes, which a run could fill.
    let [out, err] = ["said.out", "said.err"].map(|name| folder.join(name));
    let [out_file, err_file] = [&out, &err].map(|path| fs::File::create(path).unwrap());
    let mut child = command.stdout(out_file).stderr(err_file).spawn().unwrap();
    let begun = Instant::now();
    let mut stopped = false;
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            let [stdout, stderr] = [&out, &err].map(|path| fs::read(path).unwrap());
            return Some(Output { status, stdout, stderr });
        }
        let seconds = begun.elapsed().as_secs();
        if seconds >= 5 && !stopped {
            let stop = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
            stopped = stop.is_ok();
        }
        if seconds >= 125 {
            child.kill().unwrap();
            child.wait().unwrap();
            return None;
        }
        sleep(Duration::from_millis(10));
    }
}

fn options(folder: &Path, command: &str) -> Vec<OptionOf> {
    let output = run(folder, &[command.into(), "--help".into()]).unwrap();
    let help = String::from_utf8(output.stdout).unwrap();
    let mut options: Vec<OptionOf> = vec![];
    let mut listed = false;
    for line in help.split("Options:").nth(1).unwrap().lines().map(str::trim) {
        let word = line.strip_prefix("- ").and_then(|line| line.split(':').next());
        let inline = line.split_once("[possible values: ").map(|(_, rest)| rest.trim_end_matches(']'));
        if let Some(begin) = line.find("--").filter(|&at| at == 0 || line.starts_with('-') && at < 5) {
            let mut parts = line[begin..].split_whitespace();
            let name = parts.next().unwrap().to_owned();
            let value = parts.next().map(|value| value.trim_matches(['<', '>', '.', '[', ']']).to_owned());
            options.push(OptionOf { name, value, words: vec![] });
            listed = false;
        } else if line == "Possible values:" {
            listed = true;
        } else if let (Some(option), Some(word), true) = (options.last_mut(), word, listed) {
            option.words.push(word.to_owned());
        } else if let (Some(option), Some(words)) = (options.last_mut(), inline) {
            option.words.extend(words.split(", ").map(str::to_owned));
        }
    }
    options.retain(|option| !NEVER.contains(&option.name.as_str()));
    options
}

/// Picks one of the words between bars.
fn any<'a>(random: &mut Random, of: &'a str) -> &'a str {
    let words: Vec<&str> = of.split('|').collect();
    words[(random.bits() % words.len() as u64) as usize]
}

/// Picks a value, mostly of the type that the option takes.
fn value(random: &mut Random, option: &OptionOf) -> String {
    let kind = option.value.as_deref().unwrap_or_default();
    match random.bits() % 20 {
        0 => any(random, NUMBERS).into(),
        1 => any(random, WORDS).into(),
        2 => any(random, PATHS).into(),
        3 => "#".repeat(1 << (random.bits() % 17)) + ".png",
        4 => "9".repeat(1 + (random.bits() % 300) as usize),
        _ if !option.words.is_empty() => {
            option.words[(random.bits() % option.words.len() as u64) as usize].clone()
        }
        _ => match kind {
            "FILE" | "DIR" | "LIGHT" => any(random, PATHS).into(),
            "RRGGBB" | "light|RRGGBB" => any(random, COLORS).into(),
            "NAME=VALUE" => any(random, SETS).into(),
            "N|N-N" => any(random, RANGES).into(),
            "NDF" | "NAME" => any(random, WORDS).into(),
            "SIZE" | "TILE" => format!("{}", 16 << (random.bits() % 4)),
            _ if random.bits().is_multiple_of(2) => format!("{}", 1 + random.bits() % 16),
            _ => any(random, NUMBERS).into(),
        },
    }
}

fn line(random: &mut Random, all: &[(&str, Vec<OptionOf>)]) -> Vec<String> {
    let (command, options) = &all[(random.bits() % all.len() as u64) as usize];
    let mut words = vec![(*command).to_owned()];
    // Small sizes, unless another value is drawn.
    match *command {
        "render" if !random.bits().is_multiple_of(8) => {
            words.extend(["--size", "16", "--spp", "1"].map(str::to_owned));
        }
        "gallery" => words.extend(["--size", "16", "--spp", "1"].map(str::to_owned)),
        "bake" => words.extend(["--size", "64", "--samples", "1"].map(str::to_owned)),
        _ => {}
    }
    for _ in 0..random.bits() % 5 {
        let option = &options[(random.bits() % options.len() as u64) as usize];
        if words.contains(&option.name) && !random.bits().is_multiple_of(10) {
            continue;
        }
        words.push(option.name.clone());
        // Rarely the value is omitted.
        if option.value.is_some() && !random.bits().is_multiple_of(30) {
            words.push(value(random, option));
        }
    }
    if random.bits().is_multiple_of(40) {
        let at = (random.bits() % (words.len() as u64 + 1)) as usize;
        words.insert(at, any(random, WORDS).into());
    }
    words
}

fn files(folder: &Path) {
    fs::create_dir_all(folder.join("folder")).unwrap();
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 4, 4);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().unwrap().write_image_data(&[7; 16]).unwrap();
    let half = png.len() / 2;
    let system = r#"{"knots": [0, 1, 2], "alpha": [0.5, 0.5], "q": [[0, 1], [1, -1]]}"#;
    let wild = r#"{"knots": [0, 1e308, -1e308], "alpha": [1e308], "q": []}"#;
    let written: [(&str, &[u8]); 8] = [
        ("gray.png", &png),
        ("cut.png", &png[..half]),
        ("empty.png", b""),
        ("triangle.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("broken.obj", b"v 0 0 nan\nf 1 2 99999999999\n"),
        ("no.stl", b"solid"),
        ("system.json", system.as_bytes()),
        ("wild.json", wild.as_bytes()),
    ];
    written.into_iter().for_each(|(name, bytes)| fs::write(folder.join(name), bytes).unwrap());
}

#[test]
#[ignore = "slow: weekly"]
fn every_line_ends_in_0_1_or_2_with_at_most_one_line_of_error() {
    let seconds: Option<u64> = std::env::var("ASPERITY_LINES").ok().map(|text| text.parse().unwrap());
    let seed: u64 = std::env::var("ASPERITY_SEED").map_or(1, |text| text.parse().unwrap());
    let scratch = tempfile::tempdir().unwrap();
    let all = COMMANDS.map(|command| (command, options(scratch.path(), command)));
    assert!(
        all.iter().all(|(_, options)| options.len() > 2)
            && all[0].1.iter().any(|option| option.words.len() > 3)
    );
    let (mut codes, mut faults, begun, mut number) = ([0; 3], vec![], Instant::now(), 0);
    while seconds.map_or(number < 40, |seconds| begun.elapsed().as_secs() < seconds) {
        let folder = scratch.path().join(format!("{number}"));
        files(&folder);
        let words = line(&mut Random(seed.wrapping_mul(1 << 32) + number), &all);
        number += 1;
        let output = run(&folder, &words);
        let _ = fs::remove_dir_all(&folder);
        let short: Vec<String> = words.iter().map(|word| word.chars().take(80).collect()).collect();
        let Some(output) = output else {
            faults.push(format!("line {number}: {short:?} does not exit"));
            continue;
        };
        let said = String::from_utf8_lossy(&output.stderr);
        let lines: Vec<&str> = said.lines().filter(|line| !line.starts_with("note: ")).collect();
        let right = match output.status.code() {
            Some(0) => lines.is_empty(),
            Some(1) => matches!(lines[..], [line] if line.starts_with("error: ")),
            // The usage text follows.
            Some(2) => lines.first().is_some_and(|line| line.starts_with("error: ")),
            _ => false,
        };
        if let Some(count) = output.status.code().and_then(|code| codes.get_mut(code as usize)) {
            *count += 1;
        }
        if !right || said.contains("panicked") {
            let said: String = said.chars().take(400).collect();
            faults.push(format!("line {number}: {short:?}: {:?}: {said}", output.status));
        }
    }
    println!("seed {seed}: {number} lines, of which {codes:?} ended with 0, 1, 2; {} faults", faults.len());
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
