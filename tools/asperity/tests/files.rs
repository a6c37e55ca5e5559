//! Output files of runs that are killed, run out of disk space, lack write permission, or run
//! concurrently. Each file is either the old or the new version, never a partial file.
//!
//! `ASPERITY_KILLS=200 cargo test --release -p asperity --test files -- --include-ignored
//! --nocapture` runs the long form and prints the results. `ASPERITY_GALLERY`, `ASPERITY_SHADERS`
//! and `ASPERITY_WEB` are the paths of the programs of `tools/gallery`, `tests/gpu` and
//! `web/builder`, and `ASPERITY_MODULE` is the page's module. Programs without a path are skipped.
//! `ASPERITY_CASES=web,shaders` runs only these cases.
#![cfg(target_os = "linux")]
#![expect(clippy::unwrap_used, reason = "a test that cannot run a command has failed")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use asperity_render::image::content::Content;
use asperity_render::image::read::ImageFile;
use asperity_render::sampling::random::Random;

/// Files by path relative to a folder.
type Files = BTreeMap<String, Vec<u8>>;

/// A command that writes files into a folder, `{}` in its words.
struct Case {
    name: &'static str,
    program: PathBuf,
    words: String,
}

impl Case {
    fn all() -> Vec<Self> {
        let own = |name, words: &str| Self {
            name,
            program: env!("CARGO_BIN_EXE_asperity").into(),
            words: words.into(),
        };
        let mut all = vec![
            own("render", "render --scene sphere --size 64 --spp 8 --out {}/picture.png"),
            own("render, frames", "render --scene sphere --size 32 --spp 2 --frames 6 --out {}/frame-##.exr"),
            own("tables", "tables --ndf ggx:0.2,0.4 --out {}"),
            own("bake", "bake --noise perlin --size 128 --tile 64 --format png,exr,ktx2 --out {}"),
        ];
        let named = |name: &str| std::env::var(name).ok();
        if let Some(program) = named("ASPERITY_GALLERY") {
            let words = "--only ndf-masking --only kautz-2 --size 32 --spp 1 --out {}".into();
            all.push(Self { name: "gallery", program: program.into(), words });
        }
        if let Some(program) = named("ASPERITY_SHADERS") {
            let words = "export --only noise/kinds/gaussian --out {}".into();
            all.push(Self { name: "shaders", program: program.into(), words });
        }
        if let (Some(program), Some(module)) = (named("ASPERITY_WEB"), named("ASPERITY_MODULE")) {
            all.push(Self {
                name: "web",
                program: program.into(),
                words: format!("build --wasm {module} --out {{}}"),
            });
        }
        if let Some(cases) = named("ASPERITY_CASES") {
            all.retain(|case| cases.split(',').any(|name| name == case.name));
        }
        all
    }

    fn start(&self, folder: &Path) -> Child {
        let folder = folder.to_str().unwrap();
        let words = self.words.split(' ').map(|word| word.replace("{}", folder));
        let mut command = Command::new(&self.program);
        command.args(words).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    }

    fn run(&self, folder: &Path) -> Output {
        self.start(folder).wait_with_output().unwrap()
    }

    /// Runs a command that must succeed, and returns the seconds it took.
    fn done(&self, folder: &Path) -> f64 {
        let begun = Instant::now();
        let output = self.run(folder);
        assert!(output.status.success(), "{}: {}", self.name, String::from_utf8_lossy(&output.stderr));
        begun.elapsed().as_secs_f64()
    }
}

/// Whether a path is left over for the next run: a temporary file, or tiles of a bake.
fn is_leftover(path: &str) -> bool {
    path.split('/').any(|part| part.starts_with(".asperity-") || part.starts_with(".tiles-"))
}

