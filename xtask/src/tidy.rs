//! `cargo xtask tidy`: who may know whom, the files' heads, and the words that do not belong.

use std::{collections::BTreeSet, fs, path::Path};

use cargo_metadata::{DependencyKind, MetadataCommand};

use crate::figure::Failure;

/// Every edge that the house rules allow out of a published crate; nothing else may be there.
const EDGES: &[(&str, &[&str], &[&str])] = &[
    ("asperity-noise", &["approx", "fearless_simd", "glam", "libm"], &["criterion"]),
    ("asperity-ndf-sampling", &["approx", "fearless_simd", "glam", "libm"], &["criterion", "libm"]),
    ("asperity-fif", &["approx", "fearless_simd", "glam", "libm", "serde"], &["criterion"]),
    (
        "asperity-shading",
        &["approx", "asperity-ndf-sampling", "asperity-noise", "glam", "libm"],
        &["criterion"],
    ),
];

/// The members that may use everything and that nothing may use.
const TOPS: &[&str] = &["xtask", "asperity-tests"];

/// The member that may use everything and that only the tops may use.
const RENDER: &str = "asperity-render";

/// One dependency as its manifest states it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Edge {
    pub(crate) from: String,
    pub(crate) to: String,
    /// A development dependency: tests, examples and benches only.
    pub(crate) development: bool,
}

/// Looks at the whole workspace and lists what breaks a rule; an empty list is a tidy house.
pub(crate) fn offences() -> Result<Vec<String>, Failure> {
    let metadata = MetadataCommand::new().no_deps().other_options(vec!["--locked".into()]).exec()?;
    let mut edges = BTreeSet::new();
    let mut found = Vec::new();
    for package in &metadata.packages {
        for dependency in &package.dependencies {
            edges.insert(Edge {
                from: package.name.to_string(),
                to: dependency.name.clone(),
                development: dependency.kind == DependencyKind::Development,
            });
        }
        if package.edition.as_str() != "2024" || package.rust_version.is_none() {
            found.push(format!("{}: edition and rust-version come from the workspace", package.name));
        }
        let manifest = fs::read_to_string(&package.manifest_path)?;
        if !manifest.contains("[lints]\nworkspace = true") {
            found.push(format!("{}: the lints come from the workspace", package.name));
        }
    }
    found.extend(forbidden_edges(&edges));
    let root = metadata.workspace_root.as_std_path();
    for folder in ["crates", "xtask", "tests"] {
        sources(&root.join(folder), &mut |path, text| {
            let shown = path.strip_prefix(root).unwrap_or(path).display().to_string();
            found.extend(source_offences(&shown, text));
        })?;
    }
    Ok(found)
}

/// The edges that no rule allows.
pub(crate) fn forbidden_edges(edges: &BTreeSet<Edge>) -> Vec<String> {
    let mut found = Vec::new();
    for Edge { from, to, development } in edges {
        if TOPS.contains(&to.as_str()) {
            found.push(format!("{from} -> {to}: nothing uses {to}"));
        }
        if TOPS.contains(&from.as_str()) || from == RENDER {
            continue;
        }
        if to == RENDER {
            found.push(format!("{from} -> {to}: only the builder and the tests use {to}"));
            continue;
        }
        let Some((_, normal, dev)) = EDGES.iter().find(|(name, ..)| name == from) else {
            found.push(format!("{from}: a crate that the rules do not know"));
            continue;
        };
        let allowed = normal.contains(&to.as_str()) || (*development && dev.contains(&to.as_str()));
        if !allowed {
            let kind = if *development { "a development dependency" } else { "a dependency" };
            found.push(format!("{from} -> {to}: {kind} that the rules do not allow"));
        }
    }
    found
}

fn sources(folder: &Path, look: &mut impl FnMut(&Path, &str)) -> Result<(), Failure> {
    let mut entries: Vec<_> = fs::read_dir(folder)?.collect::<Result<_, _>>()?;
    entries.sort_by_key(fs::DirEntry::path);
    for entry in entries {
        let path = entry.path();
        if path.is_dir() {
            if entry.file_name() != "target" {
                sources(&path, look)?;
            }
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            look(&path, &fs::read_to_string(&path)?);
        }
    }
    Ok(())
}

/// What is wrong with one source file.
fn source_offences(path: &str, text: &str) -> Vec<String> {
    let mut found = Vec::new();
    if !text.starts_with("//! ") {
        found.push(format!("{path}: the first line says in `//!` what concept the file holds"));
    }
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    if ["utils.rs", "common.rs", "helpers.rs", "types.rs", "misc.rs"].contains(&name) {
        found.push(format!("{path}: a file is named after its concept"));
    }
    for (index, line) in text.lines().enumerate() {
        // Split so that the rule does not find itself.
        for word in [concat!("TO", "DO"), concat!("FIX", "ME"), concat!("#[ig", "nore")] {
            if line.contains(word) {
                found.push(format!("{path}:{}: `{word}` does not stay in the tree", index + 1));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(from: &str, to: &str, development: bool) -> BTreeSet<Edge> {
        BTreeSet::from([Edge { from: from.into(), to: to.into(), development }])
    }

    #[test]
    fn the_three_base_crates_know_nothing_of_one_another() {
        let base = ["asperity-noise", "asperity-ndf-sampling", "asperity-fif"];
        for from in base {
            for to in base.into_iter().filter(|to| *to != from) {
                for development in [false, true] {
                    assert_eq!(forbidden_edges(&edge(from, to, development)).len(), 1, "{from} -> {to}");
                }
            }
        }
    }

    #[test]
    fn nothing_uses_the_tops_and_third_parties_are_listed() {
        assert!(!forbidden_edges(&edge("asperity-tests", "xtask", false)).is_empty());
        assert!(!forbidden_edges(&edge("asperity-noise", "serde", false)).is_empty());
        assert!(!forbidden_edges(&edge("asperity-noise", "criterion", false)).is_empty());
        assert!(!forbidden_edges(&edge("a-new-crate", "glam", false)).is_empty());
        assert!(forbidden_edges(&edge("asperity-noise", "criterion", true)).is_empty());
        assert!(forbidden_edges(&edge("asperity-shading", "asperity-noise", false)).is_empty());
        assert!(forbidden_edges(&edge("xtask", "serde", false)).is_empty());
    }

    #[test]
    fn a_file_says_what_it_holds() {
        assert_eq!(source_offences("crates/x/src/ggx.rs", "//! The GGX density.\n"), Vec::<String>::new());
        assert_eq!(source_offences("crates/x/src/utils.rs", "fn f() {}\n").len(), 2);
    }

    #[test]
    fn this_workspace_is_tidy() {
        assert_eq!(offences().unwrap(), Vec::<String>::new());
    }
}
