//! Dependencies: from where they come, under what licences, and that the page about them has each.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

use cargo_metadata::{Metadata, MetadataCommand};
use spdx::{Expression, ParseMode};

use crate::failure::Failure;
use crate::report::say;

/// The one place that packages come from.
const REGISTRY: &str = "registry+https://github.com/rust-lang/crates.io-index";

/// Checks the packages of every lockfile of the repository.
pub(crate) fn dependencies(root: &Path) -> Result<(), Failure> {
    let deny = fs::read_to_string(root.join("deny.toml"))?;
    let allowed = allowed(&deny);
    let page = fs::read_to_string(root.join("docs/dependencies.md"))?;
    let (mut seen, mut direct, mut offences) = (BTreeSet::new(), BTreeMap::new(), Vec::new());
    let locks = lockfiles(root)?;
    for lock in &locks {
        let metadata = resolved(lock)?;
        offences.extend(foreign(&metadata, &allowed));
        seen.extend(metadata.packages.iter().filter(|p| p.source.is_some()).map(|p| p.id.repr.clone()));
        direct.extend(chosen(&metadata));
    }
    offences.extend(missing(&page, &direct));
    let rows =
        page.lines().filter_map(|line| line.strip_prefix("| `")?.split_once("` | ")).map(|(name, _)| name);
    let gone = rows.filter(|name| !direct.contains_key(*name) && !name.starts_with("asperity-"));
    gone.for_each(|name| {
        crate::report::note(&format!("docs/dependencies.md has `{name}`, on which nothing depends"));
    });
    if !offences.is_empty() {
        return Err(offences.join("\n       ").into());
    }
    say(&format!("  {} packages in {} lockfiles", seen.len(), locks.len()));
    Ok(())
}

/// The lockfiles of a folder and of what is in it.
fn lockfiles(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let apart = ["target", "node_modules", ".git"].iter().any(|other| name == *other);
        if entry.file_type()?.is_dir() && !apart {
            found.extend(lockfiles(&entry.path())?);
        } else if name == "Cargo.lock" {
            found.push(entry.path());
        }
    }
    found.sort();
    Ok(found)
}

/// All that cargo knows of the packages of a lockfile, those of optional dependencies and of all platforms too.
fn resolved(lock: &Path) -> Result<Metadata, Failure> {
    let manifest = lock.with_file_name("Cargo.toml");
    let all = ["--locked", "--all-features"].map(String::from).to_vec();
    MetadataCommand::new()
        .manifest_path(&manifest)
        .other_options(all)
        .exec()
        .map_err(|error| format!("{}: {error}", manifest.display()).into())
}

/// The licences that `deny.toml` allows.
fn allowed(deny: &str) -> BTreeSet<&str> {
    let list = deny.split("\nallow = [").nth(1).and_then(|rest| rest.split(']').next()).unwrap_or_default();
    list.split('"').skip(1).step_by(2).collect()
}

/// Packages from elsewhere than the registry, or whose licence the allowed ones do not meet.
fn foreign(metadata: &Metadata, allowed: &BTreeSet<&str>) -> Vec<String> {
    let mut offences = Vec::new();
    for package in &metadata.packages {
        let Some(source) = &package.source else { continue };
        let (name, version) = (&package.name, &package.version);
        if source.repr != REGISTRY {
            offences.push(format!("{name} {version} comes from {}", source.repr));
        }
        let licence = package.license.as_deref().unwrap_or_default();
        if !meets(licence, allowed) {
            offences.push(format!(
                "{name} {version} has the licence `{licence}`, which deny.toml does not allow"
            ));
        }
    }
    offences
}

/// Whether a licence leaves a choice of which every part is allowed; `/` is the old way to write `OR`.
fn meets(licence: &str, allowed: &BTreeSet<&str>) -> bool {
    let expression = Expression::parse_mode(licence, ParseMode::LAX);
    expression.is_ok_and(|expression| {
        expression.evaluate(|requirement| allowed.contains(requirement.to_string().as_str()))
    })
}