/// Returns every file in a folder, recursively.
fn files(folder: &Path) -> Files {
    fn collect(root: &Path, folder: &Path, found: &mut Files) {
        for entry in fs::read_dir(folder).into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                collect(root, &path, found);
            } else {
                let name = path.strip_prefix(root).unwrap().to_str().unwrap().to_owned();
                found.insert(name, fs::read(&path).unwrap());
            }
        }
    }
    let mut found = Files::new();
    collect(folder, folder, &mut found);
    found
}

/// Returns the files of a run for comparison, without the render times in records and pages.
fn whole(folder: &Path) -> Files {
    let timeless = |(name, bytes): (String, Vec<u8>)| {
        let text = String::from_utf8(bytes);
        let bytes = match text {
            Ok(text) if name.starts_with("gallery/") => text
                .split(|c: char| c.is_ascii_digit() || c == '.')
                .filter(|part| !part.is_empty())
                .collect::<String>()
                .into(),
            Ok(text) => text.into(),
            Err(error) => error.into_bytes(),
        };
        (name, bytes)
    };
    files(folder).into_iter().filter(|(name, _)| !is_leftover(name)).map(timeless).collect()
}

/// Writes files into an empty folder.
fn lay(files: &Files, folder: &Path) {
    let _ = fs::remove_dir_all(folder);
    fs::create_dir_all(folder).unwrap();
    for (name, bytes) in files {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }
}

/// Returns another version of the same files.
fn aged(files: &Files) -> Files {
    let old =
        |(name, bytes): (&String, &Vec<u8>)| (name.clone(), [bytes.as_slice(), b" from before"].concat());
    files.iter().map(old).collect()
}

/// Asserts that every file is the old or the new version.
fn assert_whole(case: &Case, found: &Files, versions: &[&Files], what: &str) {
    for (name, bytes) in found {
        // `render` overwrites its image after every pass.
        let coarse = case.name == "render" && ImageFile::decode(bytes, Content::Colors).is_ok();
        let right = coarse || versions.iter().any(|files| files.get(name) == Some(bytes));
        assert!(right, "{}, {what}: {name} of {} bytes is half a file", case.name, bytes.len());
    }
}

fn assert_clean(case: &Case, folder: &Path, what: &str) {
    let left: Vec<String> = files(folder).into_keys().filter(|name| is_leftover(name)).collect();
    assert!(left.is_empty(), "{}, {what}: {left:?} remain", case.name);
}

/// Asserts that the run printed one error line. Notes do not count.
fn assert_one_line(case: &Case, output: &Output, what: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    let lines: Vec<&str> = said.lines().filter(|line| !line.starts_with("note: ")).collect();
    let right = matches!(lines[..], [line] if line.starts_with("error: ") && line.contains("cannot write "));
    assert!(output.status.code() == Some(1) && right, "{}, {what}: {:?}: {said}", case.name, output.status);
}

#[test]
#[ignore = "slow: weekly"]
fn killed_run_leaves_whole_files_and_next_run_cleans_up() {
    let kills: usize = std::env::var("ASPERITY_KILLS").map_or(10, |text| text.parse().unwrap());
    let (cases, scratch, mut random) = (Case::all(), tempfile::tempdir().unwrap(), Random(4));
    let [reference, folder] = ["new", "killed"].map(|name| scratch.path().join(name));
    for (turn, case) in cases.iter().enumerate() {
        let _ = fs::remove_dir_all(&reference);
        let seconds = case.done(&reference);
        let (new, wanted) = (files(&reference), whole(&reference));
        lay(&aged(&new), &folder);
        let old = whole(&folder);
        let (mut hits, mut late, mut changed, mut left) = (0, 0, 0, 0);
        let share = kills / cases.len() + usize::from(turn < kills % cases.len());
        while hits < share {
            lay(&aged(&new), &folder);
            let mut child = case.start(&folder);
            sleep(Duration::from_secs_f64(1.1 * seconds * random.uniform()));
            child.kill().unwrap();
            if child.wait().unwrap().code().is_some() {
                late += 1;
                continue;
            }
            hits += 1;
            let found = whole(&folder);
            assert_eq!(found.len(), old.len(), "{}: files are missing or unexpected", case.name);
            assert_whole(case, &found, &[&old, &wanted], "killed");
            changed += usize::from(found != old);
            left += usize::from(files(&folder).keys().any(|name| is_leftover(name)));
            case.done(&folder);
            assert_clean(case, &folder, "after the next run");
            assert_eq!(whole(&folder), wanted, "{}", case.name);
        }
        println!(
            "| {} | {} files | {seconds:.2} s | {hits} killed, {late} had ended | {changed} have new files | {left} left temporaries |",
            case.name,
            new.len()
        );
    }
}

