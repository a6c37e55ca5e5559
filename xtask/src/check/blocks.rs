//! Compiles and runs documentation examples outside this workspace, with the features of a
//! downstream user.
//!
//! Inside this workspace cargo unifies features, so an example that needs glam's `f64` compiles
//! next to a crate that enables it.

use std::{
    collections::BTreeMap,
    fmt::Write,
    fs,
    path::{Path, PathBuf},
};

use crate::cargo::{cargo, run};
use crate::failure::Failure;
use crate::metadata::{self, Package};
use crate::report::say;

/// The generated workspace.
const FOLDER: &str = "target/blocks";

/// Marks the feature that a block needs, at the end of a line that starts with `use asperity_`.
const NEEDS: &str = "// feature `";

/// Runs the examples of every crate with its default features, and every Rust block of the README,
/// the guide and the crate pages with the crates used in the block.
pub(crate) fn examples(root: &Path) -> Result<(), Failure> {
    let crates = metadata::published(root)?;
    let pages_folder = write_workspace(root, &crates)?;
    let mut groups = BTreeMap::<Vec<String>, String>::new();
    let mut count = 0;
    for page in pages(root, &crates)? {
        let text = fs::read_to_string(root.join(&page))?;
        for (line, block) in blocks(&text) {
            module(groups.entry(needed(block)).or_default(), &page, line, block)?;
            count += 1;
        }
    }
    let mut packages: Vec<_> = crates.iter().map(|member| member.name.to_string()).collect();
    for (k, (needed, modules)) in groups.iter().enumerate() {
        let name = format!("pages-{k}");
        write(&pages_folder.join(&name), &page_manifest(&name, needed), modules)?;
        packages.push(name);
    }
    run_examples(root, packages)?;
    say(&format!("  ran the examples of {} crates and {count} code blocks of pages", crates.len()));
    Ok(())
}

/// Writes the workspace with the crates, and returns the folder of its pages.
fn write_workspace(root: &Path, crates: &[Package]) -> Result<PathBuf, Failure> {
    let folder = root.join(FOLDER);
    // Unchanged crates are not recompiled.
    let pages_folder = folder.join("pages");
    if pages_folder.is_dir() {
        fs::remove_dir_all(&pages_folder)?;
    }
    for member in crates {
        write_crate(&folder, member)?;
    }
    let manifest = fs::read_to_string(root.join("Cargo.toml"))?;
    fs::write(folder.join("Cargo.toml"), workspace_manifest(&manifest))?;
    fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock"))?;
    Ok(pages_folder)
}

/// Runs the documentation examples of packages of the workspace.
fn run_examples(root: &Path, packages: impl IntoIterator<Item = String>) -> Result<(), Failure> {
    let folder = root.join(FOLDER);
    // One package at a time, because cargo unifies the features of packages built together.
    let failed = packages.into_iter().filter(|package| {
        let mut test = cargo(&folder, &format!("test --quiet --doc --package {package}"));
        run(test.arg("--target-dir").arg(root.join("target"))).is_err()
    });
    let failed: Vec<String> = failed.collect();
    if !failed.is_empty() {
        return Err(format!("examples of {} fail (in {FOLDER})", failed.join(", ")).into());
    }
    Ok(())
}

/// Returns the pages whose blocks are run, relative to the root.
fn pages(root: &Path, crates: &[Package]) -> Result<Vec<String>, Failure> {
    let mut pages = vec![String::from("README.md")];
    for entry in fs::read_dir(root.join("docs/guide"))? {
        pages.push(format!("docs/guide/{}", entry?.file_name().to_string_lossy()));
    }
    pages.extend(crates.iter().map(|member| format!("crates/{}/README.md", folder_name(member))));
    pages.sort_unstable();
    Ok(pages)
}

/// Returns the Rust blocks of a page that are not ignored, with line numbers.
fn blocks(page: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    let (mut line, mut rest) = (1, page);
    while let Some((before, after)) = rest.split_once("```") {
        let Some((block, behind)) = after.split_once("\n```") else { break };
        line += before.matches('\n').count();
        if let Some((language, code)) = block.split_once('\n')
            && language.starts_with("rust")
            && !language.contains("ignore")
        {
            found.push((line, code));
        }
        line += block.matches('\n').count() + 1;
        rest = behind;
    }
    found
}

/// Returns the crates used by a block, with their non-default features, as manifest entries.
fn needed(block: &str) -> Vec<String> {
    let mut crates = BTreeMap::<String, Vec<&str>>::new();
    for line in block.lines() {
        for path in line.split("asperity_").skip(1) {
            let Some((name, _)) = path.split_once("::") else { continue };
            let features = crates.entry(format!("asperity-{}", name.replace('_', "-"))).or_default();
            features.extend(line.split_once(NEEDS).and_then(|(_, feature)| feature.split('`').next()));
        }
    }
    let path = |name: &str| format!("../../crates/{}", name.trim_start_matches("asperity-"));
    crates
        .into_iter()
        .map(|(name, features)| format!("{name} = {{ path = \"{}\", features = {features:?} }}", path(&name)))
        .collect()
}

