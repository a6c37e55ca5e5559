//! Materials beside `Material::bsdf`.

use asperity_shaders::Part;
use asperity_shaders::noise::sums::{OctavesUniform, SUMS};
use asperity_shaders::shading::material::{SCRATCHES, ScratchesUniform, VARIATIONS, VariationsUniform};
use asperity_shading::glam::Vec2;
use asperity_shading::{
    Material, PixelEllipse, Scratches, ScratchesParameters, SurfacePoint, Variations, VariationsParameters,
};

use super::{direction, floats, inputs, near, normal, number, vec3, words};
use crate::case::{Bound, Case};

pub(super) fn cases() -> Vec<Case> {
    vec![scratches(), variations()]
}

/// A material in a uniform beside the crate's, at points of texture coordinates and positions within `extent`, seen by pixels from
/// `widths[0]` to `widths[1]` wide.
fn material(
    name: &str,
    part: &'static Part,
    resources: Vec<(&'static str, Vec<u32>)>,
    [extent, narrowest, widest]: [f32; 3],
    bounds: [Bound; 2],
    of: impl Material + Sync + 'static,
) -> Case {
    let [written, adapter] = bounds;
    Case {
        name: format!("shading/material/{name}"),
        parts: vec![part],
        body: "\
    let across = 1.0 - b.w * b.w;
    let normal = vec3<f32>(b.w, 0.0, sqrt(max(across, 0.0)));
    let pixel = pixel_ellipse_from_derivatives(vec3<f32>(a.w, 0.0, 0.0), vec3<f32>(0.0, a.w * bitcast<f32>(d.z), 0.0));
    let point = SurfacePoint(a.xyz, normal, bitcast<vec2<f32>>(d.xy), vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 1.0, 0.25), pixel);
    outcome.a = bits(vec4<f32>(MATERIAL(point, b.xyz, bitcast<vec3<f32>>(c.xyz)), 0.0));"
            .replace("MATERIAL", name.rsplit('/').next().unwrap_or(name)),
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
            if i % 4 == 1 {
                // A flat surface.
                all[7] = 0.0;
            }
            let mut words = normal(inputs(i, &all));
            words[7] = all[7].to_bits();
            words
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
            let light = of.bsdf(&point, wo).scattered(wi, wo);
            words(&light.to_array())
        }),
        outputs: vec![near("light", 0..3, written, adapter)],
    }
}

fn scratches() -> Case {
    let scratches = Scratches::new(ScratchesParameters::default()).expect("defaults");
    let uniform = ScratchesUniform::new(&scratches).words().to_vec();
    material(
        "wear/scratches",
        &SCRATCHES,
        vec![("scratches_uniform", uniform)],
        [0.5, 1e-5, 0.3],
        [Bound::Absolute(1e-4), Bound::Absolute(1e-3)],
        scratches,
    )
}

/// The words of the uniform of sums.
fn sums(sums: &[OctavesUniform<3>]) -> (&'static str, Vec<u32>) {
    let mut words: Vec<u32> = sums.iter().flat_map(|sum| sum.words()).collect();
    words.resize(SUMS * OctavesUniform::<3>::WORDS, 0);
    ("octaves_uniform_3d", words)
}

fn variations() -> Case {
    let variations = Variations::new(VariationsParameters::default()).expect("defaults");
    let uniform = VariationsUniform::new(&variations, 0);
    material(
        "wear/variations",
        &VARIATIONS,
        vec![("variations_uniform", uniform.words().to_vec()), sums(&uniform.sums())],
        [0.5, 1e-5, 1.0],
        [Bound::Absolute(1e-4), Bound::Absolute(1e-3)],
        variations,
    )
}
