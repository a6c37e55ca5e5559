//! Facet densities of older models: Student's t, Blinn–Phong, Ward, Ashikhmin–Shirley, in 64 bits
//! in the crate.

use asperity_ndf_sampling::glam::{Vec2, Vec3};
use asperity_ndf_sampling::{AshikhminShirley, BlinnPhong, Microfacet, Ndf, StudentT, Ward};
use asperity_wgsl::{
    Part,
    ndf::{ASHIKHMIN_SHIRLEY, BLINN_PHONG, GGX, STUDENT_T, WARD},
};

use super::{floats, gaussian, number, words};
use crate::case::{Bound, Case, INPUTS, Output, between};

pub(super) fn cases() -> Vec<Case> {
    let student = Facets {
        name: "student_t",
        part: &STUDENT_T,
        parameters: "let p = roughness_clamped(a.xy); let q = student_t_clamped_gamma(a.z);",
        first: "p, q",
        input: |i| [log(i, 0, -3.0, 0.0), log(i, 1, -3.0, 0.0), 1.0 + log(i, 2, -0.2, 3.0)],
        of: |[x, y, gamma]| Box::new(StudentT::new_clamped(x, y, gamma)),
    };
    let blinn_phong = Facets {
        name: "blinn_phong",
        part: &BLINN_PHONG,
        parameters: "let p = blinn_phong_clamped(a.x);",
        first: "p",
        input: |i| [if i % 9 == 0 { 0.0 } else { log(i, 0, -1.0, 5.0) }, 0.0, 0.0],
        of: |[n, ..]| Box::new(BlinnPhong::new_clamped(n)),
    };
    let ashikhmin_shirley = Facets {
        name: "ashikhmin_shirley",
        part: &ASHIKHMIN_SHIRLEY,
        parameters: "let p = ashikhmin_shirley_clamped(a.xy);",
        first: "p",
        input: |i| [log(i, 0, -1.0, 5.0), log(i, 1, -1.0, 5.0), 0.0],
        of: |[n_u, n_v, _]| Box::new(AshikhminShirley::new_clamped(n_u, n_v)),
    };
    vec![student.case(), blinn_phong.case(), ashikhmin_shirley.case(), masking(), ward()]
}

fn log(i: u32, k: u32, low: f32, high: f32) -> f32 {
    10.0_f32.powf(between(i, k, low, high))
}

/// Smaller densities are treated as this value.
const FAINT: f32 = 1e-30;

/// A density with the WGSL of its parameters, and the first arguments of its functions.
struct Facets {
    name: &'static str,
    part: &'static Part,
    parameters: &'static str,
    first: &'static str,
    input: fn(u32) -> [f32; 3],
    of: fn([f32; 3]) -> Box<dyn Ndf>,
}

impl Facets {
    fn case(self) -> Case {
        let Self { name, first, of, .. } = self;
        let x = |function: &str| format!("{name}_{function}({first}, ");
        let (density, from, to, sample) = (x("d"), x("warp_gaussian"), x("invert"), x("sample"));
        Case {
            name: format!("ndf/density/{name}"),
            parts: vec![self.part, &GGX],
            body: format!(
                "    {}\n    let u = bitcast<vec2<f32>>(c.xy);\n    \
                 outcome.a = bits(vec4<f32>({from}vec2<f32>(a.w, b.x)), max({density}b.yzw), 1e-30)));\n    \
                 outcome.b = bits(vec4<f32>({to}b.yzw), 0.0, 0.0));\n    \
                 outcome.c = bits(vec4<f32>({sample}u), 0.0));",
                self.parameters
            ),
            resources: vec![],
            input: Box::new(move |i| {
                let [p, q, r] = (self.input)(i);
                let parameters = [number(i, 0, p), number(i, 1, q), number(i, 2, r)];
                let h = of(parameters).warp_gaussian(Vec2::new(gaussian(i, 5), gaussian(i, 6)));
                let u = [8, 9].map(|k| between(i, k, 0.0, 1.0));
                let good = [p, q, r, gaussian(i, 3), gaussian(i, 4), h.x, h.y, h.z, u[0], u[1]];
                let mut inputs = [0; INPUTS];
                for ((input, good), k) in inputs.iter_mut().zip(good).zip(0..) {
                    *input = number(i, k, good).to_bits();
                }
                inputs
            }),
            reference: Box::new(move |inputs| {
                let [p, q, r, z1, z2, x, y, up, u1, u2] = floats(inputs, 0);
                let (ndf, h) = (of([p, q, r]), Vec3::new(x, y, up));
                let (m, back) = (ndf.warp_gaussian(Vec2::new(z1, z2)), ndf.invert(h));
                let sample = ndf.sample(Vec2::new(u1, u2));
                let density = ndf.d(h).max(FAINT);
                words(&[m.x, m.y, m.z, density, back.x, back.y, 0.0, 0.0, sample.x, sample.y, sample.z])
            }),
            outputs: vec![
                absolute("T", 0..3, [4e-7, 8e-7]),
                relative("D", 3..4, [4e-6, 2e-5]),
                absolute("T⁻¹", 4..6, [2e-6, 8e-6]),
                absolute("sample", 8..11, [4e-7, 8e-7]),
            ],
        }
    }
}

/// Absolute bounds as written and on adapters.
fn absolute(name: &'static str, words: std::ops::Range<usize>, [written, adapter]: [f32; 2]) -> Output {
    Output { name, words, written: Bound::Absolute(written), adapter: Bound::Absolute(adapter) }
}

