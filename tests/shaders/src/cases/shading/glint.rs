//! Counted flakes.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::gpu::GlintFieldUniform;
use asperity_shading::material::{GlintField, PaintFlakes};
use asperity_shading::{Beckmann, Footprint, MetallicPaint, MetallicPaintParameters, Ndf, PixelEllipse};
use asperity_wgsl::shading::material::{COUNTED_FLAKES, GLINT_FIELD};

use super::material::{material, paint_parameters, sums};
use super::{floats, inputs, number, vec2, vec3, words};
use crate::case::{Bound, Case, INPUTS, Output, packed};

pub(super) fn cases() -> Vec<Case> {
    vec![glint_field(0.3), glint_field(0.002), elongated_pixels(), samples(), counted_flakes()]
}

fn glint_field(bin: f32) -> Case {
    const SPACING: f32 = 1e-3;
    // The density cancels.
    let ndf = Beckmann::new(1.0, 1.0).expect("a roughness");
    let field = GlintField::new(ndf, SPACING, bin, 7).expect("a field");
    let GlintFieldUniform { key, tilt_keys: [x, y], .. } = field.gpu();
    Case {
        name: format!("shading/material/paint/glint_field, bins of {bin}"),
        parts: vec![&GLINT_FIELD],
        body: format!(
            "\
    let field = GlintField(0.001, {bin}, vec2<u32>({x}u, {y}u), {key}u);
    let place = a.xyz / field.spacing;
    var flake = GlintFieldFlake(vec3<i32>(0), vec3<f32>(0.0));
    var tilt = vec2<f32>(0.0);
    if glint_field_is_near(place) {{
        flake = glint_field_nearest(field, place);
        tilt = glint_field_tilt(field, flake.cell);
    }}
    outcome.a = bits(vec4<f32>(flake.center * field.spacing, glint_field_relative(field, b.xy, a.xyz, a.w)));
    outcome.b = bits(vec4<f32>(tilt, 0.0, 0.0));"
        ),
        resources: vec![],
        input: Box::new(|i| {
            let p = [0, 1, 2].map(|k| number(i, k, [-1.0, 1.0]));
            let width = SPACING * number(i, 3, [-0.5, 8.0]).exp();
            let z = [4, 5].map(|k| number(i, k, [-5.5, 5.5]));
            let mut words = inputs(i, &[p[0], p[1], p[2], width, z[0], z[1]]);
            words[3] = Footprint::from_width(f32::from_bits(words[3])).width().min(f32::MAX).to_bits();
            words[4..6].copy_from_slice(&z.map(f32::to_bits));
            words
        }),
        reference: Box::new(move |inputs| {
            let ([width], z) = (floats(inputs, 3), vec2(inputs, 4));
            let (p, h) = (vec3(inputs, 0), ndf.warp_gaussian(z));
            let relative = field.density(h, p, Footprint::from_width(width)) / ndf.d(h);
            let mut all = [0.0; 6];
            if let Some(flake) = field.flake(p) {
                let tilt = ndf.invert(flake.normal);
                all = [flake.center.x, flake.center.y, flake.center.z, 0.0, tilt.x, tilt.y];
            }
            all[3] = relative;
            words(&all)
        }),
        outputs: vec![
            Output::new("center", 0..3, Bound::Equal, Bound::Absolute(1e-2)),
            // Quantiles are in 64 bits in the crate. A tilt at the border of a bin may round into
            // another bin.
            // Ramps between narrow bins are 10⁻³ wide, 2000 roundings of a coordinate.
            Output::new(
                "relative count",
                3..4,
                Bound::Rounding(if bin < 0.1 { 1e-2 } else { 4e-4 }),
                Bound::Rounding(if bin < 0.1 { 0.1 } else { 1e-2 }),
            ),
            Output::new("tilt", 4..6, Bound::Absolute(2e-6), Bound::Absolute(1e-3)),
        ],
    }
}

/// The angular radius of the half vectors of a light.
fn spread(i: u32) -> f32 {
    [0.0, 0.05, 0.2][i as usize % 3]
}

