//! Queries of the live page to the crates: words of uniforms and tables, curves, surfaces,
//! statistics.
//!
//! Each query is a function of numbers and of words in bulk. It returns words, or an error
//! sentence.
#![cfg_attr(target_family = "wasm", no_std)]

extern crate alloc;

mod bumps;
mod fractals;
mod materials;
#[cfg(target_family = "wasm")]
mod module;
mod noise;
mod surfaces;

use alloc::string::String;
use alloc::vec::Vec;

/// A query: numbers, words in bulk.
type Question = fn(&[f64], &[u32]) -> Result<Vec<u32>, String>;

/// Every query by name.
pub const QUESTIONS: &[(&str, Question)] = &[
    ("gaussian_levels", bumps::gaussian_levels),
    ("gaussian_anchors", bumps::gaussian_anchors),
    ("painted_map", bumps::painted_map),
    ("fractal_curve", fractals::fractal_curve),
    ("fractal_bounds", fractals::fractal_bounds),
    ("fractal_facts", fractals::fractal_facts),
    ("fractal_ground", surfaces::fractal_ground),
    ("fractal_hit", surfaces::fractal_hit),
    ("fractal_rays", surfaces::fractal_rays),
    ("material_paint", materials::paint),
    ("material_carpet", materials::carpet),
    ("material_glass", materials::glass),
    ("material_scratches", materials::scratches),
    ("material_variations", materials::variations),
    ("material_brick", materials::brick),
    ("material_marble", materials::marble),
    ("material_steam", materials::steam),
    ("noise_uniform", noise::noise_uniform),
    ("noise_moments", noise::noise_moments),
    ("noise_samples", noise::noise_samples),
];

/// Returns the words of a struct or of an array of structs.
fn words(of: &impl bytemuck::NoUninit) -> Vec<u32> {
    bytemuck::cast_slice(core::slice::from_ref(of)).to_vec()
}

/// Returns the number at an index, or 0 if there is none.
fn number(numbers: &[f64], at: usize) -> f64 {
    numbers.get(at).copied().unwrap_or(0.0)
}

/// Returns the number at an index in 32 bits.
fn float(numbers: &[f64], at: usize) -> f32 {
    number(numbers, at) as f32
}
