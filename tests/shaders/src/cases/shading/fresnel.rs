//! Fresnel reflectances.

use asperity_shading::glam::Vec3;
use asperity_shading::reflectance::SchlickF82;
use asperity_shading::{Conductor, Dielectric, Fresnel, Schlick};
use asperity_wgsl::shading::reflectance::{CONDUCTOR, DIELECTRIC, SCHLICK};

use super::{equal, floats, inputs, number, share, words};
use crate::case::{Bound, Case};

pub(super) fn cases() -> Vec<Case> {
    vec![fresnel()]
}

fn fresnel() -> Case {
    Case {
        name: "shading/reflectance/fresnel".into(),
        parts: vec![&SCHLICK, &DIELECTRIC, &CONDUCTOR],
        body: "\
    let cosine = bitcast<f32>(d.x);
    outcome.a = bits(vec4<f32>(schlick_reflectance(a.xyz, cosine), dielectric_reflectance(b.x, cosine)));
    outcome.b = bits(vec4<f32>(schlick_f82_reflectance(a.xyz, bitcast<vec3<f32>>(c.xyz), cosine), conductor_reflectance(b.y, b.z, cosine)));
    outcome.c = bits(vec4<f32>(dielectric_reversed(b.x), dielectric_transmittance(b.x, cosine), 0.0, 0.0));"
            .into(),
        resources: vec![],
        // Parameters are valid, as accepted by constructors.
        input: Box::new(|i| {
            let f0 = [0, 1, 2].map(|k| share(i, k));
            let tint = [3, 4, 5].map(|k| share(i, k));
            let index = match i % 32 {
                0 => 1.0,
                1 => f32::MAX,
                // A GPU may flush a denormal to 0, which is invalid.
                2 => f32::MIN_POSITIVE,
                _ => number(i, 6, [-1.5, 1.5]).exp(),
            };
            let (eta, k) = match i % 64 {
                0 => (1.0, 0.0),
                1 => (1e19, 1e19),
                2 => (1e-30, 0.0),
                _ => (number(i, 7, [-2.0, 2.0]).exp(), share(i, 8) * 8.0),
            };
            let mut good = [f0[0], f0[1], f0[2], 0.0, index, eta, k, 0.0, 0.0, 0.0, 0.0, 0.0, share(i, 9)];
            for (axis, tint) in tint.into_iter().enumerate() {
                good[8 + axis] = SchlickF82::new(f0[axis], tint).map_or(0.0, |metal| metal.dip());
            }
            let mut words = good.map(f32::to_bits).to_vec();
            words.extend(tint.map(f32::to_bits));
            let mut words: [u32; 16] = words.try_into().unwrap_or_default();
            words[12] = inputs(i, &[share(i, 9); 16])[i as usize % 12];
            words
        }),
        reference: Box::new(|inputs| {
            let [r, g, b, _, index, eta, k] = floats(inputs, 0);
            let [cosine, x, y, z] = floats(inputs, 12);
            let schlick = [r, g, b].map(|f0| Schlick::new(f0).expect("a share"));
            let tinted = [[r, x], [g, y], [b, z]].map(|[f0, tint]| SchlickF82::new(f0, tint).expect("shares"));
            let dielectric = Dielectric::new(index).expect("an index");
            let conductor = Conductor::new(eta, k).expect("an index");
            let last = |rgb: Vec3, last: f32| rgb.extend(last).to_array();
            let first = last(schlick.reflectance_rgb(cosine), dielectric.reflectance(cosine));
            let second = last(tinted.reflectance_rgb(cosine), conductor.reflectance(cosine));
            words(&[first, second, [dielectric.reversed().relative_index(), dielectric.transmittance(cosine), 0.0, 0.0]].concat())
        }),
        outputs: vec![
            equal("Schlick", 0..3, Bound::Absolute(5e-7)),
            equal("dielectric", 3..4, Bound::Absolute(2e-5)),
            equal("Schlick, tinted", 4..7, Bound::Absolute(5e-6)),
            equal("conductor", 7..8, Bound::Absolute(2e-5)),
            equal("transmittance", 9..10, Bound::Relative(2e-5)),
            equal("reversed", 8..9, Bound::Relative(5e-7)),
        ],
    }
}
