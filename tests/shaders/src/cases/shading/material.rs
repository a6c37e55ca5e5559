//! Materials compared with `Material::bsdf`.

use asperity_noise::gpu::FbmUniform3d;
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::material::{GlassBody, GlassWaves, SeamPattern};
use asperity_shading::{
    Carpet, CarpetParameters, Frame, Material, MetallicPaint, MetallicPaintParameters, PixelEllipse,
    Scratches, ScratchesParameters, SurfacePoint, TemperedGlass, TemperedGlassParameters, Variations,
    VariationsParameters,
};
use asperity_wgsl::Part;
use asperity_wgsl::shading::material::{CARPET, METALLIC_PAINT, SCRATCHES, TEMPERED_GLASS, VARIATIONS};

use super::coat::specular;
use super::{direction, floats, inputs, number, vec3, words};
use crate::case::{Bound, Case, INPUTS, Output, packed};

pub(super) fn cases() -> Vec<Case> {
    vec![
        carpet("lines", SeamPattern::Lines),
        carpet("grid", SeamPattern::Grid),
        rim(),
        scratches(),
        variations(),
        paint("sparkling", paint_parameters()),
        paint("rough coat", rough_paint()),
        glass("pane", pane()),
        glass("body", body()),
        delta("pane", smooth(pane())),
        delta("body", smooth(body())),
    ]
}

/// Returns words whose directions, in 4 to 6 and 8 to 10, are NaN or infinite, but not merely
/// unnormalized.
pub(super) fn units(mut words: [u32; INPUTS]) -> [u32; INPUTS] {
    for word in [4, 5, 6, 8, 9, 10] {
        let x = f32::from_bits(words[word]);
        if x.is_finite() && x.abs() > 1.0 {
            words[word] = (0.5 * x.signum()).to_bits();
        }
    }
    words
}

