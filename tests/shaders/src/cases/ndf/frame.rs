//! Tangent frames.

use asperity_ndf_sampling::{Frame, glam::Vec3};
use asperity_wgsl::shading::LEVEL_OF_DETAIL;

use super::{floats, number, words};
use crate::case::{Bound, Case, INPUTS, Output, between};

pub(super) fn cases() -> Vec<Case> {
    vec![frames()]
}

fn frames() -> Case {
    let output =
        |name, words, bound| Output { name, words, written: Bound::Equal, adapter: Bound::Absolute(bound) };
    Case {
        name: "ndf/frame".into(),
        parts: vec![&LEVEL_OF_DETAIL],
        body: "\
    let v = vec3<f32>(b.zw, bitcast<f32>(c.x));
    let frame = frame_from_normal(a.xyz);
    let other = frame_from_normal_tangent(a.xyz, vec3<f32>(a.w, b.xy));
    outcome.a = bits(vec4<f32>(frame.tangent, frame.normal.x));
    outcome.b = bits(vec4<f32>(frame.bitangent, frame.normal.y));
    outcome.c = bits(vec4<f32>(other.tangent, other.bitangent.x));
    outcome.d = bits(vec4<f32>(frame_to_world(frame, frame_to_local(other, v)), other.bitangent.y));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let mut inputs = [0; INPUTS];
            for (k, input) in (0..6).zip(&mut inputs) {
                *input = number(i, k, between(i, k, -1.0, 1.0)).to_bits();
            }
            // At the pole and near both poles.
            if let 40..44 = i {
                inputs[..2].fill(0);
                inputs[2] = [-1.0_f32, -3.0, 1.0, 1e-12][i as usize % 4].to_bits();
            }
            if i % 5 == 0 && i >= 40 {
                for input in &mut inputs[..2] {
                    *input = (f32::from_bits(*input) * 1e-3_f32.powi((i % 25 / 5) as i32)).to_bits();
                }
            }
            for (k, input) in (6..9).zip(&mut inputs[6..]) {
                *input = between(i, k, -1.0, 1.0).to_bits();
            }
            inputs
        }),
        reference: Box::new(|inputs| {
            let [nx, ny, nz, tx, ty, tz, vx, vy, vz] = floats(inputs, 0);
            let [n, t, v] = [[nx, ny, nz], [tx, ty, tz], [vx, vy, vz]].map(Vec3::from);
            let (frame, other) = (Frame::from_normal(n), Frame::from_normal_tangent(n, t));
            let back = frame.to_world(other.to_local(v));
            let [a, b] = [frame.tangent, frame.bitangent];
            words(&[
                a.x,
                a.y,
                a.z,
                frame.normal.x,
                b.x,
                b.y,
                b.z,
                frame.normal.y,
                other.tangent.x,
                other.tangent.y,
                other.tangent.z,
                other.bitangent.x,
                back.x,
                back.y,
                back.z,
                other.bitangent.y,
            ])
        }),
        outputs: vec![
            output("from the normal", 0..8, 2e-6),
            output("with a tangent", 8..12, 4e-4),
            output("to local and to world", 12..16, 4e-4),
        ],
    }
}
