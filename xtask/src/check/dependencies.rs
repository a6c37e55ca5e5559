//! Checks dependencies: registry, licenses, and their justification in `docs/dependencies.md`.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

use crate::failure::Failure;
use crate::metadata::{self, Package};
use crate::report::{note, say};

/// The only allowed registry.
const REGISTRY: &str = "registry+https://github.com/rust-lang/crates.io-index";

/// Checks the packages of every lockfile of the repository.
pub(crate) fn dependencies(root: &Path) -> Result<(), Failure> {
    let deny = fs::read_to_string(root.join("deny.toml"))?;
    let allowed = allowed(&deny);
    let page = fs::read_to_string(root.join("docs/dependencies.md"))?;
    let (mut seen, mut direct, mut offences) = (BTreeSet::new(), BTreeMap::new(), Vec::new());
    let locks = lockfiles(root)?;
    for lock in &locks {
        let packages = metadata::all(lock.parent().unwrap_or(root))?;
        offences.extend(packages.iter().filter_map(|package| foreign(package, &allowed)));
        let registry = packages.iter().filter(|package| package.source.is_some());
        seen.extend(registry.map(|package| (package.name.clone(), package.version.clone())));
        direct.extend(chosen(&packages));
    }
    offences.extend(missing(&page, &direct));
    let rows =
        page.lines().filter_map(|line| line.strip_prefix("| `")?.split_once("` | ")).map(|(name, _)| name);
    let gone = rows.filter(|name| !direct.contains_key(*name) && !name.starts_with("asperity-"));
    gone.for_each(|name| note(&format!("docs/dependencies.md lists `{name}`, which is not a dependency")));
    if !offences.is_empty() {
        return Err(offences.join("\n       ").into());
    }
    say(&format!("  {} packages in {} lockfiles", seen.len(), locks.len()));
    Ok(())
}

/// Returns the lockfiles below a folder.
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
    Ok(found)
}

/// Returns the licenses allowed by `deny.toml`.
fn allowed(deny: &str) -> BTreeSet<&str> {
    let list = deny.split("\nallow = [").nth(1).and_then(|rest| rest.split(']').next()).unwrap_or_default();
    list.split('"').skip(1).step_by(2).collect()
}

/// Returns the rule that an external package violates.
fn foreign(package: &Package, allowed: &BTreeSet<&str>) -> Option<String> {
    let Package { name, version, license, .. } = package;
    let source = package.source.as_deref()?;
    if source != REGISTRY {
        Some(format!("{name} {version} comes from {source}"))
    } else if !meets(license, allowed) {
        Some(format!("{name} {version} has the license `{license}` (not allowed in deny.toml)"))
    } else {
        None
    }
}

/// Whether a license offers an allowed choice. `AND` binds weakest here, which is stricter than
/// SPDX. cargo-deny evaluates the full expression.
fn meets(license: &str, allowed: &BTreeSet<&str>) -> bool {
    let license = license.replace('/', " OR ");
    license
        .split(" AND ")
        .all(|part| part.split(" OR ").any(|one| allowed.contains(one.trim_matches(['(', ')', ' ']))))
}

/// Returns the direct dependencies of the published packages, with their licenses.
fn chosen(packages: &[Package]) -> BTreeMap<String, String> {
    let ours = packages.iter().filter(|package| package.is_published);
    let names = ours.flat_map(|package| package.dependencies.iter().filter(|other| other.kind != "dev"));
    let names: BTreeSet<&str> = names.map(|dependency| dependency.name.as_str()).collect();
    let found = packages.iter().filter(|p| p.source.is_some() && names.contains(p.name.as_str()));
    found.map(|package| (package.name.clone(), package.license.clone())).collect()
}

/// Returns the rows missing from the page.
fn missing(page: &str, direct: &BTreeMap<String, String>) -> Vec<String> {
    let rows = direct.iter().map(|(name, license)| format!("| `{name}` | {license} | "));
    rows.filter(|row| !page.contains(row.as_str()))
        .map(|row| format!("docs/dependencies.md lacks the row {row}"))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cargo::cargo;

    #[test]
    fn license_choices() {
        let allowed = allowed("[licenses]\nallow = [\n  \"MIT\",\n  \"Zlib\",\n]\n");
        for license in ["MIT", "MIT OR GPL-3.0-only", "Apache-2.0/MIT", "(GPL-3.0-only OR Zlib) AND MIT"] {
            assert!(meets(license, &allowed), "{license}");
        }
        for license in ["", "GPL-3.0-only", "MIT AND Apache-2.0", "Apache-2.0 WITH LLVM-exception"] {
            assert!(!meets(license, &allowed), "{license}");
        }
    }

    /// Returns the names of the packages compiled for a crate, without the crate.
    fn beneath(root: &Path, name: &str, features: &str) -> BTreeSet<String> {
        let words = format!(
            "tree --package {name} --edges normal,build --prefix none --no-dedupe --locked{features}"
        );
        let output = cargo(root, &words).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let listed = String::from_utf8(output.stdout).unwrap();
        let packages = listed.lines().filter_map(|line| line.split(' ').next());
        packages.filter(|package| !package.is_empty() && *package != name).map(String::from).collect()
    }

    #[test]
    fn page_counts_packages() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let page = fs::read_to_string(root.join("docs/dependencies.md")).unwrap();
        for short in ["core", "noise", "ndf-sampling", "fif", "shading", "wgsl"] {
            let name = format!("asperity-{short}");
            let named = |features| {
                let names = beneath(root, &name, features);
                format!("{}: {}", names.len(), names.into_iter().collect::<Vec<_>>().join(", "))
            };
            let (usual, least) = (named(""), named(" --no-default-features --features libm"));
            let row = format!(
                "| `{name}` | {usual} | {least} | {} |",
                beneath(root, &name, " --all-features").len()
            );
            assert!(page.contains(&row), "docs/dependencies.md must have\n{row}");
        }
    }
}