/// A material in a uniform, compared with the crate at points of texture coordinates and positions
/// within `extent`, for pixels from `widths[0]` to `widths[1]` wide.
pub(super) fn material(
    name: &str,
    part: &'static Part,
    resources: Vec<(&'static str, Vec<u32>)>,
    [extent, narrowest, widest]: [f32; 3],
    bounds: [Bound; 2],
    of: impl Material + Send + Sync + 'static,
) -> Case {
    let [written, adapter] = bounds;
    let name_of_glass = name.contains("glass");
    Case {
        name: format!("shading/material/{name}"),
        parts: vec![part],
        body: "\
    let across = 1.0 - b.w * b.w;
    let normal = vec3<f32>(b.w, 0.0, sqrt(max(across, 0.0)));
    let pixel = pixel_ellipse_from_derivatives(vec3<f32>(a.w, 0.0, 0.0), vec3<f32>(0.0, a.w * bitcast<f32>(d.z), 0.0));
    let point = SurfacePoint(a.xyz, normal, bitcast<vec2<f32>>(d.xy), vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 1.0, 0.25), pixel);
    let frame = surface_point_frame(point);
    let wo = frame_to_local(frame, b.xyz);
    let wi = frame_to_local(frame, bitcast<vec3<f32>>(c.xyz));
    outcome.a = bits(vec4<f32>(MATERIAL(point, wo, wi), 0.0));"
            .replace("MATERIAL", name.rsplit('/').next().unwrap_or(name).split(',').next().unwrap_or(name)),
        resources,
        input: Box::new(move |i| {
            let (wi, wo) = (direction(i, 0), direction(i, 2));
            let p = [4, 5, 6, 7, 8].map(|k| number(i, k, [-extent, extent]));
            let width = match i % 8 {
                0 => 0.0,
                _ => number(i, 9, [narrowest.ln(), widest.ln()]).exp(),
            };
            let (lean, ratio) = (number(i, 10, [-0.7, 0.7]), number(i, 11, [0.2, 1.0]));
            let mut all =
                [p[0], p[1], p[2], width, wo.x, wo.y, wo.z, lean, wi.x, wi.y, wi.z, 0.0, p[3], p[4], ratio];
            if name_of_glass && i % 2 == 1 {
                // Light from behind.
                all[10] = -all[10];
            }
            if name_of_glass && i % 8 == 2 {
                all[6] = -all[6];
            }
            if i % 4 == 1 {
                // A flat surface.
                all[7] = 0.0;
            }
            // Directions in space.
            let normal = Vec3::new(all[7], 0.0, (1.0 - all[7] * all[7]).sqrt());
            let frame = Frame::from_normal_tangent(normal, Vec3::X);
            for k in [4, 8] {
                let world = frame.to_world(Vec3::from_slice(&all[k..]));
                all[k..k + 3].copy_from_slice(&world.to_array());
            }
            let mut words = inputs(i, &all);
            if name_of_glass {
                // Distant waves have no phase.
                for word in &mut words[..3] {
                    let x = f32::from_bits(*word);
                    *word = if x.is_finite() { x.clamp(-2.0, 2.0) } else { x }.to_bits();
                }
            }
            words[7] = all[7].to_bits();
            units(words)
        }),
        reference: Box::new(move |inputs| {
            let [lean] = floats(inputs, 7);
            let [width] = floats(inputs, 3);
            let [u, v, ratio] = floats(inputs, 12);
            let up = (1.0 - lean * lean).max(0.0).sqrt();
            let pixel = PixelEllipse::from_derivatives(
                [width, 0.0, 0.0].into(),
                [0.0, width * ratio, 0.0].into(),
            );
            let tangents = [[1.0, 0.0, 0.0].into(), [0.0, 1.0, 0.25].into()];
            let point = SurfacePoint {
                position: vec3(inputs, 0),
                normal: [lean, 0.0, up].into(),
                uv: Vec2::new(u, v),
                tangents,
                pixel,
            };
            let (wo, wi) = (vec3(inputs, 4), vec3(inputs, 8));
            let light = of.bsdf(&point, wo).eval_cos(wo, wi);
            words(&light.to_array())
        }),
        outputs: vec![Output::new("light", 0..3, written, adapter)],
    }
}

fn scratches() -> Case {
    let scratches = Scratches::new(ScratchesParameters::default()).expect("defaults");
    let uniform = packed(&scratches.gpu());
    material(
        "wear/scratches",
        &SCRATCHES,
        vec![("scratches_uniform", uniform)],
        [0.5, 1e-5, 0.3],
        [Bound::Absolute(4e-6), Bound::Absolute(4e-3)],
        scratches,
    )
}

/// Returns the words of the uniform of sums.
pub(super) fn sums(sums: &[FbmUniform3d]) -> (&'static str, Vec<u32>) {
    ("fbm_uniform_3d", packed(&FbmUniform3d::array(sums)))
}

fn variations() -> Case {
    let variations = Variations::new(VariationsParameters::default()).expect("defaults");
    material(
        "wear/variations",
        &VARIATIONS,
        vec![("variations_uniform", packed(&variations.gpu(0))), sums(&variations.gpu_sums())],
        [0.5, 1e-5, 1.0],
        [Bound::Absolute(1e-6), Bound::Absolute(1e-3)],
        variations,
    )
}

pub(super) fn paint_parameters() -> MetallicPaintParameters {
    MetallicPaintParameters::default()
}

/// Paint with a rough coat and more orange peel.
fn rough_paint() -> MetallicPaintParameters {
    MetallicPaintParameters { coat_roughness: 0.1, orange_peel_strength: 0.05, ..Default::default() }
}

fn paint(name: &str, parameters: MetallicPaintParameters) -> Case {
    let paint = MetallicPaint::new(parameters).expect("valid parameters");
    material(
        &format!("paint/metallic_paint, {name}"),
        &METALLIC_PAINT,
        vec![("metallic_paint_uniform", packed(&paint.gpu(0))), sums(&paint.gpu_sums())],
        [0.1, 1e-6, 0.02],
        [Bound::Relative(4e-6), Bound::Relative(1e-2)],
        paint,
    )
}

