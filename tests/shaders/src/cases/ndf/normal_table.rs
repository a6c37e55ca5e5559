//! Normal tables in every spacing and chart.

use asperity_ndf_sampling::glam::Vec2;
use asperity_ndf_sampling::normal_table::{Chart, Spacing, TableLayout};
use asperity_ndf_sampling::{Ggx, NormalLut};
use asperity_wgsl::ndf::NORMAL_TABLE;

use super::{floats, gaussian, number, words};
use crate::case::{Bound, Case, INPUTS, Output, packed};

pub(super) fn cases() -> Vec<Case> {
    vec![
        table(Spacing::Coordinates, Chart::Stereographic, 64),
        table(Spacing::Warped, Chart::Slopes, 33),
        table(Spacing::Quantiles, Chart::Projected, 64),
        table(Spacing::Coordinates, Chart::Projected, 1),
    ]
}

fn table(spacing: Spacing, chart: Chart, size: usize) -> Case {
    let layout = TableLayout { spacing, chart };
    let ggx = Ggx::new(0.2, 0.6).expect("valid roughnesses");
    let mut entries =
        NormalLut::with_layout(&ggx, size, layout).expect("a small table").view().entries().to_vec();
    // An entry outside the chart.
    if let Some(entry) = entries.get_mut(5) {
        *entry = [3e9, 2e9];
    }
    let entries: &'static [[f32; 2]] = entries.leak();
    let table = NormalLut::from_entries(size, layout, entries).expect("as many entries");
    let mut numbers: Vec<u32> = entries.as_flattened().iter().map(|x| x.to_bits()).collect();
    numbers.resize(numbers.len().next_multiple_of(1024), 0);
    // Φ is in f64 in the crate: a position may round to the adjacent entry.
    let (written, adapter) = match spacing {
        Spacing::Quantiles => (Bound::Absolute(8e-7), 1e-4),
        _ => (Bound::Equal, 1e-5),
    };
    Case {
        name: format!("ndf/normal_table, {spacing:?} {chart:?} {size}"),
        parts: vec![&NORMAL_TABLE],
        body: "\
    let bilinear = normal_table_bilinear(a.xy);
    let nearest = normal_table_nearest(a.xy);
    outcome.a = bits(vec4<f32>(bilinear, nearest.x));
    outcome.b = bits(vec4<f32>(nearest.yz, normal_table_place(normal_table_grid.spacing, a.x), 0.0));
    outcome.c = bits(vec4<f32>(normal_table_normal(normal_table_grid.chart, a.zw), 0.0));"
            .into(),
        resources: vec![("normal_table_grid", packed(&table.gpu())), ("normal_table_number", numbers)],
        input: Box::new(move |i| {
            let mut inputs = [0; INPUTS];
            for (k, input) in (0..4).zip(&mut inputs) {
                *input = number(i, k, gaussian(i, k)).to_bits();
            }
            // Not where two entries are equally near, except for invalid numbers.
            let z = floats::<2>(inputs, 0);
            let place = z.map(|z| spacing.place(z) * size as f32);
            if i >= 40 && place.iter().any(|place| (place - place.round()).abs() < 1e-4) {
                inputs[..2].fill(0.25_f32.to_bits());
            }
            inputs
        }),
        reference: Box::new(move |inputs| {
            let [z1, z2, x, y] = floats(inputs, 0);
            let z = Vec2::new(z1, z2);
            let (a, b, c) =
                (table.bilinear_normal(z), table.nearest_normal(z), chart.to_normal(Vec2::new(x, y)));
            words(&[a.x, a.y, a.z, b.x, b.y, b.z, spacing.place(z1), 0.0, c.x, c.y, c.z])
        }),
        outputs: vec![
            Output { name: "bilinear", words: 0..3, written, adapter: Bound::Absolute(adapter) },
            Output::new("nearest", 3..6, Bound::Equal, Bound::Absolute(1e-6)),
            Output {
                name: "place",
                words: 6..7,
                written: if spacing == Spacing::Quantiles { Bound::Absolute(2.5e-7) } else { Bound::Equal },
                adapter: Bound::Absolute(4e-7),
            },
            Output::new("normal of a point", 8..11, Bound::Equal, Bound::Absolute(1e-3)),
        ],
    }
}