/// Appends a block as the example of a module named after its page and line.
fn module(modules: &mut String, page: &str, line: usize, block: &str) -> Result<(), Failure> {
    let name = page.replace(['/', '-', '.'], "_").to_lowercase();
    writeln!(modules, "pub mod {name}_{line} {{\n    //! ```")?;
    for code in block.lines() {
        writeln!(modules, "    //! {code}")?;
    }
    writeln!(modules, "    //! ```\n}}")?;
    Ok(())
}

fn page_manifest(name: &str, needed: &[String]) -> String {
    format!("[package]\nname = \"{name}\"\nedition = \"2024\"\n\n[dependencies]\n{}\n", needed.join("\n"))
}

/// Returns the workspace manifest's packages and versions, without members and lints.
fn workspace_manifest(manifest: &str) -> String {
    let tables = manifest
        .split("\n[")
        .filter(|table| table.starts_with("workspace.") && !table.starts_with("workspace.lints"));
    let tables: Vec<&str> = tables.collect();
    format!(
        "[workspace]\nresolver = \"3\"\nmembers = [\"crates/*\", \"pages/*\"]\n\n[profile.test]\ndebug = false\n\n[{}",
        tables.join("\n[")
    )
}

/// Returns a crate's manifest without workspace-only parts: other targets, their dependencies and
/// lints.
fn crate_manifest(manifest: &str) -> String {
    let kept = ["package]", "features]", "dependencies]"];
    let tables = manifest.trim_start_matches('[').split("\n[");
    let mut text = String::new();
    for table in tables.filter(|table| kept.iter().any(|name| table.starts_with(name))) {
        let lines =
            table.lines().filter(|line| !line.starts_with("readme ") && !line.starts_with("exclude "));
        text += &format!("[{}\n\n", lines.collect::<Vec<_>>().join("\n"));
    }
    text
}

fn write_crate(folder: &Path, member: &Package) -> Result<(), Failure> {
    let place = folder.join("crates").join(folder_name(member));
    for part in ["src", "docs"] {
        let source = member.manifest_path.with_file_name(part);
        if source.is_dir() {
            copy(&source, &place.join(part))?;
        }
    }
    let manifest = fs::read_to_string(&member.manifest_path)?;
    fs::write(place.join("Cargo.toml"), crate_manifest(&manifest))?;
    Ok(())
}

/// Copies a folder's files, except unchanged files.
fn copy(from: &Path, to: &Path) -> Result<(), Failure> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let source = entry?.path();
        let target = to.join(source.file_name().unwrap_or_default());
        if source.is_dir() {
            copy(&source, &target)?;
        } else if fs::read(&target).ok() != Some(fs::read(&source)?) {
            fs::copy(&source, &target)?;
        }
    }
    Ok(())
}

fn write(place: &Path, manifest: &str, lib: &str) -> Result<(), Failure> {
    fs::create_dir_all(place.join("src"))?;
    fs::write(place.join("Cargo.toml"), manifest)?;
    fs::write(place.join("src/lib.rs"), lib)?;
    Ok(())
}

/// Returns the folder of a crate in `crates`.
fn folder_name(member: &Package) -> &str {
    member.name.trim_start_matches("asperity-")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_page_is_tested_in_the_workspace() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let tested = fs::read_to_string(root.join("tests/src/pages.rs")).unwrap();
        let pages = pages(root, &metadata::published(root).unwrap()).unwrap();
        let missing: Vec<_> = pages.iter().filter(|page| !tested.contains(&format!("\"{page}\""))).collect();
        assert!(missing.is_empty(), "tests/src/pages.rs lacks {missing:?}");
    }

    #[test]
    fn blocks_returns_rust_with_its_line() {
        let page = "text\n```rust\na\nb\n```\n```sh\nc\n```\n\n```rust,ignore\nd\n```\n```rust\ne\n```\n";
        assert_eq!(blocks(page), [(2, "a\nb"), (13, "e")]);
    }

    #[test]
    fn needed_lists_crates_with_their_features() {
        let block = "use asperity_fif::Fif;\nuse asperity_ndf_sampling::{Ggx, check}; // feature `check`\n";
        assert_eq!(
            needed(block),
            [
                "asperity-fif = { path = \"../../crates/fif\", features = [] }",
                "asperity-ndf-sampling = { path = \"../../crates/ndf-sampling\", features = [\"check\"] }",
            ]
        );
    }

    #[test]
    fn crate_manifest_drops_dev_dependencies_targets_and_lints() {
        let manifest = "[package]\nname = \"a\"\nreadme = \"b\"\n\n[dependencies]\nc = \"1\"\n\n[dev-dependencies]\n\
                        d = \"1\"\n\n[[bench]]\nname = \"e\"\n\n[lints]\nworkspace = true\n";
        let kept = "[package]\nname = \"a\"\n\n[dependencies]\nc = \"1\"\n\n";
        assert_eq!(crate_manifest(manifest).replace("\n\n\n", "\n\n"), kept);
    }
}
