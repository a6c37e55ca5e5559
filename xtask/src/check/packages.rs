//! Checks packages as published: licenses, metadata, and pages without broken links.

use std::{collections::BTreeSet, fs, path::Path};

use super::clean_room;
use crate::cargo::{cargo, run};
use crate::failure::Failure;
use crate::metadata::{self, Package};
use crate::report::say;

/// Files required in every package.
const FILES: [&str; 5] = ["Cargo.toml", "LICENSE-APACHE", "LICENSE-MIT", "README.md", "src/lib.rs"];

/// Paths allowed in a package: sources, documentation and licenses, but not the repository's
/// checks.
const PLACES: [&str; 11] = [
    ".cargo_vcs_info.json",
    "Cargo.lock",
    "Cargo.toml",
    "Cargo.toml.orig",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "README.md",
    "benches",
    "examples",
    "src",
    "tests",
];

/// Pages included in a crate's documentation.
const PAGES: &str = "docs/";

/// Maximum bytes of a compressed package: twice the current largest, a twentieth of the registry's
/// limit.
const LARGEST: u64 = 500_000;

/// The folder of packages as uploaded, and of their builds.
const BUILDS: &str = "target/packages";

/// Checks the contents of every package and packs it as uploaded. [`clean_room_builds`] builds the
/// packages.
pub(crate) fn packages(root: &Path) -> Result<(), Failure> {
    let members = metadata::published(root)?;
    let mut words = String::from("package --quiet --allow-dirty --locked --no-verify");
    for package in &members {
        let (name, faults) = (&package.name, faults(root, package));
        if !faults.is_empty() {
            return Err(format!("{name} {}", faults.join("; ")).into());
        }
        let mut list = cargo(root, &format!("package --quiet --list --allow-dirty --package {name}"));
        let output = list.output()?;
        let listed = String::from_utf8_lossy(&output.stdout);
        let listed: BTreeSet<&str> = listed.lines().collect();
        let missing: Vec<&str> = FILES.into_iter().filter(|file| !listed.contains(file)).collect();
        if !output.status.success() || !missing.is_empty() {
            return Err(format!("package {name} lacks {}", missing.join(", ")).into());
        }
        if let Some(file) = listed.iter().find(|file| !belongs(file)) {
            return Err(format!("package {name} contains the unnecessary file {file}").into());
        }
        words += &format!(" --package {name}");
    }
    let builds = root.join(BUILDS);
    run(cargo(root, &words).arg("--target-dir").arg(&builds))?;
    for package in &members {
        let file = builds.join(format!("package/{}-{}.crate", package.name, package.version));
        let bytes = fs::metadata(&file)?.len();
        if bytes > LARGEST {
            return Err(
                format!("package {} is too large: {bytes} bytes (at most {LARGEST})", package.name).into()
            );
        }
        say(&format!("  {} {}: {} kB packed", package.name, package.version, bytes.div_ceil(1000)));
    }
    Ok(())
}

/// Clean-room build: builds documentation and an example of every package from its archive alone,
/// in an empty workspace.
pub(crate) fn clean_room_builds(root: &Path) -> Result<(), Failure> {
    packages(root)?;
    let members = metadata::published(root)?;
    clean_room::builds(root, &root.join(BUILDS), &members)
}

/// Whether a file is allowed in a package.
fn belongs(file: &str) -> bool {
    let place = file.split(['/', '\\']).next().unwrap_or(file);
    PLACES.contains(&place) || file.replace('\\', "/").starts_with(PAGES) && file.ends_with(".md")
}

/// Runs a program that depends on the oldest `glam` that the crates allow, with the oldest version
/// of every other package.
pub(crate) fn oldest_packages(root: &Path) -> Result<(), Failure> {
    let folder = root.join("tests/oldest-glam");
    run(cargo(&folder, "run --quiet --locked --features all").env_remove("CARGO_TARGET_DIR"))
}

/// Returns the rules that a package violates.
fn faults(root: &Path, package: &Package) -> Vec<String> {
    let mut faults = Vec::new();
    let mut must = |holds: bool, fault: &str| {
        if !holds {
            faults.push(fault.to_owned());
        }
    };
    let entry = &package.entry;
    must(entry["description"].is_string(), "has no description");
    // Otherwise crates.io does not resolve the links of a page.
    let hosted = |address: &str| address.starts_with("https://github.com/");
    must(entry["repository"].as_str().is_some_and(hosted), "has no repository on GitHub");
    must(entry["documentation"].is_string(), "has no documentation");
    must(entry["metadata"]["docs"]["rs"]["all-features"] == true, "does not set all-features for docs.rs");
    let folder = package.manifest_path.parent().unwrap_or(root);
    for file in ["LICENSE-APACHE", "LICENSE-MIT"] {
        let same = matches!((fs::read(folder.join(file)), fs::read(root.join(file))), (Ok(own), Ok(all)) if own == all);
        must(same, &format!("has a {file} that differs from the project's"));
    }
    let page = fs::read_to_string(folder.join("README.md")).unwrap_or_default();
    for link in links(&page) {
        must(folder.join(link).exists(), &format!("links to {link}, which does not exist"));
    }
    faults
}

/// Returns relative links and images of a page, without anchors.
pub(super) fn links(page: &str) -> impl Iterator<Item = &str> {
    let marked = page.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let tagged = page.split("src=\"").skip(1).filter_map(|rest| rest.split('"').next());
    let paths = marked.chain(tagged).filter_map(|link| link.split('#').next());
    paths.filter(|path| !path.is_empty() && !path.contains("://"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_are_found_and_urls_skipped() {
        let page = "[a](docs/a.md#part) ![b](b.png) [c](https://c.org/c) [d](#d) <img src=\"e.png\">";
        assert_eq!(links(page).collect::<Vec<_>>(), ["docs/a.md", "b.png", "e.png"]);
    }

    #[test]
    fn belongs_rejects_repository_files() {
        for file in ["src/lib.rs", "README.md", "docs/pictures/white.md", "examples/zoom.rs"] {
            assert!(belongs(file), "{file}");
        }
        for file in ["docs/pictures/white.png", "notes.md", "proptest-regressions/a.txt", "target/debug/x"] {
            assert!(!belongs(file), "{file}");
        }
    }

    #[test]
    fn oldest_packages_are_the_minimum_versions() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("a workspace");
        let members = metadata::published(root).expect("metadata");
        let lock = fs::read_to_string(root.join("tests/oldest-glam/Cargo.lock")).expect("a lockfile");
        let mut asked = 0;
        for package in &members {
            let registry = |name: &str| members.iter().all(|member| member.name != name);
            for other in package.dependencies.iter().filter(|d| d.kind.is_empty() && registry(&d.name)) {
                let least =
                    other.req.trim_start_matches(['^', '>', '=']).split(',').next().expect("a version");
                let missing = ".0".repeat(2 - least.matches('.').count());
                let entry = format!("name = \"{}\"\nversion = \"{least}{missing}\"", other.name);
                assert!(lock.contains(&entry), "{}: {entry}", package.name);
                asked += 1;
            }
        }
        assert!(asked > 15);
    }

    #[test]
    fn packages_have_metadata_licenses_and_links() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("a workspace");
        let members = metadata::published(root).expect("metadata");
        assert_eq!(members.len(), 6);
        for package in &members {
            assert_eq!(faults(root, package), Vec::<String>::new(), "{}", package.name);
        }
        let page = fs::read_to_string(root.join("README.md")).expect("a page");
        for link in links(&page) {
            assert!(root.join(link).exists(), "{link}");
        }
    }
}
