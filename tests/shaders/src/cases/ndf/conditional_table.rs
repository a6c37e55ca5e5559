//! Textures of half vectors.

use asperity_ndf_sampling::glam::{Vec2, Vec3};
use asperity_ndf_sampling::{ConditionalTable, GaussianSplit, Ndf, StudentT};
use asperity_wgsl::ndf::CONDITIONAL_TABLE;

use super::{floats, gaussian, number, words};
use crate::case::{Bound, Case, INPUTS, Output, between, packed};

pub(super) fn cases() -> Vec<Case> {
    vec![table(40), table(1)]
}

fn table(size: usize) -> Case {
    let student = StudentT::new_clamped(0.2, 0.5, 1.6);
    let table = ConditionalTable::new(&student, size).expect("a small table");
    let entries: &'static [[f32; 3]] = table.view().entries().to_vec().leak();
    let table =
        ConditionalTable::from_entries(size, table.view().stretch(), entries).expect("as many entries");
    let mut numbers: Vec<u32> = entries.as_flattened().iter().map(|x| x.to_bits()).collect();
    // NaN after the entries: with a single entry nothing else may be read.
    numbers.resize(numbers.len().next_multiple_of(1024), f32::NAN.to_bits());
    Case {
        name: format!("ndf/level_of_detail/conditional_table, {size}"),
        parts: vec![&CONDITIONAL_TABLE],
        body: "\
    let split = gaussian_split(vec2<f32>(a.w, b.x), b.y);
    outcome.a = bits(vec4<f32>(conditional_table_interpolated(a.xyz).xy, max(conditional_table_residual_ndf(a.xyz, split), 1e-30), 0.0));"
            .into(),
        resources: vec![
            ("conditional_table_grid", packed(&table.gpu())),
            ("conditional_table_number", numbers),
        ],
        input: Box::new(move |i| {
            let h = student.warp_gaussian(Vec2::new(gaussian(i, 0), gaussian(i, 1)));
            let s = between(i, 5, 0.0, 0.99);
            let good = [h.x, h.y, h.z, gaussian(i, 3), gaussian(i, 4), s];
            let mut inputs = [0; INPUTS];
            for ((input, good), k) in inputs.iter_mut().zip(good).zip(0..) {
                *input = number(i, k, good).to_bits();
            }
            inputs
        }),
        reference: Box::new(move |inputs| {
            let [x, y, up, z1, z2, s] = floats(inputs, 0);
            let h = Vec3::new(x, y, up);
            let z = table.invert(h);
            let density = table.residual_ndf(h, GaussianSplit::new(Vec2::new(z1, z2), s));
            words(&[z.x, z.y, density.max(1e-30)])
        }),
        outputs: vec![
            Output::new("T⁻¹", 0..2, Bound::Equal, Bound::Absolute(1e-5)),
            // The crate's exponential comes from its backend.
            Output::new("exact rule", 2..3, Bound::Relative(1e-6), Bound::Relative(5e-3)),
        ],
    }
}
