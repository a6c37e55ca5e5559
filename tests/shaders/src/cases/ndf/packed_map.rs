//! Packed maps with both reconstructions.

use asperity_ndf_sampling::glam::{Vec2, Vec3};
use asperity_ndf_sampling::{GaussianSplit, Measure, Ndf, NdfMap, PackedMapRef, Reconstruction};
use asperity_wgsl::ndf::PACKED_MAP;

use super::{floats, gaussian, number, words};
use crate::case::{Bound, Case, INPUTS, Output, between, packed as words_of};

pub(super) fn cases() -> Vec<Case> {
    // Adjacent lobes on a uniform background, and lobes separated by gaps.
    let painting =
        |n: Vec3| (-40.0 * (n.truncate() - Vec2::new(0.3, 0.2)).length_squared()).exp() + 0.05 * n.z;
    let gaps = |n: Vec3| f32::from(n.x.abs() > 0.2) * (0.1 + n.y).max(0.0);
    vec![
        packed("constant", Reconstruction::Constant, painting, Some(8e-6)),
        packed("bilinear", Reconstruction::Bilinear, painting, Some(8e-6)),
        packed("constant with gaps", Reconstruction::Constant, gaps, None),
        packed("bilinear with gaps", Reconstruction::Bilinear, gaps, None),
    ]
}

/// The bound applies to T. Next to gaps there is none, because a rounding of Φ moves across a gap.
fn packed(
    name: &str,
    kind: Reconstruction,
    painting: impl Fn(Vec3) -> f32,
    gaussian_bound: Option<f32>,
) -> Case {
    let map = NdfMap::from_fn(48, 33, Measure::ProjectedSolidAngle, kind, painting)
        .expect("a painting")
        .into_array();
    let map: &'static [f32] = map.leak();
    let packed = PackedMapRef::new(map).expect("a packed map");
    let table: Vec<u32> = map.iter().map(|x| x.to_bits()).collect();
    let output =
        |name, words, written, adapter| Output { name, words, written, adapter: Bound::Absolute(adapter) };
    let mut outputs = vec![
        output("D", 0..1, Bound::Equal, 5e-6),
        output("(M, C)", 1..3, Bound::Equal, 2e-6),
        // In f64 in the crate. A rounding of M is a large part of a distant coordinate: 0.13 at
        // 5.4, where u ends.
        output("T⁻¹", 3..5, Bound::Absolute(3e-6), 0.15),
        output("T⁻¹ within 3", 12..14, Bound::Absolute(1.4e-6), 2e-4),
        output("sample", 5..7, Bound::Equal, 1e-4),
        // √(1 − x² − y²) at the rim.
        output("sample, upwards", 7..8, Bound::Equal, 5e-3),
    ];
    if let Some(bound) = gaussian_bound {
        outputs.push(output("T", 8..10, Bound::Absolute(bound), 10.0 * bound));
        let [written, adapter] = [Bound::Relative(7e-5), Bound::Relative(5e-3)];
        outputs.push(Output { name: "exact rule", words: 11..12, written, adapter });
    }
    Case {
        name: format!("ndf/map/packed_map, {name}"),
        parts: vec![&PACKED_MAP],
        body: "\
    let split = gaussian_split(vec2<f32>(a.w, b.x), b.y);
    outcome.a = bits(vec4<f32>(packed_map_d(a.xyz), packed_map_forward(a.xy), packed_map_invert(a.xyz).x));
    outcome.b = bits(vec4<f32>(packed_map_invert(a.xyz).y, packed_map_sample(b.zw)));
    outcome.c = bits(vec4<f32>(packed_map_warp_gaussian(vec2<f32>(a.w, b.x)), max(packed_map_residual_ndf(a.xyz, split), 1e-34)));
    let within = clamp(packed_map_invert(a.xyz), vec2<f32>(-3.0), vec2<f32>(3.0));
    outcome.d = bits(vec4<f32>(within, 0.0, 0.0));"
            .into(),
        resources: vec![("packed_map_grid", words_of(&packed.gpu())), ("packed_map_word", table)],
        input: Box::new(move |i| {
            let from = |k| gaussian(i, k).clamp(-3.0, 3.0);
            let m = packed.warp_gaussian(Vec2::new(from(0), from(1)));
            let s = between(i, 5, 0.0, 0.9);
            // Some at the ends of the square, whose normals are at the rim.
            let u = [6, 7].map(|k| match (i + 5 * k) % 16 {
                0 => between(i, k, -24.0, -1.0).exp2(),
                1 => 1.0 - between(i, k, -24.0, -1.0).exp2(),
                _ => between(i, k, 0.0, 1.0),
            });
            let good = [m.x, m.y, m.z, gaussian(i, 3), gaussian(i, 4), s, u[0], u[1]];
            let mut inputs = [0; INPUTS];
            for ((input, good), k) in inputs.iter_mut().zip(good).zip(0..) {
                *input = number(i, k, good).to_bits();
            }
            inputs
        }),
        reference: Box::new(move |inputs| {
            let [x, y, up, z1, z2, s, u1, u2] = floats(inputs, 0);
            let (m, z) = (Vec3::new(x, y, up), Vec2::new(z1, z2));
            let (forward, back) = (packed.forward(m.truncate()), packed.invert(m));
            let (sample, from) = (packed.sample(Vec2::new(u1, u2)), packed.warp_gaussian(z));
            let seen = packed.residual_ndf(m, GaussianSplit::new(z, s));
            let mut numbers = [0.0; 14];
            numbers[..8].copy_from_slice(&[
                packed.d(m),
                forward.x,
                forward.y,
                back.x,
                back.y,
                sample.x,
                sample.y,
                sample.z,
            ]);
            numbers[8..12].copy_from_slice(&[from.x, from.y, from.z, seen.max(1e-34)]);
            numbers[12..].copy_from_slice(&back.clamp(Vec2::splat(-3.0), Vec2::splat(3.0)).to_array());
            words(&numbers)
        }),
        outputs,
    }
}
