//! The standard materials with all of their lobes.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::level_of_detail::ResolvedBumps;
use asperity_shading::reflectance::{CharlieSheen, FacetBrdf, GgxAlbedo, GlassAlbedo};
use asperity_shading::{OpenPbr, OpenPbrParameters, StandardMaterial, StandardMaterialParameters};
use asperity_wgsl::Part;
use asperity_wgsl::shading::reflectance::{OPEN_PBR, STANDARD_MATERIAL};

use super::{direction, floats, number, share, vec2, vec3, words};
use crate::case::{Bound, Case, INPUTS, Output};

pub(super) fn cases() -> Vec<Case> {
    vec![standard_material(), open_pbr()]
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

/// The material of OpenPBR of an input.
fn coated(inputs: [u32; INPUTS]) -> OpenPbr {
    let [specular_roughness, base_metalness, coat_weight, specular_roughness_anisotropy] = floats(inputs, 0);
    let [fuzz_weight, transmission_weight] = [f32::from_bits(inputs[7]), f32::from_bits(inputs[11])];
    OpenPbr::new(OpenPbrParameters {
        base_weight: 0.75,
        base_color: Vec3::new(0.75, 0.5, 0.25),
        base_diffuse_roughness: 0.5,
        base_metalness,
        specular_weight: 0.5,
        specular_color: Vec3::new(1.0, 0.75, 0.5),
        specular_roughness,
        specular_roughness_anisotropy,
        specular_ior: 1.75,
        transmission_weight,
        transmission_color: Vec3::ONE,
        transmission_depth: 0.0,
        coat_weight,
        coat_color: Vec3::new(1.0, 0.75, 0.5),
        coat_roughness: 0.5,
        coat_roughness_anisotropy: 0.25,
        coat_ior: 1.5,
        coat_darkening: 0.75,
        fuzz_weight,
        fuzz_color: Vec3::new(0.5, 0.75, 1.0),
        fuzz_roughness: 0.5,
        emission_luminance: 2.0,
        emission_color: Vec3::new(1.0, 0.5, 0.25),
        geometry_thin_walled: inputs[15].is_multiple_of(2),
    })
    .expect("parameters in range")
}

/// A case of a material whose layers the text `layers` makes.
fn case<M: FacetBrdf + 'static>(
    [name, layers]: [&str; 2],
    part: &'static Part,
    material: fn([u32; INPUTS]) -> M,
) -> Case {
    let body = format!(
        "\
    let wi = bitcast<vec3<f32>>(c.xyz);
    let bumps = bitcast<vec3<f32>>(d.xyz);
    let transmission = bitcast<f32>(c.w);
    let odd = d.w % 2u;
{layers}
    outcome.a = bits(vec4<f32>(standard_layers_eval(layers, b.xyz, wi, bumps.xy, bumps.z), 0.0));
    outcome.b = bits(vec4<f32>(standard_layers_emitted(layers, b.xyz), 0.0));"
    );
    Case {
        name: format!("shading/reflectance/{name}"),
        parts: vec![part],
        body,
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
        reference: Box::new(move |inputs| {
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

fn standard_material() -> Case {
    let layers = "\
    let material = StandardMaterial(
        vec3<f32>(0.8, 0.5, 0.25), a.y, vec3<f32>(3.0, 2.0, 1.0), a.x, vec3<f32>(1.5, 1.0, 0.5), 0.75,
        b.w * vec3<f32>(0.25, 0.5, 1.0), 0.5, 1.75, a.z, 0.5, transmission, f32(odd), a.w, 0.5);
    let layers = standard_material_layers(material);";
    case(["standard material", layers], &STANDARD_MATERIAL, material)
}

fn open_pbr() -> Case {
    let layers = "\
    let material = OpenPbr(
        vec3<f32>(0.75, 0.5, 0.25), 0.75, vec3<f32>(1.0, 0.75, 0.5), 0.5, vec3<f32>(1.0, 0.75, 0.5), a.z,
        vec3<f32>(0.5, 0.75, 1.0), b.w, vec3<f32>(1.0, 0.5, 0.25), 2.0, 0.5, a.y, a.x, a.w, 1.75, transmission,
        0.5, 0.25, 1.5, 0.75, 0.5, 1u - odd);
    let layers = open_pbr_layers(material);";
    case(["open pbr", layers], &OPEN_PBR, coated)
}
