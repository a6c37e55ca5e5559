//! Octaves of a footprint.

use asperity_noise::filtered_fraction;
use asperity_shading::{Footprint, pixel::FrequencyClamp};
use asperity_wgsl::shading::{LEVEL_OF_DETAIL, material::SURFACE_POINT};

use super::{float, put};
use crate::case::{BAD, Bound, Case, INPUTS, OUTPUTS, Output, between, packed};

pub(super) fn cases() -> Vec<Case> {
    vec![octaves()]
}

fn octaves() -> Case {
    let clamp = FrequencyClamp::new(20.0, 2.17, 14.0).expect("a clamp");
    Case {
        name: "shading/pixel/frequency_clamp".into(),
        parts: vec![&SURFACE_POINT, &LEVEL_OF_DETAIL],
        body: "\
    let limits = FrequencyClamp(a.z, a.w, b.x);
    outcome.a = bits(vec4<f32>(frequency_clamp_octaves(a.x, limits), frequency_clamp_filtered_fraction(a.x, a.y), 0.0, 0.0));"
            .into(),
        resources: vec![],
        input: Box::new(move |i| {
            // Widths from 2⁻³⁰ to 2: a mantissa times a power of 2.
            let power = f32::from_bits((127 - 30 + i % 31) << 23);
            let width = BAD.get(i as usize).copied().unwrap_or(between(i, 0, 1.0, 2.0) * power);
            let mut words = [0; INPUTS];
            put(&mut words, [width, 2.0 * f32::from((i % 7) as u8)]);
            words[2..5].copy_from_slice(&packed(&clamp.gpu()));
            words
        }),
        reference: Box::new(move |words| {
            let (width, mut outputs) = (float(&words, 0), [0; OUTPUTS]);
            let octaves = clamp.octaves(Footprint::from_width(width));
            put(&mut outputs, [octaves, filtered_fraction(width, float(&words, 1))]);
            outputs
        }),
        outputs: vec![
            // The built-in logarithm and the crate's are each a unit in the last place off, 2e-6
            // for values of 16 and above.
            Output::new("octaves", 0..1, Bound::Absolute(4e-6), Bound::Absolute(6e-6)),
            Output::new("filtered fraction", 1..2, Bound::Equal, Bound::Absolute(1e-6)),
        ],
    }
}