/// A frosted pane with sine waves.
fn pane() -> TemperedGlassParameters {
    let tint = [0.5, 0.8, 0.9].into();
    TemperedGlassParameters { roughness: 0.2, wave_amplitude: 0.01, tint, ..Default::default() }
}

/// A frosted body with noise waves.
fn body() -> TemperedGlassParameters {
    let (waves, body) = (GlassWaves::Noise, GlassBody::Solid);
    TemperedGlassParameters { roughness: 0.15, wave_amplitude: 0.005, waves, body, ..Default::default() }
}

fn glass(name: &str, parameters: TemperedGlassParameters) -> Case {
    let glass = TemperedGlass::new(parameters).expect("valid parameters");
    material(
        &format!("tempered_glass, {name}"),
        &TEMPERED_GLASS,
        vec![("tempered_glass_uniform", packed(&glass.gpu(0))), sums(&[glass.gpu_sum()])],
        [1.0, 1e-3, 1.0],
        [Bound::Rounding(5e-6), Bound::Absolute(1e-3)],
        glass,
    )
}

/// Glass without roughness.
fn smooth(parameters: TemperedGlassParameters) -> TemperedGlassParameters {
    TemperedGlassParameters { roughness: 0.0, ..parameters }
}

/// Light in single directions from smooth glass and from the clear coat of paint.
fn delta(name: &str, parameters: TemperedGlassParameters) -> Case {
    let glass = TemperedGlass::new(parameters).expect("valid parameters");
    let paint = MetallicPaint::new(paint_parameters()).expect("valid parameters");
    let [peel, passive] = paint.gpu_sums();
    Case {
        name: format!("shading/material/tempered_glass and metallic_paint, deltas, {name}"),
        parts: vec![&TEMPERED_GLASS, &METALLIC_PAINT],
        body: "\
    let pixel = pixel_ellipse_from_derivatives(vec3<f32>(a.w, 0.0, 0.0), vec3<f32>(0.0, a.w, 0.0));
    let x = vec3<f32>(1.0, 0.0, 0.0);
    let y = vec3<f32>(0.0, 1.0, 0.0);
    let point = SurfacePoint(a.xyz, vec3<f32>(0.0, 0.0, 1.0), vec2<f32>(0.0), x, y, pixel);
    let u = bitcast<vec2<f32>>(c.xy);
    let deltas = tempered_glass_specular_samples(tempered_glass_uniform, point, b.xyz, u);
    let coat = metallic_paint_mirrored(metallic_paint_uniform, point, b.xyz, u);
    let mirrored = vec4<f32>(deltas.mirrored.wi, deltas.mirrored.weight.x);
    let transmitted = vec4<f32>(deltas.transmitted.wi, deltas.transmitted.weight.y);
    outcome.a = bits(select(vec4<f32>(0.0), mirrored, mirrored.w > 0.0));
    outcome.b = bits(select(vec4<f32>(0.0), transmitted, transmitted.w > 0.0));
    outcome.c = bits(select(vec4<f32>(0.0), vec4<f32>(coat.wi, coat.weight.x), coat.weight.x > 0.0));"
            .into(),
        resources: vec![
            ("tempered_glass_uniform", packed(&glass.gpu(0))),
            ("metallic_paint_uniform", packed(&paint.gpu(1))),
            sums(&[glass.gpu_sum(), peel, passive]),
        ],
        input: Box::new(|i| {
            let wo = direction(i, 0);
            let wo = if i % 4 == 2 { -wo } else { wo };
            let p = [4, 5, 6].map(|k| number(i, k, [-1.0, 1.0]));
            let width = if i % 8 == 0 { 0.0 } else { number(i, 9, [-8.0, 0.0]).exp() };
            let u = [7, 8].map(|k| number(i, k, [0.0, 1.0]));
            // Invalid numbers occur alone: directions are checked, but distant waves are not.
            let mut words = inputs(i, &[p[0], p[1], p[2], width, wo.x, wo.y, wo.z, 0.0, u[0], u[1]]);
            words[..3].copy_from_slice(&p.map(f32::to_bits));
            units(words)
        }),
        reference: Box::new(move |inputs| {
            let ([width], [u, v]) = (floats(inputs, 3), floats(inputs, 8));
            let pixel = PixelEllipse::from_derivatives([width, 0.0, 0.0].into(), [0.0, width, 0.0].into());
            let point = SurfacePoint {
                position: vec3(inputs, 0),
                normal: [0.0, 0.0, 1.0].into(),
                uv: Vec2::ZERO,
                tangents: [[1.0, 0.0, 0.0].into(), [0.0, 1.0, 0.0].into()],
                pixel,
            };
            let (wo, u) = (vec3(inputs, 4), Vec2::new(u, v));
            let [mirrored, transmitted] = glass.bsdf(&point, wo).specular_samples(wo, u);
            let [coat, _] = paint.bsdf(&point, wo).specular_samples(wo, u);
            words(&[specular(mirrored, 0), specular(transmitted, 1), specular(coat, 0)].concat())
        }),
        outputs: vec![
            Output::new("mirrored by glass", 0..4, Bound::Absolute(1.4e-4), Bound::Absolute(2e-3)),
            Output::new("transmitted", 4..8, Bound::Absolute(1.4e-4), Bound::Absolute(2e-3)),
            Output::new("mirrored by paint", 8..12, Bound::Absolute(1.4e-4), Bound::Absolute(2e-3)),
        ],
    }
}

