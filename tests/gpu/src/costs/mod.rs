//! The cost page: operations of every function, and milliseconds per frame.

mod spirv;

use std::collections::{HashMap, HashSet};
use std::fmt::Write as _;
use std::path::Path;

use asperity_shader_tests::cases;
use asperity_wgsl::{Bindings, Part, compose, ordered};

use self::spirv::{Cost, Operations, costs};
use crate::{dialect, picture};

/// Prints the page, and writes it if requested.
pub(crate) fn run(adapter: Option<&str>, size: u32, out: Option<&Path>) -> Result<(), String> {
    let mut page = String::from(HEAD);
    let parts = parts();
    let functions = counted(&parts)?;
    page += "\n## Per octave\n\n| sum | floats | special | integers | texels |\n|---|---|---|---|---|\n";
    let sums =
        parts.iter().filter(|part| part.name().starts_with("noise/sums/")).flat_map(|part| part.names());
    for sum in sums.filter(|name| !name.starts_with("fbm_") && name.contains("_fbm_")) {
        if let Some(cost) = functions.get(sum).filter(|cost| cost.turn != Operations::default()) {
            let _ = writeln!(page, "| `{sum}` | {} |", cells(cost.turn));
        }
    }
    page += "\n## Per pixel\n\nA teapot lit by a lamp and a sky, see `picture/surface.wgsl`.\n\n";
    page += "| bumps | floats | special | integers | texels | per octave | | | |\n|---|---|---|---|---|---|---|---|---|\n";
    for (part, name) in picture::BUMPS {
        let Cost { once, turn } = counted(&[part])?["surface_pixel"];
        let _ = writeln!(page, "| {name} | {} | {} |", cells(once), cells(turn));
    }
    let _ = writeln!(
        page,
        "\n## Per frame\n\nMilliseconds per frame of {size}² pixels, from the submitted command to the bytes: medians of five.\n"
    );
    page += &picture::times(adapter, size)?;
    page +=
        "\n## All functions\n\n| part | function | floats | special | integers | texels | in loops | | | |\n";
    page += "|---|---|---|---|---|---|---|---|---|---|\n";
    for part in &parts {
        let names = part.names().filter_map(|name| Some((name, functions.get(name)?)));
        for (name, cost) in names {
            let looped = if cost.turn == Operations::default() { " | | |".into() } else { cells(cost.turn) };
            let _ = writeln!(page, "| {} | `{name}` | {} | {looped} |", part.name(), cells(cost.total()));
        }
    }
    print!("{page}");
    if let Some(path) = out {
        crate::write(path, page.as_bytes())?;
        println!("costs written to {}", path.display());
    }
    Ok(())
}

const HEAD: &str = "\
# Costs of the shaders

Scalar operations, counted in the SPIR-V that naga writes. A sum of three-dimensional vectors counts as three. The
operations of called functions are included. Both branches of every condition are counted, and the body of a loop once.
*Floats* are sums, products, comparisons, rounding, minimum and maximum. *Special* are quotients, roots and
transcendental functions. *Integers* are integer operations, conversions and selections. *Texels* are fetched or
filtered. `cargo xtask shaders --costs` writes this page.
";

fn cells(operations: Operations) -> String {
    let Operations { floats, special, integers, texels } = operations;
    format!("{floats} | {special} | {integers} | {texels}")
}

/// Returns the parts of all cases without duplicates, dependencies first.
fn parts() -> Vec<&'static Part> {
    let of_cases: Vec<&'static Part> = cases::all().iter().flat_map(|case| case.parts.clone()).collect();
    let mut names = HashSet::new();
    let mut parts = ordered(&of_cases);
    parts.retain(|part| names.insert(part.name()));
    parts
}

/// Returns the costs of all functions of parts and their dependencies.
fn counted(parts: &[&'static Part]) -> Result<HashMap<String, Cost>, String> {
    let words = dialect::counted(&compose(parts, Bindings::Textures { group: 0 }))?;
    Ok(costs(&words))
}
