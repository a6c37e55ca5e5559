//! Modules, tests and orders of layers that the documents name are there.

use std::{fs, path::Path};

use super::imports;
use super::layers::{CRATES, Crate};
use crate::check::packages::links;

/// Every path that `a::{b, c::{d, e}}` stands for.
fn expanded(text: &str) -> Vec<String> {
    let paths = imports::read(&format!("use {text};"), &[]).unwrap_or_default().paths;
    paths.iter().map(|path| path.segments.join("::")).collect()
}

/// The words in backticks.
fn quoted(text: &str) -> Vec<String> {
    text.split('`').skip(1).step_by(2).flat_map(expanded).collect()
}

/// The crate that a path begins with, in the order that data takes through them, and its modules.
fn krate(path: &str) -> Option<(usize, &'static Crate, &str)> {
    let (name, modules) = path.split_once("::").unwrap_or((path, ""));
    let index = CRATES.iter().position(|krate| krate.name.replace('-', "_") == name)?;
    Some((index, &CRATES[index], modules))
}

/// Why a path into the crates' modules leads nowhere; its last part may be a name that the module
/// defines.
fn astray(root: &Path, path: &str) -> Option<String> {
    let (_, krate, modules) = krate(path)?;
    let mut place = root.join(krate.sources);
    for part in modules.split("::").filter(|part| !part.is_empty()) {
        let next = place.join(part);
        if next.is_dir() || next.with_extension("rs").is_file() {
            place = next;
            continue;
        }
        let text = fs::read_to_string(place.with_extension("rs")).unwrap_or_default();
        let defined = ["fn", "struct", "enum", "trait", "type", "const"]
            .iter()
            .any(|keyword| text.contains(&format!("{keyword} {part}")));
        return (!defined).then(|| format!("`{path}`: no `{part}` in {}", place.display()));
    }
    None
}

/// The modules of a coverage row, the last but two of its cells, and the tests, the last but one.
fn cells(row: &str) -> Option<[&str; 2]> {
    let mut cells = row.trim_matches('|').rsplit('|').skip(1);
    let tests = cells.next()?;
    Some([cells.next()?, tests])
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

#[test]
fn modules_and_tests_of_the_coverage_page_are_there() {
    let page = fs::read_to_string(root().join("docs/coverage.md")).unwrap();
    let rows: Vec<_> = page.lines().filter(|line| line.starts_with('|')).filter_map(cells).collect();
    assert!(rows.len() > 55);
    let modules: Vec<String> = rows.iter().flat_map(|[modules, _]| quoted(modules)).collect();
    assert!(modules.iter().filter(|path| path.contains("::")).count() > 50);
    let lost: Vec<_> = modules.iter().filter_map(|path| astray(root(), path)).collect();
    assert!(lost.is_empty(), "{lost:#?}");
    for test in rows.iter().flat_map(|[_, tests]| quoted(tests)) {
        let folders = ["fif", "ndf", "noise", "shading"].map(|name| format!("tests/tests/{name}/{test}.rs"));
        let renderer = format!("tools/render/tests/zoom/{test}.rs");
        let found = folders.iter().chain([&renderer]).any(|file| root().join(file).is_file());
        assert!(found, "no test `{test}`");
    }
}

#[test]
fn modules_of_the_architecture_are_there() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let lost: Vec<_> = quoted(&page).iter().filter_map(|path| astray(root(), path)).collect();
    assert!(lost.is_empty(), "{lost:#?}");
}

/// The place of a path in the order of crates and layers.
fn place(path: &str) -> Option<(usize, usize)> {
    let (index, krate, modules) = krate(path)?;
    Some((index, krate.layer(&modules.replace("::", "/"))?))
}

#[test]
fn the_ways_of_data_run_in_the_order_of_the_rooms() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let (_, section) = page.split_once("## Data flow").unwrap();
    let section = section.split("\n## ").next().unwrap();
    let ways: Vec<_> = section.split("\n- ").skip(1).collect();
    assert_eq!(ways.len(), 5);
    for way in ways {
        let steps = quoted(way);
        assert!(steps.len() >= 4, "{way}");
        let places: Vec<_> = steps
            .iter()
            .map(|step| place(step).unwrap_or_else(|| panic!("`{step}` is in no layer")))
            .collect();
        assert!(places.is_sorted(), "{steps:?}: {places:?}");
    }
}

#[test]
fn the_picture_of_the_rooms_is_their_order() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    for krate in CRATES {
        let line = format!("{}: {}", krate.name, krate.layers);
        assert!(page.contains(&line), "ARCHITECTURE.md must have `{line}`");
    }
}

#[test]
fn lists_are_expanded_and_paths_that_lead_nowhere_are_named() {
    assert_eq!(expanded("a::{b, c::{d, e}}"), ["a::b", "a::c::d", "a::c::e"]);
    assert_eq!(astray(root(), "noise::sums"), None);
    assert_eq!(astray(root(), "LevelOfDetail::Exact"), None);
    assert!(astray(root(), "noise::nowhere").unwrap().contains("nowhere"));
    assert!(astray(root(), "fif::ray::nowhere::at_all").is_some());
}

#[test]
fn book_lists_every_page_of_the_guide() {
    let docs = root().join("docs");
    let summary = fs::read_to_string(docs.join("SUMMARY.md")).unwrap();
    let listed: Vec<&str> = links(&summary).collect();
    for entry in fs::read_dir(docs.join("guide")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(listed.contains(&format!("guide/{name}").as_str()), "SUMMARY.md has no {name}");
    }
    for chapter in listed {
        let place = docs.join(chapter);
        let page = fs::read_to_string(&place).unwrap_or_else(|error| panic!("{chapter}: {error}"));
        for link in links(&page) {
            assert!(place.parent().unwrap().join(link).exists(), "{chapter} links to {link}");
        }
    }
}
