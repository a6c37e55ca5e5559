//! Sums of octaves: Gaussian pairs, octaves of every noise, and transforms.

pub mod anchors;
mod frequency_clamp;
mod gaussian;
mod kinds;
mod transforms;

use std::{array, ops::Range};

use asperity_noise::{
    FbmSpectrum, GaussianNoise, Sample,
    glam::{Vec2, Vec3},
};

use crate::case::{BAD, Bound, Case, INPUTS, Output, any, between};

pub(super) fn cases() -> Vec<Case> {
    [anchors::cases(), gaussian::cases(), kinds::cases(), transforms::cases(), frequency_clamp::cases()]
        .into_iter()
        .flatten()
        .collect()
}

/// The sum in every module with parallel octaves of doubling frequency: products with its matrix
/// are exact, fused or not, so that huge coordinates have the same cell everywhere.
const EXACT: u32 = 3;

/// Octaves of doubling frequency.
fn exact_spectrum() -> FbmSpectrum {
    FbmSpectrum::new(2.0, 0.6, 4).expect("a spectrum")
}

/// A point in words 0 to 2 with coordinates up to `reach`, octaves in 3, a footprint in 4, a
/// feedback in 5, the sum's number in 8.
fn input(i: u32, reach: f32, octaves: f32) -> [u32; INPUTS] {
    let mut words = [0; INPUTS];
    let p = array::from_fn::<f32, 3, _>(|k| between(i, k as u32, -reach, reach));
    let footprint = if any(i, 5).is_multiple_of(2) { 0.0 } else { between(i, 4, 0.0, 0.5) };
    let numbers = [p[0], p[1], p[2], between(i, 3, 0.0, octaves), footprint, between(i, 6, 0.0, 3.0)];
    words[..6].copy_from_slice(&numbers.map(f32::to_bits));
    words[8] = i % 4;
    match i as usize {
        bad @ 0..30 => words[bad % 3] = BAD[bad / 3].to_bits(),
        bad @ 30..40 => words[3] = BAD[bad - 30].to_bits(),
        bad @ 40..50 => words[4] = BAD[bad - 40].to_bits(),
        _ => return words,
    }
    words[8] = EXACT;
    words
}

fn float(words: &[u32; INPUTS], k: usize) -> f32 {
    f32::from_bits(words[k])
}

fn space(words: &[u32; INPUTS]) -> Vec3 {
    Vec3::from(array::from_fn(|k| float(words, k)))
}

fn plane(words: &[u32; INPUTS]) -> Vec2 {
    Vec2::from(array::from_fn(|k| float(words, k)))
}

fn put(outputs: &mut [u32], numbers: impl IntoIterator<Item = f32>) {
    for (word, x) in outputs.iter_mut().zip(numbers) {
        *word = x.to_bits();
    }
}

fn in_space(sample: Sample<Vec3>) -> [f32; 4] {
    let [x, y, z] = sample.gradient.to_array();
    [sample.value, x, y, z]
}

fn in_plane(sample: Sample<Vec2>) -> [f32; 3] {
    [sample.value, sample.gradient.x, sample.gradient.y]
}

/// Returns the table of Gaussian levels.
fn levels() -> Vec<u32> {
    GaussianNoise::gpu_levels().map(f32::to_bits).collect()
}

/// Equal bits as written, and this tolerance on an adapter.
fn output(name: &'static str, words: Range<usize>, adapter: f32) -> Output {
    Output { name, words, written: Bound::Equal, adapter: Bound::Absolute(adapter) }
}
