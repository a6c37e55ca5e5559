//! Files of a crate as a graph of imports: arrows between rooms, arrows up, circles, imports through the root.

use std::collections::{BTreeMap, BTreeSet};

use super::imports::{self, Imports};
use super::rooms::House;
use crate::failure::Failure;

/// A crate as its sources are.
#[derive(Debug)]
pub(super) struct Survey {
    /// The crate's line of the table.
    pub(super) row: String,
    /// The rooms in their order, with the number of files of each.
    pub(super) order: String,
    /// Everything that breaks a rule, one line each.
    pub(super) offences: Vec<String>,
}

impl Survey {
    /// The first line of the table.
    pub(super) const HEAD: &'static str =
        "crate            rooms  files  side by side  arrows  up  in circles  through root  names + modules";

    /// Reads a crate: every file by its path below the folder of sources, and its text.
    pub(super) fn new(house: &House, sources: &BTreeMap<String, String>) -> Result<Self, Failure> {
        let files = Files::read(sources)?;
        let place = |file: &str, line: usize| format!("{}/{file}:{line}", house.sources);
        // Files and the files that they import from, with the place of the first import.
        let mut arrows = BTreeMap::<(&str, &str), String>::new();
        let mut through_root = Vec::new();
        for (file, imports) in files.modules() {
            for path in &imports.paths {
                let Some(absolute) = files.absolute(file, path) else { continue };
                let mut target = files.owner(&absolute);
                if target.is_empty() {
                    // Of the root's own modules only: what it exports belongs to another file.
                    let (path, at) = (path.segments.join("::"), place(file, path.line));
                    through_root.push(format!("{at}: `{path}` is imported through the crate's root"));
                    target = files.exporter(&absolute).unwrap_or_default();
                }
                if !target.is_empty() && target != file {
                    arrows.entry((file, target)).or_insert_with(|| place(file, path.line));
                }
            }
        }
        let rooms: BTreeMap<&str, Option<usize>> =
            files.modules().map(|(file, _)| (file, house.room(file))).collect();
        let is_up = |from, to| rooms[from].zip(rooms[to]).is_some_and(|(from, to)| from < to);
        let up = arrows.iter().filter(|((from, to), _)| is_up(from, to));
        let mut offences: Vec<String> =
            up.map(|((_, to), place)| format!("{place}: an arrow up, to {to}")).collect();
        let ups = offences.len();
        let mut broken = |rule: String| offences.push(format!("{}: {rule}", house.name));
        let circles = in_circles(arrows.keys().copied().collect());
        if !circles.is_empty() {
            broken(format!("files import one another in a circle: {}", circles.join(", ")));
        }
        for (file, _) in rooms.iter().filter(|(_, room)| room.is_none()) {
            broken(format!("{file} is in no room of the order"));
        }
        let mut order = Vec::new();
        for (at, room) in house.rooms().enumerate() {
            let count = rooms.values().filter(|of| **of == Some(at)).count();
            order.push(format!("{room} {count}"));
            if count == 0 {
                broken(format!("the room `{room}` of the order is empty"));
            }
        }
        let [names, modules] =
            files.0.get("").map_or([0; 2], |root| [root.public.len(), root.public_modules.len()]);
        if house.face.is_some_and(|most| names > most) {
            broken(format!("the root exports {names} names"));
        }
        let mut folders = BTreeMap::<&str, usize>::new();
        files.modules().for_each(|(file, _)| *folders.entry(split(file).0).or_default() += 1);
        let row = format!(
            "{:<16} {:5}  {:5}  {:12}  {:6}  {ups:2}  {:10}  {:12}  {names:5} + {modules}",
            house.name,
            order.len(),
            rooms.len(),
            folders.values().max().unwrap_or(&0),
            arrows.len(),
            circles.len(),
            through_root.len(),
        );
        offences.append(&mut through_root);
        Ok(Self { row, order: order.join(" ← "), offences })
    }
}

/// The imports of a crate's files by module: the path from the root, which has no name, slashes between; without tests.
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

/// `a/b/mod.rs` and `a/b.rs` are the module `a/b`; `lib.rs` and `main.rs` are the root, which has no name.
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

/// Files that are left when those that import no other, or that no other imports, are taken away again and again.
fn in_circles<'a>(mut arrows: BTreeSet<(&'a str, &'a str)>) -> Vec<&'a str> {
    loop {
        let count = arrows.len();
        let (from, to): (BTreeSet<_>, BTreeSet<_>) = arrows.iter().copied().unzip();
        arrows.retain(|(a, b)| to.contains(a) && from.contains(b));
        if arrows.len() == count {
            return from.into_iter().collect();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOUSE: House =
        House { name: "x", sources: "x/src", rooms: "math → low → high/inner → high", face: Some(2) };

    /// Three rooms in order, with more text for some files.
    fn survey(house: &House, more: &[(&str, &str)]) -> Survey {
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
        Survey::new(house, &sources).unwrap()
    }

    #[test]
    fn arrows_down_are_allowed() {
        let survey = survey(&HOUSE, &[]);
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
                    "x/src/low/a:1: an arrow up, to high/inner",
                    "x: files import one another in a circle: high/inner, low/a, low/b",
                ][..],
            ),
            // A room inside a folder has its own place in the order.
            (
                "high/inner.rs",
                "use super::top::Top;",
                &[
                    "x/src/high/inner:1: an arrow up, to high/top",
                    "x: files import one another in a circle: high/inner, high/top",
                ],
            ),
            ("low/a.rs", "use super::b::B;", &["x: files import one another in a circle: low/a, low/b"]),
            // A face that exports a file closes a circle with a file that imports from the face.
            (
                "high/top.rs",
                "use super::Shown;",
                &["x: files import one another in a circle: high, high/top"],
            ),
            (
                "high/top.rs",
                "use crate::Top;",
                &["x/src/high/top:1: `crate::Top` is imported through the crate's root"],
            ),
            ("low/b.rs", "use crate::{math::abs, low::a};", &[]),
            ("stray.rs", "use crate::math::abs;", &["x: stray is in no room of the order"]),
            ("lib.rs", "pub struct Third;", &["x: the root exports 3 names"]),
        ] {
            assert_eq!(survey(&HOUSE, &[(file, text)]).offences, offences, "{file}: {text}");
        }
        let house = House { rooms: "math → low → high → attic", ..HOUSE };
        assert_eq!(survey(&house, &[]).offences, ["x: the room `attic` of the order is empty"]);
    }
}
