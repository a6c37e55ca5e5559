//! Memory, threads and files of repeated runs: memory stays constant, and nothing is left behind.
//!
//! `ASPERITY_REPEATS=100 cargo test --release -p asperity --test load -- --ignored --nocapture`
//! runs the long form and prints the measurements.
#![cfg(target_os = "linux")]
#![expect(clippy::unwrap_used, reason = "a test that cannot run a command has failed")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

fn repeats(usual: usize) -> usize {
    std::env::var("ASPERITY_REPEATS").map_or(usual, |text| text.parse().unwrap())
}

fn start(words: &str, folder: &Path) -> Child {
    let words = words.split(' ').map(|word| word.replace("{}", folder.to_str().unwrap()));
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.args(words).stdin(Stdio::null()).stdout(Stdio::null()).spawn().unwrap()
}

/// Returns the peak memory of a process in kB and its thread count, from the kernel.
fn status(child: &Child) -> Option<[usize; 2]> {
    let text = fs::read_to_string(format!("/proc/{}/status", child.id())).ok()?;
    let number = |field: &str| {
        text.lines().find_map(|line| line.strip_prefix(field)?.split_whitespace().next()?.parse().ok())
    };
    Some([number("VmHWM:")?, number("Threads:")?])
}

/// Runs a command to its end, and returns the last status that was read.
fn peak(words: &str, folder: &Path) -> [usize; 2] {
    let mut child = start(words, folder);
    let mut last = [0; 2];
    loop {
        last = status(&child).unwrap_or(last);
        if let Some(status) = child.try_wait().unwrap() {
            assert!(status.success(), "{words}: {status}");
            return last;
        }
        sleep(Duration::from_millis(1));
    }
}

fn names(folder: &Path) -> BTreeSet<PathBuf> {
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            names.extend(crate::names(&path));
        }
        names.insert(path);
    }
    names
}

/// Within one process: peak memory after a tenth of the work and at the end, with the thread
/// counts.
fn grown(words: &str, folder: &Path, tenth: impl Fn() -> bool) -> [[usize; 2]; 2] {
    let mut child = start(words, folder);
    let (mut early, mut last) = (None, [0; 2]);
    loop {
        // Check the progress before reading the status, so that the status is from that moment or
        // later.
        let done = early.is_none() && tenth();
        last = status(&child).unwrap_or(last);
        if done {
            early = Some(last);
        }
        if let Some(status) = child.try_wait().unwrap() {
            assert!(status.success(), "{words}: {status}");
            return [early.unwrap(), last];
        }
        sleep(Duration::from_millis(1));
    }
}

#[test]
#[ignore = "slow: weekly"]
fn frames_in_one_process_keep_no_memory_and_no_thread() {
    let (scratch, frames) = (tempfile::tempdir().unwrap(), repeats(20));
    let words =
        format!("--jobs 2 render --scene plane --size 256 --spp 1 --frames {frames} --out {{}}/###.png");
    let tenth = scratch.path().join(format!("{:03}.png", frames / 10));
    let [early, last] = grown(&words, scratch.path(), || tenth.exists());
    println!(
        "render, frame {} and {frames}: {} kB and {} kB, {} and {} threads",
        frames / 10,
        early[0],
        last[0],
        early[1],
        last[1]
    );
    // Half of the memory that would accumulate if every later frame leaked one image of three
    // floats per pixel.
    let image = 256 * 256 * 12 / 1024;
    assert!(
        last[0].saturating_sub(early[0]) < (frames - frames / 10) * image / 2,
        "{early:?} and {last:?} kB"
    );
    assert!(last[1] <= early[1], "{early:?} and {last:?} threads");
    assert_eq!(names(scratch.path()).len(), frames);
}

#[test]
#[ignore = "slow: weekly"]
fn render_memory_is_one_image() {
    let scratch = tempfile::tempdir().unwrap();
    let run = |side: usize, ending: &str| {
        let words = format!("--jobs 2 render --scene plane --size {side} --spp 1 --out {{}}/a.{ending}");
        peak(&words, scratch.path())[0]
    };
    let side = 1024;
    let image = side * side * 12 / 1024;
    for ending in ["exr", "png"] {
        let [least, all] = [run(32, ending), run(side, ending)];
        println!(
            "render, {side}² as {ending}: {all} kB, of which the program has {least} kB and the image {image} kB"
        );
        // The image once. Any other growth would be another copy of the image.
        assert!(all - least < image * 3 / 2, "{ending}: {all} kB, {least} kB for a small one");
    }
}

#[test]
#[ignore = "slow: weekly"]
fn tiles_in_one_process_keep_no_memory_and_no_thread() {
    let scratch = tempfile::tempdir().unwrap();
    let words = "--jobs 2 bake --noise perlin --size 1024 --tile 64 --samples 1 --octaves 1 --out {}";
    let tiles = || {
        names(scratch.path())
            .iter()
            .filter(|path| path.extension().is_some_and(|ending| ending == "tile"))
            .count()
    };
    let [early, last] = grown(words, scratch.path(), || tiles() >= 25);
    println!(
        "bake, tile 25 of 256 and the end: {} kB and {} kB, {} and {} threads",
        early[0], last[0], early[1], last[1]
    );
    // Half of the memory that would accumulate if every later tile stayed: 20 bytes per texel, plus
    // a third for the levels.
    assert!(
        last[0].saturating_sub(early[0]) < 231 * 64 * 64 * 20 * 4 / 3 / 1024 / 2,
        "{early:?} and {last:?} kB"
    );
    assert!(last[1] <= early[1], "{early:?} and {last:?} threads");
}

#[test]
#[ignore = "slow: weekly"]
fn repeated_runs_have_constant_memory_and_files() {
    let scratch = tempfile::tempdir().unwrap();
    for (name, words) in [
        ("render", "--jobs 2 render --scene sphere --size 128 --spp 2 --out {}/a.png"),
        ("bake", "--jobs 2 bake --noise perlin --size 64 --samples 1 --out {}"),
        ("tables", "--jobs 2 tables --ndf ggx:0.2,0.4 --out {}"),
    ] {
        let folder = scratch.path().join(name);
        let first = peak(words, &folder);
        let there = names(&folder);
        let rest: Vec<[usize; 2]> = (1..repeats(3)).map(|_| peak(words, &folder)).collect();
        let (least, most) = (rest.iter().map(|run| run[0]).min(), rest.iter().map(|run| run[0]).max());
        println!(
            "{name}: {} kB the first time, {least:?} to {most:?} kB in {} more; {} files",
            first[0],
            rest.len(),
            there.len()
        );
        assert_eq!(names(&folder), there, "{name}");
    }
}
