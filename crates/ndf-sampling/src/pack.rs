//! Packs a map into one array of `f32`.

use alloc::vec::Vec;

use crate::map::NdfMap;
use crate::packed_layout::{KEYS, LINES, Layout, SLAB};
use crate::reconstruction::Reconstruction;
use crate::slab::Slab;

/// How far off, in u, the inverse of a slab's marginal may be to be written as a cubic.
const CUBIC: f64 = 3e-8;

impl NdfMap {
    /// The map in one array of `f32`, for [`PackedMap`](crate::PackedMap).
    ///
    /// It takes about 9 bytes a texel and 100 KB. It is the same on every machine that rounds alike, and may be written to a file
    /// or to a program's constants.
    #[must_use]
    pub fn pack(&self) -> Vec<f32> {
        let cdf = self.cdf();
        let columns = cdf.columns();
        let (slabs, kind) = (cdf.slabs(), columns.kind());
        let layout = Layout {
            width: columns.width(),
            height: columns.height(),
            kind,
            slabs: slabs.len(),
            guide: (2 * slabs.len()).next_power_of_two(),
            quantiles: cdf.quantiles().parts(),
        };
        let mut packed = Vec::with_capacity(layout.len().map_or(0, |len| len as usize));
        packed.extend(layout.header());
        let scale = cdf.scale();
        let weights: Vec<f32> = cdf.cumulative().iter().map(|&weight| weight as f32).collect();
        let places: Vec<f32> = cdf.places().iter().map(|&place| (2.0 * place - 1.0) as f32).collect();
        let beyond = [2.0; KEYS];
        packed.extend(weights.iter().copied().chain(beyond));
        packed.extend(places.iter().copied().chain(beyond));
        // The product that finds the part is exact for weights; places are rounded before it.
        extend_guide(&mut packed, &weights, layout.guide, |part| part);
        extend_guide(&mut packed, &places, layout.guide, |part| 2.0 * part - 1.0 - 3e-7);
        for (k, slab) in slabs.iter().enumerate() {
            let weights = [k, k + 1].map(|k| weights.get(k).copied().unwrap_or(1.0));
            packed.extend(slab_numbers(slab, weights, kind, layout.width, scale));
        }
        packed.extend(cdf.quantiles().rows());
        let border = kind.cells(layout.width) - layout.width;
        let all =
            (0..layout.width + 2 * border).map(|column| column.saturating_sub(border).min(layout.width - 1));
        for column in all.clone() {
            packed.extend(
                columns.sums(column).iter().map(|&sum| (sum * scale) as f32).chain([f32::MAX; LINES]),
            );
        }
        for column in all {
            packed.extend(columns.padded(column).map(|value| (f64::from(value) * scale) as f32));
        }
        packed
    }
}

/// For each part the last key that is at most where it begins.
fn extend_guide(packed: &mut Vec<f32>, keys: &[f32], parts: usize, begin: impl Fn(f64) -> f64) {
    let mut key = 0;
    packed.extend((0..parts).map(|part| {
        let begin = begin(part as f64 / parts as f64);
        while keys.get(key + 1).is_some_and(|&next| f64::from(next) <= begin) {
            key += 1;
        }
        f32::from_bits(key as u32)
    }));
}

/// The numbers of a slab: what is before and after the straight inverse, its place and width in its column, the marginal, its part
/// below the middle, the column, the weights before and after it, and where it begins.
fn slab_numbers(
    slab: &Slab,
    weights: [f32; 2],
    kind: Reconstruction,
    width: usize,
    scale: f64,
) -> [f32; SLAB] {
    let mass = f64::from(weights[1]) - f64::from(weights[0]);
    let mean = 0.25 * slab.marginal.iter().sum::<f64>();
    let [begin, .., end] = slab.marginal;
    let slopes = [begin, end].map(|marginal| mean / marginal);
    let bend = [slopes[0] - 1.0, 1.0 - slopes[1]];
    let cubic = |r: f64| r + r * (1.0 - r) * (bend[0] * (1.0 - r) + bend[1] * r);
    // A cubic between these slopes increases.
    let increases = slopes.iter().all(|slope| (0.0..=3.0).contains(slope));
    let exact =
        increases && [0.25, 0.5, 0.75].into_iter().all(|r| (slab.share(cubic(r)) - r).abs() * mass < CUBIC);
    let bend = if exact { bend.map(|bend| bend as f32) } else { [f32::MAX; 2] };
    let column = slab.column as usize;
    let place = slab.x.map(|x| x * width as f64 + kind.offset() - column as f64);
    let [m0, m1, m2, m3] = slab.marginal.map(|m| (m * scale) as f32);
    let [b0, b1, b2, b3] = slab.below.map(|b| (b * scale) as f32);
    let before_next = 1.0 - f32::EPSILON / 2.0;
    let begin = (place[0] as f32).clamp(0.0, before_next);
    let wide = (place[1] - place[0]) as f32;
    [
        bend[0],
        bend[1],
        begin,
        wide,
        m0,
        m1,
        m2,
        m3,
        b0,
        b1,
        b2,
        b3,
        f32::from_bits(column as u32),
        weights[0],
        weights[1],
        (2.0 * slab.x[0] - 1.0) as f32,
    ]
}
