//! Gaussian noise, one channel and two.

use asperity_noise::{
    GaussianNoise,
    glam::{Vec2, Vec3},
};
use asperity_wgsl::noise;

use super::{body, case, input, number, outputs_of, seed};
use crate::case::{Bound, Case, OUTPUTS, Output};

const VALUE: Bound = Bound::Absolute(1e-5);
const GRADIENT: Bound = Bound::Absolute(3e-5);

pub(super) fn cases() -> Vec<Case> {
    let one = case(&noise::GAUSSIAN, body("gaussian", "", false), [VALUE, GRADIENT], |words| {
        outputs_of(&GaussianNoise::new(seed(words)), words)
    });
    vec![Case { resources: table(), ..one }, pair()]
}

/// The table of levels.
fn table() -> Vec<(&'static str, Vec<u32>)> {
    vec![("gaussian_level", GaussianNoise::gpu_levels().map(f32::to_bits).collect())]
}

fn pair() -> Case {
    let output = |name, words, adapter| Output { name, words, written: Bound::Equal, adapter };
    Case {
        name: "noise/kinds/gaussian, pair".into(),
        parts: vec![&noise::GAUSSIAN],
        body: "\
    let plane = gaussian_pair_2d(a.xy, d.x);
    let space = gaussian_pair_3d(a.xyz, d.x);
    outcome.a = bits(vec4<f32>(plane.value, space.value));
    outcome.b = bits(vec4<f32>(plane.dx, plane.dy));
    outcome.c = bits(vec4<f32>(space.dx, space.dy));
    outcome.d = bits(vec4<f32>(space.dz, 0.0, 0.0));"
            .into(),
        resources: table(),
        input: Box::new(input),
        reference: Box::new(|words| {
            let [x, y, z] = [0, 1, 2].map(|axis| number(words, axis));
            let noise = GaussianNoise::new(seed(words));
            let (plane, space) = (noise.pair(Vec2::new(x, y)), noise.pair(Vec3::new(x, y, z)));
            let mut outputs = [0.0; OUTPUTS];
            for channel in 0..2 {
                let ([p, q], [r, s, t]) = (plane[channel].gradient.into(), space[channel].gradient.into());
                for (k, x) in
                    [plane[channel].value, space[channel].value, p, q, r, s, t].into_iter().enumerate()
                {
                    outputs[2 * k + channel] = x;
                }
            }
            outputs.map(f32::to_bits)
        }),
        outputs: vec![
            output("values", 0..4, VALUE),
            output("gradients, 2-D", 4..8, GRADIENT),
            output("gradients, 3-D", 8..14, GRADIENT),
        ],
    }
}