/// The packages that the members and their neighbours depend on by name, with their licences.
fn chosen(metadata: &Metadata) -> BTreeMap<String, String> {
    let ours = metadata.packages.iter().filter(|package| package.source.is_none());
    let members: BTreeSet<_> = metadata.workspace_members.iter().collect();
    let names = ours.flat_map(|package| {
        // What a neighbour has for its own tests is in the lockfile of its workspace.
        let member = members.contains(&package.id);
        package.dependencies.iter().filter(move |dependency| {
            dependency.path.is_none()
                && (member || dependency.kind != cargo_metadata::DependencyKind::Development)
        })
    });
    let names: BTreeSet<&str> = names.map(|dependency| dependency.name.as_str()).collect();
    let found = metadata.packages.iter().filter(|p| p.source.is_some() && names.contains(p.name.as_str()));
    found.map(|p| (p.name.to_string(), p.license.clone().unwrap_or_default())).collect()
}

/// Direct dependencies of which the page does not say why they are trusted.
fn missing(page: &str, direct: &BTreeMap<String, String>) -> Vec<String> {
    let rows = direct.iter().map(|(name, licence)| format!("| `{name}` | {licence} | "));
    rows.filter(|row| !page.contains(row.as_str()))
        .map(|row| format!("docs/dependencies.md lacks a row that begins with {row}"))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cargo::cargo;

    fn root() -> &'static Path {
        Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
    }

    #[test]
    fn licences_are_met_by_a_choice() {
        let allowed = allowed("[licenses]\nallow = [\n  \"MIT\",\n  \"Zlib\",\n]\n");
        for licence in ["MIT", "MIT OR GPL-3.0-only", "Apache-2.0/MIT", "(GPL-3.0-only OR Zlib) AND MIT"] {
            assert!(meets(licence, &allowed), "{licence}");
        }
        for licence in ["", "GPL-3.0-only", "MIT AND Apache-2.0", "Apache-2.0 WITH LLVM-exception"] {
            assert!(!meets(licence, &allowed), "{licence}");
        }
    }

    #[test]
    fn the_workspace_depends_on_what_the_page_tells() {
        let metadata = resolved(&root().join("Cargo.lock")).unwrap();
        let deny = fs::read_to_string(root().join("deny.toml")).unwrap();
        let page = fs::read_to_string(root().join("docs/dependencies.md")).unwrap();
        assert_eq!(foreign(&metadata, &allowed(&deny)), Vec::<String>::new());
        let direct = chosen(&metadata);
        assert!(direct.len() > 30);
        assert_eq!(missing(&page, &direct), Vec::<String>::new());
        assert_eq!(
            foreign(&metadata, &BTreeSet::new()).len(),
            metadata.packages.iter().filter(|p| p.source.is_some()).count()
        );
    }

    /// Names of the packages that are compiled for a crate, without itself.
    fn beneath(name: &str, features: &str) -> BTreeSet<String> {
        let words = format!(
            "tree --package {name} --edges normal,build --prefix none --no-dedupe --locked{features}"
        );
        let output = cargo(root(), &words).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let listed = String::from_utf8(output.stdout).unwrap();
        let packages = listed.lines().filter_map(|line| line.split(' ').next());
        packages.filter(|package| !package.is_empty() && *package != name).map(String::from).collect()
    }

    #[test]
    fn the_page_counts_the_packages_beneath_a_crate() {
        let page = fs::read_to_string(root().join("docs/dependencies.md")).unwrap();
        for short in ["core", "noise", "ndf-sampling", "fif", "shading", "shaders"] {
            let name = format!("asperity-{short}");
            let named = |features| {
                let names = beneath(&name, features);
                format!("{}: {}", names.len(), names.into_iter().collect::<Vec<_>>().join(", "))
            };
            let (usual, least) = (named(""), named(" --no-default-features --features libm"));
            let row =
                format!("| `{name}` | {usual} | {least} | {} |", beneath(&name, " --all-features").len());
            assert!(page.contains(&row), "docs/dependencies.md must have\n{row}");
        }
    }
}
