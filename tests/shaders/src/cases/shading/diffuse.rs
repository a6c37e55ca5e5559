//! Diffuse reflectances.

use asperity_shading::glam::Vec3;
use asperity_shading::reflectance::{OrenNayar, OrenNayarVariant};
use asperity_shading::{Brdf, EnergyPreservingOrenNayar, Lambert};
use asperity_wgsl::shading::reflectance::{ENERGY_PRESERVING, LAMBERT, OREN_NAYAR};

use super::{direction, equal, floats, inputs, number, share, vec3, words};
use crate::case::{Bound, Case, Output};

pub(super) fn cases() -> Vec<Case> {
    vec![angle(), diffuse()]
}

fn angle() -> Case {
    // The crate's angle is the library's `atan2`.
    let bound = Bound::Absolute(8e-7);
    Case {
        name: "shading/math".into(),
        parts: vec![&LAMBERT],
        body: "\
    outcome.a = bits(vec4<f32>(math_angle(a.x, a.y), math_shares(b.xyz)));
    outcome.b = vec4<u32>(u32(math_is_finite(b.x)), 0u, 0u, 0u);"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let [x, y] = [0, 1].map(|k| number(i, k, [-1.0, 1.0]));
            let x = if i % 8 == 0 { 0.0 } else { x };
            let b = [2, 3, 4].map(|k| number(i, k, [-0.5, 1.5]));
            let mut words = inputs(i, &[x, y, 0.0, 0.0, b[0], b[1], b[2]]);
            words[..2].copy_from_slice(&[x, y].map(f32::to_bits));
            words
        }),
        reference: Box::new(|inputs| {
            let [x, y] = floats(inputs, 0);
            let shares = vec3(inputs, 4).to_array().map(|c| if c > 0.0 { c.min(1.0) } else { 0.0 });
            let mut outputs = words(&[x.atan2(y), shares[0], shares[1], shares[2]]);
            outputs[4] = u32::from(f32::from_bits(inputs[4]).is_finite());
            outputs
        }),
        outputs: vec![
            Output::new("angle", 0..1, bound, bound),
            equal("shares", 1..4, Bound::Absolute(1e-37)),
            equal("finite", 4..5, Bound::Equal),
        ],
    }
}

fn diffuse() -> Case {
    // The angles of the full and the energy-preserving form come from the library.
    let bound = Bound::Absolute(2.4e-7);
    Case {
        name: "shading/reflectance/diffuse".into(),
        parts: vec![&LAMBERT, &OREN_NAYAR, &ENERGY_PRESERVING],
        body: "\
    let wi = bitcast<vec3<f32>>(c.xyz);
    let wo = bitcast<vec3<f32>>(vec3<u32>(c.w, d.xy));
    outcome.a = bits(vec4<f32>(lambert_eval(a.xyz, wi, wo), oren_nayar_qualitative(a.xyz, b.x, wi, wo).x));
    outcome.b = bits(vec4<f32>(oren_nayar_full(a.xyz, b.x, wi, wo), oren_nayar_fujii(a.xyz, b.y, wi, wo).x));
    outcome.c = bits(vec4<f32>(energy_preserving_oren_nayar_eval(a.xyz, b.y, wi, wo), 0.0));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let (wi, wo) = (direction(i, 4), direction(i, 6));
            let mut words =
                inputs(i, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, wi.x, wi.y, wi.z, wo.x, wo.y, wo.z]);
            for k in 0..6 {
                words[k as usize] = share(i, k).to_bits();
            }
            words
        }),
        reference: Box::new(|inputs| {
            let [r, g, b, _, sigma, roughness] = floats(inputs, 0);
            let (albedo, wi, wo) = (Vec3::new(r, g, b), vec3(inputs, 8), vec3(inputs, 11));
            let oren_nayar = |sigma, form| OrenNayar::new(albedo, sigma, form).expect("shares").eval(wo, wi);
            let lambert = Lambert::new(albedo).expect("shares").eval(wo, wi);
            let even = EnergyPreservingOrenNayar::new_clamped(albedo, roughness).eval(wo, wi);
            let first = lambert.extend(oren_nayar(sigma, OrenNayarVariant::Qualitative).x).to_array();
            let second = oren_nayar(sigma, OrenNayarVariant::Full)
                .extend(oren_nayar(roughness, OrenNayarVariant::Fujii).x)
                .to_array();
            words(&[first, second, even.extend(0.0).to_array()].concat())
        }),
        outputs: vec![
            equal("Lambert", 0..3, Bound::Relative(2e-7)),
            equal("Oren–Nayar, qualitative", 3..4, Bound::Relative(1e-5)),
            Output::new("Oren–Nayar, full", 4..7, Bound::Relative(2e-4), Bound::Relative(4e-4)),
            equal("Oren–Nayar, Fujii's", 7..8, Bound::Relative(1e-5)),
            Output::new("energy-preserving", 8..11, bound, Bound::Absolute(1e-5)),
        ],
    }
}
