//! Warps and flows of octave sums: several sums in one module.

use asperity_noise::gpu::{FbmUniform2d, FbmUniform3d};
use asperity_noise::{
    Anchor, Fbm, FbmSpectrum, Field, Perlin, Point, Warp,
    curl::{Curl2, Curl3, CurlPotential},
    glam::{Vec2, Vec3},
};
use asperity_wgsl::noise::{CURL, FBM_2D, FBM_3D, WARP};

use super::{float, in_plane, in_space, input, output, plane, put, space};
use crate::case::{Case, INPUTS, OUTPUTS, between, packed};

pub(super) fn cases() -> Vec<Case> {
    vec![in_3d(), in_2d()]
}

/// Octaves of these sums: few, because a warp amplifies rounding by gradients.
const OCTAVES: f32 = 1.5;

/// Four sums, anchored at the origin, which compile without SIMD.
fn four<V, const N: usize>() -> [Fbm<<Perlin as Anchor<N>>::Shifted, V>; 4]
where
    V: Point<Coordinates = [f32; N]>,
    Perlin: Field<V> + Anchor<N>,
{
    [1, 2, 3, 4].map(|seed| {
        Fbm::<_, V>::new(Perlin::new(seed), FbmSpectrum::default()).with_octaves(OCTAVES).anchored([0.0; N])
    })
}

fn in_3d() -> Case {
    let fields = four::<Vec3, 3>();
    let words = packed(&FbmUniform3d::array(&fields.map(|sum| sum.gpu())));
    Case {
        name: "noise/transforms/warp and curl, 3-D".into(),
        parts: vec![&FBM_3D.perlin, &WARP, &CURL],
        body: "\
    let s = perlin_fbm_3d(a.xyz, 1.5, 0.0, 0u);
    let x = perlin_fbm_3d(a.xyz, 1.5, 0.0, 1u);
    let y = perlin_fbm_3d(a.xyz, 1.5, 0.0, 2u);
    let z = perlin_fbm_3d(a.xyz, 1.5, 0.0, 3u);
    let moved = warp_displacement_3d(a.xyz, b.z, x, y, z);
    let warped = warp_sample_3d(moved, perlin_fbm_3d(moved.point, 1.5, 0.0, 0u));
    outcome.a = bits(vec4<f32>(warped.value, warped.gradient));
    outcome.b = bits(vec4<f32>(moved.point, 0.0));
    outcome.c = bits(vec4<f32>(curl_velocity_3d(s.gradient, x.gradient), 0.0));
    outcome.d = bits(vec4<f32>(curl_potential_velocity(x.gradient, y.gradient, z.gradient), 0.0));"
            .into(),
        resources: vec![("fbm_uniform_3d", words)],
        input: Box::new(strongly),
        reference: Box::new(move |words| {
            let [s, by @ ..] = fields;
            let (p, mut outputs) = (space(&words), [0; OUTPUTS]);
            let warp = Warp::new(s, by, float(&words, 6)).expect("a strength");
            put(&mut outputs, in_space(warp.sample(p)));
            put(&mut outputs[4..], warp.displacement(p).point.to_array());
            put(&mut outputs[8..], Curl3(s, by[0]).velocity(p).to_array());
            put(&mut outputs[12..], CurlPotential(by).velocity(p).to_array());
            outputs
        }),
        outputs: vec![
            output("warped value", 0..1, 2e-4),
            output("its gradient", 1..4, 2e-3),
            output("displaced point", 4..7, 2e-4),
            output("flow between level surfaces", 8..11, 2e-3),
            output("curl of a potential", 12..15, 2e-3),
        ],
    }
}

fn in_2d() -> Case {
    let fields = four::<Vec2, 2>();
    let words = packed(&FbmUniform2d::array(&fields.map(|sum| sum.gpu())));
    Case {
        name: "noise/transforms/warp and curl, 2-D".into(),
        parts: vec![&FBM_2D.perlin, &WARP, &CURL],
        body: "\
    let x = perlin_fbm_2d(a.xy, 1.5, 0.0, 1u);
    let y = perlin_fbm_2d(a.xy, 1.5, 0.0, 2u);
    let moved = warp_displacement_2d(a.xy, b.z, x, y);
    let warped = warp_sample_2d(moved, perlin_fbm_2d(moved.point, 1.5, 0.0, 0u));
    outcome.a = bits(vec4<f32>(warped.value, warped.gradient, 0.0));
    outcome.b = bits(vec4<f32>(moved.point, curl_velocity_2d(x.gradient)));"
            .into(),
        resources: vec![("fbm_uniform_2d", words)],
        input: Box::new(strongly),
        reference: Box::new(move |words| {
            let [s, x, y, _] = fields;
            let (p, mut outputs) = (plane(&words), [0; OUTPUTS]);
            let warp = Warp::new(s, [x, y], float(&words, 6)).expect("a strength");
            put(&mut outputs, in_plane(warp.sample(p)));
            put(&mut outputs[4..], warp.displacement(p).point.to_array());
            put(&mut outputs[6..], Curl2(x).velocity(p).to_array());
            outputs
        }),
        outputs: vec![
            output("warped value", 0..1, 2e-4),
            output("its gradient", 1..3, 2e-3),
            output("displaced point", 4..6, 2e-4),
            output("flow", 6..8, 2e-3),
        ],
    }
}

/// A point, with a strength in word 6. Huge coordinates, for which rotated octaves round to other
/// cells, are tested with the sums.
fn strongly(i: u32) -> [u32; INPUTS] {
    let mut words = input(i, 10.0, 4.0);
    for word in &mut words[..3] {
        let x = f32::from_bits(*word);
        if x.is_finite() && x.abs() > 10.0 {
            *word = 0;
        }
    }
    words[6] = between(i, 7, -0.5, 0.5).to_bits();
    words
}
