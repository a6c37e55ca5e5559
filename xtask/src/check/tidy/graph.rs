//! Files of a crate as a graph of imports: arrows between rooms, arrows up, circles, imports through the root.

use std::{
    collections::{BTreeMap, BTreeSet},
    fmt::{self, Display, Formatter},
};

use super::{
    imports::{self, Imports},
    rooms::House,
};

/// A crate as its sources are.
#[derive(Debug, Default)]
pub(super) struct Survey {
    /// Files by module: the path from the root, slashes between, without `.rs` and `/mod`.
    pub(super) files: BTreeSet<String>,
    /// Files and the files that they import from, with the line of the first import.
    pub(super) arrows: BTreeMap<(String, String), usize>,
    /// Arrows from a room to a later one.
    pub(super) up: Vec<(String, String)>,
    /// Files that import one another, each circle sorted.
    pub(super) circles: Vec<Vec<String>>,
    /// Imports of a name from the crate's root: file, line, path.
    pub(super) through_root: Vec<(String, usize, String)>,
    /// Files in no room.
    pub(super) homeless: Vec<String>,
    /// Names that the root exports, modules not counted.
    pub(super) face: usize,
    /// Modules that the root exports.
    pub(super) modules: usize,
    rooms: Vec<(&'static str, usize)>,
}

impl Survey {
    /// Reads a crate: every file by its path below the folder of sources, and its text.
    pub(super) fn new(house: &House, sources: &BTreeMap<String, String>) -> Self {
        let modules: BTreeMap<String, &String> =
            sources.iter().map(|(path, text)| (module(path).to_owned(), text)).collect();
        let read: BTreeMap<&str, Imports> = modules
            .iter()
            .map(|(name, text)| (name.as_str(), imports::read(text, &children(&modules, name))))
            .collect();
        let tests: Vec<String> = read
            .iter()
            .flat_map(|(name, imports)| {
                let own = imports.test_only.then(|| (*name).to_owned());
                imports.test_modules.iter().map(|child| below(name, child)).chain(own)
            })
            .collect();
        let is_test = |name: &str| {
            tests.iter().any(|test| {
                name.strip_prefix(test.as_str()).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
            })
        };
        let mut survey = Self::default();
        if let Some(root) = read.get("") {
            survey.face = root.public.iter().collect::<BTreeSet<_>>().len();
            survey.modules = root.public_modules.len();
        }
        for (name, imports) in &read {
            if name.is_empty() || is_test(name) {
                continue;
            }
            survey.files.insert((*name).into());
            for path in &imports.paths {
                let Some(absolute) = absolute(name, path, &modules) else {
                    continue;
                };
                let mut target = owner(&absolute, &modules);
                if target.is_empty() {
                    // Of the root's own modules only: what it exports belongs to another file.
                    survey.through_root.push(((*name).into(), path.line, path.segments.join("::")));
                    let Some(at) = exporter(read.get(""), &absolute, &modules) else {
                        continue;
                    };
                    target = at;
                }
                if target != *name && !is_test(&target) {
                    survey.arrows.entry(((*name).into(), target)).or_insert(path.line);
                }
            }
        }
        survey.rooms = house.rooms.iter().map(|room| (*room, 0)).collect();
        let places: BTreeMap<&String, Option<usize>> =
            survey.files.iter().map(|file| (file, place(house, file))).collect();
        for (file, at) in &places {
            match at {
                Some(at) => survey.rooms[*at].1 += 1,
                None => survey.homeless.push((*file).clone()),
            }
        }
        survey.up = survey
            .arrows
            .keys()
            .filter(|(from, to)| {
                let at = |file| places.get(file).copied().flatten();
                at(from).zip(at(to)).is_some_and(|(from, to)| from < to)
            })
            .cloned()
            .collect();
        survey.circles = circles(&survey.files, &survey.arrows);
        survey
    }

    /// The largest number of files in one folder.
    pub(super) fn side_by_side(&self) -> usize {
        let mut folders = BTreeMap::<&str, usize>::new();
        for file in &self.files {
            *folders.entry(file.rsplit_once('/').map_or("", |(folder, _)| folder)).or_default() += 1;
        }
        folders.values().copied().max().unwrap_or(0)
    }

