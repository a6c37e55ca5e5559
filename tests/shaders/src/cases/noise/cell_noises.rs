//! Noises on the cells of the integer lattice.

use asperity_noise::{Perlin, PerlinClassic, ValueCatmullRom, ValueGradient, ValueNoise, WhiteNoise};
use asperity_wgsl::noise;

use super::{body, case, number, outputs, outputs_of, sample, seed};
use crate::case::{Bound, Case};

/// For values in [−1, 1] with gradients of a few units.
const BOUNDS: [Bound; 2] = [Bound::Absolute(4e-6), Bound::Absolute(1e-5)];

pub(super) fn cases() -> Vec<Case> {
    vec![
        case(&noise::WHITE, body("white", "", false), [Bound::Equal; 2], |words| {
            outputs_of(&WhiteNoise::new(seed(words)), words)
        }),
        case(&noise::VALUE, body("value", "", true), BOUNDS, |words| {
            let value = ValueNoise::new(seed(words));
            outputs(sample(&value, words), sample(&value, words), sample(&value, words))
        }),
        case(&noise::PERLIN_CLASSIC, body("perlin_classic", "", false), BOUNDS, |words| {
            outputs_of(&PerlinClassic::new(seed(words)), words)
        }),
        case(&noise::PERLIN, body("perlin", "", true), BOUNDS, |words| {
            let perlin = Perlin::new(seed(words));
            outputs(sample(&perlin, words), sample(&perlin, words), sample(&perlin, words))
        }),
        case(&noise::VALUE_GRADIENT, body("value_gradient", "b.x, ", false), BOUNDS, |words| {
            let noise = ValueGradient::new(seed(words));
            outputs_of(&noise.with_weight(number(words, 4)).unwrap_or(noise), words)
        }),
        case(&noise::VALUE_CATMULL_ROM, body("value_catmull_rom", "", false), BOUNDS, |words| {
            outputs_of(&ValueCatmullRom::new(seed(words)), words)
        }),
    ]
}
