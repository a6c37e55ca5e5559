//! The tables that a crate without allocator ships as constants and the pictures of its pages, and the check that they have
//! not drifted.

use std::{fs, path::Path};

use super::{
    noise_cdf::noise_statistics_source, noise_cellular::cellular_statistics_source,
    noise_levels::noise_levels_source, noise_means::absolute_moments_source, noise_pictures::noise_pictures,
};
use crate::{failure::Failure, output::Output, progress};

/// One generated file: its folder and name in the source tree, and what makes its text.
type Shipped = (&'static str, &'static str, fn() -> String);

const SHIPPED: [Shipped; 4] = [
    ("crates/noise/src/statistics", "absolute_moments.rs", absolute_moments_source),
    ("crates/noise/src/statistics", "cellular.rs", cellular_statistics_source),
    ("crates/noise/src/lattice", "gaussian_levels.rs", noise_levels_source),
    ("crates/noise/src/statistics", "tables.rs", noise_statistics_source),
];

/// Folder of the pictures of the noise crate's pages.
const PICTURES: &str = "crates/noise/docs/pictures";

/// Writes every generated file into the source tree at `root`.
pub(crate) fn ship(root: &Path) -> Result<(), Failure> {
    let mut changed = false;
    for (folder, name, make) in SHIPPED {
        let text = make();
        changed |= fs::read(root.join(folder).join(name)).ok().as_deref() != Some(text.as_bytes());
        Output::new(root.join(folder))?.write(name, text.as_bytes())?;
        progress::say(&format!("wrote {folder}/{name}"));
    }
    if changed {
        // This program still has the constants from before.
        progress::say("constants have changed: run it once more, and the pictures are drawn with them");
        return Ok(());
    }
    let folder = Output::new(root.join(PICTURES))?;
    for (name, bytes) in noise_pictures()? {
        folder.write(&name, &bytes)?;
    }
    progress::say(&format!("wrote {PICTURES}"));
    Ok(())
}

/// Compares every generated file in the source tree at `root` with a newly made one.
pub(crate) fn check(root: &Path) -> Result<(), Failure> {
    for (folder, name, make) in SHIPPED {
        compare(root, folder, name, make().as_bytes())?;
    }
    noise_pictures()?.iter().try_for_each(|(name, bytes)| compare(root, PICTURES, name, bytes))
}

fn compare(root: &Path, folder: &str, name: &str, made: &[u8]) -> Result<(), Failure> {
    let mut there =
        fs::read(root.join(folder).join(name)).map_err(|error| format!("{folder}/{name}: {error}"))?;
    if !name.ends_with(".png") {
        // A checkout may have turned the line ends.
        there.retain(|&byte| byte != b'\r');
    }
    if there != made {
        return Err(format!("{folder}/{name} has drifted: `cargo xtask tables --ship` makes it anew").into());
    }
    Ok(())
}