fn elongated_pixels() -> Case {
    const SPACING: f32 = 1e-3;
    let ndf = Beckmann::new(1.0, 1.0).expect("a roughness");
    let field = GlintField::new(ndf, SPACING, 0.3, 7).expect("a field");
    let GlintFieldUniform { key, tilt_keys: [x, y], .. } = field.gpu();
    Case {
        name: "shading/material/paint/glint_field, elongated pixels".into(),
        parts: vec![&GLINT_FIELD],
        body: format!(
            "\
    let field = GlintField(0.001, 0.3, vec2<u32>({x}u, {y}u), {key}u);
    let pixel = pixel_ellipse_aligned(vec2<f32>(a.w, b.z));
    outcome.a = bits(vec4<f32>(glint_field_relative_over(field, b.xy, b.w, a.xyz, pixel), 0.0, 0.0, 0.0));"
        ),
        resources: vec![],
        input: Box::new(move |i| {
            let p = [0, 1, 2].map(|k| number(i, k, [-1.0, 1.0]));
            let width = SPACING * number(i, 3, [-0.5, 5.0]).exp();
            // The interpreter takes long for long pixels.
            let long = width * number(i, 6, [0.0, if i % 32 == 0 { 3.0 } else { 0.8 }]).exp();
            let z = [4, 5].map(|k| number(i, k, [-2.5, 2.5]));
            let light = field.light_width(ndf.warp_gaussian(Vec2::from(z)), spread(i));
            let numbers = [p[0], p[1], p[2], width, z[0], z[1], long, light];
            let mut words = [0; INPUTS];
            words.iter_mut().zip(numbers).for_each(|(word, number)| *word = number.to_bits());
            words
        }),
        reference: Box::new(move |inputs| {
            let ([width], z) = (floats(inputs, 3), vec2(inputs, 4));
            let h = ndf.warp_gaussian(z);
            // Along an axis, so that both place their taps in the same cells.
            let pixel = PixelEllipse::aligned(Vec2::new(width, f32::from_bits(inputs[6])));
            // The spread that has this width; the point lights are every other one.
            let of = |spread: f32| field.light_width(h, spread) == f32::from_bits(inputs[7]);
            let spread = [0.0, 0.05, 0.2].into_iter().find(|&spread| of(spread)).expect("a spread");
            // No cells can be told apart far away, where the density is the mean of the light.
            let [density, mean] =
                [vec3(inputs, 0), Vec3::splat(1e30)].map(|p| field.density_over(h, spread, p, &pixel));
            words(&[density / mean])
        }),
        outputs: vec![
            // Counts up to 100 in 32 bits.
            Output::new("relative count", 0..1, Bound::Rounding(1e-3), Bound::Rounding(5e-2)),
        ],
    }
}

fn samples() -> Case {
    const SPACING: f32 = 1e-3;
    let ndf = Beckmann::new(1.0, 1.0).expect("a roughness");
    let field = GlintField::new(ndf, SPACING, 1.0, 7).expect("a field");
    let GlintFieldUniform { key, tilt_keys: [x, y], .. } = field.gpu();
    Case {
        name: "shading/material/paint/glint_field, samples".into(),
        parts: vec![&GLINT_FIELD],
        body: format!(
            "\
    let field = GlintField(0.001, 1.0, vec2<u32>({x}u, {y}u), {key}u);
    let pixel = pixel_ellipse_aligned(vec2<f32>(a.w, b.z));
    outcome.a = bits(vec4<f32>(glint_field_sample(field, b.xy, a.xyz, pixel), 0.0, 0.0));"
        ),
        resources: vec![],
        input: Box::new(|i| {
            let p = [0, 1, 2].map(|k| number(i, k, [-1.0, 1.0]));
            let width = SPACING * number(i, 3, [-0.5, 12.0]).exp();
            let long = width * number(i, 6, [0.0, 3.0]).exp();
            let u = [4, 5].map(|k| number(i, k, [0.01, 0.99]));
            let mut words = [0; INPUTS];
            let numbers = [p[0], p[1], p[2], width, u[0], u[1], long];
            words.iter_mut().zip(numbers).for_each(|(word, number)| *word = number.to_bits());
            words
        }),
        reference: Box::new(move |inputs| {
            let [width, u, v, long] = [3, 4, 5, 6].map(|k| f32::from_bits(inputs[k]));
            let pixel = PixelEllipse::aligned(Vec2::new(width, long));
            let m = field.sample(Vec2::new(u, v), vec3(inputs, 0), &pixel);
            words(&ndf.invert(m).to_array())
        }),
        outputs: vec![
            // Each split takes digits of a uniform number. The last ones place the sample in its bin,
            // which is 1 wide. Its borders
            // are displaced by up to 0.25.
            Output::new("coordinates", 0..2, Bound::Absolute(0.05), Bound::Absolute(1.0)),
        ],
    }
}

fn counted_flakes() -> Case {
    let flakes = PaintFlakes::Counted { spacing: 2e-4, bin: 0.2 };
    let parameters = MetallicPaintParameters { flakes, coat_roughness: 0.1, ..paint_parameters() };
    let paint = MetallicPaint::new(parameters).expect("valid parameters");
    let counted = packed(&paint.gpu_counted(0).expect("counted"));
    material(
        "paint/counted_flakes",
        &COUNTED_FLAKES,
        vec![("counted_flakes_uniform", counted), sums(&paint.gpu_sums())],
        [0.1, 1e-5, 0.02],
        // The counts are divided by masses of bins, with 32 bits in the shader.
        [Bound::Rounding(1e-5), Bound::Absolute(1e-2)],
        paint,
    )
}
