//! Normal densities: elementary functions, closed forms, maps, tables, level of detail.

use crate::case::{Case, DENORMAL, INPUTS, OUTPUTS, between};

mod closed_form;
mod conditional_table;
mod elementary;
mod facets;
mod frame;
mod normal_table;
mod packed_map;

pub(super) fn cases() -> Vec<Case> {
    [
        elementary::cases(),
        closed_form::cases(),
        conditional_table::cases(),
        facets::cases(),
        frame::cases(),
        normal_table::cases(),
        packed_map::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Numbers that every function must handle, one per initial input.
const BAD: [f32; 16] = [
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::MAX,
    f32::MIN,
    3e9,
    -3e9,
    -0.0,
    DENORMAL,
    0.0,
    1.0,
    -1.0,
    1e-20,
    -1e-6,
    13.5,
    2.0,
];

/// Returns the k-th number of the i-th input: an invalid number for the first inputs, in all
/// combinations, otherwise `good`.
fn number(i: u32, k: u32, good: f32) -> f32 {
    match i {
        // One invalid number at a time, then all.
        0..16 if k == i / 2 => BAD[(3 * i as usize + 7) % 16],
        16..40 => BAD[(i + 5 * k) as usize % 16],
        _ => good,
    }
}

/// Returns standard Gaussian numbers, the k-th of the i-th input.
fn gaussian(i: u32, k: u32) -> f32 {
    asperity_ndf_sampling::inverse_gaussian_cdf(f64::from(between(i, k, 1e-6, 0.999_999))) as f32
}

fn floats<const N: usize>(words: [u32; INPUTS], from: usize) -> [f32; N] {
    std::array::from_fn(|k| f32::from_bits(words[from + k]))
}

/// Returns the words of floats, padded with zeros.
fn words(floats: &[f32]) -> [u32; OUTPUTS] {
    std::array::from_fn(|k| floats.get(k).map_or(0, |x| x.to_bits()))
}
