//! Packages as `cargo metadata` lists them.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::cargo::cargo;
use crate::failure::Result;

/// One package of a workspace or of its lockfile.
#[derive(Debug)]
pub(crate) struct Package {
    pub(crate) name: String,
    pub(crate) version: String,
    pub(crate) manifest_path: PathBuf,
    /// The registry; `None` for packages of this repository.
    pub(crate) source: Option<String>,
    pub(crate) license: String,
    pub(crate) is_published: bool,
    pub(crate) features: Vec<String>,
    pub(crate) targets: Vec<Target>,
    pub(crate) dependencies: Vec<Dependency>,
    /// The whole entry.
    pub(crate) entry: Value,
}

/// A library, program, example or bench of a package.
#[derive(Debug)]
pub(crate) struct Target {
    pub(crate) name: String,
    /// `lib`, `bin`, `example`, `bench`, `test` or `custom-build`.
    pub(crate) kind: String,
}

/// An entry of a manifest.
#[derive(Debug)]
pub(crate) struct Dependency {
    pub(crate) name: String,
    /// `dev` or `build`; empty for ordinary dependencies.
    pub(crate) kind: String,
    pub(crate) req: String,
    pub(crate) features: Vec<String>,
}

/// Returns the members of a workspace.
pub(crate) fn members(root: &Path) -> Result<Vec<Package>> {
    read(root, "metadata --format-version 1 --locked --no-deps")
}

/// Returns the published members of a workspace.
pub(crate) fn published(root: &Path) -> Result<Vec<Package>> {
    let mut packages = members(root)?;
    packages.retain(|package| package.is_published);
    Ok(packages)
}

/// Returns every package of a lockfile.
pub(crate) fn all(folder: &Path) -> Result<Vec<Package>> {
    read(folder, "metadata --format-version 1 --locked --all-features")
}

fn read(folder: &Path, words: &str) -> Result<Vec<Package>> {
    let output = cargo(folder, words).output()?;
    if !output.status.success() {
        return Err(format!("{}: {}", folder.display(), String::from_utf8_lossy(&output.stderr)).into());
    }
    let metadata: Value = serde_json::from_slice(&output.stdout)?;
    let members = list(&metadata["workspace_members"]);
    Ok(list(&metadata["packages"])
        .iter()
        .map(|entry| package(entry, members.contains(&entry["id"])))
        .collect())
}

fn package(entry: &Value, is_member: bool) -> Package {
    let target = |target: &Value| Target { name: text(&target["name"]), kind: text(&target["kind"][0]) };
    let dependency = |other: &Value| Dependency {
        name: text(&other["name"]),
        kind: text(&other["kind"]),
        req: text(&other["req"]),
        features: list(&other["features"]).iter().map(text).collect(),
    };
    Package {
        name: text(&entry["name"]),
        version: text(&entry["version"]),
        manifest_path: text(&entry["manifest_path"]).into(),
        source: entry["source"].as_str().map(str::to_owned),
        license: text(&entry["license"]),
        is_published: is_member && entry["publish"].is_null(),
        features: entry["features"].as_object().into_iter().flat_map(|all| all.keys().cloned()).collect(),
        targets: list(&entry["targets"]).iter().map(target).collect(),
        dependencies: list(&entry["dependencies"]).iter().map(dependency).collect(),
        entry: entry.clone(),
    }
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}
