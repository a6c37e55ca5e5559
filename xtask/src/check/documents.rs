//! Modules and tests that the documents name are there.

use std::{fs, path::Path};

/// Every path that `a::{b, c::{d, e}}` stands for.
fn expanded(text: &str) -> Vec<String> {
    let Some((head, list)) = text.split_once('{') else { return vec![text.trim().to_owned()] };
    let list = list.strip_suffix('}').unwrap_or(list);
    let (mut parts, mut depth) = (vec![String::new()], 0);
    for c in list.chars() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        match parts.last_mut() {
            Some(last) if c != ',' || depth > 0 => last.push(c),
            _ => parts.push(String::new()),
        }
    }
    let below = parts.iter().flat_map(|part| expanded(part.trim()));
    below.map(|path| format!("{}{path}", head.trim())).collect()
}

/// The words in backticks.
fn quoted(text: &str) -> Vec<String> {
    text.split('`').skip(1).step_by(2).flat_map(expanded).collect()
}

/// The folder of a crate's sources by its name in paths.
fn sources(name: &str) -> Option<&'static str> {
    Some(match name {
        "noise" => "crates/noise/src",
        "ndf_sampling" => "crates/ndf-sampling/src",
        "fif" => "crates/fif/src",
        "shading" => "crates/shading/src",
        "render" => "xtask/render/src",
        "xtask" => "xtask/src",
        _ => return None,
    })
}

/// Why a path into the crates' modules leads nowhere; its last part may be a name that the module defines.
fn astray(root: &Path, path: &str) -> Option<String> {
    let mut parts = path.split("::");
    let mut place = root.join(sources(parts.next()?)?);
    for part in parts {
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
        assert!(folders.iter().any(|file| root().join(file).is_file()), "no test `{test}`");
    }
}

#[test]
fn modules_of_the_architecture_are_there() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let lost: Vec<_> = quoted(&page).iter().filter_map(|path| astray(root(), path)).collect();
    assert!(lost.is_empty(), "{lost:#?}");
}

#[test]
fn lists_are_expanded_and_paths_that_lead_nowhere_are_named() {
    assert_eq!(expanded("a::{b, c::{d, e}}"), ["a::b", "a::c::d", "a::c::e"]);
    assert_eq!(astray(root(), "noise::sums"), None);
    assert_eq!(astray(root(), "LevelOfDetail::Exact"), None);
    assert!(astray(root(), "noise::nowhere").unwrap().contains("nowhere"));
    assert!(astray(root(), "fif::ray::nowhere::at_all").is_some());
}
