//! Quadratic B-splines that interpolate a function, and the tables of their coefficients.

use std::fmt::{Display, Write};

use rayon::prelude::*;

/// The place from 0 to 1 of a number from 0 to 1, with a finer scale below `width`.
pub(crate) fn place(t: f64, width: f64) -> f64 {
    (t * (1.0 + width) / (t + width).max(1e-12)).sqrt()
}

/// The number from 0 to 1 where an increasing function has this value.
pub(crate) fn inverse(value: f64, f: impl Fn(f64) -> f64) -> f64 {
    let [low, high] = (0..50).fold([0.0, 1.0], |[low, high], _| {
        let middle = 0.5 * (low + high);
        if f(middle) < value { [middle, high] } else { [low, middle] }
    });
    0.5 * (low + high)
}

/// Coefficients of the quadratic B-spline that interpolates a function on the unit cube, by axis.
pub(crate) fn spline<const N: usize>(counts: [usize; N], f: impl Fn([f64; N]) -> f64 + Sync) -> Vec<f64> {
    // Both ends and the middles of the intervals.
    let site = |count: usize, k: usize| ((k as f64 - 0.5) / (count as f64 - 2.0).max(1.0)).clamp(0.0, 1.0);
    let stride = |axis: usize| counts[axis + 1..].iter().product::<usize>();
    let index = |entry: usize, axis: usize| entry / stride(axis) % counts[axis];
    let at = |entry: usize| f(std::array::from_fn(|axis| site(counts[axis], index(entry, axis))));
    let mut entries: Vec<f64> = (0..counts.iter().product()).into_par_iter().map(at).collect();
    for (axis, &count) in counts.iter().enumerate() {
        for first in (0..entries.len()).filter(|&entry| index(entry, axis) == 0) {
            interpolate(&mut entries[first..], stride(axis), count);
        }
    }
    entries
}

/// Replaces values by coefficients along one line, with the weights ½ ½ at the ends and ⅛ ¾ ⅛
/// within.
fn interpolate(entries: &mut [f64], stride: usize, count: usize) {
    if count < 3 {
        return;
    }
    let mut ratios = vec![0.0; count];
    for k in 0..count {
        let [before, here, after] = match k {
            0 => [0.0, 0.5, 0.5],
            k if k + 1 == count => [0.5, 0.5, 0.0],
            _ => [0.125, 0.75, 0.125],
        };
        let [ratio, entry] = if k > 0 { [ratios[k - 1], entries[(k - 1) * stride]] } else { [0.0; 2] };
        let pivot = here - before * ratio;
        ratios[k] = after / pivot;
        entries[k * stride] = (entries[k * stride] - before * entry) / pivot;
    }
    for k in (0..count - 1).rev() {
        entries[k * stride] -= ratios[k] * entries[(k + 1) * stride];
    }
}

/// Writes a table in units of 1/60000 as nested arrays without those of length 1.
pub(crate) fn table(text: &mut String, name: &str, about: &str, counts: [usize; 3], entries: &[f64]) {
    let units: Vec<u16> = entries.iter().map(|e| (60_000.0 * e).round().clamp(0.0, 65535.0) as u16).collect();
    arrays(text, name, about, counts, ("u16", &units));
}

/// Writes integers as nested arrays without those of length 1.
pub(crate) fn arrays<E: Display>(
    text: &mut String,
    name: &str,
    about: &str,
    counts: [usize; 3],
    (kind, entries): (&str, &[E]),
) {
    let [slices, rows, columns] = counts;
    let mut kind = format!("[{kind}; {columns}]");
    for count in [rows, slices] {
        if count > 1 {
            kind = format!("[{kind}; {count}]");
        }
    }
    let _ = write!(text, "\n/// {about}\n#[rustfmt::skip]\npub(crate) static {name}: {kind} = ");
    let list = |row: &[E]| {
        let row: Vec<String> = row.iter().map(E::to_string).collect();
        row.join(", ")
    };
    if rows == 1 {
        let _ = writeln!(text, "[{}];", list(entries));
        return;
    }
    text.push_str("[\n");
    for slice in entries.chunks(rows * columns) {
        let rows: Vec<String> = slice.chunks(columns).map(|row| format!("[{}]", list(row))).collect();
        // Short slices take one line.
        let _ = match (slices > 1, slice.len() <= 40) {
            (true, true) => writeln!(text, "    [{}],", rows.join(", ")),
            (true, false) => writeln!(text, "    [\n        {},\n    ],", rows.join(",\n        ")),
            (false, _) => writeln!(text, "    {},", rows.join(",\n    ")),
        };
    }
    text.push_str("];\n");
}