    /// Everything that breaks a rule, one line each.
    pub(super) fn offences(&self, house: &House) -> Vec<String> {
        let at = |file: &str, line: usize| format!("{}/{file}:{line}", house.sources);
        let mut found = Vec::new();
        for (from, to) in &self.up {
            let line = self.arrows[&(from.clone(), to.clone())];
            found.push(format!("{}: an arrow up, to {to}", at(from, line)));
        }
        for circle in &self.circles {
            found.push(format!(
                "{}: files import one another in a circle: {}",
                house.name,
                circle.join(", ")
            ));
        }
        for (file, line, path) in &self.through_root {
            found.push(format!("{}: `{path}` is imported through the crate's root", at(file, *line)));
        }
        for file in &self.homeless {
            found.push(format!("{}: {file} is in no room of the order", house.name));
        }
        for (room, _) in self.rooms.iter().filter(|(_, files)| *files == 0) {
            found.push(format!("{}: the room `{room}` of the order is empty", house.name));
        }
        if house.face.is_some_and(|most| self.face > most) {
            found.push(format!("{}: the root exports {} names", house.name, self.face));
        }
        found
    }

    /// The first line of the table.
    pub(super) const HEAD: &'static str = "crate            rooms  files  side by side  arrows  up  circles (largest)  through root  names + modules";

    /// The crate's line of the table.
    pub(super) fn row(&self, house: &House) -> String {
        let largest = self.circles.iter().map(Vec::len).max().unwrap_or(0);
        format!(
            "{:<16} {:5}  {:5}  {:12}  {:6}  {:2}  {:7} ({largest:7})  {:12}  {:5} + {}",
            house.name,
            self.rooms.len(),
            self.files.len(),
            self.side_by_side(),
            self.arrows.len(),
            self.up.len(),
            self.circles.len(),
            self.through_root.len(),
            self.face,
            self.modules,
        )
    }
}

/// The rooms in their order, with the number of files of each.
impl Display for Survey {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (i, (room, files)) in self.rooms.iter().enumerate() {
            write!(f, "{}{room} {files}", if i == 0 { "" } else { " ← " })?;
        }
        Ok(())
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

fn below(folder: &str, name: &str) -> String {
    if folder.is_empty() { name.into() } else { format!("{folder}/{name}") }
}

/// The modules in files directly below one.
fn children<'a>(modules: &'a BTreeMap<String, &String>, name: &str) -> Vec<&'a str> {
    let child = |other: &'a String| {
        let rest =
            if name.is_empty() { Some(other.as_str()) } else { other.strip_prefix(name)?.strip_prefix('/') };
        rest.filter(|rest| !rest.is_empty() && !rest.contains('/'))
    };
    modules.keys().filter_map(child).collect()
}

/// A path from the crate's root, or none where it leads out of the crate.
fn absolute(file: &str, path: &imports::Path, modules: &BTreeMap<String, &String>) -> Option<Vec<String>> {
    let mut here: Vec<String> = file.split('/').filter(|part| !part.is_empty()).map(str::to_owned).collect();
    here.extend(path.within.iter().cloned());
    let first = path.segments.first()?;
    let rest = match first.as_str() {
        "crate" => {
            here.clear();
            &path.segments[1..]
        }
        "self" => &path.segments[1..],
        "super" => {
            let up = path.segments.iter().take_while(|part| *part == "super").count();
            here.truncate(here.len().saturating_sub(up));
            &path.segments[up..]
        }
        // A path that begins with a module below.
        child => {
            modules.contains_key(&below(&here.join("/"), child)).then_some(())?;
            &path.segments[..]
        }
    };
    here.extend(rest.iter().cloned());
    Some(here)
}

/// The file that the longest beginning of a path names; the root's is empty.
fn owner(path: &[String], modules: &BTreeMap<String, &String>) -> String {
    (0..=path.len())
        .rev()
        .map(|end| path[..end].join("/"))
        .find(|name| modules.contains_key(name))
        .unwrap_or_default()
}

/// The file from which the root exports a name.
fn exporter(root: Option<&Imports>, path: &[String], modules: &BTreeMap<String, &String>) -> Option<String> {
    let name = path.first()?;
    let exported = root?.paths.iter().find(|path| path.exported.as_ref() == Some(name))?;
    let at = owner(&absolute("", exported, modules)?, modules);
    (!at.is_empty()).then_some(at)
}

/// The room of a file: the one with the longest name that is the file or a folder around it.
fn place(house: &House, file: &str) -> Option<usize> {
    let inside = |name: &str| {
        file.strip_prefix(name)
            .is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
            .then_some(name.len())
    };
    let rooms = house.rooms.iter().enumerate();
    let matches = rooms.filter_map(|(at, room)| Some((room.split(' ').filter_map(inside).max()?, at)));
    matches.max().map(|(_, at)| at)
}

