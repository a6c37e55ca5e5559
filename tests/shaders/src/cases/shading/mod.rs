//! Shading: pixels, bump mapping, reflectances, textures, materials.

use asperity_shading::glam::{Vec2, Vec3};

use crate::case::{BAD, Bound, Case, INPUTS, OUTPUTS, Output, between};

mod bump;
mod coat;
mod diffuse;
mod energy;
mod fresnel;
mod fuzz;
mod glint;
mod glossy;
mod mapped;
mod material;
mod noisy_texture;
mod pixel;
mod standard_material;
mod texture;
mod textured;

pub(super) fn cases() -> Vec<Case> {
    [
        bump::cases(),
        diffuse::cases(),
        energy::cases(),
        fresnel::cases(),
        fuzz::cases(),
        glint::cases(),
        coat::cases(),
        glossy::cases(),
        mapped::cases(),
        material::cases(),
        pixel::cases(),
        standard_material::cases(),
        noisy_texture::cases(),
        texture::cases(),
        textured::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Returns the words of the i-th input: these numbers, with invalid numbers in the first inputs,
/// one at a time and then all.
fn inputs(i: u32, good: &[f32]) -> [u32; INPUTS] {
    std::array::from_fn(|k| {
        let k32 = k as u32;
        let number = good.get(k).copied().unwrap_or(0.0);
        let is_bad = i < 24 && (i % 12 == k32 % 12 || i >= 18);
        if is_bad { BAD[(i as usize + 3 * k) % BAD.len()] } else { number }.to_bits()
    })
}

/// Returns a number, the k-th of the i-th input.
fn number(i: u32, k: u32, [low, high]: [f32; 2]) -> f32 {
    between(i, k, low, high)
}

/// Returns a number within [0, 1], the k-th of the i-th input, sometimes 0 and 1.
fn share(i: u32, k: u32) -> f32 {
    match (i + k) % 16 {
        0 => 0.0,
        1 => 1.0,
        _ => between(i, k, 0.0, 1.0),
    }
}

/// Returns a unit direction above the horizon from the k-th number of the i-th input and the next,
/// sometimes straight up or grazing.
fn direction(i: u32, k: u32) -> Vec3 {
    let (up, turn) = (between(i, k, 0.0, 1.0), between(i, k + 1, 0.0, std::f32::consts::TAU));
    let up = match (i + k) % 32 {
        0 => return Vec3::Z,
        1 => 0.01 * up,
        _ => up,
    };
    let across = (1.0 - up * up).sqrt();
    Vec3::new(across * turn.cos(), across * turn.sin(), up)
}

/// Returns a vector with bounded components from three numbers of the i-th input.
fn vector(i: u32, k: u32, most: f32) -> Vec3 {
    Vec3::from([0, 1, 2].map(|axis| between(i, k + axis, -most, most)))
}

/// Returns the floats of an input starting at one.
fn floats<const N: usize>(words: [u32; INPUTS], from: usize) -> [f32; N] {
    std::array::from_fn(|k| f32::from_bits(words[from + k]))
}

/// Returns the 3-D vector of an input at an index.
fn vec3(words: [u32; INPUTS], from: usize) -> Vec3 {
    Vec3::from(floats::<3>(words, from))
}

/// Returns the 2-D vector of an input at an index.
fn vec2(words: [u32; INPUTS], from: usize) -> Vec2 {
    Vec2::from(floats::<2>(words, from))
}

/// Returns the words of floats, padded with zeros.
fn words(floats: &[f32]) -> [u32; OUTPUTS] {
    std::array::from_fn(|k| floats.get(k).map_or(0, |x| x.to_bits()))
}

/// An output with equal bits as written.
fn equal(name: &'static str, words: std::ops::Range<usize>, adapter: Bound) -> Output {
    Output { name, words, written: Bound::Equal, adapter }
}
