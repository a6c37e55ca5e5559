//! GGX and Beckmann with both level-of-detail rules.

use asperity_ndf_sampling::{
    Beckmann, ClosedForm, GaussianSplit, Ggx, Microfacet, Ndf, VisibleFacets, VisibleWarp,
    glam::{Vec2, Vec3},
};
use asperity_shading::level_of_detail::ResolvedBumps;
use asperity_shading::{LevelOfDetail, far_field};
use asperity_wgsl::{
    Part,
    ndf::{BECKMANN, GGX},
    shading::LEVEL_OF_DETAIL,
};

use super::{floats, gaussian, number, words};
use crate::case::{Bound, Case, INPUTS, Output, between};

pub(super) fn cases() -> Vec<Case> {
    // The crate's Beckmann masking is in f64: Λ, σ and D_v to 32 bits. Its exponential amplifies
    // the rounding of the exponent.
    let ggx =
        Density { name: "ggx", part: &GGX, of: Ggx::new_clamped, density: 1e-6, masking: [Bound::Equal; 4] };
    let beckmann = Density {
        name: "beckmann",
        part: &BECKMANN,
        of: Beckmann::new_clamped,
        density: 2e-5,
        masking: [Bound::Relative(2e-5), Bound::Absolute(4e-7), Bound::Relative(1e-6), Bound::Relative(1e-6)],
    };
    vec![
        ggx.normals(),
        ggx.visible_normals(),
        resolved_visible_normals(),
        reflecting_normals(),
        beckmann.normals(),
        beckmann.visible_normals(),
    ]
}

/// A density with its parts. Bounds: of its density on adapters, and as written of Λ, of G₁ and G₂,
/// of σ, of D_v.
#[derive(Clone, Copy)]
struct Density<N> {
    name: &'static str,
    part: &'static Part,
    of: fn(f32, f32) -> N,
    density: f32,
    masking: [Bound; 4],
}

/// Smaller densities are treated as this value: drivers may flush denormals, which are invisible in
/// sums of lights.
const FAINT: f32 = 1e-34;

