//! `cargo xtask tidy`: dependencies between packages, the order of modules, first lines of files,
//! idioms of the pages.

mod allowed;
mod comparisons;
#[cfg(test)]
mod documents;
mod idioms;
mod imports;
mod layers;
mod source;
mod survey;

use std::{collections::BTreeMap, fs, io, path::Path};

use crate::failure::Failure;
use crate::metadata;
use layers::CRATES;
use survey::Survey;

/// Lines to print, and the broken rules.
#[derive(Debug, Default)]
pub(crate) struct Report {
    pub(crate) lines: Vec<String>,
    offences: Vec<String>,
}

/// Checks the whole workspace.
pub(crate) fn report() -> Result<Report, Failure> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("no workspace")?;
    let mut report = Report::default();
    for package in metadata::members(root)? {
        let name = &package.name;
        report.offences.extend(
            package.dependencies.iter().filter_map(|dependency| {
                allowed::forbidden(name, &dependency.name, dependency.kind == "dev")
            }),
        );
        if package.entry["edition"] != "2024" || package.entry["rust_version"].is_null() {
            report.offences.push(format!("{name}: edition and rust-version come from the workspace"));
        }
        if package.targets.iter().any(|target| target.kind == "custom-build") {
            report.offences.push(format!("{name}: packages have no build script"));
        }
        if !fs::read_to_string(&package.manifest_path)?.contains("[lints]\nworkspace = true") {
            report.offences.push(format!("{name}: the lints come from the workspace"));
        }
    }
    report.layers(root)?;
    report.words(root)?;
    files(root, root, "md", &mut |path, text| report.offences.extend(idioms::offences(&path, &text)))?;
    Ok(report)
}

impl Report {
    /// An error that names every broken rule, if there is one.
    pub(crate) fn verdict(&self) -> Result<(), Failure> {
        if self.offences.is_empty() { Ok(()) } else { Err(self.offences.join("\n       ").into()) }
    }

    /// The layers of every crate.
    fn layers(&mut self, root: &Path) -> Result<(), Failure> {
        let mut orders = vec![String::new()];
        self.lines.push(Survey::HEAD.into());
        for krate in CRATES {
            let folder = root.join(krate.sources);
            let mut files = BTreeMap::new();
            self::files(&folder, &folder, "rs", &mut |path, text| drop(files.insert(path, text)))?;
            let survey = Survey::new(krate, &files)?;
            self.lines.push(survey.row);
            orders.push(format!("{}: {}", krate.name, survey.order));
            self.offences.extend(survey.offences);
        }
        self.lines.append(&mut orders);
        Ok(())
    }

    /// First lines of files, leftovers, and counts of lines and of floats compared by hand.
    fn words(&mut self, root: &Path) -> Result<(), Failure> {
        let mut counts = BTreeMap::<String, [usize; 2]>::new();
        for folder in ["crates", "tools", "xtask", "tests"] {
            files(root, &root.join(folder), "rs", &mut |path, text| {
                self.offences.extend(source::offences(&path, &text));
                let place = path.splitn(3, '/').take(2).collect::<Vec<_>>().join("/");
                let [lines, by_hand] = counts.entry(place).or_default();
                *lines += text.lines().count();
                *by_hand += comparisons::by_hand(&text);
            })?;
        }
        self.lines.push("\nsources               lines  floats compared by hand".into());
        for (place, [lines, by_hand]) in counts {
            self.lines.push(format!("{place:<20} {lines:6}  {by_hand:23}"));
        }
        Ok(())
    }
}

/// Visits every file with an extension below a folder: its path from the root, with slashes, and
/// its text.
fn files(
    root: &Path,
    folder: &Path,
    extension: &str,
    look: &mut impl FnMut(String, String),
) -> Result<(), Failure> {
    let mut paths = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>()?;
    paths.sort();
    for path in paths {
        let skipped = path.ends_with("target") || path.ends_with("node_modules") || path.ends_with(".git");
        if path.is_dir() && !skipped {
            files(root, &path, extension, look)?;
        } else if path.extension().is_some_and(|ending| ending == extension) {
            let below = path.strip_prefix(root)?.display().to_string().replace('\\', "/");
            look(below, fs::read_to_string(&path)?);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn this_workspace_is_tidy() {
        report().unwrap().verdict().unwrap();
    }
}
