//! Directions, surface gradients and facets.

use asperity_shading::bump::{
    Facet, bumped_normal, flip_to_visible, gradient_of_normal, project_to_tangent_plane, slope_facets,
    surface_gradient,
};
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::{Frame, half_vector, reflect};
use asperity_wgsl::shading::{material::SURFACE_POINT, reflectance::COAT};

use super::{direction, equal, floats, inputs, number, vec3, vector, words};
use crate::case::{Bound, Case};

pub(super) fn cases() -> Vec<Case> {
    vec![directions(), gradients(), normals(), facets()]
}

fn directions() -> Case {
    Case {
        name: "shading/direction".into(),
        parts: vec![&SURFACE_POINT],
        body: "\
    let wi = a.xyz;
    let wo = b.xyz;
    let left = direction_unit_or_2d(direction_left_2d(wo.xy), vec2<f32>(0.0, 1.0));
    let finite = direction_is_finite(wi) && direction_is_finite(wo);
    let moderate = finite && dot(wi, wi) < 16.0 && dot(wo, wo) < 16.0;
    outcome.a = bits(vec4<f32>(direction_half(wi, wo), left.x));
    outcome.b = bits(vec4<f32>(select(vec3<f32>(0.0), direction_reflect(wi, wo), moderate), left.y));
    outcome.c = bits(vec4<f32>(direction_unit_or_zero(wi), 0.0));
    outcome.d = vec4<u32>(u32(direction_are_above(wi, wo)), u32(direction_have_sides(wi, wo)), 0u, 0u);"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let (wi, wo) = (direction(i, 0), direction(i, 3));
            let wi = if i % 4 == 0 { vector(i, 6, 2.0) } else { wi };
            let wo = if i % 64 == 5 { -wi } else { wo };
            inputs(i, &[wi.x, wi.y, wi.z, 0.0, wo.x, wo.y, wo.z])
        }),
        reference: Box::new(|inputs| {
            let (wi, wo) = (vec3(inputs, 0), vec3(inputs, 4));
            let moderate = wi.dot(wi) < 16.0 && wo.dot(wo) < 16.0;
            let left = Vec2::new(-wo.y, wo.x).normalize_or(Vec2::Y);
            let mirrored = if moderate { reflect(wi, wo) } else { Vec3::ZERO };
            let half = half_vector(wi, wo).extend(left.x).to_array();
            let mirrored = mirrored.extend(left.y).to_array();
            let unit = wi.normalize_or_zero().extend(0.0).to_array();
            let mut outputs = words(&[half, mirrored, unit].concat());
            let finite = wi.is_finite() && wo.is_finite();
            outputs[12] = u32::from(finite && wi.z > 0.0 && wo.z > 0.0);
            outputs[13] = u32::from(finite && wi.z != 0.0 && wo.z != 0.0);
            outputs
        }),
        outputs: vec![
            equal("half and turned vector", 0..4, Bound::Absolute(2e-6)),
            equal("mirrored and turned vector", 4..8, Bound::Absolute(1e-5)),
            equal("unit vector", 8..11, Bound::Absolute(5e-7)),
            equal("sides", 12..14, Bound::Equal),
        ],
    }
}

fn gradients() -> Case {
    Case {
        name: "shading/bump/surface_gradient".into(),
        parts: vec![&SURFACE_POINT],
        body: "\
    let n = a.xyz;
    let slope = vec2<f32>(a.w, b.x);
    let p_u = b.yzw;
    let p_v = bitcast<vec3<f32>>(c.xyz);
    let m = vec3<f32>(bitcast<f32>(c.w), bitcast<vec2<f32>>(d.xy));
    outcome.a = bits(vec4<f32>(surface_gradient(n, p_u, p_v, slope), 0.0));
    outcome.b = bits(vec4<f32>(surface_gradient_tangential(n, p_u), 0.0));
    outcome.c = bits(vec4<f32>(surface_gradient_of_normal(p_u, p_v, m), 0.0));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let (n, m) = (direction(i, 0), direction(i, 2));
            // Tangents that are not nearly parallel, so that the rounding of their area is bounded.
            let frame = Frame::from_normal(n);
            let [u, v] = [4, 7].map(|k| 0.3 * vector(i, k, 1.0));
            let (p_u, p_v) = (2.0 * frame.tangent + u, frame.bitangent + v);
            let p_v = if i % 64 == 7 { Vec3::ZERO } else { p_v };
            let [s, t] = [10, 11].map(|k| number(i, k, [-2.0, 2.0]));
            inputs(i, &[n.x, n.y, n.z, s, t, p_u.x, p_u.y, p_u.z, p_v.x, p_v.y, p_v.z, m.x, m.y, m.z])
        }),
        reference: Box::new(|inputs| {
            let [nx, ny, nz, s, t] = floats(inputs, 0);
            let (n, slope, p_u, p_v, m) =
                (Vec3::new(nx, ny, nz), Vec2::new(s, t), vec3(inputs, 5), vec3(inputs, 8), vec3(inputs, 11));
            let frame = Frame { tangent: p_u, bitangent: p_v, normal: n };
            let gradient = surface_gradient(n, [p_u, p_v], slope).extend(0.0).to_array();
            let along = project_to_tangent_plane(n, p_u).extend(0.0).to_array();
            words(&[gradient, along, gradient_of_normal(&frame, m).extend(0.0).to_array()].concat())
        }),
        outputs: vec![
            equal("surface gradient", 0..3, Bound::Relative(1e-2)),
            equal("tangential part", 4..7, Bound::Relative(1e-2)),
            equal("gradient of a normal", 8..11, Bound::Relative(1e-2)),
        ],
    }
}

