//! Pixels on a surface.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::pixel::SpecularAntialiasing;
use asperity_shading::{Footprint, PixelEllipse};
use asperity_wgsl::shading::SPECULAR_ANTIALIASING;
use asperity_wgsl::shading::material::SURFACE_POINT;

use super::{equal, floats, inputs, number, share, vec2, vec3, vector, words};
use crate::case::{Bound, Case, Output};

pub(super) fn cases() -> Vec<Case> {
    vec![footprint(), ellipse(), taps(), specular_antialiasing()]
}

/// Returns the width in a shader, where infinity is the largest number.
fn width(footprint: Footprint) -> f32 {
    footprint.width().min(f32::MAX)
}

fn footprint() -> Case {
    Case {
        name: "shading/pixel/footprint".into(),
        parts: vec![&SURFACE_POINT],
        body: "\
    let u = bitcast<f32>(c.x);
    outcome.a = bits(vec4<f32>(
        footprint_from_width(a.w), footprint_from_distance(a.w, 0.001, b.w), footprint_from_derivatives(a.xyz, b.xyz), footprint_kept(abs(a.w), u),
    ));"
        .into(),
        resources: vec![],
        input: Box::new(|i| {
            let (dx, dy) = derivatives(i);
            let (distance, cosine) = (number(i, 6, [-2.0, 2.0]), number(i, 7, [-1.0, 1.0]));
            inputs(i, &[dx.x, dx.y, dx.z, distance, dy.x, dy.y, dy.z, cosine, number(i, 8, [0.0, 1.0])])
        }),
        reference: Box::new(|inputs| {
            let (dx, dy) = (vec3(inputs, 0), vec3(inputs, 4));
            let [distance, cosine] = [floats::<1>(inputs, 3)[0], floats::<1>(inputs, 7)[0]];
            let [frequency] = floats(inputs, 8);
            words(&[
                width(Footprint::from_width(distance)),
                width(Footprint::from_distance(distance, 0.001, cosine)),
                width(Footprint::from_derivatives(dx, dy)),
                1.0 - asperity_noise::filtered_fraction(distance.abs(), frequency),
            ])
        }),
        outputs: vec![
            equal("width", 0..1, Bound::Absolute(1e-37)),
            equal("by distance", 1..2, Bound::Relative(1e-6)),
            equal("by derivatives", 2..3, Bound::Relative(2e-6)),
            equal("kept", 3..4, Bound::Absolute(1e-5)),
        ],
    }
}

/// Returns derivatives of a position per pixel, to the right and down, of the i-th input.
fn derivatives(i: u32) -> (Vec3, Vec3) {
    let scale = number(i, 9, [-9.0, 3.0]).exp();
    let (dx, dy) = (vector(i, 0, scale), vector(i, 3, scale));
    match i % 16 {
        // A circle.
        0 => (Vec3::X * scale, Vec3::Y * scale),
        1 => (dx, Vec3::ZERO),
        2 => (Vec3::ZERO, Vec3::ZERO),
        _ => (dx, dy),
    }
}

fn ellipse() -> Case {
    Case {
        name: "shading/pixel/ellipse".into(),
        parts: vec![&SURFACE_POINT],
        body: "\
    let pixel = pixel_ellipse_from_derivatives(a.xyz, b.xyz);
    outcome.a = bits(vec4<f32>(pixel.widths, pixel_ellipse_sides(pixel)));
    outcome.b = bits(vec4<f32>(abs(pixel.major), 0.0));
    outcome.c = bits(vec4<f32>(abs(pixel.minor), 0.0));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let (dx, dy) = derivatives(i);
            let words = inputs(i, &[dx.x, dx.y, dx.z, 0.0, dy.x, dy.y, dy.z]);
            // A quotient off by its last bit would overflow the largest number.
            words.map(|word| if f32::from_bits(word).abs() == f32::MAX { 1e30_f32.to_bits() } else { word })
        }),
        reference: Box::new(|inputs| {
            let pixel = PixelEllipse::from_derivatives(vec3(inputs, 0), vec3(inputs, 4));
            let [major, minor] = pixel.axes();
            let sides = pixel.sides().min(Vec2::MAX);
            words(
                &[
                    [width(pixel.long()), width(pixel.short()), sides.x, sides.y],
                    major.abs().extend(0.0).to_array(),
                    minor.abs().extend(0.0).to_array(),
                ]
                .concat(),
            )
        }),
        outputs: vec![
            equal("widths", 0..2, Bound::Relative(1e-3)),
            equal("sides", 2..4, Bound::Relative(1e-3)),
            equal("long axis", 4..7, Bound::Relative(0.1)),
            equal("short axis", 8..11, Bound::Relative(0.1)),
        ],
    }
}

