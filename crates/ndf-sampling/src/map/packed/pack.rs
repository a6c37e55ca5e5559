//! Packs a map into one array of `f32`.

use alloc::vec::Vec;

use crate::map::columns::Columns;
use crate::map::marginal::Marginal;
use crate::map::packed::grid::margin;
use crate::map::packed::layout::{LINES, Layout};
use crate::map::packed::leaf::{BEGIN, Leaf, WEIGHT, head, leaf};
use crate::map::packed::quantiles::{self, ROWS};
use crate::map::reconstruction::Reconstruction;
use crate::numeric::guide_table::GuideTable;

/// Parts of the guides of the exact map that share an entry.
const STARTS: usize = 2;

/// The layout and the array of a map.
pub(crate) fn pack(marginal: &Marginal) -> (Layout, Vec<f32>) {
    let columns = &marginal.columns;
    let kind = columns.kind;
    let layout = Layout {
        width: columns.width,
        height: columns.height,
        kind,
        leaves: marginal.pieces.len(),
        guide: marginal.by_weight.starts.len().div_ceil(STARTS),
        quantiles: columns.height.div_ceil(ROWS),
    };
    let mut packed = Vec::with_capacity(layout.len().map_or(0, |len| len as usize));
    packed.extend(layout.header());
    let margin = f64::from(margin(kind, columns.width));
    let leaves = marginal.pieces.iter().zip(marginal.cumulative.array_windows());
    let leaves: Vec<_> = leaves.map(|(piece, weights)| leaf(marginal, piece, *weights, margin)).collect();
    extend_guide::<WEIGHT>(&mut packed, &marginal.by_weight, &leaves);
    extend_guide::<BEGIN>(&mut packed, &marginal.by_place, &leaves);
    packed.extend(leaves.as_flattened().as_flattened());
    packed.extend(leaves.iter().flat_map(head));
    let border = kind.cells(layout.width) - layout.width;
    let last = layout.width - 1;
    let all = (0..layout.columns()).map(|column| column.saturating_sub(border).min(last));
    let nodes = packed.len();
    for column in all.clone() {
        extend_nodes(&mut packed, columns, column, marginal.scale);
    }
    let per = 0.25 * marginal.scale;
    for column in all {
        packed.extend(columns.values(column).iter().map(|&v| (f64::from(v) * per) as f32));
    }
    let quantiles = packed.len();
    packed.resize(quantiles + kind.cells(layout.width) * (layout.quantiles + 1), 0.0);
    let (before, quantiles) = packed.split_at_mut(quantiles);
    if let Some(nodes) = before.get(nodes..) {
        quantiles::fill(&layout, nodes, quantiles);
    }
    (layout, packed)
}

/// The integrals of a column, and in bilinear maps its values, on the grid lines.
fn extend_nodes(packed: &mut Vec<f32>, columns: &Columns, column: usize, scale: f64) {
    let (sums, values) = (columns.sums(column), columns.values(column));
    match columns.kind {
        Reconstruction::Constant => {
            packed.extend(sums.iter().map(|&sum| (sum * scale) as f32));
            packed.extend([f32::MAX; LINES - 1]);
        }
        Reconstruction::Bilinear => {
            // Block by block, so that the compiler vectorizes it.
            let mut nodes = [[0.0; 2]; 64];
            for (sums, values) in sums.chunks(64).zip(values.chunks(64)) {
                for (node, (&sum, &value)) in nodes.iter_mut().zip(sums.iter().zip(values)) {
                    *node = [(sum * scale) as f32, (f64::from(value) * scale) as f32];
                }
                packed.extend_from_slice(nodes.as_flattened().get(..2 * sums.len()).unwrap_or_default());
            }
            packed.extend_from_slice([[f32::MAX, 0.0]; LINES - 1].as_flattened());
        }
    }
}

/// For each group of parts of the guide the leaf there, and the keys of the next three.
fn extend_guide<const KEY: usize>(packed: &mut Vec<f32>, guide: &GuideTable, leaves: &[Leaf]) {
    let key = |leaf: u32| leaves.get(leaf as usize).map_or(f32::MAX, |leaf| leaf[0][KEY]);
    let entries = guide.starts.iter().step_by(STARTS);
    packed.extend(entries.flat_map(|&k| [f32::from_bits(k), key(k + 1), key(k + 2), key(k + 3)]));
}
