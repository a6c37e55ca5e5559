//! The tables committed as constants of a crate without allocator, the images of its pages, and the
//! check that they are up to date.

use std::io::{self, Write};
use std::{fs, path::Path};

use crate::{
    albedos::{albedos_source, charlie_source},
    glass_albedos::glass_source,
    noise_cdf::noise_statistics_source,
    noise_cellular::cellular_statistics_source,
    noise_levels::noise_levels_source,
    noise_means::absolute_moments_source,
    noise_pictures::noise_pictures,
};
use asperity_output::Output;
use asperity_render::failure::Failure;

/// A generated file: folder and name in the source tree, and the function that returns its text.
type Shipped = (&'static str, &'static str, fn() -> String);

const SHIPPED: [Shipped; 7] = [
    ("crates/noise/src/statistics", "absolute_moments.rs", absolute_moments_source),
    ("crates/noise/src/statistics", "cellular.rs", cellular_statistics_source),
    ("crates/noise/src/lattice", "gaussian_levels.rs", noise_levels_source),
    ("crates/noise/src/statistics", "tables.rs", noise_statistics_source),
    ("crates/shading/src/reflectance/energy", "tables.rs", albedos_source),
    ("crates/shading/src/reflectance/energy", "glass_tables.rs", glass_source),
    ("crates/shading/src/reflectance/fuzz", "charlie_albedo.rs", charlie_source),
];

/// Folder of the images of the noise crate's pages.
const PICTURES: &str = "crates/noise/docs/pictures";

/// Writes every generated file into the source tree at `root`.
pub(crate) fn ship(root: &Path) -> Result<(), Failure> {
    let mut changed = false;
    for (folder, name, make) in SHIPPED {
        let text = make();
        changed |= fs::read(root.join(folder).join(name)).ok().as_deref() != Some(text.as_bytes());
        Output::new(root.join(folder))?.write(name, text.as_bytes())?;
        say(&format!("wrote {folder}/{name}"));
    }
    if changed {
        // This program still contains the previous constants.
        say("constants have changed: run this command again to update the images");
        return Ok(());
    }
    let folder = Output::new(root.join(PICTURES))?;
    for (name, bytes) in noise_pictures()? {
        folder.write(&name, &bytes)?;
    }
    say(&format!("wrote {PICTURES}"));
    Ok(())
}

/// Compares every generated file in the source tree at `root` with a new one, and lists the files
/// that differ.
pub(crate) fn check(root: &Path) -> Result<(), Failure> {
    let sources = SHIPPED.map(|(folder, name, make)| (folder, name.to_owned(), make().into_bytes()));
    let pictures = noise_pictures()?.into_iter().map(|(name, bytes)| (PICTURES, name, bytes));
    let made = sources.into_iter().chain(pictures);
    let others = made.filter(|(folder, name, bytes)| !is_there(&root.join(folder).join(name), bytes));
    let others: Vec<_> = others.map(|(folder, name, _)| format!("{folder}/{name}")).collect();
    if others.is_empty() {
        return Ok(());
    }
    let hint = "run `cargo xtask tables` to write them";
    Err(format!("missing or drifted: {}; {hint}", others.join(", ")).into())
}

/// Prints one line; a closed pipe is not an error.
pub(crate) fn say(line: &str) {
    let _ = writeln!(io::stdout(), "{line}");
}

fn is_there(path: &Path, made: &[u8]) -> bool {
    let Ok(mut there) = fs::read(path) else { return false };
    if path.extension().is_none_or(|ending| ending != "png") {
        // A checkout may have converted the line endings.
        there.retain(|&byte| byte != b'\r');
    }
    there == made
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn compare_finds_every_flipped_bit_and_ignores_line_endings() {
        let scratch = tempfile::tempdir().unwrap();
        let (text, path) = (b"const A: [u8; 2] = [1, 2];\n// M\n", scratch.path().join("a.rs"));
        fs::write(&path, "const A: [u8; 2] = [1, 2];\r\n// M\r\n").unwrap();
        assert!(is_there(&path, text) && !is_there(&scratch.path().join("b.rs"), text));
        for bit in 0..8 * text.len() {
            let mut flipped = text.to_vec();
            flipped[bit / 8] ^= 1 << (bit % 8);
            fs::write(&path, flipped).unwrap();
            assert!(!is_there(&path, text), "bit {bit}");
        }
    }
}