fn taps() -> Case {
    Case {
        name: "shading/pixel/ellipse, taps".into(),
        parts: vec![&SURFACE_POINT],
        body: "\
    let pixel = pixel_ellipse_aligned(a.xy);
    let round = pixel_ellipse_round(a.x);
    let count = pixel_ellipse_tap_count(pixel, c.x);
    let tap = pixel_ellipse_tap(pixel, count, c.y % count);
    outcome.a = bits(vec4<f32>(tap.xyz * select(0.0, 1.0, pixel.widths.x < 1e3), tap.w));
    outcome.b = vec4<u32>(count, pixel_ellipse_tap_count(round, c.x), 0u, 0u);
    outcome.c = bits(vec4<f32>(pixel_ellipse_change(pixel, b.xyz), pixel_ellipse_change(round, b.xyz), 0.0, 0.0));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let widths = [0, 1].map(|k| number(i, k, [-6.0, 1.0]).exp());
            let gradient = vector(i, 2, 3.0);
            let mut words =
                inputs(i, &[widths[0], widths[1], 0.0, 0.0, gradient.x, gradient.y, gradient.z]);
            if i >= 24 && i % 8 == 0 {
                words[1] = 0;
            }
            (words[8], words[9]) = (i % 70, i);
            words
        }),
        reference: Box::new(|inputs| {
            let ([u, v], gradient) = (floats(inputs, 0), vec3(inputs, 4));
            // The maximum width in shaders.
            let pixel = PixelEllipse::aligned(Vec2::new(u, v).map(|w| width(Footprint::from_width(w))));
            let round = PixelEllipse::from(Footprint::from_width(width(Footprint::from_width(u))));
            let taps: Vec<_> = pixel.taps(inputs[8]).collect();
            let tap = taps[inputs[9] as usize % taps.len()];
            let offset = if width(pixel.long()) < 1e3 { tap.offset } else { Vec3::ZERO };
            let change = |pixel: PixelEllipse| pixel.change(gradient).min(f32::MAX);
            let mut outputs = words(&[offset.x, offset.y, offset.z, width(tap.footprint)]);
            (outputs[4], outputs[5]) = (taps.len() as u32, round.taps(inputs[8]).count() as u32);
            (outputs[8], outputs[9]) = (change(pixel).to_bits(), change(round).to_bits());
            outputs
        }),
        outputs: vec![
            equal("tap", 0..3, Bound::Absolute(1e-5)),
            equal("width of taps", 3..4, Bound::Relative(1e-6)),
            equal("number of taps", 4..6, Bound::Equal),
            equal("change", 8..10, Bound::Relative(2e-6)),
        ],
    }
}

/// Specular anti-aliasing.
fn specular_antialiasing() -> Case {
    Case {
        name: "shading/pixel/specular_antialiasing".into(),
        parts: vec![&SPECULAR_ANTIALIASING],
        body: "\
    outcome.a = bits(vec4<f32>(specular_antialiasing_slope_covariance(a.xy, a.zw), specular_antialiasing_roughness(b.x, a.xy, a.zw)));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let d = [0, 1, 2, 3].map(|k| number(i, k, [-1.5, 1.5]));
            inputs(i, &[d[0], d[1], d[2], d[3], share(i, 4)])
        }),
        reference: Box::new(|inputs| {
            let d = [vec2(inputs, 0), vec2(inputs, 2)];
            let filter = SpecularAntialiasing::default();
            let [xx, xy, yy] = filter.slope_covariance(d);
            words(&[xx, xy, yy, filter.roughness(floats::<1>(inputs, 4)[0], d)])
        }),
        outputs: vec![
            Output::new("covariance", 0..3, Bound::Absolute(1e-6), Bound::Absolute(1e-5)),
            Output::new("roughness", 3..4, Bound::Absolute(1e-6), Bound::Absolute(1e-5)),
        ],
    }
}