fn carpet(name: &str, seams_pattern: SeamPattern) -> Case {
    let carpet = Carpet::new(CarpetParameters { seams_pattern, ..Default::default() }).expect("defaults");
    material(
        &format!("carpet/carpet, {name}"),
        &CARPET,
        vec![("carpet_uniform", packed(&carpet.gpu(0))), sums(&carpet.gpu_sums())],
        [0.5, 1e-6, 1.0],
        // Light is a difference of coverages up to 1, each with the rounding of one transcendental
        // Light is a difference of coverages up to 1. Each has the rounding of a transcendental
        // function and of three products, 4 · 2⁻²⁴. At the border of a fiber, rounding may select
        // the fiber below.
        [Bound::Absolute(4.8e-7), Bound::Absolute(1e-1)],
        carpet,
    )
}

/// The rim light of a carpet.
fn rim() -> Case {
    let carpet = Carpet::new(CarpetParameters::default()).expect("defaults");
    Case {
        name: "shading/material/carpet/carpet, rim".into(),
        parts: vec![&CARPET],
        body: "\
    let x = vec3<f32>(1.0, 0.0, 0.0);
    let y = vec3<f32>(0.0, 1.0, 0.0);
    let point = SurfacePoint(x, vec3<f32>(0.0, 0.0, 1.0), vec2<f32>(0.0), x, y, pixel_ellipse_round(0.1));
    outcome.a = bits(vec4<f32>(carpet_emitted(carpet_uniform, point, a.xyz), 0.0));"
            .into(),
        resources: vec![("carpet_uniform", packed(&carpet.gpu(0))), sums(&carpet.gpu_sums())],
        input: Box::new(|i| {
            let wo = direction(i, 0);
            inputs(i, &wo.to_array())
        }),
        reference: Box::new(move |inputs| {
            let pixel = PixelEllipse::from(asperity_shading::Footprint::from_width(0.1));
            let point = SurfacePoint::new([1.0, 0.0, 0.0].into(), [0.0, 0.0, 1.0].into(), pixel);
            words(&carpet.bsdf(&point, vec3(inputs, 0)).emitted().to_array())
        }),
        outputs: vec![Output::new("light", 0..3, Bound::Equal, Bound::Absolute(1e-6))],
    }
}
