//! Fuzz: Zeltner and Charlie.

use asperity_shading::Brdf;
use asperity_shading::glam::Vec3;
use asperity_shading::reflectance::{CharlieSheen, ZeltnerFuzz};
use asperity_wgsl::shading::reflectance::{CHARLIE_SHEEN, ZELTNER_FUZZ};

use super::{direction, floats, inputs, number, vec3, words};
use crate::case::{Bound, Case, Output};

pub(super) fn cases() -> Vec<Case> {
    vec![fuzz()]
}

/// Smaller values are read as this.
const FAINT: f32 = 1e-12;

fn fuzz() -> Case {
    Case {
        name: "shading/reflectance/fuzz".into(),
        parts: vec![&CHARLIE_SHEEN, &ZELTNER_FUZZ],
        body: "\
    let wi = bitcast<vec3<f32>>(c.xyz);
    let wo = bitcast<vec3<f32>>(vec3<u32>(c.w, d.xy));
    let values = vec4<f32>(zeltner_fuzz_eval(a.x, wi, wo), zeltner_fuzz_albedo(a.x, wo.z), charlie_sheen_eval(a.y, wi, wo), charlie_sheen_albedo(a.y, wo.z));
    outcome.a = bits(max(values, vec4<f32>(1e-12)));"
            .into(),
        resources: vec![("charlie_albedo_number", CharlieSheen::table().map(f32::to_bits).collect())],
        input: Box::new(|i| {
            let (wi, wo) = (direction(i, 8), direction(i, 10));
            let mut all = [0.0; 14];
            all[8..].copy_from_slice(&[wi.x, wi.y, wi.z, wo.x, wo.y, wo.z]);
            let mut words = inputs(i, &all);
            words[0] = number(i, 0, [0.01, 1.0]).to_bits();
            words[1] = number(i, 1, [0.07, 1.0]).to_bits();
            words
        }),
        reference: Box::new(|inputs| {
            let [zeltner, charlie] = floats(inputs, 0);
            let (wi, wo) = (vec3(inputs, 8), vec3(inputs, 11));
            let zeltner = ZeltnerFuzz::new(Vec3::ONE, zeltner).expect("a roughness");
            let charlie = CharlieSheen::new(Vec3::ONE, charlie).expect("a roughness");
            let values =
                [zeltner.eval(wo, wi).x, zeltner.albedo(wo.z).x, charlie.eval(wo, wi).x, charlie.albedo(wo.z).x];
            words(&values.map(|value| value.max(FAINT)))
        }),
        outputs: vec![
            Output::new("Zeltner", 0..1, Bound::Relative(2e-4), Bound::Relative(2e-3)),
            Output::new("albedo", 1..2, Bound::Relative(2e-4), Bound::Relative(2e-3)),
            Output::new("Charlie", 2..3, Bound::Relative(2e-4), Bound::Relative(2e-3)),
            Output::new("albedo of Charlie", 3..4, Bound::Absolute(2e-6), Bound::Absolute(2e-5)),
        ],
    }
}
