//! `cargo xtask tidy`: who may know whom, the order of rooms, the files' heads, and the words that do not belong.

mod comparisons;
#[cfg(test)]
mod documents;
mod edges;
mod graph;
mod imports;
mod rooms;
mod words;

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::Path,
};

use cargo_metadata::{DependencyKind, MetadataCommand};

use crate::failure::Failure;
use edges::{Edge, forbidden_edges};
use graph::Survey;
use rooms::HOUSES;

/// The state of the house: lines to read, and what breaks a rule; no offences are a tidy house.
#[derive(Debug, Default)]
pub(crate) struct Report {
    pub(crate) lines: Vec<String>,
    pub(crate) offences: Vec<String>,
}

/// Looks at the whole workspace.
pub(crate) fn report() -> Result<Report, Failure> {
    let metadata = MetadataCommand::new().no_deps().other_options(vec!["--locked".into()]).exec()?;
    let mut edges = BTreeSet::new();
    let mut report = Report::default();
    for package in &metadata.packages {
        for dependency in &package.dependencies {
            edges.insert(Edge {
                from: package.name.to_string(),
                to: dependency.name.clone(),
                development: dependency.kind == DependencyKind::Development,
            });
        }
        if package.edition.as_str() != "2024" || package.rust_version.is_none() {
            let rule = format!("{}: edition and rust-version come from the workspace", package.name);
            report.offences.push(rule);
        }
        let manifest = fs::read_to_string(&package.manifest_path)?;
        if !manifest.contains("[lints]\nworkspace = true") {
            report.offences.push(format!("{}: the lints come from the workspace", package.name));
        }
    }
    report.offences.extend(forbidden_edges(&edges));
    let root = metadata.workspace_root.as_std_path();
    report.rooms(root)?;
    report.words(root)?;
    Ok(report)
}

impl Report {
    /// The order of rooms, crate by crate.
    fn rooms(&mut self, root: &Path) -> Result<(), Failure> {
        let mut orders = vec![String::new()];
        self.lines.push(Survey::HEAD.into());
        for house in HOUSES {
            let folder = root.join(house.sources);
            let mut files = BTreeMap::new();
            sources(&folder, &mut |path, text| {
                let below = path.strip_prefix(&folder).unwrap_or(path);
                let below: Vec<_> = below.iter().map(|part| part.to_string_lossy()).collect();
                files.insert(below.join("/"), text.to_owned());
            })?;
            let survey = Survey::new(house, &files);
            self.lines.push(survey.row(house));
            orders.push(format!("{}: {survey}", house.name));
            let offences = survey.offences(house);
            if house.held {
                self.offences.extend(offences);
            } else {
                orders.extend(offences.into_iter().map(|line| format!("  not held yet: {line}")));
            }
        }
        self.lines.append(&mut orders);
        Ok(())
    }

    /// Heads of files, words that do not belong, first words of doc lines, floats compared by hand.
    fn words(&mut self, root: &Path) -> Result<(), Failure> {
        let mut counts = BTreeMap::<String, [usize; 3]>::new();
        for folder in ["crates", "xtask", "tests"] {
            sources(&root.join(folder), &mut |path, text| {
                let shown = path.strip_prefix(root).unwrap_or(path).display().to_string().replace('\\', "/");
                self.offences.extend(words::offences(&shown, text));
                let vague = words::vague_doc_lines(&shown, text);
                let place = shown.splitn(3, '/').take(2).collect::<Vec<_>>().join("/");
                let [lines, doc, by_hand] = counts.entry(place).or_default();
                *lines += text.lines().count();
                *doc += vague.len();
                *by_hand += comparisons::by_hand(text);
                if words::DOC_LINES_HELD.iter().any(|folder| shown.starts_with(folder)) {
                    self.offences.extend(vague);
                }
            })?;
        }
        self.lines.push(String::new());
        self.lines.push("sources               lines  vague doc lines  floats compared by hand".into());
        for (place, [lines, doc, by_hand]) in counts {
            self.lines.push(format!("{place:<20} {lines:6}  {doc:15}  {by_hand:23}"));
        }
        Ok(())
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn this_workspace_is_tidy() {
        assert_eq!(report().unwrap().offences, Vec::<String>::new());
    }
}