/// Groups of files of which each reaches every other.
fn circles(files: &BTreeSet<String>, arrows: &BTreeMap<(String, String), usize>) -> Vec<Vec<String>> {
    let mut next = BTreeMap::<&str, Vec<&str>>::new();
    for (from, to) in arrows.keys() {
        next.entry(from).or_default().push(to);
    }
    let reached: BTreeMap<&str, BTreeSet<&str>> = files
        .iter()
        .map(|file| {
            let (mut seen, mut open) = (BTreeSet::new(), vec![file.as_str()]);
            while let Some(at) = open.pop() {
                open.extend(next.get(at).into_iter().flatten().filter(|to| seen.insert(**to)));
            }
            (file.as_str(), seen)
        })
        .collect();
    let mut found = BTreeSet::new();
    for (file, seen) in &reached {
        let back = |other: &&&str| reached.get(**other).is_some_and(|seen| seen.contains(file));
        let circle: Vec<String> = seen.iter().filter(back).map(|file| (*file).to_owned()).collect();
        if circle.len() > 1 {
            found.insert(circle);
        }
    }
    found.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOUSE: House = House {
        name: "x",
        sources: "x/src",
        rooms: &["math", "low", "high/inner", "high"],
        face: Some(2),
        held: true,
    };

    /// Three rooms in order, with more text for some files.
    fn survey(more: &[(&str, &str)]) -> Survey {
        let mut sources = BTreeMap::from([
            ("lib.rs", "mod math; mod low; mod high; pub use high::top::{Top, Other};".to_owned()),
            ("math.rs", String::new()),
            ("low/mod.rs", "pub(super) mod a; pub(super) mod b;".into()),
            ("low/a.rs", "use crate::math::sqrt;".into()),
            ("low/b.rs", "use super::a::A; fn f() { crate::math::abs(1.0) }".into()),
            ("high/mod.rs", "mod inner; mod top; pub use top::Top;".into()),
            ("high/inner.rs", "use crate::low::{a::A, b::B};".into()),
            (
                "high/top.rs",
                "use super::inner::I; #[cfg(test)] mod tests { use crate::Top; use super::*; }".into(),
            ),
        ]);
        for (file, text) in more {
            sources.entry(file).or_default().push_str(text);
        }
        let sources = sources.into_iter().map(|(file, text)| (file.to_owned(), text)).collect();
        Survey::new(&HOUSE, &sources)
    }

    fn offences(more: &[(&str, &str)]) -> Vec<String> {
        survey(more).offences(&HOUSE)
    }

    #[test]
    fn arrows_down_are_allowed() {
        assert_eq!(offences(&[]), Vec::<String>::new());
        let survey = survey(&[]);
        assert_eq!((survey.files.len(), survey.arrows.len(), survey.face), (7, 7, 2));
        assert_eq!(survey.to_string(), "math 1 ← low 3 ← high/inner 1 ← high 2");
    }

    #[test]
    fn an_arrow_up_is_refused() {
        let up = ["x/src/low/a:1: an arrow up, to high/inner"];
        assert_eq!(offences(&[("low/a.rs", "fn f() -> crate::high::inner::J { todo!() }")])[0], up[0]);
        // A room inside a folder has its own place in the order.
        assert_eq!(
            offences(&[("high/inner.rs", "use super::top::Top;")])[0],
            "x/src/high/inner:1: an arrow up, to high/top"
        );
    }

    #[test]
    fn a_circle_is_refused_within_a_room_too() {
        let circle = ["x: files import one another in a circle: low/a, low/b"];
        assert_eq!(offences(&[("low/a.rs", "use super::b::B;")]), circle);
        // A face that exports a file closes a circle with a file that imports from the face.
        let through_face = ["x: files import one another in a circle: high, high/top"];
        assert_eq!(offences(&[("high/top.rs", "use super::Shown;")]), through_face);
    }

    #[test]
    fn an_import_through_the_root_is_refused() {
        let through = "x/src/low/a:1: `crate::Top` is imported through the crate's root";
        assert!(offences(&[("low/a.rs", "use crate::Top;")]).contains(&through.into()));
        assert_eq!(offences(&[("low/b.rs", "use crate::{math::abs, low::a};")]), Vec::<String>::new());
    }

    #[test]
    fn a_file_has_a_room_and_a_room_has_files() {
        assert_eq!(
            offences(&[("stray.rs", "use crate::math::abs;")]),
            ["x: stray is in no room of the order"]
        );
        assert_eq!(offences(&[("lib.rs", "pub struct Third;")]), ["x: the root exports 3 names"]);
        let empty = House { rooms: &["math", "low", "high", "attic"], ..HOUSE };
        assert_eq!(survey(&[]).offences(&empty), Vec::<String>::new());
        let sources = BTreeMap::from([("math.rs".to_owned(), String::new())]);
        let said = Survey::new(&House { rooms: &["math", "attic"], ..HOUSE }, &sources).offences(&HOUSE);
        assert_eq!(said, ["x: the room `attic` of the order is empty"]);
    }
}
