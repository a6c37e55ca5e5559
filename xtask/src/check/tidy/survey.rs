//! The imports between the files of a crate: against the order of layers, in cycles, through the
//! root.

use std::collections::{BTreeMap, BTreeSet};

use super::imports::{self, Imports};
use super::layers::Crate;
use crate::failure::Failure;

/// The layers and imports of a crate.
#[derive(Debug)]
pub(super) struct Survey {
    /// The crate's line of the table.
    pub(super) row: String,
    /// The layers in their order, with the number of files of each.
    pub(super) order: String,
    /// Everything that breaks a rule, one line each.
    pub(super) offences: Vec<String>,
}

impl Survey {
    /// The first line of the table.
    pub(super) const HEAD: &'static str = "crate           layers  files  most in one folder  imports  upward  in cycles  through root  names + modules";

    /// Reads a crate: every file by its path below the folder of sources, and its text.
    pub(super) fn new(krate: &Crate, sources: &BTreeMap<String, String>) -> Result<Self, Failure> {
        let files = Files::read(sources)?;
        let place = |file: &str, line: usize| format!("{}/{file}:{line}", krate.sources);
        // Files and the files that they import from, with the place of the first import.
        let mut edges = BTreeMap::<(&str, &str), String>::new();
        let mut through_root = Vec::new();
        for (file, imports) in files.modules() {
            for path in &imports.paths {
                let Some(absolute) = files.absolute(file, path) else { continue };
                let mut target = files.owner(&absolute);
                if target.is_empty() {
                    // The root owns only its modules. Its exports belong to other files.
                    let (path, at) = (path.segments.join("::"), place(file, path.line));
                    through_root.push(format!("{at}: `{path}` is imported through the crate's root"));
                    target = files.exporter(&absolute).unwrap_or_default();
                }
                if !target.is_empty() && target != file {
                    edges.entry((file, target)).or_insert_with(|| place(file, path.line));
                }
            }
        }
        let layers: BTreeMap<&str, Option<usize>> =
            files.modules().map(|(file, _)| (file, krate.layer(file))).collect();
        let is_up = |from, to| layers[from].zip(layers[to]).is_some_and(|(from, to)| from < to);
        let up = edges.iter().filter(|((from, to), _)| is_up(from, to));
        let mut offences: Vec<String> =
            up.map(|((_, to), place)| format!("{place}: imports {to}, a later layer")).collect();
        let upward = offences.len();
        let mut broken = |rule: String| offences.push(format!("{}: {rule}", krate.name));
        let cycles = in_cycles(edges.keys().copied().collect());
        if !cycles.is_empty() {
            broken(format!("files import one another in a cycle: {}", cycles.join(", ")));
        }
        for (file, _) in layers.iter().filter(|(_, layer)| layer.is_none()) {
            broken(format!("{file} is in no layer"));
        }
        let mut order = Vec::new();
        for (at, layer) in krate.layers().enumerate() {
            let count = layers.values().filter(|of| **of == Some(at)).count();
            order.push(format!("{layer} {count}"));
            if count == 0 {
                broken(format!("the layer `{layer}` is empty"));
            }
        }
        let [names, modules] =
            files.0.get("").map_or([0; 2], |root| [root.public.len(), root.public_modules.len()]);
        if krate.max_exports.is_some_and(|most| names > most) {
            broken(format!("the root exports {names} names"));
        }
        let mut folders = BTreeMap::<&str, usize>::new();
        files.modules().for_each(|(file, _)| *folders.entry(split(file).0).or_default() += 1);
        let row = format!(
            "{:<15} {:6}  {:5}  {:18}  {:7}  {upward:6}  {:9}  {:12}  {names:5} + {modules}",
            krate.name,
            order.len(),
            layers.len(),
            folders.values().max().unwrap_or(&0),
            edges.len(),
            cycles.len(),
            through_root.len(),
        );
        offences.append(&mut through_root);
        Ok(Self { row, order: order.join(" ← "), offences })
    }
}

/// The imports of a crate's files by module: the path from the root, which has no name, slashes
/// between; without tests.
struct Files(BTreeMap<String, Imports>);

impl Files {
    fn read(sources: &BTreeMap<String, String>) -> Result<Self, Failure> {
        let names: Vec<&str> = sources.keys().map(|path| module(path)).collect();
        let (mut files, mut tests) = (BTreeMap::new(), Vec::new());
        for (name, text) in names.iter().zip(sources.values()) {
            let below = names.iter().map(|other| split(other)).filter(|(folder, _)| folder == name);
            let children: Vec<&str> =
                below.map(|(_, child)| child).filter(|child| !child.is_empty()).collect();
            let imports = imports::read(text, &children).map_err(|error| format!("{name}.rs: {error}"))?;
            tests.extend(imports.test_modules.iter().map(|child| joined(&[name, child])));
            tests.extend(imports.test_only.then(|| (*name).to_owned()));
            files.insert((*name).to_owned(), imports);
        }
        files.retain(|name, _| {
            !tests.iter().any(|test| name == test || name.starts_with(&format!("{test}/")))
        });
        Ok(Self(files))
    }

    /// Every file but the root.
    fn modules(&self) -> impl Iterator<Item = (&str, &Imports)> {
        self.0.iter().filter(|(name, _)| !name.is_empty()).map(|(name, imports)| (name.as_str(), imports))
    }

