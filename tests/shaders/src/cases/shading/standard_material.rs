//! The standard material with all of its lobes.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::level_of_detail::ResolvedBumps;
use asperity_shading::reflectance::{CharlieSheen, FacetBrdf, GgxAlbedo, GlassAlbedo};
use asperity_shading::{StandardMaterial, StandardMaterialParameters};
use asperity_wgsl::shading::reflectance::STANDARD_MATERIAL;

use super::{direction, floats, number, share, vec2, vec3, words};
use crate::case::{Bound, Case, INPUTS, Output};

pub(super) fn cases() -> Vec<Case> {
    vec![standard_material()]
}

/// The material of an input: every lobe of some.
fn material(inputs: [u32; INPUTS]) -> StandardMaterial {
    let ([roughness, metallic, clearcoat, anisotropy], kind) = (floats(inputs, 0), inputs[15]);
    let [sheen, transmission] = [f32::from_bits(inputs[7]), f32::from_bits(inputs[11])];
    StandardMaterial::new_clamped(StandardMaterialParameters {
        base_color: Vec3::new(0.8, 0.5, 0.25),
        metallic,
        roughness,
        emissive: Vec3::new(3.0, 2.0, 1.0),
        ior: 1.75,
        specular: 0.75,
        specular_color: Vec3::new(1.5, 1.0, 0.5),
        clearcoat,
        clearcoat_roughness: 0.5,
        sheen_color: sheen * Vec3::new(0.25, 0.5, 1.0),
        sheen_roughness: 0.5,
        transmission,
        thickness: (kind % 2) as f32,
        anisotropy,
        anisotropy_rotation: 0.5,
    })
}

fn standard_material() -> Case {
    let body = "\
    let wi = bitcast<vec3<f32>>(c.xyz);
    let bumps = bitcast<vec3<f32>>(d.xyz);
    let transmission = bitcast<f32>(c.w);
    let thickness = f32(d.w % 2u);
    let material = StandardMaterial(
        vec3<f32>(0.8, 0.5, 0.25), a.y, vec3<f32>(3.0, 2.0, 1.0), a.x, vec3<f32>(1.5, 1.0, 0.5), 0.75,
        b.w * vec3<f32>(0.25, 0.5, 1.0), 0.5, 1.75, a.z, 0.5, transmission, thickness, a.w, 0.5);
    let layers = standard_material_layers(material);
    outcome.a = bits(vec4<f32>(standard_layers_eval(layers, b.xyz, wi, bumps.xy, bumps.z), 0.0));
    outcome.b = bits(vec4<f32>(standard_layers_emitted(layers, b.xyz), 0.0));";
    Case {
        name: "shading/reflectance/standard material".into(),
        parts: vec![&STANDARD_MATERIAL],
        body: body.into(),
        resources: [
            ("ggx_albedo_number", GgxAlbedo::table().collect::<Vec<_>>()),
            ("glass_albedo_number", GlassAlbedo::table().collect()),
            ("charlie_albedo_number", CharlieSheen::table().collect()),
        ]
        .map(|(name, table)| (name, table.into_iter().map(f32::to_bits).collect()))
        .into(),
        input: Box::new(|i| {
            let some = |k: u32| if (i >> (k % 4)).is_multiple_of(2) { 0.0 } else { share(i, k) };
            let (wo, wi) = (direction(i, 8), direction(i, 10));
            let variance = if i.is_multiple_of(3) { 0.0 } else { number(i, 7, [0.0, 0.95]) };
            let z = [12, 14].map(|k| number(i, k, [-2.0, 2.0]));
            let numbers = [number(i, 0, [0.2, 1.0]), some(1), some(2), some(3), wo.x, wo.y, wo.z, some(4)];
            let rest = [wi.x, wi.y, wi.z, some(6), z[0], z[1], variance];
            let mut all = [i; INPUTS];
            for (word, number) in all.iter_mut().zip(numbers.into_iter().chain(rest)) {
                *word = number.to_bits();
            }
            all
        }),
        reference: Box::new(|inputs| {
            let (material, wo, wi) = (material(inputs), vec3(inputs, 4), vec3(inputs, 8));
            let z: Vec2 = vec2(inputs, 12);
            let bumps = ResolvedBumps { z, variance: f32::from_bits(inputs[14]), blend: 1.0 };
            let value = material.eval_resolved(wo, wi, bumps);
            let emitted = material.emitted(wo);
            words(&[value.x, value.y, value.z, 0.0, emitted.x, emitted.y, emitted.z])
        }),
        outputs: vec![
            // Products of half a dozen functions that differ by a few 1e-6 each.
            Output::new("light", 0..3, Bound::Relative(1e-4), Bound::Relative(2e-3)),
            Output::new("emitted", 4..7, Bound::Relative(1e-5), Bound::Relative(1e-4)),
        ],
    }
}
