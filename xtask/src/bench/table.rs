//! The times and ratios as Markdown.

use std::fmt::Write;

use super::machine::Machine;
use super::times::{Contender, OURS, Row, Times};

/// The whole text of `peers.md`; `chart` is the name of the picture beside it.
pub(crate) fn markdown(machine: &Machine, times: &Times, chart: &str) -> String {
    let mut out = String::from("# Asperity beside its peers\n\n");
    for line in machine.lines() {
        let _ = writeln!(out, "- {line}");
    }
    let _ = writeln!(
        out,
        "- Medians of {} rounds in which all contenders of a row took turns, in one process; grids have a step of {} \
         cells. `xtask/peers/README.md` says what is measured and how.\n\n![Nanoseconds per sample of Asperity and of \
         the fastest peer]({chart})\n",
        times.rounds, times.step
    );
    out += &ratios(times);
    for form in forms(times) {
        let rows: Vec<_> =
            times.rows.iter().filter(|row| row.name.starts_with(&format!("{form}/"))).collect();
        let _ = write!(
            out,
            "\n## `{form}`\n\nNanoseconds per sample, ± half the distance between the quartiles.\n\n"
        );
        out += &form_table(form, &rows);
    }
    out
}

/// One line per row and level of ours; a peer counts at its level and at those above it.
pub(crate) fn ratios(times: &Times) -> String {
    let lines: Vec<_> = times
        .rows
        .iter()
        .flat_map(|row| row.ratios().into_iter().map(move |ratio| (row, ratio)))
        .map(|(row, ratio)| {
            vec![
                format!("`{}`", row.name),
                ratio.ours.level.clone(),
                number(ratio.ours.median()),
                number(ratio.peer.median()),
                format!("{}, {}", ratio.peer.library, ratio.peer.level),
                format!("{:.2}", ratio.value()),
            ]
        })
        .collect();
    let head = ["row", "level", "Asperity, ns", "fastest peer, ns", "which", "ratio"].map(str::to_owned);
    format!(
        "## Ratios\n\nThe fastest peer at the same SIMD level or below, over Asperity.\n\n{}",
        table(&head, &lines)
    )
}

fn forms(times: &Times) -> Vec<&str> {
    let mut forms = Vec::new();
    for row in &times.rows {
        let form = row.name.split('/').next().unwrap_or_default();
        if !forms.contains(&form) {
            forms.push(form);
        }
    }
    forms
}

fn form_table(form: &str, rows: &[&Row]) -> String {
    let mut contenders: Vec<&Contender> = Vec::new();
    for contender in rows.iter().flat_map(|row| &row.contenders) {
        if !contenders.iter().any(|c| same(c, contender)) {
            contenders.push(contender);
        }
    }
    contenders.sort_by_key(|c| c.library != OURS);
    let mut head = vec!["library".to_owned(), "level".to_owned()];
    head.extend(rows.iter().map(|row| row.name.trim_start_matches(form).trim_start_matches('/').to_owned()));
    let lines: Vec<_> = contenders
        .iter()
        .map(|contender| {
            let mut line =
                vec![format!("{} {}", contender.library, contender.version), contender.level.clone()];
            line.extend(rows.iter().map(|row| {
                let found = row.contenders.iter().find(|c| same(c, contender));
                found.map_or_else(String::new, |c| format!("{} ± {}", number(c.median()), number(c.spread())))
            }));
            line
        })
        .collect();
    table(&head, &lines)
}

fn same(a: &Contender, b: &Contender) -> bool {
    (&a.library, &a.level) == (&b.library, &b.level)
}

/// Nanoseconds with the digits that mean something.
pub(super) fn number(value: f64) -> String {
    if value < 10.0 { format!("{value:.2}") } else { format!("{value:.1}") }
}

/// Columns of equal width, the first to the left.
fn table(head: &[String], lines: &[Vec<String>]) -> String {
    let width = |column: usize| {
        let cells = lines.iter().filter_map(|line| line.get(column)).chain(head.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<_> = (0..head.len()).map(width).collect();
    let line = |cells: &[String]| {
        cells.iter().zip(&widths).enumerate().fold(String::from("|"), |mut out, (column, (cell, &width))| {
            let _ =
                if column == 0 { write!(out, " {cell:<width$} |") } else { write!(out, " {cell:>width$} |") };
            out
        })
    };
    let rule = widths.iter().enumerate().fold(String::from("|"), |mut out, (column, &width)| {
        let dashes = "-".repeat(width + 1);
        let _ = if column == 0 { write!(out, "{dashes}-|") } else { write!(out, "{dashes}:|") };
        out
    });
    let body = lines.iter().fold(String::new(), |out, cells| out + &line(cells) + "\n");
    format!("{}\n{rule}\n{body}", line(head))
}

#[cfg(test)]
mod tests {
    use super::super::times::tests::{contender, row};
    use super::*;

    fn times() -> Times {
        let mut calls = row();
        calls.name = "value/3-d/simplex-continuous".into();
        calls.contenders =
            vec![contender("asperity", "scalar", &[25.0]), contender("plain", "scalar", &[20.0])];
        Times { step: 0.05, rounds: 3, rows: vec![row(), calls] }
    }

    #[test]
    fn ratios_are_lines_of_equal_width() {
        let text = ratios(&times());
        let lines: Vec<_> = text.lines().skip(4).collect();
        assert_eq!(lines.len(), 2 + 3, "{text}");
        assert!(lines.iter().all(|line| line.chars().count() == lines[0].chars().count()), "{text}");
        assert_eq!(
            lines[3].split_whitespace().collect::<Vec<_>>().join(" "),
            "| `fill_grid/2-d/perlin-2002` | avx2 | 2.00 | 5.00 | fast, sse4.1 | 2.50 |"
        );
        assert!(lines[4].contains("0.80"), "{text}");
    }

    #[test]
    fn every_form_has_a_table_and_every_contender_a_line() {
        let machine = Machine {
            processor: "Some CPU".into(),
            cores: 2,
            features: vec!["sse2".into()],
            platform: "x86_64, linux".into(),
            rustc: "rustc 1.95.0".into(),
            fastnoise2: None,
        };
        let text = markdown(&machine, &times(), "peers.svg");
        for part in ["Some CPU", "FastNoise2: not measured", "](peers.svg)", "## `fill_grid`", "## `value`"] {
            assert!(text.contains(part), "{part}: {text}");
        }
        assert_eq!(text.matches("plain 1.2.3").count(), 2, "{text}");
        assert!(text.contains("10.0 ± 5.50"), "{text}");
    }
}
