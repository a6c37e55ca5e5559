//! `cargo xtask bits`: the values of every crate on every platform at hand, beside the golden ones.

mod platform;
mod report;
mod table;

use std::path::Path;

use crate::failure::Result;
use crate::report::{say, write};
use platform::Column;
use report::Report;

/// The program that computes and digests.
const PROBE: &str = "tests/bits";
/// The golden digests, in the probe's folder.
const GOLDEN: &str = "golden.tsv";

/// The table of every platform; an error if one has other bits than the golden ones.
pub(crate) fn table(root: &Path) -> Result<String> {
    let (columns, golden) = compared(root, true)?;
    Ok(table::markdown(&columns, &golden))
}

/// The quick check: the platforms that build fast. Prints which platforms ran and which are
/// missing.
pub(crate) fn gate(root: &Path) -> Result<()> {
    let (columns, golden) = compared(root, false)?;
    table::in_short(&columns, &golden).iter().for_each(|line| say(&format!("  {line}")));
    Ok(())
}

fn compared(root: &Path, all: bool) -> Result<(Vec<Column>, Report)> {
    let golden = Report::read(&std::fs::read_to_string(root.join(PROBE).join(GOLDEN))?)?;
    let columns = platform::columns(&root.join(PROBE), all)?;
    let differences = table::differences(&columns, &golden);
    let Some(first) = differences.first() else { return Ok((columns, golden)) };
    say(&table::markdown(&columns, &golden));
    Err(format!(
        "{} digests are other than golden; the first is {first}. A change of values is value-breaking: `cargo xtask bits --ship` makes \
         the new ones golden",
        differences.len()
    )
    .into())
}

/// Makes this machine's digests golden and returns the table, if every platform has them.
pub(crate) fn ship(root: &Path) -> Result<String> {
    let columns = platform::columns(&root.join(PROBE), true)?;
    let golden =
        columns.iter().find_map(|column| column.report.as_ref().ok()).ok_or("nothing could be run")?;
    if let Some(first) = table::differences(&columns, golden).first() {
        return Err(format!("platforms differ, so nothing is golden: {first}").into());
    }
    write(&root.join(PROBE).join(GOLDEN), golden.text().as_bytes())?;
    Ok(table::markdown(&columns, golden))
}
