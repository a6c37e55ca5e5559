//! The table of crates, and what is not covered of each, by file and function.

use std::fmt::Write;

use super::lcov::File;

/// The page.
pub(super) fn markdown(packages: &[String], files: &[File]) -> String {
    let mut crates: Vec<&str> = files.iter().map(|file| file.of.as_str()).collect();
    crates.sort_unstable();
    crates.dedup();
    let mut text = format!(
        "# Lines that tests run\n\nLines of code of every crate, tests left out, that ran at least once in the tests of {}. `cargo xtask \
         coverage` counts them.\nExamples in docs are tests too, and are not counted here, nor is `tests/shaders`, which\nruns the shaders and what fills their uniforms under an interpreter.\n\n| crate | files | lines | run | |\n|---|---|---|---|---|\n",
        packages.join(", ")
    );
    let of = |name: &str| files.iter().filter(|file| file.of == name).cloned().collect::<Vec<_>>();
    for name in &crates {
        row(&format!("`{name}`"), &of(name), &mut text);
    }
    row("all", files, &mut text);
    text +=
        "\n## What is not covered\n\nFunctions with lines that no test ran, and the number of those lines.\n";
    for name in crates {
        let _ = write!(text, "\n### `{name}`\n\n");
        let mut files = of(name);
        files.retain(|file| !file.missed.is_empty());
        files.sort_by_key(|file| std::cmp::Reverse(file.missed_lines()));
        for file in files {
            let missed: Vec<_> =
                file.missed.iter().map(|(name, lines)| format!("`{name}` {lines}")).collect();
            let share = percent(file.lines - file.missed_lines(), file.lines);
            let _ = writeln!(text, "- `{}`, {share}: {}", file.name, missed.join(", "));
        }
    }
    text
}

fn row(name: &str, files: &[File], text: &mut String) {
    let lines: usize = files.iter().map(|file| file.lines).sum();
    let run = lines - files.iter().map(File::missed_lines).sum::<usize>();
    let _ = writeln!(text, "| {name} | {} | {lines} | {run} | {} |", files.len(), percent(run, lines));
}

/// A share with one digit behind the point, rounded down, so that all is said of all alone.
fn percent(part: usize, whole: usize) -> String {
    let thousandths = 1000 * part / whole.max(1);
    format!("{}.{} %", thousandths / 10, thousandths % 10)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crates_are_summed_and_what_is_missed_most_comes_first() {
        let file = |name: &str, lines, missed: &[(&str, usize)]| File {
            of: "noise".into(),
            name: name.into(),
            lines,
            missed: missed.iter().map(|&(name, lines)| (name.to_owned(), lines)).collect(),
        };
        let files = [
            file("a.rs", 100, &[("one", 1)]),
            file("b.rs", 900, &[("two", 2), ("three", 1)]),
            file("c.rs", 1, &[]),
        ];
        let page = markdown(&["asperity-noise".into()], &files);
        assert!(page.contains("| `noise` | 3 | 1001 | 997 | 99.6 % |"), "{page}");
        assert!(
            page.ends_with("- `b.rs`, 99.6 %: `two` 2, `three` 1\n- `a.rs`, 99.0 %: `one` 1\n"),
            "{page}"
        );
    }

    #[test]
    fn all_is_said_of_all_alone() {
        assert_eq!([percent(9999, 10_000), percent(7, 7), percent(0, 0)], ["99.9 %", "100.0 %", "0.0 %"]);
    }
}