impl<N: ClosedForm + Microfacet + 'static> Density<N> {
    fn normals(self) -> Case {
        Case {
            name: format!("ndf/density/{}, level of detail", self.name),
            parts: vec![self.part, &LEVEL_OF_DETAIL],
            body: "\
    let alpha = roughness_clamped(a.xy);
    let u = bitcast<vec2<f32>>(c.xy);
    let fade = bitcast<f32>(c.z);
    outcome.a = bits(vec4<f32>(x_warp_gaussian(alpha, a.zw), max(x_d(alpha, b.xyz), 1e-34)));
    let center = x_warp_gaussian(alpha, level_of_detail_exact_coordinates(a.zw, b.w));
    let sample = x_sample(alpha, u);
    let split = gaussian_split(a.zw, b.w);
    outcome.b = bits(vec4<f32>(x_invert(alpha, b.xyz), center.xy));
    outcome.c = bits(vec4<f32>(
        center.z,
        sample.xy,
        select(sample.z, max(x_d(alpha, b.xyz), 1e-34), d.x == 1u),
    ));
    outcome.d = bits(vec4<f32>(
        max(level_of_detail_exact_x(alpha, b.xyz, a.zw, b.w), 1e-34),
        max(level_of_detail_fractal_x(alpha, b.xyz, a.zw, fade), 1e-34),
        select(gaussian_split_join(split, u), gaussian_split_rest(split, u), d.x == 1u),
    ));"
            .replace("x_", &format!("{}_", self.name))
            .replace("_x(", &format!("_{}(", self.name)),
            resources: vec![],
            input: Box::new(move |i| {
                let alpha = [0, 1].map(|k| number(i, k, 10.0_f32.powf(between(i, k, -3.0, 0.0))));
                let z = Vec2::new(gaussian(i, 2), gaussian(i, 3));
                let s = number(i, 7, if i % 8 == 0 { 0.0 } else { between(i, 7, 0.0, 0.999) });
                // Where the density is not negligible, with and without the resolved part.
                let xi = Vec2::new(gaussian(i, 4), gaussian(i, 5));
                let rest = if i % 3 == 0 { xi } else { z * s.sqrt() + xi * (1.0 - s).sqrt() };
                // Some next to the pole.
                let rest = if i % 64 == 0 { rest * between(i, 11, -20.0, 0.0).exp2() } else { rest };
                let h = (self.of)(alpha[0], alpha[1]).warp_gaussian(rest);
                let u = [8, 9].map(|k| between(i, k, 0.0, 1.0));
                let fade = if i % 2 == 0 { 1.0 } else { between(i, 10, 0.0, 1.2) };
                let good = [alpha[0], alpha[1], z.x, z.y, h.x, h.y, h.z, s, u[0], u[1], fade];
                let mut inputs = [0; INPUTS];
                for ((input, good), k) in inputs.iter_mut().zip(good).zip(0..) {
                    *input = number(i, k, good).to_bits();
                }
                // Every other point tests other functions.
                inputs[12] = i % 2;
                inputs
            }),
            reference: Box::new(move |inputs| {
                let [alpha_x, alpha_y, z1, z2, x, y, up, share, u1, u2, fade] = floats(inputs, 0);
                let is_other = inputs[12] == 1;
                let (ndf, z, h) = ((self.of)(alpha_x, alpha_y), Vec2::new(z1, z2), Vec3::new(x, y, up));
                let (coordinates, u) = (ResolvedBumps { z, variance: share, blend: fade }, Vec2::new(u1, u2));
                let (m, sample) = (ndf.warp_gaussian(z), ndf.sample(u));
                let back = ndf.invert(h);
                let center = LevelOfDetail::Exact.normal(&ndf, coordinates);
                let split = GaussianSplit::new(z, share);
                let joined = if is_other { split.rest(u) } else { split.join(u) };
                words(&[
                    m.x,
                    m.y,
                    m.z,
                    ndf.d(h).max(FAINT),
                    back.x,
                    back.y,
                    center.x,
                    center.y,
                    center.z,
                    sample.x,
                    sample.y,
                    if is_other { far_field(&ndf, h).max(FAINT) } else { sample.z },
                    LevelOfDetail::Exact.radiance(&ndf, h, coordinates).max(FAINT),
                    LevelOfDetail::Fractal.radiance(&ndf, h, coordinates).max(FAINT),
                    joined.x,
                    joined.y,
                ])
            }),
            outputs: vec![
                equal("T", 0..3, Bound::Absolute(4e-7)),
                equal("D", 3..4, Bound::Relative(self.density)),
                equal("T⁻¹", 4..6, Bound::Absolute(4e-6)),
                equal("normal of the exact rule", 6..9, Bound::Absolute(4e-7)),
                equal("sample", 9..11, Bound::Absolute(4e-7)),
                equal("sample, far field", 11..12, Bound::Relative(self.density)),
                equal("exact rule", 12..13, Bound::Relative(5e-4)),
                equal("fractal rule", 13..14, Bound::Relative(5e-4)),
                // With the fraction 1 the rest is divided by 10⁻³.
                equal("join and rest", 14..16, Bound::Absolute(2e-3)),
            ],
        }
    }

    fn visible_normals(self) -> Case {
        Case {
            name: format!("ndf/density/{}, visible normals", self.name),
            parts: vec![self.part],
            body: "\
    let alpha = roughness_clamped(a.xy);
    let v = vec3<f32>(a.zw, b.x);
    let m = b.yzw;
    let w = bitcast<vec3<f32>>(c.xyz);
    let u = vec2<f32>(bitcast<f32>(c.w), bitcast<f32>(d.x));
    outcome.a = bits(vec4<f32>(
        max(min(x_lambda(alpha, v), 1e30), 1e-30), x_masking(alpha, v), x_masking_shadowing(alpha, v, w), x_projected_area(alpha, v),
    ));
    outcome.b = bits(vec4<f32>(x_sample_visible(alpha, v, u), max(x_visible_pdf(alpha, v, m) * f32(d.y), 1e-34)));
    outcome.c = bits(vec4<f32>(microfacet_above(v), 0.0));"
                .replace("x_", &format!("{}_", self.name)),
            resources: vec![],
            input: Box::new(move |i| {
                let alpha = [0, 1].map(|k| number(i, k, 10.0_f32.powf(between(i, k, -3.0, 0.0))));
                let direction = |k| {
                    let (up, turn) = (between(i, k, 0.0, 1.0), between(i, k + 1, 0.0, std::f32::consts::TAU));
                    let across = (1.0 - up * up).sqrt();
                    Vec3::new(across * turn.cos(), across * turn.sin(), up)
                };
                let (v, w) = (direction(2), direction(4));
                let m = (self.of)(alpha[0], alpha[1]).warp_gaussian(Vec2::new(gaussian(i, 6), gaussian(i, 7)));
                let u = [8, 9].map(|k| between(i, k, 0.0, 1.0));
                let good =
                    [alpha[0], alpha[1], v.x, v.y, v.z, m.x, m.y, m.z, w.x, w.y, w.z, u[0], u[1]];
                let mut inputs = [0; INPUTS];
                for ((input, good), k) in inputs.iter_mut().zip(good).zip(0..) {
                    *input = number(i, k, good).to_bits();
                }
                // Views without a direction, and from below.
                if let 40..44 = i {
                    inputs[2..5].fill(0);
                    inputs[2 + i as usize % 4] = [-1.0_f32, f32::NAN][i as usize % 2].to_bits();
                }
                // Not where v is perpendicular to m, because their product cancels.
                inputs[13] = u32::from(v.dot(m) > 0.05);
                inputs
            }),
            reference: Box::new(move |inputs| {
                let is_seen = inputs[13] as f32;
                let [alpha_x, alpha_y, vx, vy, vz, mx, my, mz, wx, wy, wz, u1, u2] = floats(inputs, 0);
                let ndf = (self.of)(alpha_x, alpha_y);
                let [v, m, w] = [[vx, vy, vz], [mx, my, mz], [wx, wy, wz]].map(Vec3::from);
                // Batch calls, because Beckmann's single calls are in f64.
                let ([mut x], [mut y], [mut z]) = ([0.0; 1], [0.0; 1], [0.0; 1]);
                let arrays = [&mut x, &mut y, &mut z].map(core::slice::from_mut);
                let (view, u) = ([&[vx][..], &[vy], &[vz]], [&[u1][..], &[u2]]);
                ndf.sample_visible_batch(view, u, arrays).expect("arrays of one number");
                let above = above(v);
                words(&[
                    ndf.lambda(v).clamp(1e-30, 1e30),
                    ndf.g1(v),
                    ndf.g2(v, w),
                    ndf.projected_area(v),
                    x,
                    y,
                    z,
                    (ndf.visible_pdf(v, m) * is_seen).max(FAINT),
                    above.x,
                    above.y,
                    above.z,
                ])
            }),
            outputs: vec![
                Output { name: "Λ", words: 0..1, written: self.masking[0], adapter: Bound::Relative(2e-5) },
                Output { name: "G₁ and G₂", words: 1..3, written: self.masking[1], adapter: Bound::Absolute(1e-6) },
                Output { name: "σ", words: 3..4, written: self.masking[2], adapter: Bound::Relative(2e-6) },
                equal("visible normal", 4..7, Bound::Absolute(1e-4)),
                Output {
                    name: "D_v",
                    words: 7..8,
                    written: self.masking[3],
                    adapter: Bound::Relative(2.0 * self.density),
                },
                equal("view from above", 8..11, Bound::Absolute(4e-7)),
            ],
        }
    }
}