fn normals() -> Case {
    Case {
        name: "shading/bump/surface_gradient, normals".into(),
        parts: vec![&SURFACE_POINT],
        body: "\
    outcome.a = bits(vec4<f32>(surface_gradient_normal(a.xyz, b.xyz), 0.0));
    outcome.b = bits(vec4<f32>(surface_gradient_facing(a.xyz, surface_gradient_normal(a.xyz, b.xyz), bitcast<vec3<f32>>(c.xyz)), 0.0));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let (n, wo) = (direction(i, 0), direction(i, 2));
            // Squares of a short view underflow.
            let wo = if i % 16 == 5 { 1e-21 * wo } else { wo };
            let gradient = vector(i, 4, if i % 8 == 0 { 1e5 } else { 1.5 });
            inputs(i, &[n.x, n.y, n.z, 0.0, gradient.x, gradient.y, gradient.z, 0.0, wo.x, wo.y, wo.z])
        }),
        reference: Box::new(|inputs| {
            let (n, gradient, wo) = (vec3(inputs, 0), vec3(inputs, 4), vec3(inputs, 8));
            let bumped = bumped_normal(n, gradient);
            let seen = flip_to_visible(n, bumped, wo);
            words(&[bumped.extend(0.0).to_array(), seen.extend(0.0).to_array()].concat())
        }),
        outputs: vec![
            equal("bumped normal", 0..3, Bound::Absolute(2e-6)),
            equal("normal that faces the view", 4..7, Bound::Absolute(1e-4)),
        ],
    }
}

fn facets() -> Case {
    Case {
        name: "shading/bump/slope_facets".into(),
        parts: vec![&COAT],
        body: "\
    let facets = slope_facets(a.xyz, b.xyz, vec3<f32>(a.w, 0.0, 0.0), vec3<f32>(0.0, a.w, 0.0));
    let facet = slope_facets_gaussian(facets, c.x);
    outcome.a = bits(vec4<f32>(facet.weight, facet.normal));
    let along = slope_facets_along(facets, 0.5, c.x % 7u);
    outcome.b = bits(vec4<f32>(along.weight, along.normal));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let bumped = direction(i, 0);
            let deviation = if i % 16 == 3 { 0.0 } else { number(i, 2, [1e-3, 0.5]) };
            let mut words = inputs(i, &[0.0, 0.0, 1.0, deviation, bumped.x, bumped.y, bumped.z]);
            for (word, x) in words.iter_mut().zip([0.0, 0.0, 1.0, deviation]) {
                *word = x.to_bits();
            }
            words[8] = i % 13;
            words
        }),
        reference: Box::new(|inputs| {
            let [deviation, x, y, z] = floats(inputs, 3);
            let bumped = Vec3::new(x, y, z);
            let none = Facet { weight: 0.0, normal: bumped };
            // The root of the square is the deviation, up to rounding.
            let facet = slope_facets(Vec3::Z, bumped, deviation * deviation).nth(inputs[8] as usize);
            let facet = facet.unwrap_or(none);
            let along = asperity_shading::bump::facets_along(
                Vec3::Z,
                bumped,
                [Vec3::X * deviation, Vec3::Y * deviation],
                0.5,
            );
            let along = along.into_iter().nth(inputs[8] as usize % 7).unwrap_or(none);
            let words_of = |facet: Facet| facet.normal.to_array().map(f32::to_bits);
            let mut outputs = words(&[facet.weight, 0.0, 0.0, 0.0, along.weight]);
            outputs[1..4].copy_from_slice(&words_of(facet));
            outputs[5..8].copy_from_slice(&words_of(along));
            outputs
        }),
        outputs: vec![
            equal("facet of thirteen", 0..4, Bound::Absolute(2e-6)),
            equal("facet of seven", 4..8, Bound::Absolute(2e-6)),
        ],
    }
}
