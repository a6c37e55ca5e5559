//! Splits a bake into a job for several machines: parts as tasks, or tiles followed by an assembly
//! step.

use crate::bake::options;
use crate::bake::plan::Plan;
use crate::cli::bake::Bake;
use crate::failure::Result;
use crate::invocation::Invocation;
use crate::job::{self, Step};
use crate::progress;

/// Writes the job: a task per part, or a task per tile and a step that assembles them. All machines
/// share the output folder.
pub(super) fn write(
    wanted: &Bake,
    plan: &Plan,
    file: &std::path::Path,
    invocation: &Invocation,
) -> Result<()> {
    if plan.part.of > 1 {
        return parts(wanted, file, invocation);
    }
    let all = plan.tiles() * plan.tiles();
    let [first, last] = plan.some(wanted.tiles)?;
    let arguments = arguments(wanted, invocation)?;
    let mut of_tile = arguments.clone();
    of_tile.extend(["--tiles".into(), job::number("Tile")]);
    let tiles = Step {
        name: "Tiles",
        tasks: Some(("Tile", format!("{first}-{last}"))),
        arguments: of_tile,
        after: None,
    };
    let set = Step { name: "Set", tasks: None, arguments, after: Some("Tiles") };
    let place = job::write(file, "asperity-bake", &invocation.command, &[tiles, set])?;
    progress::say(&format!(
        "job written to {place} ({} of {all} tiles, then the set; run it with `openjd run` or on a farm)",
        last - first + 1
    ));
    Ok(())
}

fn parts(wanted: &Bake, file: &std::path::Path, invocation: &Invocation) -> Result<()> {
    let [first, last] = options::parts(wanted)?;
    let mut arguments = arguments(wanted, invocation)?;
    arguments.extend(["--part".into(), job::number("Part")]);
    let tasks = Some(("Part", format!("{first}-{last}")));
    let place = job::write(
        file,
        "asperity-bake",
        &invocation.command,
        &[Step { name: "Parts", tasks, arguments, after: None }],
    )?;
    progress::say(&format!(
        "job written to {place} ({} parts; run it with `openjd run` or on a farm)",
        last - first + 1
    ));
    Ok(())
}

/// Returns the arguments common to all tasks.
fn arguments(wanted: &Bake, invocation: &Invocation) -> Result<Vec<String>> {
    let mut arguments = job::arguments(invocation.arguments(), &["--job", "--tiles", "--part", "--out"])?;
    arguments.extend(["--out".into(), std::path::absolute(&wanted.out)?.display().to_string()]);
    Ok(arguments)
}
