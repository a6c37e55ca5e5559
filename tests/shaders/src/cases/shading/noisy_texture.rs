//! Textures from noise and from hashes.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::texture::{Gas, PerturbedTexture, StarWallpaper, Steam, march};
use asperity_shading::{Footprint, Marble};
use asperity_wgsl::shading::material::PERTURBED_POINT;
use asperity_wgsl::shading::texture::{GAS, MARBLE, STAR_WALLPAPER};
use asperity_wgsl::{Binding, Part};

use super::material::sums;
use super::{floats, inputs, number, vec3, words};
use crate::case::{Bound, Case, OUTPUTS, Output, packed};

pub(super) fn cases() -> Vec<Case> {
    vec![stars(), marble(), gas(false), gas(true), gas_march(), perturbed()]
}

/// A texture whose structure the body builds from words, at points within `extent`, for pixels up
/// to `widest` wide. p, the width, u and v are `a.xyz`, `a.w` and `b.xy`.
fn texture(
    name: String,
    part: &'static Part,
    resources: Vec<(&'static str, Vec<u32>)>,
    body: String,
    [extent, widest]: [f32; 2],
    reference: impl Fn(Vec3, f32, Vec2) -> [u32; OUTPUTS] + Send + Sync + 'static,
    outputs: Vec<Output>,
) -> Case {
    Case {
        name,
        parts: vec![part],
        body,
        resources,
        input: Box::new(move |i| {
            let p = [0, 1, 2, 3, 4].map(|k| number(i, k, [-extent, extent]));
            let width = if i % 4 == 0 { 0.0 } else { widest * number(i, 5, [-9.0, 0.0]).exp() };
            let mut words = inputs(i, &[p[0], p[1], p[2], width, p[3], p[4]]);
            // Far from the origin, a rounding selects another cell.
            for word in &mut words[4..6] {
                let x = f32::from_bits(*word);
                *word = if x.is_finite() { x.clamp(-20.0, 20.0) } else { x }.to_bits();
            }
            // Widths are footprints.
            words[3] = Footprint::from_width(f32::from_bits(words[3])).width().min(f32::MAX).to_bits();
            words
        }),
        reference: Box::new(move |inputs| {
            let ([width], [u, v]) = (floats(inputs, 3), floats(inputs, 4));
            reference(vec3(inputs, 0), width, Vec2::new(u, v))
        }),
        outputs,
    }
}

/// Defines a part without functions that binds a structure as `given`.
macro_rules! given {
    ($part:path, $of:literal) => {{
        static GIVEN: Part = Part::new(concat!("case/", $of), "", &[&$part])
            .with_bindings(&[Binding::Uniform { name: "given", of: $of }]);
        &GIVEN
    }};
}

fn stars() -> Case {
    let stars = StarWallpaper::default();
    texture(
        "shading/texture/star_wallpaper".into(),
        given!(STAR_WALLPAPER, "StarWallpaper"),
        vec![("given", packed(&stars.gpu()))],
        "\
    outcome.a = bits(vec4<f32>(star_wallpaper_coverage(given, b.xy, a.w), 0.0, 0.0, 0.0));"
            .into(),
        [2.0, 0.1],
        move |_, width, uv| words(&[stars.coverage(uv, Footprint::from_width(width))]),
        // Angles come from the library in the crate.
        vec![Output::new("coverage", 0..1, Bound::Absolute(1.4e-5), Bound::Absolute(2e-3))],
    )
}

fn marble() -> Case {
    let marble = Marble::default();
    texture(
        "shading/texture/marble".into(),
        given!(MARBLE, "Marble"),
        vec![("given", packed(&marble.gpu()))],
        "\
    outcome.a = bits(vec4<f32>(marble_color(given, a.xyz, a.w), marble_sum(given, a.xyz, 0.0).sum));"
            .into(),
        [4.0, 2.0],
        move |p, width, _| {
            let color = marble.color(p, Footprint::from_width(width));
            words(&color.extend(marble.sum(p)).to_array())
        },
        vec![Output::new("color and sum", 0..4, Bound::Equal, Bound::Absolute(2e-4))],
    )
}

fn gas(has_veins: bool) -> Case {
    let gas = if has_veins { Gas::default().with_veins() } else { Gas::default() };
    let steam = Steam::new(Vec3::new(0.5, -0.5, 0.0), 1.5, 2.0).expect("positive");
    // The sine of veins comes from the library in the crate.
    let bound = if has_veins { Bound::Absolute(5e-6) } else { Bound::Equal };
    texture(
        format!("shading/texture/gas{}", if has_veins { " with veins" } else { "" }),
        given!(GAS, "Gas"),
        vec![sums(&[gas.gpu_sum()]), ("given", packed(&gas.gpu(0)))],
        "\
    let share = gas_steam_share(vec3<f32>(0.5, -0.5, 0.0), 1.5, 2.0, a.xyz);
    outcome.a = bits(vec4<f32>(gas_density(given, a.xyz, a.w), gas_density(given, a.xyz, 0.0), share, 0.0));"
            .into(),
        [3.0, 2.0],
        move |p, width, _| {
            words(&[gas.clamped_density(p, Footprint::from_width(width)), gas.density(p), steam.share(p)])
        },
        vec![
            Output::new("density", 0..2, bound, Bound::Absolute(1e-3)),
            Output::new("share of steam", 2..3, Bound::Equal, Bound::Absolute(1e-5)),
        ],
    )
}

/// Rays through steam, and through fog with varying extinction and emission.
fn gas_march() -> Case {
    const STEP: f32 = 0.4;
    let gas = Gas::default();
    let center = Vec3::new(0.5, -0.5, 0.0);
    let steam = Steam::new(center, 1.5, 2.0).expect("positive");
    let fog = |p: Vec3| 0.5 + 0.2 * p.x;
    Case {
        name: "shading/texture/gas_march".into(),
        parts: vec![given!(GAS, "Gas")],
        body: "\
    let steam = GasSteam(vec3<f32>(0.5, -0.5, 0.0), 1.5, 2.0);
    let interval = gas_march_interval(steam, a.xyz, b.xyz);
    let through = gas_march_transmittance(given, steam, 2.0, b.w, a.xyz, b.xyz, 0.4, a.w);
    let ends = bitcast<vec4<f32>>(c);
    var fog = gas_march_begin(ends.x, ends.y, ends.z, a.w);
    while gas_march_goes_on(fog) {
        let p = gas_march_point(fog, vec3<f32>(0.1, 0.2, 0.3), vec3<f32>(0.6, 0.0, 0.8));
        fog = gas_march_added(fog, 0.5 + 0.2 * p.x, abs(p));
    }
    outcome.a = bits(vec4<f32>(interval, through, fog.transmittance));
    outcome.b = bits(vec4<f32>(fog.light, 0.0));"
            .into(),
        resources: vec![sums(&[gas.gpu_sum()]), ("given", packed(&gas.gpu(0)))],
        input: Box::new(|i| {
            let origin = [0, 1, 2].map(|k| number(i, k, [-3.0, 3.0]));
            // Sometimes upward, or level.
            let direction = match i % 16 {
                0 => [0.0, 0.0, -1.0],
                1 => [0.6, 0.8, 0.0],
                _ => Vec3::from([3, 4, 5].map(|k| number(i, k, [-1.0, 1.0]))).normalize().to_array(),
            };
            let width = if i % 4 == 0 { 0.0 } else { number(i, 6, [-9.0, 0.5]).exp() };
            let (near, length) = (number(i, 7, [-2.0, 2.0]), number(i, 8, [-0.2, 3.0]));
            let [a, b, c] = origin;
            let [d, e, f] = direction;
            let all = [a, b, c, number(i, 9, [0.0, 1.0]), d, e, f, width, near, near + length, 0.5];
            let mut words = inputs(i, &all);
            // From far away, a rounding moves the position in the steam.
            for word in &mut words[..11] {
                let x = f32::from_bits(*word);
                *word = if x.is_finite() { x.clamp(-20.0, 20.0) } else { x }.to_bits();
            }
            words[7] = Footprint::from_width(f32::from_bits(words[7])).width().min(f32::MAX).to_bits();
            // Tens of thousands of steps for a single input.
            let step = f32::from_bits(words[10]);
            words[10] = if i == 22 || step.is_nan() { step } else { step.abs().max(0.1) }.to_bits();
            words
        }),
        reference: Box::new(move |inputs| {
            let (origin, direction) = (vec3(inputs, 0), vec3(inputs, 4));
            let ([offset], [width, near, far, step]) = (floats(inputs, 3), floats(inputs, 7));
            let interval = steam.interval(origin, direction);
            let wider = [interval[0] - STEP, interval[1] + STEP];
            let extinction = |p: Vec3| match steam.share(p) {
                share if share > 0.0 => 2.0 * share * gas.clamped_density(p, Footprint::from_width(width)),
                _ => 0.0,
            };
            let dark = |_| Vec3::ZERO;
            let through = march(origin, direction, wider, STEP, offset, extinction, dark).transmittance;
            let (from, along) = (Vec3::new(0.1, 0.2, 0.3), Vec3::new(0.6, 0.0, 0.8));
            let seen = march(from, along, [near, far], step, offset, fog, Vec3::abs);
            let [begin, end] = interval.map(|x| x.clamp(f32::MIN, f32::MAX));
            let light = seen.light.to_array();
            words(&[begin, end, through, seen.transmittance, light[0], light[1], light[2]])
        }),
        outputs: vec![
            Output::new("interval", 0..2, Bound::Equal, Bound::Absolute(1e-2)),
            // Exponentials come from the library in the crate, with 65,536 steps of one input.
            Output::new("transmittance", 2..4, Bound::Absolute(2e-5), Bound::Absolute(2e-3)),
            Output::new("light", 4..7, Bound::Absolute(2e-5), Bound::Absolute(2e-3)),
        ],
    }
}

fn perturbed() -> Case {
    let running = PerturbedTexture::default();
    texture(
        "shading/texture/perturbed".into(),
        given!(PERTURBED_POINT, "PerturbedTexture"),
        vec![("given", packed(&running.gpu()))],
        "\
    let seen = perturbed_look_up(given, a.xyz, b.xy, a.w);
    let finite = direction_is_finite(vec3<f32>(seen.uv, 0.0));
    outcome.a = bits(vec4<f32>(select(vec2<f32>(0.0), seen.uv, finite), seen.spread));"
            .into(),
        [20.0, 20.0],
        move |p, width, uv| {
            let seen = running.filtered(p, uv, Footprint::from_width(width));
            let uv = if seen.uv.is_finite() { seen.uv } else { Vec2::ZERO };
            words(&[uv.x, uv.y, seen.spread.x, seen.spread.y])
        },
        vec![
            Output::new("coordinates", 0..2, Bound::Equal, Bound::Relative(1e-3)),
            Output::new("spread", 2..4, Bound::Equal, Bound::Absolute(1e-5)),
        ],
    )
}
