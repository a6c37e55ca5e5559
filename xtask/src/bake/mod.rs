//! `cargo xtask bake`: a surface as textures for engines, tile by tile.

mod files;
mod formats;
mod gltf;
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
use crate::cli::{Bake, BakedFormat};
use crate::failure::{Interrupted, Result};
use crate::output::Output;
use crate::progress;

/// Bakes what was asked for and tells where it lies.
pub(crate) fn bake(wanted: &Bake, interrupted: &AtomicBool) -> Result<()> {
    let plan = options::plan(wanted)?;
    let output = Output::new(&wanted.out)?;
    let program = std::env::current_exe().and_then(std::fs::read)?;
    let started = Instant::now();
    let fresh = fill(&plan, &output, &program, &wanted.format, interrupted)?;
    let seconds = started.elapsed().as_secs_f64();
    let megatexels = f64::from(plan.size) * f64::from(plan.size) / 1e6;
    let kept = if fresh < 1.0 {
        format!(", {:.0} % of it from before", 100.0 * (1.0 - fresh))
    } else {
        String::new()
    };
    progress::say(&format!(
        "the set: {} ({megatexels:.1} megatexels in {seconds:.1} s{kept})",
        output.place("provenance.json")
    ));
    Ok(())
}

/// Bakes the tiles that are missing, writes the set, and returns the share of tiles that were missing.
fn fill(
    plan: &Plan,
    output: &Output,
    program: &[u8],
    formats: &[BakedFormat],
    interrupted: &AtomicBool,
) -> Result<f64> {
    let scratch = Scratch::new(plan, output, program)?;
    let missing = scratch.missing();
    let bar = progress::bar("bake");
    let all = u64::from(plan.tiles()).pow(2);
    bar.set_length(all);
    bar.set_position(all - missing.len() as u64);
    for (done, &at) in missing.iter().enumerate() {
        scratch.bake(at, interrupted).map_err(|error| {
            let kept = all - (missing.len() - done) as u64;
            if error.is::<Interrupted>() {
                format!("interrupted; {kept} of {all} tiles are kept, run the same command to go on").into()
            } else {
                error
            }
        })?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    let tops = scratch.tops()?;
    let bar = progress::bar("write");
    let levels = Levels { scratch: &scratch, tops: &tops };
    files::write(&Set { plan, levels: &levels, formats, interrupted, bar: &bar }, output)?;
    bar.finish_and_clear();
    scratch.remove();
    Ok(missing.len() as f64 / all as f64)
}

#[cfg(test)]
mod tests;