/// Roughnesses, and a view above the horizon.
fn seen(i: u32) -> [f32; 5] {
    let alpha = [0, 1].map(|k| number(i, k, 10.0_f32.powf(between(i, k, -3.0, 0.0))));
    let (up, turn) = (between(i, 2, 0.0, 1.0), between(i, 3, 0.0, std::f32::consts::TAU));
    let across = (1.0 - up * up).sqrt();
    let [x, y, z] = [across * turn.cos(), across * turn.sin(), up];
    [alpha[0], alpha[1], number(i, 2, x), number(i, 3, y), number(i, 4, z)]
}

fn resolved_visible_normals() -> Case {
    Case {
        name: "ndf/density/ggx, resolved visible normals".to_owned(),
        parts: vec![&GGX],
        body: "\
    let alpha = roughness_clamped(a.xy);
    let v = vec3<f32>(a.zw, b.x);
    let m = bitcast<vec3<f32>>(c.xyz);
    let split = gaussian_split(bitcast<vec2<f32>>(d.xy), bitcast<f32>(d.z));
    outcome.a = bits(vec4<f32>(ggx_warp_visible(alpha, v, b.yz), max(ggx_visible_facets_d(alpha, v, m, split) * f32(d.w), 1e-34)));
    outcome.b = bits(vec4<f32>(ggx_visible_facets_warp_gaussian(alpha, v, b.yz, split), 0.0));
    outcome.c = bits(vec4<f32>(ggx_invert_visible(alpha, v, m) * f32(d.w), 0.0, 0.0));"
            .to_owned(),
        resources: vec![],
        input: Box::new(move |i| {
            let [alpha_x, alpha_y, x, y, z] = seen(i);
            let (ggx, v) = (Ggx::new_clamped(alpha_x, alpha_y), Vec3::new(x, y, z));
            let m = ggx.warp_visible(v, Vec2::new(gaussian(i, 5), gaussian(i, 6)));
            let z_b = [gaussian(i, 7), gaussian(i, 8), between(i, 9, 0.0, 0.9)];
            let xi = [gaussian(i, 10), gaussian(i, 11)];
            let mut inputs = [0; INPUTS];
            let good = [alpha_x, alpha_y, x, y, z, xi[0], xi[1], 0.0, m.x, m.y, m.z, 0.0, z_b[0], z_b[1], z_b[2]];
            for ((input, good), k) in inputs.iter_mut().zip(good).zip(0..) {
                *input = number(i, k, good).to_bits();
            }
            // Not where v is nearly perpendicular to m, because the terms of the inverse cancel.
            inputs[15] = u32::from(v.dot(m) > 0.1);
            inputs
        }),
        reference: Box::new(move |inputs| {
            let [alpha_x, alpha_y, x, y, z, xi1, xi2, _, mx, my, mz, _, z1, z2, s] = floats(inputs, 0);
            let (ggx, v, xi) = (Ggx::new_clamped(alpha_x, alpha_y), Vec3::new(x, y, z), Vec2::new(xi1, xi2));
            let (m, is_seen) = (Vec3::new(mx, my, mz), inputs[15] as f32);
            let facets = VisibleFacets::new(ggx, v, Vec2::new(z1, z2), s);
            let (warped, sample, back) = (ggx.warp_visible(v, xi), facets.warp_gaussian(xi), ggx.invert_visible(v, m));
            let density = (facets.d(m) * is_seen).max(FAINT);
            words(&[
                warped.x, warped.y, warped.z, density, sample.x, sample.y, sample.z, 0.0,
                back.x * is_seen, back.y * is_seen,
            ])
        }),
        outputs: vec![
            equal("T_v", 0..3, Bound::Absolute(1e-4)),
            // The crate's exponential of the weight is that of the float library.
            Output::new("p_v", 3..4, Bound::Relative(2e-6), Bound::Relative(5e-3)),
            equal("sample", 4..7, Bound::Absolute(1e-4)),
            equal("T_v⁻¹", 8..10, Bound::Absolute(2e-4)),
        ],
    }
}

