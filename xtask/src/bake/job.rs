//! A bake for many machines: tiles as tasks, and the set when all of them are there.

use crate::bake::plan::Plan;
use crate::cli::Bake;
use crate::failure::Result;
use crate::job::{self, Step};
use crate::progress;

/// Writes the job: a task for every so many tiles, and the step that joins them, in a folder that all machines share.
pub(super) fn write(wanted: &Bake, plan: &Plan, file: &std::path::Path) -> Result<()> {
    let all = plan.tiles() * plan.tiles();
    let [first, last] = plan.some(wanted.tiles)?;
    let out = std::path::absolute(&wanted.out)?.display().to_string();
    let mut arguments = job::arguments(std::env::args().skip(1), &["--job", "--tiles", "--out"])?;
    arguments.extend(["--out".into(), out]);
    let mut of_tile = arguments.clone();
    of_tile.extend(["--tiles".into(), job::number("Tile")]);
    let tiles = Step {
        name: "Tiles",
        tasks: Some(("Tile", format!("{first}-{last}"))),
        arguments: of_tile,
        after: None,
    };
    let set = Step { name: "Set", tasks: None, arguments, after: Some("Tiles") };
    let place = job::write(file, "asperity-bake", &[tiles, set])?;
    progress::say(&format!(
        "the job: {place} ({} of {all} tiles, then the set; `openjd run` or a farm carries it out)",
        last - first + 1
    ));
    Ok(())
}
