//! Fractal interpolation: table functions, height fields, rays.

use asperity_fif::{
    Fif, FoldedSurface, HeightField, Intersect, Ray, Table32, cochran_2000, glam::DVec3,
    gpu::HeightFieldRangesUniform,
};
use asperity_wgsl::{Binding, Part, fif};

use crate::case::{BAD, Bound, Case, INPUTS, OUTPUTS, Output, any, between, packed};

pub(super) fn cases() -> Vec<Case> {
    vec![values(), jets(), height_field(), folded(), intersect()]
}

/// Functions for the cases of values and of jets.
static FUNCTIONS: Part = Part::new("case/fif/functions", "", &[&fif::TABLE])
    .with_bindings(&[Binding::Uniform { name: "fif_functions", of: "array<FifTable, 4>" }]);

/// A field and its ranges.
static FIELD: Part = Part::new("case/fif/field", "", &[&fif::INTERSECT]).with_bindings(&[
    Binding::Uniform { name: "field", of: "HeightField" },
    Binding::Uniform { name: "field_ranges", of: "HeightFieldRanges" },
]);

/// Surfaces that are not products.
static SURFACES: Part = Part::new("case/fif/surfaces", "", &[&fif::FOLDED_SURFACE])
    .with_bindings(&[Binding::Uniform { name: "fif_surfaces", of: "array<FoldedSurface, 2>" }]);

type Smooth = Fif<3>;

fn smooth(y: &[f64], alpha: &[f64]) -> Smooth {
    let x: Vec<f64> = (0..y.len()).map(|j| 2.0 * j as f64 / (y.len() - 1) as f64).collect();
    Fif::<2>::affine(&x, y, alpha).and_then(|f| f.integral(0.0)).expect("smooth")
}

/// Words of uniforms and of rows.
struct Tables {
    uniforms: Vec<u32>,
    rows: Vec<u32>,
}

impl Tables {
    fn new() -> Self {
        Self { uniforms: vec![], rows: vec![] }
    }

    fn add<const C: usize>(&mut self, table: &Table32<C>) {
        self.uniforms.extend(packed(&table.gpu(self.rows.len() as u32).expect("equal knots")));
        self.rows.extend(table.gpu_rows().map(f32::to_bits));
    }
}

fn float(word: u32) -> f32 {
    f32::from_bits(word)
}

/// Returns points in [0, 2] and near it, the first invalid, many next to the left end or at knots
/// of composites; and a word below `count`.
fn place(i: u32, count: u32) -> [u32; INPUTS] {
    let bad = |k: u32| BAD.get(k as usize).copied();
    let mut words = [0; INPUTS];
    for (k, word) in words.iter_mut().take(2).enumerate() {
        let uniform = between(i, k as u32, -0.02, 2.02);
        let place = match i / 4 % 8 {
            0 => (any(i, 2) as f32 * 2e-10).powi(1 + (i / 32 % 6) as i32),
            1 => (1024.0 * uniform).floor() / 1024.0,
            _ => uniform,
        };
        *word = bad(i / (1 + k as u32)).unwrap_or(place).to_bits();
    }
    words[8] = i % count;
    words
}