fn reflecting_normals() -> Case {
    Case {
        name: "ndf/density/ggx, normals for reflections".to_owned(),
        parts: vec![&GGX],
        body: "\
    let alpha = roughness_clamped(a.xy);
    let v = vec3<f32>(a.zw, b.x);
    let m = bitcast<vec3<f32>>(c.xyz);
    outcome.a = bits(vec4<f32>(ggx_sample_reflecting(alpha, v, b.yz), max(ggx_reflecting_pdf(alpha, v, m) * f32(d.x), 1e-34)));"
            .to_owned(),
        resources: vec![],
        input: Box::new(move |i| {
            let [alpha_x, alpha_y, x, y, z] = seen(i);
            let (ggx, v) = (Ggx::new_clamped(alpha_x, alpha_y), Vec3::new(x, y, z));
            let m = ggx.warp_gaussian(Vec2::new(gaussian(i, 5), gaussian(i, 6)));
            let u = [between(i, 7, 0.0, 1.0), between(i, 8, 0.0, 1.0)];
            let mut inputs = [0; INPUTS];
            for ((input, good), k) in
                inputs.iter_mut().zip([alpha_x, alpha_y, x, y, z, u[0], u[1], 0.0, m.x, m.y, m.z]).zip(0..)
            {
                *input = number(i, k, good).to_bits();
            }
            // Away from the edges of the visible normals and of the cap.
            let w = 2.0 * v.dot(m) * m - v;
            inputs[12] = u32::from(v.dot(m) > 0.05 && w.z > 1e-3);
            inputs
        }),
        reference: Box::new(move |inputs| {
            let [alpha_x, alpha_y, x, y, z, u1, u2, _, mx, my, mz] = floats(inputs, 0);
            let (ggx, v, m) = (Ggx::new_clamped(alpha_x, alpha_y), Vec3::new(x, y, z), Vec3::new(mx, my, mz));
            let sample = ggx.sample_reflecting(v, Vec2::new(u1, u2));
            words(&[sample.x, sample.y, sample.z, (ggx.reflecting_pdf(v, m) * inputs[12] as f32).max(FAINT)])
        }),
        outputs: vec![
            equal("sample", 0..3, Bound::Absolute(1e-4)),
            equal("density", 3..4, Bound::Relative(4e-6)),
        ],
    }
}

/// Equal bits as written.
fn equal(name: &'static str, words: std::ops::Range<usize>, adapter: Bound) -> Output {
    Output { name, words, written: Bound::Equal, adapter }
}

/// A view above the horizon, as documented by [`Microfacet`].
fn above(v: Vec3) -> Vec3 {
    if v.z > 0.0 && (0.25..=4.0).contains(&v.length_squared()) {
        return v;
    }
    let number = |c: f32| if c.is_nan() { 0.0 } else { c };
    Vec3::new(number(v.x), number(v.y), v.z.max(0.0)).try_normalize().unwrap_or(Vec3::Z)
}
