//! Clean-room builds: each package is unpacked from its archive into an empty workspace, with its
//! documentation and an example.

use std::{
    fmt::Write,
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use crate::cargo::{cargo, run};
use crate::failure::Failure;
use crate::metadata::Package;
use crate::report::say;

/// Builds and runs a program on every package, outside this workspace.
///
/// The packages are patched to their unpacked folders, because the registry does not have them yet.
/// All other packages come from this workspace's lockfile.
pub(super) fn builds(root: &Path, packed: &Path, members: &[Package]) -> Result<(), Failure> {
    let away = std::env::temp_dir().join(format!("asperity-clean-room-{}", std::process::id()));
    fs::create_dir_all(&away)?;
    let built = each(root, packed, members, &away);
    fs::remove_dir_all(&away)?;
    built
}

fn each(root: &Path, packed: &Path, members: &[Package], away: &Path) -> Result<(), Failure> {
    let target = packed.join("clean-room");
    for package in members {
        let file = packed.join(format!("package/{}.crate", unpacked(package)));
        run(Command::new("tar").arg("-xzf").arg(file).arg("-C").arg(away))?;
    }
    for package in members {
        let patches = Patches { folder: away, needed: beneath(package, members) };
        let source = away.join(unpacked(package));
        let mut docs = cargo(&source, "doc --quiet --no-deps --all-features");
        run(patches.given(&mut docs).arg("--target-dir").arg(&target).env("RUSTDOCFLAGS", "-D warnings"))?;
        let example = program(root, away, &source, package, &patches)?;
        let mut start = cargo(&away.join(format!("on-{}", package.name)), "run --quiet");
        run(start.arg("--target-dir").arg(&target).stdout(std::process::Stdio::null()))?;
        say(&format!("  {} in an empty workspace: documentation, and `{example}` runs", package.name));
    }
    Ok(())
}

/// Returns the folder that a package's archive unpacks to.
fn unpacked(package: &Package) -> String {
    format!("{}-{}", package.name, package.version)
}

/// Returns a package and its dependencies in this workspace, direct or not.
fn beneath<'a>(package: &'a Package, members: &'a [Package]) -> Vec<&'a Package> {
    let mut found = vec![package];
    let mut at = 0;
    while let Some(next) = found.get(at).copied() {
        for dependency in next.dependencies.iter().filter(|d| d.kind.is_empty()) {
            let own = members.iter().find(|member| member.name == dependency.name);
            found.extend(own.filter(|own| !found.iter().any(|known| known.name == own.name)));
        }
        at += 1;
    }
    found
}

/// Folders of packages that the registry does not have.
struct Patches<'a> {
    folder: &'a Path,
    needed: Vec<&'a Package>,
}

impl Patches<'_> {
    fn places(&self) -> impl Iterator<Item = (&str, PathBuf)> {
        self.needed.iter().map(|package| (package.name.as_str(), self.folder.join(unpacked(package))))
    }

    /// Adds the patches to a command, except the patch for its own package.
    fn given<'c>(&self, command: &'c mut Command) -> &'c mut Command {
        for (name, place) in self.places().skip(1) {
            command.arg("--config").arg(format!("patch.crates-io.{name}.path='{}'", place.display()));
        }
        command
    }
}

/// Writes a workspace with one program, the package's first example, and returns the example's
/// name.
fn program(
    root: &Path,
    away: &Path,
    source: &Path,
    package: &Package,
    patches: &Patches<'_>,
) -> Result<String, Failure> {
    let mut examples: Vec<&str> =
        package.targets.iter().filter(|t| t.kind == "example").map(|t| t.name.as_str()).collect();
    examples.sort_unstable();
    let name = *examples.first().ok_or_else(|| format!("{} has no example", package.name))?;
    let text = fs::read_to_string(source.join(format!("examples/{name}.rs")))?;
    let mut manifest = String::from(
        "[workspace]\n[package]\nname = \"clean-room\"\nedition = \"2024\"\n[profile.dev]\nopt-level = 1\n[dependencies]\n",
    );
    let used = |name: &str| text.contains(&format!("{}::", name.replace('-', "_")));
    let dev = || package.dependencies.iter().filter(|d| d.kind == "dev");
    for (own, _) in patches.places().filter(|(own, _)| used(own)) {
        let features = dev().find(|d| d.name == own).map_or(&[][..], |d| &d.features);
        writeln!(manifest, "{own} = {{ version = \"={}\", features = {features:?} }}", package.version)?;
    }
    let third = dev().filter(|d| patches.places().all(|(own, _)| own != d.name));
    for other in third.filter(|d| used(&d.name)) {
        writeln!(
            manifest,
            "{} = {{ version = \"{}\", features = {:?} }}",
            other.name, other.req, other.features
        )?;
    }
    manifest += "[patch.crates-io]\n";
    for (own, place) in patches.places() {
        writeln!(manifest, "{own} = {{ path = '{}' }}", place.display())?;
    }
    let folder = away.join(format!("on-{}", package.name));
    fs::create_dir_all(folder.join("src"))?;
    // Where examples write their images.
    fs::create_dir_all(folder.join("target"))?;
    fs::write(folder.join("Cargo.toml"), manifest)?;
    fs::write(folder.join("src/main.rs"), text)?;
    fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock"))?;
    Ok(name.into())
}