fn values() -> Case {
    let thirds: [f64; 4] = core::array::from_fn(|j| 2.0 * j as f64 / 3.0);
    let thirds = Fif::affine(&thirds, &[0.0, 1.0, -1.0, 0.5], &[0.3, -0.4, 0.6]).expect("thirds");
    let [f, g, thirds] = [
        cochran_2000::f().expect("paper").table(1e-7).expect("f"),
        cochran_2000::g().expect("paper").table(1e-7).expect("g"),
        thirds.table(1e-7).expect("thirds"),
    ]
    .map(|table| table.to_f32());
    let g_hat = cochran_2000::g_hat().expect("paper").table(1e-7).expect("ĝ").to_f32();
    let mut tables = Tables::new();
    [&f, &g, &thirds].into_iter().for_each(|table| tables.add(table));
    tables.add(&g_hat);
    Case {
        name: "fif/table/uniform".into(),
        parts: vec![&FUNCTIONS],
        body: "\
    let table = fif_functions[c.x];
    let value = bitcast<u32>(fif_table_value(table, a.x));
    // 2^-40 of the domain.
    let near = a.x > 0.0 && a.x < 1.8189894e-12;
    outcome.a = select(vec4<u32>(value, 0u, 0u, 0u), vec4<u32>(0u, value, 0u, 0u), near);
    outcome.b = vec4<u32>(fif_table_digit(c.yz, c.w), 0u);"
            .into(),
        resources: vec![("fif_rows", tables.rows), ("fif_functions", tables.uniforms)],
        // A fraction and a radix. For a third of them the product carries over or nearly so.
        input: Box::new(|i| {
            let mut words = place(i, 4);
            let radix = any(i, 5) >> 16 | 1;
            let multiple = u64::from(1 + any(i, 3) % radix) << 32;
            words[9] = if i % 3 == 0 { ((multiple - 1) / u64::from(radix)) as u32 } else { any(i, 3) };
            words[10] = any(i, 4);
            words[11] = radix;
            words
        }),
        reference: Box::new(move |words| {
            let x = float(words[0]);
            let value = match words[8] {
                0 => f.value(x),
                1 => g.value(x),
                2 => thirds.value(x),
                _ => g_hat.value(x),
            };
            let mut outputs = [0; OUTPUTS];
            outputs[usize::from(x > 0.0 && x < 1.818_989_4e-12)] = value.to_bits();
            let product = (u128::from(words[9]) << 32 | u128::from(words[10])) * u128::from(words[11]);
            [outputs[4], outputs[5], outputs[6]] =
                [product >> 64, product >> 32, product].map(|word| word as u32);
            outputs
        }),
        outputs: vec![
            Output::new("digit", 4..7, Bound::Equal, Bound::Equal),
            Output::new("value", 0..1, Bound::Equal, Bound::Absolute(1e-6)),
            // The crate evaluates these few in f64.
            Output::new("value next to the left end", 1..2, Bound::Absolute(1.6e-8), Bound::Absolute(1.6e-8)),
        ],
    }
}

fn jets() -> Case {
    let thirds = smooth(&[0.0, 1.0, -1.0, 0.5], &[0.2, -0.25, 0.3]);
    // The source's f̂ and ĝ, and two more.
    let functions = [
        smooth(&[0.0, 1.0, 0.0], &[0.5, 0.5]),
        smooth(&[0.0, 1.0, 0.0], &[0.85, -0.85]),
        thirds,
        smooth(&[1.0, 0.0, 2.0, -1.0, 0.5], &[0.1, -0.2, 0.15, 0.05]),
    ];
    let functions = functions.map(|f| f.table(1e-9).expect("smooth"));
    let mut tables = Tables::new();
    functions.iter().for_each(|table| tables.add(&table.to_f32()));
    Case {
        name: "fif/table/jet".into(),
        parts: vec![&FUNCTIONS],
        body: "\
    let jet = fif_table_jet(fif_functions[c.x], a.x);
    outcome.a = bits(vec4<f32>(jet, 0.0, 0.0));"
            .into(),
        resources: vec![("fif_rows", tables.rows), ("fif_functions", tables.uniforms)],
        input: Box::new(|i| place(i, 4)),
        reference: Box::new(move |words| {
            let jet = functions[words[8] as usize].jet(f64::from(float(words[0])));
            let mut outputs = [0; OUTPUTS];
            outputs[0] = (jet.value as f32).to_bits();
            outputs[1] = (jet.slope as f32).to_bits();
            outputs
        }),
        // The crate's jets are f64.
        outputs: vec![
            Output::new("value", 0..1, Bound::Absolute(4e-7), Bound::Absolute(1e-6)),
            Output::new("slope", 1..2, Bound::Absolute(3e-5), Bound::Absolute(6e-5)),
        ],
    }
}

type Field = HeightField<Smooth, Smooth>;

