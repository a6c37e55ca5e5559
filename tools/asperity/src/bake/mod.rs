//! `asperity bake`: bakes a surface to engine textures, tile by tile.

pub(crate) mod arrays;
mod files;
mod formats;
mod gltf;
mod job;
mod maps;
mod materialx;
mod occlusion;
mod options;
mod plan;
mod provenance;
mod scratch;
mod set;
mod source;
mod sources;
mod texel;
mod tile;

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use crate::bake::plan::Plan;
use crate::bake::scratch::{Levels, Scratch};
use crate::bake::set::Set;
use crate::cli::bake::{Bake, BakedFormat};
use crate::failure::{Interrupted, Result};
use crate::invocation::Invocation;
use crate::output::Output;
use crate::progress;

/// Bakes the request and prints the output path.
pub(crate) fn bake(wanted: &Bake, invocation: &Invocation, interrupted: &AtomicBool) -> Result<()> {
    let [first, last] = options::parts(wanted)?;
    let plan = options::plan(wanted, first)?;
    if let Some(file) = &wanted.job {
        return job::write(wanted, &plan, file, invocation);
    }
    part(wanted, &plan, invocation, interrupted)?;
    for number in first + 1..=last {
        part(wanted, &options::plan(wanted, number)?, invocation, interrupted).inspect_err(|_| {
            progress::say(&format!(
                "{} parts are done; resume with `--part {number}-{last}`",
                number - first
            ));
        })?;
    }
    Ok(())
}

/// Bakes one part, or the whole texture.
fn part(wanted: &Bake, plan: &Plan, invocation: &Invocation, interrupted: &AtomicBool) -> Result<()> {
    let some = plan.some(wanted.tiles)?;
    let output = Output::new(&wanted.out)?;
    let output = plan.part.folder().map_or(Ok(output.clone()), |folder| output.inside(&folder))?;
    let program = std::fs::read(&invocation.binary)?;
    let started = Instant::now();
    let scratch = Scratch::new(plan, &output, &program)?;
    if wanted.tiles.is_none() {
        scratch.others(&output).iter().for_each(|line| progress::say(line));
    }
    let fresh = fill(plan, &scratch, some, interrupted)?;
    if wanted.tiles.is_some() {
        let ([first, last], all) = (some, plan.tiles() * plan.tiles());
        progress::say(&format!("tiles {first}–{last} of {all}: {}", output.place("")));
        return Ok(());
    }
    write(plan, scratch, &output, &wanted.format, interrupted)?;
    let seconds = started.elapsed().as_secs_f64();
    let megatexels = f64::from(plan.size) * f64::from(plan.size) / 1e6;
    let kept = if fresh < 1.0 { format!(", {:.0} % reused", 100.0 * (1.0 - fresh)) } else { String::new() };
    if !plan.source.varies().height {
        progress::say(
            "surface is flat, or its normals do not derive from a height: height map omitted, ambient occlusion is white",
        );
    }
    progress::say(&format!(
        "texture set written to {} ({megatexels:.1} megatexels in {seconds:.1} s{kept})",
        output.place("provenance.json")
    ));
    Ok(())
}

/// Bakes the missing tiles of a range, and returns the fraction of tiles that were missing.
fn fill(
    plan: &Plan,
    scratch: &Scratch<'_>,
    [first, last]: [u32; 2],
    interrupted: &AtomicBool,
) -> Result<f64> {
    let missing = scratch.missing([first, last]);
    let (bar, wanted) = (progress::bar("bake"), last + 1 - first);
    bar.set_length(wanted.into());
    bar.set_position(u64::from(wanted) - missing.len() as u64);
    for (done, &at) in missing.iter().enumerate() {
        scratch.bake(at, interrupted).map_err(|error| {
            let (kept, all) = (wanted as usize + done - missing.len(), plan.tiles() * plan.tiles());
            let of = if wanted == all { format!("{all}") } else { format!("these {wanted}") };
            if error.is::<Interrupted>() {
                format!("interrupted: {kept} of {of} tiles are done (run the same command to resume)").into()
            } else {
                error
            }
        })?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(missing.len() as f64 / f64::from(wanted))
}

/// Writes the set from all tiles, then removes the tiles.
fn write(
    plan: &Plan,
    scratch: Scratch<'_>,
    output: &Output,
    formats: &[BakedFormat],
    interrupted: &AtomicBool,
) -> Result<()> {
    let (tops, bar) = (scratch.tops()?, progress::bar("write"));
    let levels = Levels { scratch: &scratch, tops: &tops };
    files::write(&Set { plan, levels: &levels, formats, interrupted, bar: &bar }, output)?;
    bar.finish_and_clear();
    scratch.remove();
    Ok(())
}

#[cfg(test)]
mod tests;
