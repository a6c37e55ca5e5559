//! Counts of lines in the format of lcov, without the tests that stand in the same files.

use std::path::{Path, PathBuf};

/// A file with its lines that are code: numbers from 1 on, and how often each ran.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Lines {
    pub(super) path: PathBuf,
    pub(super) counts: Vec<(usize, u64)>,
}

/// A file of a crate's sources.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct File {
    /// The folder of the crate, then the file's path under its `src`.
    pub(super) of: String,
    pub(super) name: String,
    pub(super) lines: usize,
    /// Functions with lines that never ran, in order, and the number of those lines.
    pub(super) missed: Vec<(String, usize)>,
}

impl File {
    pub(super) fn missed_lines(&self) -> usize {
        self.missed.iter().map(|(_, lines)| lines).sum()
    }
}

/// The files of an export.
pub(super) fn read(text: &str) -> Vec<Lines> {
    let mut files: Vec<Lines> = Vec::new();
    for line in text.lines() {
        if let Some(path) = line.strip_prefix("SF:") {
            files.push(Lines { path: path.into(), counts: Vec::new() });
        } else if let (Some(file), Some((number, count))) =
            (files.last_mut(), line.strip_prefix("DA:").and_then(|counts| counts.split_once(',')))
            && let (Ok(number), Ok(count)) = (number.parse(), count.parse())
        {
            file.counts.push((number, count));
        }
    }
    files
}

/// A file if it is of a crate's sources, without its tests.
pub(super) fn of_sources(lines: &Lines, crates: &Path) -> Option<File> {
    let inside = lines.path.strip_prefix(crates).ok()?.to_string_lossy().replace('\\', "/");
    let (of, name) = inside.split_once("/src/")?;
    let source = std::fs::read_to_string(&lines.path).ok()?;
    let (lines, missed) = counted(&source, &lines.counts);
    (lines > 0).then(|| File { of: of.into(), name: name.into(), lines, missed })
}

/// The number of a source's lines before its tests, and its functions with lines that never ran.
fn counted(source: &str, counts: &[(usize, u64)]) -> (usize, Vec<(String, usize)>) {
    let source: Vec<&str> = source.lines().collect();
    // Tests of their own file stand at its end.
    let tests = source.windows(2).position(|two| two[0] == "#[cfg(test)]" && two[1].starts_with("mod tests"));
    let end = tests.unwrap_or(source.len());
    let counts = counts.iter().filter(|(number, _)| (1..=end).contains(number));
    let mut missed: Vec<(String, usize)> = Vec::new();
    for (number, _) in counts.clone().filter(|(_, count)| *count == 0) {
        let name = source[..*number].iter().rev().find_map(|line| function(line)).unwrap_or("(none)");
        match missed.last_mut() {
            Some((last, lines)) if last == name => *lines += 1,
            _ => missed.push((name.into(), 1)),
        }
    }
    (counts.count(), missed)
}

/// The name of the function that a line begins.
fn function(line: &str) -> Option<&str> {
    let line = line.trim_start();
    if line.starts_with("//") {
        return None;
    }
    let (before, after) = line.split_once("fn ")?;
    let is_head = before.split_whitespace().all(|word| {
        word.starts_with("pub") || ["const", "unsafe", "extern", "in"].contains(&word) || word.ends_with(')')
    });
    let end = after.find(|c: char| !c.is_alphanumeric() && c != '_')?;
    (is_head && end > 0).then(|| &after[..end])
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = "//! A file.\npub(crate) fn one() {\n    a();\n}\n    pub const fn two<T>(f: fn (T)) {\n        // fn no\n        b();\n        c();\n    }\n#[cfg(test)]\nmod tests {\n    fn three() {\n    }\n}\n";

    #[test]
    fn lines_of_files_are_read() {
        let files = read("SF:/a/src/b.rs\nDA:2,7\nDA:3,0\nLF:2\nend_of_record\nSF:/c.rs\nDA:1,1\n");
        let [(first, counts), (second, _)] =
            [0, 1].map(|k| (files[k].path.to_str().unwrap(), files[k].counts.clone()));
        assert_eq!((first, counts, second), ("/a/src/b.rs", vec![(2, 7), (3, 0)], "/c.rs"));
    }

    #[test]
    fn lines_that_never_ran_are_of_their_function_and_tests_are_left_out() {
        let (lines, missed) = counted(SOURCE, &[(2, 1), (3, 1), (5, 1), (7, 0), (8, 0), (12, 0)]);
        assert_eq!((lines, missed), (5, vec![("two".to_owned(), 2)]));
        let (lines, missed) = counted(SOURCE, &[(3, 0)]);
        assert_eq!((lines, missed), (1, vec![("one".to_owned(), 1)]));
    }
}
