//! Noise: hash and noise types.

use asperity_noise::{
    Field, IntegerHash, Point, Sample,
    glam::{Vec2, Vec3, Vec4},
};
use asperity_wgsl::Part;

use crate::case::{BAD, Bound, Case, INPUTS, OUTPUTS, Output, any, between};

mod cell_noises;
mod cellular;
mod gaussian;
mod hash;
mod simplex;
mod sparse;

pub(super) fn cases() -> Vec<Case> {
    [
        hash::cases(),
        cell_noises::cases(),
        gaussian::cases(),
        simplex::cases(),
        sparse::cases(),
        cellular::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// A point in four dimensions in `a`, numbers in [0, 1) in `b`, key and seed in `d`. The first
/// points are invalid or huge. Some others are next to lattice points, and some so far out that
/// coordinates have a resolution of a sixteenth of a cell.
fn input(i: u32) -> [u32; INPUTS] {
    input_within(1e6, i)
}

/// Input with another far distance, as for simplex noise.
fn input_within(far: f32, i: u32) -> [u32; INPUTS] {
    let mut words = [0; INPUTS];
    for k in 0..4 {
        let x = match (i, i % 8) {
            (0..40, _) if i % 4 == k => BAD[(i / 4) as usize],
            (40..60, _) => BAD[(i + 3 * k) as usize % BAD.len()],
            // Where cells exceed 32-bit integers, and where no cells remain.
            (60..200, _) if i % 4 == k => f32::from_bits(any(i, k) & 0x807f_ffff | (149 + i / 4 % 36) << 23),
            (_, 0) => between(i, k, -9.0, 9.0).round() + between(i, 4 + k, -1e-3, 1e-3),
            (_, 1) => between(i, k, -far, far),
            _ => between(i, k, -100.0, 100.0),
        };
        words[k as usize] = x.to_bits();
        words[4 + k as usize] = between(i, 8 + k, 0.0, 1.0).to_bits();
    }
    words[13] = any(i, 12);
    words[12] = IntegerHash::gpu_key(words[13]);
    words
}

fn number(words: [u32; INPUTS], k: usize) -> f32 {
    f32::from_bits(words[k])
}

fn seed(words: [u32; INPUTS]) -> u32 {
    words[13]
}

fn sample<V: Point<Coordinates = [f32; N]>, const N: usize>(
    field: &impl Field<V>,
    words: [u32; INPUTS],
) -> Sample<V> {
    field.sample(V::from_coordinates(std::array::from_fn(|axis| number(words, axis))))
}

/// Returns value and gradient in two, three and four dimensions, in the layout of [`body`].
fn outputs(plane: Sample<Vec2>, space: Sample<Vec3>, hyperspace: Sample<Vec4>) -> [u32; OUTPUTS] {
    let (a, b) = (plane.gradient, space.gradient);
    let [x, y, z, w] = hyperspace.gradient.to_array();
    let value = hyperspace.value;
    [plane.value, a.x, a.y, 0.0, space.value, b.x, b.y, b.z, x, y, z, w, value, 0.0, 0.0, 0.0]
        .map(f32::to_bits)
}

/// Returns outputs in 2-D and 3-D.
fn outputs_of(field: &(impl Field<Vec2> + Field<Vec3>), words: [u32; INPUTS]) -> [u32; OUTPUTS] {
    outputs(sample(field, words), sample(field, words), Sample::default())
}

/// Returns WGSL that samples `{name}_noise_2d` and so on, with additional parameters between point
/// and key.
fn body(name: &str, parameters: &str, has_4d: bool) -> String {
    let of = |dimension: &str, point: &str| format!("{name}_noise_{dimension}({point}, {parameters}d.x)");
    let mut body = format!(
        "\x20   let plane = {};\n    let space = {};\n\
         \x20   outcome.a = bits(vec4<f32>(plane.value, plane.gradient, 0.0));\n\
         \x20   outcome.b = bits(vec4<f32>(space.value, space.gradient));",
        of("2d", "a.xy"),
        of("3d", "a.xyz")
    );
    if has_4d {
        body += &format!(
            "\n    let all = {};\n    outcome.c = bits(all.gradient);\n\
             \x20   outcome.d = bits(vec4<f32>(all.value, 0.0, 0.0, 0.0));",
            of("4d", "a")
        );
    }
    body
}

/// A noise whose bits equal the crate's.
fn case(
    part: &'static Part,
    body: String,
    bounds: [Bound; 2],
    reference: impl Fn([u32; INPUTS]) -> [u32; OUTPUTS] + Send + Sync + 'static,
) -> Case {
    let has_4d = body.contains("outcome.c");
    let [value, gradient] = bounds;
    let output = |name, words, adapter| Output { name, words, written: Bound::Equal, adapter };
    let mut outputs = vec![
        output("value, 2-D", 0..1, value),
        output("gradient, 2-D", 1..3, gradient),
        output("value, 3-D", 4..5, value),
        output("gradient, 3-D", 5..8, gradient),
    ];
    if has_4d {
        outputs.push(output("value, 4-D", 12..13, value));
        outputs.push(output("gradient, 4-D", 8..12, gradient));
    }
    let name = part.name().into();
    let (input, reference) = (Box::new(input), Box::new(reference));
    Case { name, parts: vec![part], body, resources: vec![], input, reference, outputs }
}
