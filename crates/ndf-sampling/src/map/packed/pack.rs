//! Packs a map into one array of `f32`.

use alloc::vec::Vec;

use crate::map::ndf_map::NdfMap;
use crate::map::packed::bins::Bins;
use crate::map::packed::layout::{KEYS, LINES, Layout};
use crate::map::packed::record::LEAF;
use crate::map::quantiles::Quantiles;

impl NdfMap {
    /// The map in one array of `f32`, for [`PackedMapRef`](crate::PackedMapRef).
    ///
    /// It takes about 9 bytes a texel and, for the distribution of `n_x`, 30 to 200 KB. It is the same on every machine that rounds alike, and may be written to a file
    /// or to a program's constants.
    #[must_use]
    pub fn pack(&self) -> Vec<f32> {
        let cdf = self.cdf();
        let columns = &cdf.columns;
        let (bins, quantiles) = (Bins::new(cdf), Quantiles::new(columns));
        let kind = columns.kind;
        let layout = Layout {
            width: columns.width,
            height: columns.height,
            kind,
            split: bins.split,
            cubics: bins.cubics.len(),
            leaves: bins.leaves.len(),
            guide: (2 * bins.leaves.len()).next_power_of_two(),
            quantiles: quantiles.parts,
        };
        let scale = cdf.scale;
        let mut packed = Vec::with_capacity(layout.len().map_or(0, |len| len as usize));
        packed.extend(layout.header());
        extend_guide(&mut packed, &bins.leaves, layout.guide);
        packed.extend(bins.leaves.iter().skip(1).map(|leaf| leaf[0]));
        packed.extend([2.0; KEYS + 1]);
        packed.extend(bins.leaves.as_flattened());
        packed.extend(bins.cubics.as_flattened().as_flattened());
        packed.extend(quantiles.rows);
        let border = kind.cells(layout.width) - layout.width;
        let all =
            (0..layout.width + 2 * border).map(|column| column.saturating_sub(border).min(layout.width - 1));
        for column in all {
            let nodes = columns.sums(column).iter().zip(columns.padded(column));
            packed.extend(
                nodes.flat_map(|(&sum, value)| [(sum * scale) as f32, (f64::from(value) * scale) as f32]),
            );
            packed.extend([[f32::MAX, 0.0]; LINES].as_flattened());
        }
        packed
    }
}

/// For each part of [0, 1] the last leaf that begins at or before it: exact, for the parts are a power of two.
fn extend_guide(packed: &mut Vec<f32>, leaves: &[[f32; LEAF]], parts: usize) {
    let mut leaf = 0;
    packed.extend((0..parts).map(|part| {
        let begin = part as f32 / parts as f32;
        while leaves.get(leaf + 1).is_some_and(|next| next[0] <= begin) {
            leaf += 1;
        }
        f32::from_bits(leaf as u32)
    }));
}
