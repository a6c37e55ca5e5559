//! Coats of every type.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::gpu::CoatUniform;
use asperity_shading::reflectance::{BsdfSample, Coat};
use asperity_shading::{Bsdf, Dielectric, Frame, Lambert, bump::Facet};
use asperity_wgsl::shading::reflectance::COAT;

use super::{direction, floats, inputs, number, share, vec2, vec3, words};
use crate::case::{Bound, Case, INPUTS, Output};

pub(super) fn cases() -> Vec<Case> {
    vec![over(), deltas()]
}

/// Returns the coat of an input: type, normal, variance of slopes and roughness.
fn coat(inputs: [u32; INPUTS]) -> Coat {
    let ([x, y, variance, roughness], kind) = (floats(inputs, 0), inputs[15] % 5);
    let (fresnel, color) = (Dielectric::new_clamped(1.5), Vec3::new(0.9, 0.7, 0.5));
    let coat = match kind {
        0 => Coat::clearcoat(fresnel),
        1 => Coat::thin_dielectric(fresnel, color),
        2 => Coat::dielectric(fresnel),
        3 => Coat::conductor(color),
        _ => Coat::transparent(color),
    };
    coat.rough(roughness).bumped(Vec3::new(x, y, (1.0 - x * x - y * y).sqrt()), variance)
}

/// Returns words of both directions, after slopes, their variance and a roughness. Directions may
/// be invalid.
fn input(i: u32, roughness: f32, u: [f32; 2]) -> [u32; INPUTS] {
    let (wi, wo) = (direction(i, 0), direction(i, 2));
    let tilt = [4, 5].map(|k| number(i, k, [-0.3, 0.3]));
    let variance = if i.is_multiple_of(3) { 0.0 } else { number(i, 6, [-9.0, -2.0]).exp() };
    let mut all =
        [tilt[0], tilt[1], variance, roughness, wo.x, wo.y, wo.z, 0.0, wi.x, wi.y, wi.z, 0.0, u[0], u[1]];
    if i % 5 == 1 || i % 5 == 2 {
        // Light from behind, and views from behind.
        all[10] *= if i % 2 == 1 { -1.0 } else { 1.0 };
        all[6] *= if i % 3 == 1 { -1.0 } else { 1.0 };
    }
    let mut words = super::material::units(inputs(i, &all));
    words[..4].copy_from_slice(&[tilt[0], tilt[1], variance, roughness].map(f32::to_bits));
    words[15] = i;
    words
}

/// Returns WGSL of the structure `Coat` for an input.
fn structure() -> String {
    let of = |make: fn(Dielectric, Vec3) -> Coat| {
        let CoatUniform { color: [r, g, b], index, .. } =
            make(Dielectric::new_clamped(1.5), Vec3::new(0.9, 0.7, 0.5)).gpu();
        let numbers = [r, g, b, index].map(|x| format!("bitcast<f32>({}u)", x.to_bits()));
        format!("vec4<f32>({})", numbers.join(", "))
    };
    let rows = [
        of(|fresnel, _| Coat::clearcoat(fresnel)),
        of(Coat::thin_dielectric),
        of(|fresnel, _| Coat::dielectric(fresnel)),
        of(|_, color| Coat::conductor(color)),
        of(|_, color| Coat::transparent(color)),
    ];
    let choices: Vec<String> =
        (0..).zip(&rows).map(|(kind, row)| format!("    if kind == {kind}u {{ row = {row}; }}\n")).collect();
    // glslang cannot read arrays with variable indices in HLSL.
    format!(
        "\
    let kind = d.w % 5u;
    var row = vec4<f32>(0.0);
{}\
    let normal = vec3<f32>(a.xy, sqrt(1.0 - a.x * a.x - a.y * a.y));
    let coat = Coat(normal, a.z, vec3<f32>(0.0), a.w, row.xyz, row.w, kind);
",
        choices.concat()
    )
}

fn over() -> Case {
    let body = "\
    let wi = bitcast<vec3<f32>>(c.xyz);
    let below = select(vec3<f32>(0.0), vec3<f32>(0.3183099 * 0.5) * wi.z, direction_are_above(wi, b.xyz));
    outcome.a = bits(vec4<f32>(coat_over(coat, below, b.xyz, wi), 0.0));";
    Case {
        name: "shading/reflectance/coat over any layers".into(),
        parts: vec![&COAT],
        body: structure() + body,
        resources: vec![],
        input: Box::new(|i| {
            let roughness = if i.is_multiple_of(4) { 0.0 } else { number(i, 7, [-3.0, 0.0]).exp() };
            input(i, roughness, [0.0; 2])
        }),
        reference: Box::new(|inputs| {
            let (wo, wi) = (vec3(inputs, 4), vec3(inputs, 8));
            let below = Lambert::new(Vec3::splat(0.5)).expect("a color");
            let bsdf = Bsdf::new(Frame::IDENTITY, wo)
                .with([Facet::FLAT], [(&below as &dyn asperity_shading::Brdf).into()]);
            words(&bsdf.with_coat(coat(inputs)).eval_cos(wo, wi).to_array())
        }),
        // Masking is in 64 bits in the crate, and exponentials of absorption come from the library.
        outputs: vec![Output::new("light", 0..3, Bound::Absolute(8e-6), Bound::Absolute(1e-3))],
    }
}

/// Returns the direction of a sample and a channel of its weight; zeros without a sample.
pub(super) fn specular(sample: Option<BsdfSample>, channel: usize) -> [f32; 4] {
    sample.map_or([0.0; 4], |sample| sample.wi.extend(sample.eval_cos[channel]).to_array())
}

fn deltas() -> Case {
    let body = "\
    let deltas = coat_specular_samples(coat, b.xyz, bitcast<vec2<f32>>(d.xy));
    let mirrored = vec4<f32>(deltas.mirrored.wi, deltas.mirrored.weight.x);
    let transmitted = vec4<f32>(deltas.transmitted.wi, 1.0) * deltas.transmitted.weight.y;
    outcome.a = bits(select(vec4<f32>(0.0), mirrored, mirrored.w > 0.0));
    outcome.b = bits(select(vec4<f32>(0.0), transmitted, transmitted.w > 0.0));";
    Case {
        name: "shading/reflectance/coat, deltas".into(),
        parts: vec![&COAT],
        body: structure() + body,
        resources: vec![],
        input: Box::new(|i| input(i, 0.0, [8, 9].map(|k| share(i, k)))),
        reference: Box::new(|inputs| {
            let (wo, u): (_, Vec2) = (vec3(inputs, 4), vec2(inputs, 12));
            let bsdf = Bsdf::new(Frame::IDENTITY, wo).with_coat(coat(inputs));
            let [mirrored, transmitted] = bsdf.specular_samples(wo, u);
            // At a grazing view the weight vanishes, and with it the direction. A fused driver rounds
            // a weight of 4e-4 to 0 there, so a direction counts by its weight.
            let [x, y, z, weight] = specular(transmitted, 1);
            let transmitted = [x * weight, y * weight, z * weight, weight];
            words(&[specular(mirrored, 0), transmitted].concat())
        }),
        outputs: vec![
            // In the crate a facet is chosen with the library's logarithm and cosine.
            Output::new("mirrored", 0..4, Bound::Absolute(6e-5), Bound::Absolute(2e-3)),
            Output::new("transmitted", 4..8, Bound::Absolute(4e-5), Bound::Absolute(2e-3)),
        ],
    }
}