#[test]
#[ignore = "slow: weekly"]
fn concurrent_runs_succeed_and_leave_whole_files() {
    let times: usize = std::env::var("ASPERITY_KILLS").map_or(1, |_| 10);
    let scratch = tempfile::tempdir().unwrap();
    for case in Case::all() {
        let [reference, folder] = ["alone", "both"].map(|name| scratch.path().join(case.name).join(name));
        case.done(&reference);
        let wanted = whole(&reference);
        for _ in 0..times {
            let _ = fs::remove_dir_all(&folder);
            let both = [(); 2].map(|()| case.start(&folder)).map(|child| child.wait_with_output().unwrap());
            for output in both {
                let said = String::from_utf8_lossy(&output.stderr);
                assert!(output.status.success(), "{}: {said}", case.name);
            }
            assert_eq!(whole(&folder), wanted, "{}", case.name);
            assert_clean(&case, &folder, "after both");
        }
        println!("| {} | {times} times two at once |", case.name);
    }
}

/// A file system in memory, or `None` if this user may not mount one.
struct Mount(PathBuf);

impl Mount {
    fn new(folder: PathBuf, options: &str) -> Option<Self> {
        fs::create_dir_all(&folder).unwrap();
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", options, "tmpfs"]).arg(&folder).stderr(Stdio::null());
        mount.status().is_ok_and(|status| status.success()).then_some(Self(folder))
    }
}

impl Drop for Mount {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(&self.0).status();
    }
}

#[test]
fn full_disk_is_one_error_line_without_partial_files() {
    let scratch = tempfile::tempdir().unwrap();
    for case in Case::all() {
        let [reference, disk] = ["all", "disk"].map(|name| scratch.path().join(case.name).join(name));
        case.done(&reference);
        let (new, wanted) = (files(&reference), whole(&reference));
        let bytes: usize = new.values().map(Vec::len).sum();
        let (mut refused, mut kept) = (0, 0);
        for room in [0.02, 0.1, 0.3, 0.6, 0.9] {
            // Whole memory pages.
            let pages = 1.max((room * bytes as f64 / 4096.0) as usize);
            let Some(mount) = Mount::new(disk.clone(), &format!("size={}k", 4 * pages)) else {
                println!("skipped: this user may not mount a file system");
                return;
            };
            let output = case.run(&mount.0);
            let found = whole(&mount.0);
            if !output.status.success() {
                assert_one_line(&case, &output, "a full disk");
                refused += 1;
            }
            assert_whole(&case, &found, &[&wanted], "a full disk");
            kept = kept.max(found.len());
            let temporary = files(&mount.0).into_keys().find(|name| name.contains(".asperity-"));
            assert_eq!(temporary, None, "{}", case.name);
        }
        assert!(refused > 0, "{}: every disk was large enough", case.name);
        println!(
            "| {} | {bytes} bytes | {refused} of 5 disks too small | up to {kept} files kept |",
            case.name
        );
    }
}

#[test]
fn read_only_directory_is_one_error_line() {
    let scratch = tempfile::tempdir().unwrap();
    for case in Case::all() {
        let place = scratch.path().join(case.name);
        let Some(mount) = Mount::new(place, "ro,size=64k") else {
            println!("skipped: this user may not mount a file system");
            return;
        };
        assert_one_line(&case, &case.run(&mount.0), "a read-only directory");
    }
}
