//! The times and ratios as Markdown.

use std::collections::BTreeSet;

use crate::times::{Contender, OURS, Row, Times};

/// Returns the whole text of `peers.md`.
pub(crate) fn markdown(machine: &[String], times: &Times) -> String {
    let forms = times.rows.chunk_by(|a, b| a.form() == b.form());
    let tables: String = forms.map(form_table).collect();
    format!(
        "# Asperity compared with other libraries\n\n- {}\n\
         - Medians of {} rounds with all contenders of a row interleaved in one process; grids have a step of {} \
         cells. See `tools/peers/README.md` for the method.\n\n{}{tables}",
        machine.join("\n- "),
        times.rounds,
        times.step,
        ratios(times)
    )
}

/// Returns one line per row and Asperity level. A peer counts at its level and at higher levels.
pub(crate) fn ratios(times: &Times) -> String {
    let mut lines =
        vec![["row", "level", "Asperity, ns", "fastest peer, ns", "which", "ratio"].map(str::to_owned)];
    for row in &times.rows {
        lines.extend(row.ratios().into_iter().map(|ratio| {
            [
                format!("`{}`", row.name),
                ratio.ours.level.clone(),
                number(ratio.ours.median()),
                number(ratio.peer.median()),
                format!("{}, {}", ratio.peer.library, ratio.peer.level),
                format!("{:.2}", ratio.value()),
            ]
        }));
    }
    let lines = table(&lines);
    format!("## Ratios\n\nThe fastest peer at the same SIMD level or below, over Asperity.\n\n{lines}")
}

/// Returns the times of rows of one form: a column per row, and a line per contender, Asperity
/// first.
fn form_table(rows: &[Row]) -> String {
    let key = |contender: &Contender| (contender.library.clone(), contender.level.clone());
    let mut contenders: Vec<&Contender> = rows.iter().flat_map(|row| &row.contenders).collect();
    let mut seen = BTreeSet::new();
    contenders.retain(|contender| seen.insert(key(contender)));
    contenders.sort_by_key(|contender| contender.library != OURS);
    let names = rows.iter().map(|row| row.name[row.form().len()..].trim_start_matches('/').to_owned());
    let mut lines: Vec<Vec<String>> =
        vec![["library".into(), "level".into()].into_iter().chain(names).collect()];
    lines.extend(contenders.iter().map(|contender| {
        let times = rows.iter().map(|row| {
            let found = row.contenders.iter().find(|other| key(other) == key(contender));
            found.map_or_else(String::new, |c| format!("{} ± {}", number(c.median()), number(c.spread())))
        });
        let name = format!("{} {}", contender.library, contender.version);
        [name, contender.level.clone()].into_iter().chain(times).collect()
    }));
    let form = rows.first().map_or("", Row::form);
    format!("\n## `{form}`\n\nNanoseconds per sample, ± half the interquartile range.\n\n{}", table(&lines))
}

/// Formats nanoseconds with significant digits.
pub(super) fn number(value: f64) -> String {
    if value < 10.0 { format!("{value:.2}") } else { format!("{value:.1}") }
}

/// Aligns columns, the first to the left.
pub(super) fn table(lines: &[impl AsRef<[String]>]) -> String {
    let mut widths: Vec<usize> = Vec::new();
    for line in lines {
        let line = line.as_ref();
        widths.resize(widths.len().max(line.len()), 0);
        widths.iter_mut().zip(line).for_each(|(width, cell)| *width = (*width).max(cell.chars().count()));
    }
    let mut out = String::new();
    for (index, line) in lines.iter().enumerate() {
        let cells = line.as_ref().iter().zip(&widths).enumerate().map(|(column, (cell, &width))| {
            if column == 0 { format!(" {cell:<width$} |") } else { format!(" {cell:>width$} |") }
        });
        out += &format!("|{}\n", cells.collect::<String>());
        if index == 0 {
            let rules = widths.iter().enumerate().map(|(column, width)| {
                format!("{}{}|", "-".repeat(width + 1), if column == 0 { '-' } else { ':' })
            });
            out += &format!("|{}\n", rules.collect::<String>());
        }
    }
    out
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
    fn ratio_lines_have_equal_width() {
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
    fn every_form_has_a_table_with_all_contenders() {
        let machine = ["Processor: Some CPU".to_owned(), "FastNoise2: not measured".to_owned()];
        let text = markdown(&machine, &times());
        for part in ["Some CPU", "FastNoise2: not measured", "## `fill_grid`", "## `value`"] {
            assert!(text.contains(part), "{part}: {text}");
        }
        assert_eq!(text.matches("plain 1.2.3").count(), 2, "{text}");
        assert!(text.contains("10.0 ± 5.50"), "{text}");
    }
}
