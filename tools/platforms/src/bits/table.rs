//! The result table: groups of functions by platforms.

use std::fmt::Write;

use super::platform::Column;
use super::report::Report;

/// The reason why s390x has no column.
const OTHER_BIG_ENDIAN: &str = "- **s390x**, big-endian too: not run: `qemu-s390x` 7.2 computes the double-precision \
                                product of two single-precision numbers (MDEBR) wrongly,\n  1.5 × 1.5 as 0.1875.\n";

/// Returns the digests that differ from the golden digests, for display.
pub(super) fn differences(columns: &[Column], golden: &Report) -> Vec<String> {
    let of = |column: &Column| -> Vec<String> {
        let Ok(report) = &column.report else { return Vec::new() };
        let differences = report.differences(golden);
        differences.map(|(group, name)| format!("`{name}` of {group} on {}", column.title)).collect()
    };
    columns.iter().flat_map(of).collect()
}

/// Returns a line of the platforms with every golden digest, and a line per platform that could not
/// run.
pub(super) fn in_short(columns: &[Column], golden: &Report) -> Vec<String> {
    let ran: Vec<_> =
        columns.iter().filter(|column| column.report.is_ok()).map(|column| column.title).collect();
    let mut lines =
        vec![format!("{} functions equal the golden bits on {}", golden.rows.len(), ran.join("; "))];
    for column in columns {
        lines.extend(column.report.as_ref().err().map(|why| format!("not run: {}: {why}", column.title)));
    }
    lines
}

/// Returns the page.
pub(super) fn markdown(columns: &[Column], golden: &Report) -> String {
    let mut rows = vec![vec!["functions".to_owned(), "number".to_owned()]];
    rows[0].extend(columns.iter().map(|column| column.title.to_owned()));
    for group in golden.groups() {
        let count = golden.rows.iter().filter(|row| row.group == group).count();
        let mut row = vec![group.to_owned(), count.to_string()];
        row.extend(columns.iter().map(|column| cell(column, golden, group, count)));
        rows.push(row);
    }
    let mut text = format!(
        "# Bit equality\n\nDigests of {} functions of all four crates under `libm`, each of its values at some hundred points, with all NaN \
         treated as equal. **same**: all digests equal those of `tests/bits/golden.tsv`.\n\n",
        golden.rows.len()
    );
    aligned(&rows, &mut text);
    text += "\n## Methods\n\n";
    for column in columns {
        let how = column.report.as_ref().map_or_else(
            |why| format!("not run: {why}"),
            |report| format!("{}; lanes: {}", column.how, report.level),
        );
        let _ = writeln!(text, "- **{}**: {how}.", column.title);
    }
    text += OTHER_BIG_ENDIAN;
    text
}

fn cell(column: &Column, golden: &Report, group: &str, count: usize) -> String {
    let Ok(report) = &column.report else { return "not run".into() };
    match report.differences(golden).filter(|(of, _)| *of == group).count() {
        0 => "same".into(),
        other => format!("{other} of {count} differ"),
    }
}

/// Aligns the columns of a table.
fn aligned(rows: &[Vec<String>], text: &mut String) {
    let width = |k: usize| rows.iter().map(|row| row[k].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..rows[0].len()).map(width).collect();
    let mut line = |cells: &mut dyn Iterator<Item = String>| {
        let _ = writeln!(text, "| {} |", cells.collect::<Vec<_>>().join(" | "));
    };
    for (number, row) in rows.iter().enumerate() {
        line(&mut row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:width$}")));
        if number == 0 {
            line(&mut widths.iter().map(|&width| "-".repeat(width)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOLDEN: &str = "level\tneon\nnoise: kinds\tvalue\t02\nndf: maps\tGgx\t03\n";

    fn column(report: Result<&str, &str>) -> Column {
        Column {
            title: "Z80",
            how: "manually".into(),
            report: report.map(|text| Report::read(text).unwrap()).map_err(str::to_owned),
        }
    }

    #[test]
    fn differences_are_listed_and_counted() {
        let golden = Report::read(GOLDEN).unwrap();
        let columns = [column(Ok(&GOLDEN.replace("03", "04")))];
        assert_eq!(differences(&columns, &golden), ["`Ggx` of ndf: maps on Z80"]);
        let page = markdown(&columns, &golden);
        assert!(page.contains("| ndf: maps    | 1      | 1 of 1 differ |"), "{page}");
        assert!(page.contains("| noise: kinds | 1      | same          |"), "{page}");
        assert!(page.contains("- **Z80**: manually; lanes: neon.\n"), "{page}");
        assert!(differences(&[column(Ok(GOLDEN))], &golden).is_empty());
    }

    #[test]
    fn platforms_that_could_not_run_give_the_reason() {
        let page = markdown(&[column(Err("no Z80 available"))], &Report::read(GOLDEN).unwrap());
        let why = "- **Z80**: not run: no Z80 available.\n";
        assert!(page.contains("| not run |") && page.contains(why), "{page}");
        let golden = Report::read(GOLDEN).unwrap();
        let lines = in_short(&[column(Ok(GOLDEN)), column(Err("no Z80 available"))], &golden);
        assert_eq!(lines, ["2 functions equal the golden bits on Z80", "not run: Z80: no Z80 available"]);
    }
}