    /// A path from the crate's root, or none where it leads out of the crate.
    fn absolute<'a>(&self, file: &'a str, path: &'a imports::Path) -> Option<Vec<&'a str>> {
        let mut here: Vec<&str> = file.split('/').filter(|part| !part.is_empty()).collect();
        here.extend(path.within.iter().map(String::as_str));
        let mut rest = path.segments.iter().map(String::as_str).peekable();
        match *rest.peek()? {
            "crate" => {
                here.clear();
                rest.next();
            }
            "self" => drop(rest.next()),
            "super" => {
                while rest.next_if_eq(&"super").is_some() {
                    here.pop();
                }
            }
            // A path that begins with a module below.
            child => drop(self.0.get(&joined(&[&here[..], &[child]].concat()))?),
        }
        here.extend(rest);
        Some(here)
    }

    /// The file that the longest beginning of a path names; the root's is empty.
    fn owner(&self, path: &[&str]) -> &str {
        let beginnings = (0..=path.len()).rev().map(|end| joined(&path[..end]));
        let known = beginnings.filter_map(|name| self.0.get_key_value(&name)).next();
        known.map_or("", |(name, _)| name)
    }

    /// The file from which the root exports a name.
    fn exporter(&self, path: &[&str]) -> Option<&str> {
        let exported = self.0.get("")?.public.get(*path.first()?)?.as_ref()?;
        Some(self.owner(&self.absolute("", exported)?))
    }
}

/// `a/b/mod.rs` and `a/b.rs` are the module `a/b`; `lib.rs` and `main.rs` are the root, which has
/// no name.
fn module(path: &str) -> &str {
    let path = path.strip_suffix(".rs").unwrap_or(path);
    match path {
        "lib" | "main" | "mod" => "",
        _ => path.strip_suffix("/mod").unwrap_or(path),
    }
}

/// The folder of a module and its name there.
fn split(module: &str) -> (&str, &str) {
    module.rsplit_once('/').unwrap_or(("", module))
}

fn joined(parts: &[&str]) -> String {
    parts.join("/").trim_start_matches('/').to_owned()
}

/// The files in cycles of imports: those that remain after repeatedly removing files without
/// imports or importers.
fn in_cycles<'a>(mut edges: BTreeSet<(&'a str, &'a str)>) -> Vec<&'a str> {
    loop {
        let count = edges.len();
        let (from, to): (BTreeSet<_>, BTreeSet<_>) = edges.iter().copied().unzip();
        edges.retain(|(a, b)| to.contains(a) && from.contains(b));
        if edges.len() == count {
            return from.into_iter().collect();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CRATE: Crate =
        Crate {
            name: "x", sources: "x/src", layers: "math → low → high/inner → high", max_exports: Some(2)
        };

    /// Surveys four layers in order, with more text for some files.
    fn survey(krate: &Crate, more: &[(&str, &str)]) -> Survey {
        let mut sources: BTreeMap<String, String> = [
            ("lib.rs", "mod math; mod low; mod high; pub use high::top::{Top, Other};"),
            ("math.rs", ""),
            ("low/mod.rs", "pub(super) mod a; pub(super) mod b;"),
            ("low/a.rs", "use crate::math::sqrt;"),
            ("low/b.rs", "use super::a::A; fn f() { crate::math::abs(1.0) }"),
            ("high/mod.rs", "mod inner; mod top; pub use top::Top;"),
            ("high/inner.rs", "use crate::low::{a::A, b::B};"),
            ("high/top.rs", "use super::inner::I; #[cfg(test)] mod tests { use crate::Top; use super::*; }"),
        ]
        .map(|(file, text)| (file.into(), text.into()))
        .into();
        for (file, text) in more {
            sources.entry((*file).into()).or_default().push_str(text);
        }
        Survey::new(krate, &sources).unwrap()
    }

    #[test]
    fn imports_of_earlier_layers_are_allowed() {
        let survey = survey(&CRATE, &[]);
        assert_eq!(survey.offences, Vec::<String>::new());
        assert_eq!(survey.order, "math 1 ← low 3 ← high/inner 1 ← high 2");
        let numbers: Vec<_> = survey.row.split_whitespace().collect();
        assert_eq!(numbers, ["x", "4", "7", "3", "7", "0", "0", "0", "2", "+", "0"]);
    }

    #[test]
    fn every_broken_rule_is_named() {
        for (file, text, offences) in [
            (
                "low/a.rs",
                "fn f() -> crate::high::inner::J { g() }",
                &[
                    "x/src/low/a:1: imports high/inner, a later layer",
                    "x: files import one another in a cycle: high/inner, low/a, low/b",
                ][..],
            ),
            // A layer inside a folder has its own position.
            (
                "high/inner.rs",
                "use super::top::Top;",
                &[
                    "x/src/high/inner:1: imports high/top, a later layer",
                    "x: files import one another in a cycle: high/inner, high/top",
                ],
            ),
            ("low/a.rs", "use super::b::B;", &["x: files import one another in a cycle: low/a, low/b"]),
            // A module that re-exports a file is in a cycle with a file that imports from the
            // module.
            ("high/top.rs", "use super::Shown;", &["x: files import one another in a cycle: high, high/top"]),
            (
                "high/top.rs",
                "use crate::Top;",
                &["x/src/high/top:1: `crate::Top` is imported through the crate's root"],
            ),
            ("low/b.rs", "use crate::{math::abs, low::a};", &[]),
            ("stray.rs", "use crate::math::abs;", &["x: stray is in no layer"]),
            ("lib.rs", "pub struct Third;", &["x: the root exports 3 names"]),
        ] {
            assert_eq!(survey(&CRATE, &[(file, text)]).offences, offences, "{file}: {text}");
        }
        let krate = Crate { layers: "math → low → high → attic", ..CRATE };
        assert_eq!(survey(&krate, &[]).offences, ["x: the layer `attic` is empty"]);
    }
}
