//! Glossy reflectances.

use asperity_shading::glam::Vec3;
use asperity_shading::reflectance::{BlinnPhongBrdf, BlinnPhongNormalization, WardBrdf, WardNormalization};
use asperity_shading::{Beckmann, Brdf, CookTorrance, Ggx, Phong, Schlick, TorranceSparrow};
use asperity_wgsl::shading::reflectance::{
    COOK_TORRANCE_BECKMANN, COOK_TORRANCE_GGX, PHONG, SCHLICK, TORRANCE_SPARROW, WARD,
};

use super::{direction, equal, floats, inputs, number, share, vec3, words};
use crate::case::{Bound, Case, INPUTS, Output};

pub(super) fn cases() -> Vec<Case> {
    vec![microfacets(), lobes()]
}

/// Smaller values are treated as this value: drivers may flush denormals, which are invisible in
/// sums of lights.
const FAINT: f32 = 1e-30;

/// Two directions in words 8 to 13, invalid ones first, sometimes near the mirror direction.
fn directions(i: u32, good: [f32; 8]) -> [u32; INPUTS] {
    let (wi, wo) = (direction(i, 8), direction(i, 10));
    let mirrored = Vec3::new(-wo.x, -wo.y, wo.z) + 0.1 * (wi - Vec3::Z);
    let wi = if i.is_multiple_of(2) && mirrored.z > 0.0 { mirrored.normalize() } else { wi };
    let mut all = [0.0; 14];
    all[8..].copy_from_slice(&[wi.x, wi.y, wi.z, wo.x, wo.y, wo.z]);
    let mut words = inputs(i, &all);
    words[..8].copy_from_slice(&good.map(f32::to_bits));
    words
}

fn microfacets() -> Case {
    Case {
        name: "shading/reflectance, microfacets".into(),
        parts: vec![&COOK_TORRANCE_GGX, &COOK_TORRANCE_BECKMANN, &TORRANCE_SPARROW, &SCHLICK],
        body:
            "\
    let alpha = roughness_clamped(a.xy);
    let wi = bitcast<vec3<f32>>(c.xyz);
    let wo = bitcast<vec3<f32>>(vec3<u32>(c.w, d.xy));
    let ggx = cook_torrance_ggx(alpha, wi, wo);
    let beckmann = cook_torrance_beckmann(alpha, wi, wo);
    let grooves = torrance_sparrow(wi, wo);
    let f0 = vec3<f32>(b.xyz);
    outcome.a = bits(max(vec4<f32>(ggx.x * schlick_reflectance(f0, ggx.y), 0.0), vec4<f32>(1e-30)));
    outcome.b = bits(max(vec4<f32>(beckmann.x * schlick_reflectance(f0, beckmann.y), 0.0), vec4<f32>(1e-30)));
    let walls = torrance_sparrow_eval(grooves, ggx_d(alpha, grooves.h));
    outcome.c = bits(max(vec4<f32>(walls * schlick_reflectance(f0, grooves.cosine), 0.0), vec4<f32>(1e-30)));"
                .into(),
        resources: vec![],
        input: Box::new(|i| {
            let alpha = [0, 1].map(|k| match (i + k) % 64 {
                0 => 0.0,
                _ => 10.0_f32.powf(number(i, k, [-2.0, 0.0])),
            });
            let f0 = [2, 3, 4].map(|k| share(i, k));
            directions(i, [alpha[0], alpha[1], 0.0, 0.0, f0[0], f0[1], f0[2], 0.0])
        }),
        reference: Box::new(|inputs| {
            let ([x, y], [r, g, b]) = (floats(inputs, 0), floats(inputs, 4));
            let (wi, wo) = (vec3(inputs, 8), vec3(inputs, 11));
            let fresnel = [r, g, b].map(|f0| Schlick::new(f0).expect("a share"));
            let (ggx, beckmann) = (Ggx::new_clamped(x, y), Beckmann::new_clamped(x, y));
            let values = [
                CookTorrance::new(ggx, fresnel).eval(wo, wi),
                CookTorrance::new(beckmann, fresnel).eval(wo, wi),
                TorranceSparrow::new(ggx, fresnel).eval(wo, wi),
            ];
            words(&values.map(|value| value.extend(0.0).max([FAINT; 4].into()).to_array()).concat())
        }),
        outputs: vec![
            equal("Cook–Torrance, GGX", 0..3, Bound::Relative(1e-2)),
            // The crate's masking of the Beckmann density is in 64 bits.
            Output::new("Cook–Torrance, Beckmann", 4..7, Bound::Relative(2e-5), Bound::Relative(1e-2)),
            equal("Torrance–Sparrow, GGX", 8..11, Bound::Relative(1e-2)),
        ],
    }
}

fn lobes() -> Case {
    // Exponentials and logarithms come from the library in the crate.
    let (written, adapter) = (Bound::Relative(4e-5), Bound::Relative(1e-3));
    Case {
        name: "shading/reflectance, lobes".into(),
        parts: vec![&PHONG, &WARD],
        body: "\
    let wi = bitcast<vec3<f32>>(c.xyz);
    let wo = bitcast<vec3<f32>>(vec3<u32>(c.w, d.xy));
    let blinn = blinn_phong_brdf_eval(a.z, blinn_phong_brdf_factor(a.z), wi, wo);
    outcome.a = bits(max(vec4<f32>(phong_eval(a.z, wi, wo), blinn, 0.0, 0.0), vec4<f32>(1e-30)));
    outcome.b = bits(max(vec4<f32>(
        ward_brdf_eval(a.xy, WARD_AS_PUBLISHED, wi, wo), ward_brdf_eval(a.xy, WARD_DUR, wi, wo), ward_brdf_eval(a.xy, WARD_BOUNDED, wi, wo), 0.0,
    ), vec4<f32>(1e-30)));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let alpha = [0, 1].map(|k| 10.0_f32.powf(number(i, k, [-2.0, 0.0])));
            let exponent = match i % 16 {
                0 => 1e-6,
                1 => 1e6,
                _ => 10.0_f32.powf(number(i, 2, [-1.0, 4.0])),
            };
            directions(i, [alpha[0], alpha[1], exponent, 0.0, 0.0, 0.0, 0.0, 0.0])
        }),
        reference: Box::new(|inputs| {
            let [x, y, exponent] = floats(inputs, 0);
            let (wi, wo) = (vec3(inputs, 8), vec3(inputs, 11));
            let phong = Phong::new(Vec3::ONE, exponent).expect("an exponent").eval(wo, wi).x;
            let blinn = BlinnPhongBrdf::new(Vec3::ONE, exponent, BlinnPhongNormalization::Albedo);
            let blinn = blinn.expect("an exponent").eval(wo, wi).x;
            let ward = [WardNormalization::Ward, WardNormalization::Dur, WardNormalization::Bounded]
                .map(|form| WardBrdf::new(Vec3::ONE, x, y, form).expect("roughnesses").eval(wo, wi).x);
            words(&[phong, blinn, 0.0, 0.0, ward[0], ward[1], ward[2], 0.0].map(|value| value.max(FAINT)))
        }),
        outputs: vec![
            Output::new("Phong", 0..1, written, adapter),
            Output::new("Blinn–Phong", 1..2, written, adapter),
            Output::new("Ward", 4..7, written, adapter),
        ],
    }
}
