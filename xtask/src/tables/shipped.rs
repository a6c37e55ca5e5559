//! The tables that a crate without allocator ships as constants, and the check that they have not drifted.

use std::{fs, path::Path};

use super::{
    noise_cdf::noise_statistics_source, noise_levels::noise_levels_source,
    noise_means::absolute_moments_source,
};
use crate::{figure::Failure, output::Output, progress};

/// One generated file: its folder and name in the source tree, and what makes its text.
type Shipped = (&'static str, &'static str, fn() -> String);

const SHIPPED: [Shipped; 3] = [
    ("crates/noise/src", "absolute_moments.rs", absolute_moments_source),
    ("crates/noise/src", "gaussian_levels.rs", noise_levels_source),
    ("crates/noise/src", "statistics_tables.rs", noise_statistics_source),
];

/// Writes every generated file into the source tree at `root`.
pub(crate) fn ship(root: &Path) -> Result<(), Failure> {
    for (folder, name, make) in SHIPPED {
        Output::new(root.join(folder))?.write(name, make().as_bytes())?;
        progress::say(&format!("wrote {folder}/{name}"));
    }
    Ok(())
}

/// Compares every generated file in the source tree at `root` with a newly made one.
pub(crate) fn check(root: &Path) -> Result<(), Failure> {
    for (folder, name, make) in SHIPPED {
        let path = root.join(folder).join(name);
        let there = fs::read_to_string(&path).map_err(|error| format!("{folder}/{name}: {error}"))?;
        // A checkout may have turned the line ends.
        if there.replace("\r\n", "\n") != make() {
            return Err(
                format!("{folder}/{name} has drifted: `cargo xtask tables --ship` makes it anew").into()
            );
        }
    }
    Ok(())
}