/// The source's f̂(x) times a function on quarters, with tables and resources.
fn field() -> (Field, Vec<(&'static str, Vec<u32>)>) {
    let (f, g) = (
        smooth(&[0.0, 1.0, 0.0], &[0.5, 0.5]),
        smooth(&[1.0, 0.0, 2.0, -1.0, 0.5], &[0.1, -0.2, 0.15, 0.05]),
    );
    let surface = HeightField::new(f, g).tabulated();
    let [f, g] = [surface.x(), surface.y()].map(|axis| axis.function().table(1e-9).expect("smooth").to_f32());
    let mut tables = Tables::new();
    tables.add(&f);
    tables.add(&g);
    let along_x: Vec<u32> = surface.x().gpu_ranges().map(f32::to_bits).collect();
    let along_y = surface.y().gpu_ranges().map(f32::to_bits);
    let uniform = HeightFieldRangesUniform {
        x: surface.x().gpu(&f, 0).expect("smooth"),
        y: surface.y().gpu(&g, along_x.len() as u32).expect("smooth"),
    };
    let resources = vec![
        ("fif_rows", tables.rows),
        ("field", tables.uniforms),
        ("fif_ranges", along_x.iter().copied().chain(along_y).collect()),
        ("field_ranges", packed(&uniform)),
    ];
    (surface, resources)
}

fn height_field() -> Case {
    let (surface, resources) = field();
    Case {
        name: "fif/surface/height_field".into(),
        parts: vec![&FIELD],
        body: "\
    let jet = height_field_jet(field, a.xy);
    let normal = upward_normal(jet.gradient);
    outcome.a = bits(vec4<f32>(jet.height, jet.gradient, height_field_height(field, a.xy) - jet.height));
    outcome.b = bits(vec4<f32>(normal, 0.0));"
            .into(),
        resources,
        // NaN input gives NaN, whose bits are unspecified.
        input: Box::new(|i| place(i + 2, 1)),
        reference: Box::new(move |words| {
            let [x, y] = [0, 1].map(|k| f64::from(float(words[k])));
            let (gradient, normal) = (surface.gradient(x, y), surface.normal(x, y));
            let mut outputs = [0; OUTPUTS];
            if let (Some(gradient), Some(normal)) = (gradient, normal) {
                let floats =
                    [surface.height(x, y), gradient.x, gradient.y, 0.0, normal.x, normal.y, normal.z];
                outputs.iter_mut().zip(floats).for_each(|(word, float)| *word = (float as f32).to_bits());
            }
            outputs
        }),
        // The crate computes in f64.
        outputs: vec![
            Output::new("height", 0..1, Bound::Absolute(8e-7), Bound::Absolute(2e-6)),
            Output::new("gradient", 1..3, Bound::Absolute(1.4e-6), Bound::Absolute(3e-6)),
            Output::new("height alone", 3..4, Bound::Equal, Bound::Absolute(1e-6)),
            Output::new("normal", 4..7, Bound::Absolute(5e-7), Bound::Absolute(1e-6)),
        ],
    }
}

/// Surfaces over [0, 2]²: on unequal cells, and on equal cells with a decreasing factor and slopes
/// at the border.
fn surfaces() -> [FoldedSurface; 2] {
    let (x, y) = ([0.0, 0.7, 1.3, 2.0], [0.0, 0.9, 2.0]);
    let z = [0.0, 1.0, 0.5, -0.5, 0.75, 1.5, 1.0, -1.0, 0.25, 0.5, 0.0, 1.25];
    let slope = |k: usize| [0.5 - 0.125 * k as f64, 0.25 * (k % 5) as f64 - 0.5];
    let slopes: Vec<_> = (0..z.len()).map(slope).collect();
    let unequal = FoldedSurface::new(&x, &y, 0.09, &z, &slopes).expect("unequal cells");
    let quarters = [0.0, 0.5, 1.0, 1.5, 2.0];
    let heights: Vec<_> = (0..25).map(|k| f64::from(k * 7 % 11) / 8.0 - 0.5).collect();
    let slopes: Vec<_> = (0..25).map(slope).collect();
    [unequal, FoldedSurface::new(&quarters, &quarters, -0.06, &heights, &slopes).expect("equal cells")]
}

fn folded() -> Case {
    let surfaces = surfaces();
    let (mut nodes, mut uniforms) = (vec![], vec![]);
    for surface in &surfaces {
        uniforms.extend(packed(&surface.gpu(nodes.len() as u32)));
        nodes.extend(surface.gpu_nodes().map(f32::to_bits));
    }
    Case {
        name: "fif/surface/folded".into(),
        parts: vec![&SURFACES],
        body: "\
    let jet = folded_surface_jet(fif_surfaces[c.x], a.xy);
    outcome.a = bits(vec4<f32>(jet, folded_surface_height(fif_surfaces[c.x], a.xy) - jet.x));"
            .into(),
        resources: vec![("fif_nodes", nodes), ("fif_surfaces", uniforms)],
        input: Box::new(|i| place(i, 2)),
        reference: Box::new(move |words| {
            let [x, y] = [0, 1].map(|k| f64::from(float(words[k])));
            let surface = &surfaces[words[8] as usize];
            let (height, gradient) = (surface.height(x, y), surface.gradient(x, y));
            let mut outputs = [0; OUTPUTS];
            let rest = if height.is_nan() { height } else { 0.0 };
            let floats = [height, gradient.x, gradient.y, rest];
            outputs.iter_mut().zip(floats).for_each(|(word, float)| *word = (float as f32).to_bits());
            outputs
        }),
        // The crate computes in f64. Maximum errors are 4e-7 and 2e-6 on all drivers.
        outputs: vec![
            Output::new("height", 0..1, Bound::Absolute(8e-7), Bound::Absolute(2e-6)),
            Output::new("gradient", 1..3, Bound::Absolute(4e-6), Bound::Absolute(8e-6)),
            Output::new("height alone", 3..4, Bound::Equal, Bound::Absolute(1e-6)),
        ],
    }
}

/// A ray counts as grazing if rays shifted up or down by this height differ.
const GRAZING: f64 = 1e-4;

/// Rays from around the field to a point near it, including from below, level and vertical.
fn ray(i: u32) -> [f32; 6] {
    let at = |k: u32, low: f32, high: f32| between(i, k, low, high);
    let from = [at(0, -3.0, 5.0), at(1, -3.0, 5.0), at(2, -1.0, 4.0)];
    let to = [at(3, -0.5, 2.5), at(4, -0.5, 2.5), at(5, -0.5, 1.5)];
    let mut ray = [from[0], from[1], from[2], to[0] - from[0], to[1] - from[1], to[2] - from[2]];
    match i {
        0..20 => ray[i as usize % 6] = BAD[i as usize / 2],
        20..40 => ray[3..].copy_from_slice(&[0.0, 0.0, -1.0]),
        40..60 => ray[5] = 0.0,
        60..80 => ray[3 + i as usize % 2] = 0.0,
        80..90 => ray[3..].fill(0.0),
        _ => {}
    }
    ray
}

fn intersect() -> Case {
    let (surface, resources) = field();
    let by_input = surface.clone();
    let first = |surface: &Field, ray: [f32; 6], lift: f64| {
        let [x, y, z, u, v, w] = ray.map(f64::from);
        surface.intersect(&Ray { origin: DVec3::new(x, y, z + lift), direction: DVec3::new(u, v, w) })
    };
    Case {
        name: "fif/ray/intersect".into(),
        parts: vec![&FIELD],
        body: "\
    let hit = height_field_intersect(field, field_ranges, a.xyz, b.xyz, vec2<f32>(0.0, 1e30));
    if d.x == 0u {
        outcome.a = vec4<u32>(min(hit.kind, 1u), bits(vec4<f32>(hit.t, hit.p, hit.height)).xyz);
        outcome.b = bits(vec4<f32>(hit.height, hit.gradient, 0.0));
    }"
        .into(),
        resources,
        // The fourth-to-last word marks grazing rays, which may hit or miss at different points.
        // Other rays must agree on hit or miss, certain or not.
        input: Box::new(move |i| {
            let ray = ray(i);
            let mut words = [0; INPUTS];
            words.iter_mut().zip([ray[0], ray[1], ray[2], 0.0, ray[3], ray[4], ray[5]]).for_each(
                |(word, float)| {
                    *word = float.to_bits();
                },
            );
            words[12] = u32::from(grazes(
                [-GRAZING, 0.0, GRAZING].map(|lift| first(&by_input, ray, lift).map(|hit| hit.t)),
            ));
            words
        }),
        reference: Box::new(move |words| {
            let mut outputs = [0; OUTPUTS];
            let ray = [0, 1, 2, 4, 5, 6].map(|k| float(words[k]));
            if let (0, Some(hit)) = (words[12], first(&surface, ray, 0.0)) {
                let gradient = hit.gradient.unwrap_or_default();
                let floats = [hit.t, hit.x, hit.y, hit.height, gradient.x, gradient.y];
                outputs[0] = 1;
                outputs
                    .iter_mut()
                    .skip(1)
                    .zip(floats)
                    .for_each(|(word, float)| *word = (float as f32).to_bits());
            }
            outputs
        }),
        outputs: vec![
            Output::new("hit or miss", 0..1, Bound::Equal, Bound::Equal),
            Output::new("t", 1..2, Bound::Absolute(2e-5), Bound::Absolute(5e-5)),
            Output::new("point", 2..5, Bound::Absolute(9e-5), Bound::Absolute(2e-4)),
            Output::new("gradient", 5..7, Bound::Absolute(5e-4), Bound::Absolute(1e-3)),
        ],
    }
}

/// Whether hits and misses are mixed, or hits are far apart.
fn grazes(t: [Option<f64>; 3]) -> bool {
    match t {
        [Some(a), Some(b), Some(c)] => (a - b).abs().max((b - c).abs()) > 100.0 * GRAZING,
        [None, None, None] => false,
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grazing_rays_are_few_and_both_outcomes_frequent() {
        let case = intersect();
        let inputs: Vec<_> = (0..Case::COUNT).map(|i| (case.input)(i)).collect();
        let grazing = inputs.iter().filter(|words| words[12] == 1).count();
        let hits = inputs.iter().filter(|&&words| (case.reference)(words)[0] == 1).count();
        assert!(grazing < 100 && hits > 3000 && hits < 7000, "{grazing} graze, {hits} hit");
    }
}
