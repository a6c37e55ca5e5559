//! Bounds that are seen to fail: every output of every case by a fault in its source.

use asperity_shader_tests::case::{Case, INPUTS, OUTPUTS};
use asperity_wgsl::Interpreter;
use rayon::prelude::*;

/// Faults: an operator, a function or a number in place of another.
const FAULTS: [(&str, &str); 14] = [
    (" + ", " - "),
    (" - ", " + "),
    (" * ", " / "),
    (" / ", " * "),
    (" ^ ", " & "),
    (" < ", " > "),
    (">> ", "<< "),
    (" & ", " | "),
    ("max(", "min("),
    ("sqrt(", "abs("),
    ("0.0", "0.25"),
    ("0.5", "0.75"),
    ("1.0", "1.5"),
    ("2.0", "1.5"),
];

/// Sources with one fault each that are tried for a case.
const MOST: usize = 3000;

/// Breaks the source of every case, one place at a time, until each output has been seen beyond its bound on adapters;
/// prints a line for each case and names the outputs that no fault was found for.
pub(crate) fn run(cases: &[Case]) -> Result<(), String> {
    println!("| function | outputs | beyond their bounds | faults tried |\n|---|---|---|---|");
    let rows: Vec<_> = cases.par_iter().map(|case| (case, tried(case))).collect();
    let mut kept = vec![];
    let (mut outputs, mut broken) = (0, 0);
    for (case, row) in rows {
        let (seen, faults) = row.map_err(|error| format!("{}: {error}", case.name))?;
        let count = seen.iter().filter(|seen| **seen).count();
        println!("| {} | {} | {count} | {faults} |", case.name, seen.len());
        (outputs, broken) = (outputs + seen.len(), broken + count);
        let names = case.outputs.iter().zip(seen).filter(|(_, seen)| !seen);
        kept.extend(names.map(|(output, _)| format!("{}, {}", case.name, output.name)));
    }
    println!("\n{broken} of {outputs} bounds were seen to fail");
    if kept.is_empty() { Ok(()) } else { Err(format!("no fault broke:\n{}", kept.join("\n"))) }
}

/// Which outputs were seen beyond their bounds, and how many faults that took.
fn tried(case: &Case) -> Result<(Vec<bool>, usize), String> {
    // Enough inputs to meet every branch, behind the bad ones.
    let inputs: Vec<[u32; INPUTS]> = (0..Case::COUNT).step_by(8).map(|i| (case.input)(i)).collect();
    let expected: Vec<_> = inputs.iter().map(|input| (case.reference)(*input)).collect();
    let mut seen = vec![false; case.outputs.len()];
    let mut faults = 0;
    let wgsl = case.wgsl();
    for source in faulty(&wgsl).take(MOST) {
        // Many a fault is no valid source.
        let Ok(shader) = Interpreter::new(&source) else { continue };
        let Ok(shader) = case.bound(shader) else { continue };
        faults += 1;
        let Ok(outcomes) = shader.call_many("evaluate", &inputs) else { continue };
        for (seen, output) in seen.iter_mut().zip(&case.outputs) {
            *seen |= outcomes.iter().zip(&expected).any(|(got, expected): (_, &[u32; OUTPUTS])| {
                let error = |k: usize| output.adapter.error(got.words()[k], expected[k]);
                output.words.clone().any(|k| error(k) > output.adapter.limit())
            });
        }
        if seen.iter().all(|seen| *seen) {
            break;
        }
    }
    Ok((seen, faults))
}

/// The source with one fault, at every place of the parts; the case's own body is left as it is.
fn faulty(wgsl: &str) -> impl Iterator<Item = String> {
    let parts = wgsl.find("struct Outcome").unwrap_or(wgsl.len());
    let mut places: Vec<_> = FAULTS
        .iter()
        .flat_map(|(from, to)| wgsl[..parts].match_indices(from).map(move |(at, _)| (at, *from, *to)))
        .filter(|(at, ..)| {
            let line = wgsl[..*at].rfind('\n').map_or(0, |end| end + 1);
            !wgsl[line..*at].contains("//")
        })
        .collect();
    // Spread over the source: of neighbours most do the same.
    places.sort_unstable_by_key(|(at, ..)| (*at as u32).wrapping_mul(0x9e37_79b9));
    places.into_iter().map(|(at, from, to)| format!("{}{to}{}", &wgsl[..at], &wgsl[at + from.len()..]))
}