/// Relative bounds as written and on adapters.
fn relative(name: &'static str, words: std::ops::Range<usize>, [written, adapter]: [f32; 2]) -> Output {
    Output { name, words, written: Bound::Relative(written), adapter: Bound::Relative(adapter) }
}

fn masking() -> Case {
    Case {
        name: "ndf/density/student_t, masking".into(),
        parts: vec![&STUDENT_T],
        body: "\
    let alpha = roughness_clamped(a.xy);
    let gamma = student_t_clamped_gamma(a.z);
    let w = vec3<f32>(a.w, b.xy);
    let v = vec3<f32>(b.zw, bitcast<f32>(c.x));
    let m = bitcast<vec3<f32>>(c.yzw);
    outcome.a = bits(vec4<f32>(
        clamp(student_t_lambda(alpha, gamma, v), 1e-10, 1e30), student_t_projected_area(alpha, gamma, v),
        student_t_masking(alpha, gamma, v), student_t_masking_shadowing(alpha, gamma, v, w),
    ));
    let sample = student_t_sample_visible(alpha, gamma, v, bitcast<vec2<f32>>(d.yz));
    let is_inside = f32(d.w);
    outcome.b = bits(vec4<f32>(max(student_t_visible_pdf(alpha, gamma, v, m) * f32(d.x), 1e-30), sample));
    outcome.c = bits(vec4<f32>(sample * is_inside, 0.0));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let direction = |k| {
                let (up, turn) = (between(i, k, 0.001, 1.0), between(i, k + 1, 0.0, std::f32::consts::TAU));
                let across = (1.0 - up * up).sqrt();
                Vec3::new(across * turn.cos(), across * turn.sin(), up)
            };
            let (w, v) = (direction(3), direction(5));
            let alpha = [0, 1].map(|k| number(i, k, log(i, k, -3.0, 0.0)));
            let gamma = number(i, 2, 1.0 + log(i, 2, -0.2, 3.0));
            let m = StudentT::new_clamped(alpha[0], alpha[1], gamma)
                .warp_gaussian(Vec2::new(gaussian(i, 7), gaussian(i, 8)));
            let good = [alpha[0], alpha[1], gamma, w.x, w.y, w.z, v.x, v.y, v.z, m.x, m.y, m.z];
            let mut inputs = [0; INPUTS];
            for ((input, good), k) in inputs.iter_mut().zip(good).zip(0..) {
                *input = number(i, k, good).to_bits();
            }
            // Not where v is perpendicular to m, because their product cancels.
            inputs[12] = u32::from(v.dot(m) > 0.05);
            inputs[13..15]
                .copy_from_slice(&[13, 14].map(|k| number(i, k, between(i, k, 0.001, 0.999)).to_bits()));
            inputs[15] = u32::from(i >= 40);
            inputs
        }),
        reference: Box::new(|inputs| {
            let [x, y, gamma, wx, wy, wz, vx, vy, vz, mx, my, mz] = floats(inputs, 0);
            let ndf = StudentT::new_clamped(x, y, gamma);
            let [v, w, m] = [[vx, vy, vz], [wx, wy, wz], [mx, my, mz]].map(Vec3::from);
            let visible = ndf.visible_pdf(v, m) * inputs[12] as f32;
            let lambda = ndf.lambda(v).clamp(1e-10, 1e30);
            let u = Vec2::from(floats::<2>(inputs, 13));
            let sample = ndf.sample_visible(v, u);
            let [area, masking, both] = [ndf.projected_area(v), ndf.g1(v), ndf.g2(v, w)];
            let inside = sample * inputs[15] as f32;
            words(&[
                lambda,
                area,
                masking,
                both,
                visible.max(FAINT),
                sample.x,
                sample.y,
                sample.z,
                inside.x,
                inside.y,
                inside.z,
            ])
        }),
        outputs: vec![
            relative("Λ", 0..1, [8e-6, 4e-5]),
            relative("σ", 1..2, [6e-7, 2e-6]),
            absolute("G₁ and G₂", 2..4, [4e-7, 2e-6]),
            relative("D_v", 4..5, [3e-6, 2e-5]),
            // At the ends of the square, where u itself is rounded.
            absolute("visible normal", 5..8, [3e-3, 1e-2]),
            absolute("visible normal within", 8..11, [2e-6, 4e-5]),
        ],
    }
}

fn ward() -> Case {
    Case {
        name: "ndf/density/ward".into(),
        parts: vec![&WARD, &GGX],
        body: "    outcome.a.x = bitcast<u32>(max(ward_lobe(roughness_clamped(a.xy), vec3<f32>(a.zw, b.x)), 1e-30));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let alpha = [0, 1].map(|k| number(i, k, log(i, k, -3.0, 0.0)));
            let h = Ward::new_clamped(alpha[0], alpha[1]).warp_gaussian(Vec2::new(gaussian(i, 3), gaussian(i, 4)));
            let mut inputs = [0; INPUTS];
            for ((input, good), k) in inputs.iter_mut().zip([alpha[0], alpha[1], h.x, h.y, h.z]).zip(0..) {
                *input = number(i, k, good).to_bits();
            }
            inputs
        }),
        reference: Box::new(|inputs| {
            let [alpha_x, alpha_y, x, y, z] = floats(inputs, 0);
            words(&[Ward::new_clamped(alpha_x, alpha_y).lobe(Vec3::new(x, y, z)).max(FAINT)])
        }),
        outputs: vec![relative("lobe", 0..1, [4e-7, 2e-5])],
    }
}
