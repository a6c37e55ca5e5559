//! Layout of a packed map: its parts in their order.

use crate::map::packed::error::PackedMapError;
use crate::map::packed::record::{CUBIC, HEADER, LEAF};
use crate::map::reconstruction::Reconstruction;

/// The first number of every packed map: its format. Integers are written as the floats that have their bits.
pub(crate) const FORMAT: f32 = 2002.0;
/// Weights that are looked through at once, and so many follow the last.
pub(crate) const KEYS: usize = 2;
/// Lines of the grid that are looked through at once.
pub(crate) const LINES: usize = 8;
/// No part of a map has more entries.
const LARGEST: u32 = 1 << 28;

/// The sizes of the parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layout {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) kind: Reconstruction,
    /// Bins of a column of cells: a power of two.
    pub(crate) split: usize,
    /// Cubics of bins, and of the pieces of those that have more than one.
    pub(crate) cubics: usize,
    /// Bins and pieces that are one cubic.
    pub(crate) leaves: usize,
    /// Entries of the guide to the leaves: a power of two.
    pub(crate) guide: usize,
    /// Quantiles of a column, less one.
    pub(crate) quantiles: usize,
}

impl Layout {
    /// The layout that a header states, and the length of its array.
    pub(crate) fn read(header: &[f32]) -> Result<(Self, usize), PackedMapError> {
        let len = header.len();
        let Some(&[format, kind, width, height, split, cubics, leaves, guide, quantiles, ..]) =
            header.first_chunk::<HEADER>()
        else {
            return Err(PackedMapError::Length { expected: HEADER as u64, got: len });
        };
        if format != FORMAT {
            return Err(PackedMapError::Format { value: format });
        }
        let kind = match kind.to_bits() {
            0 => Reconstruction::Constant,
            1 => Reconstruction::Bilinear,
            value => return Err(PackedMapError::Header { index: 1, value }),
        };
        let mut sizes = [0; 7];
        let values = [width, height, split, cubics, leaves, guide, quantiles].map(f32::to_bits);
        for ((index, value), size) in values.into_iter().enumerate().zip(&mut sizes) {
            let power = index != 2 || value.is_power_of_two();
            if !(power && (1..=LARGEST).contains(&value)) {
                return Err(PackedMapError::Header { index: index + 2, value });
            }
            *size = value as usize;
        }
        let [width, height, split, cubics, leaves, guide, quantiles] = sizes;
        let layout = Self { width, height, kind, split, cubics, leaves, guide, quantiles };
        if cubics < layout.bins() {
            return Err(PackedMapError::Header { index: 5, value: cubics as u32 });
        }
        // With every size at most 2²⁴ this fits in 64 bits, and where it does not in usize, no slice is as long.
        let expected = layout.len().and_then(|len| usize::try_from(len).ok());
        match expected {
            Some(expected) if expected == len => Ok((layout, len)),
            _ => Err(PackedMapError::Length { expected: layout.len().unwrap_or(u64::MAX), got: len }),
        }
    }

    /// The header.
    #[cfg(feature = "alloc")]
    pub(crate) fn header(&self) -> [f32; HEADER] {
        let kind = match self.kind {
            Reconstruction::Constant => 0,
            Reconstruction::Bilinear => 1,
        };
        let sizes =
            [self.width, self.height, self.split, self.cubics, self.leaves, self.guide, self.quantiles]
                .map(|size| size as u32);
        let mut header = [0.0; HEADER];
        for (to, from) in header.iter_mut().zip([FORMAT.to_bits(), kind].into_iter().chain(sizes)) {
            *to = f32::from_bits(from);
        }
        header
    }

    /// Lengths of the parts, in their order: the guide, weights, leaves, cubics, quantiles, nodes.
    pub(crate) fn parts(&self) -> [Option<u64>; 6] {
        let [width, cubics, leaves, guide, quantiles] =
            [self.width, self.cubics, self.leaves, self.guide, self.quantiles].map(|size| size as u64);
        let cells = self.kind.cells(self.width) as u64;
        // Bilinear maps repeat their first and their last column, so that every cell lies between two.
        let columns = width + 2 * (cells - width);
        [
            Some(guide),
            Some(leaves + KEYS as u64),
            leaves.checked_mul(LEAF as u64),
            cubics.checked_mul(CUBIC as u64),
            cells.checked_mul(quantiles + 1),
            columns.checked_mul(self.stride() as u64),
        ]
    }

    /// Bins of all columns.
    pub(crate) const fn bins(&self) -> usize {
        self.kind.cells(self.width).saturating_mul(self.split)
    }

    /// Numbers of a column of nodes: an integral and a value for each line, and for those that fill the last look.
    pub(crate) const fn stride(&self) -> usize {
        2 * (self.kind.cells(self.height) + 1 + LINES)
    }

    pub(crate) fn len(&self) -> Option<u64> {
        self.parts().into_iter().try_fold(HEADER as u64, |sum, part| sum.checked_add(part?))
    }
}
