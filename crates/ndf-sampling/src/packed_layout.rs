//! Where the parts of a packed map lie in its array.

use crate::packed::PackedMapError;
use crate::reconstruction::Reconstruction;

/// The first number of every packed map: its format. Integers are written as the floats that have their bits.
pub(crate) const FORMAT: f32 = 2001.0;
/// Numbers before the first part.
pub(crate) const HEADER: usize = 16;
/// Numbers of a slab.
pub(crate) const SLAB: usize = 16;
/// Keys that are looked through at once, and behind the last of which so many follow.
pub(crate) const KEYS: usize = 4;
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
    /// Pieces of the marginal.
    pub(crate) slabs: usize,
    /// Entries of each of the two guides: a power of two.
    pub(crate) guide: usize,
    /// Quantiles of a column, less one.
    pub(crate) quantiles: usize,
}

impl Layout {
    /// The layout that a header states, and the length of its array.
    pub(crate) fn read(header: &[f32]) -> Result<(Self, usize), PackedMapError> {
        let len = header.len();
        let Some(&[format, kind, width, height, slabs, guide, quantiles, ..]) =
            header.first_chunk::<HEADER>()
        else {
            return Err(PackedMapError::NoHeader { len });
        };
        if format != FORMAT {
            return Err(PackedMapError::Format { value: format });
        }
        let kind = match kind.to_bits() {
            0 => Reconstruction::Constant,
            1 => Reconstruction::Bilinear,
            value => return Err(PackedMapError::Header { index: 1, value }),
        };
        let mut sizes = [0; 5];
        let values = [width, height, slabs, guide, quantiles].map(f32::to_bits);
        for ((index, value), size) in values.into_iter().enumerate().zip(&mut sizes) {
            if !(1..=LARGEST).contains(&value) {
                return Err(PackedMapError::Header { index: index + 2, value });
            }
            *size = value as usize;
        }
        let [width, height, slabs, guide, quantiles] = sizes;
        let layout = Self { width, height, kind, slabs, guide, quantiles };
        // With every size at most 2²⁴ this fits in 64 bits, and where it does not in usize, no slice is as long.
        let expected = layout.len().and_then(|len| usize::try_from(len).ok());
        match expected {
            Some(expected) if expected == len => Ok((layout, len)),
            _ => Err(PackedMapError::Length { expected: layout.len().unwrap_or(u64::MAX), len }),
        }
    }

    /// The header, without the scale.
    #[cfg(feature = "alloc")]
    pub(crate) fn header(&self) -> [f32; HEADER] {
        let kind = match self.kind {
            Reconstruction::Constant => 0,
            Reconstruction::Bilinear => 1,
        };
        let sizes = [self.width, self.height, self.slabs, self.guide, self.quantiles].map(|size| size as u32);
        let mut header = [0.0; HEADER];
        for (to, from) in header.iter_mut().zip([FORMAT.to_bits(), kind].into_iter().chain(sizes)) {
            *to = f32::from_bits(from);
        }
        header
    }

    /// How long the parts are, in their order: weights, places, the guides to both, slabs, quantiles, sums, values.
    pub(crate) fn parts(&self) -> [Option<u64>; 8] {
        let [width, height, slabs, guide, quantiles] =
            [self.width, self.height, self.slabs, self.guide, self.quantiles].map(|size| size as u64);
        let cells = self.kind.cells(self.width) as u64;
        // Bilinear maps repeat their first and their last column, so that every cell lies between two.
        let columns = width + 2 * (cells - width);
        [
            Some(slabs + 1 + KEYS as u64),
            Some(slabs + 1 + KEYS as u64),
            Some(guide),
            Some(guide),
            Some(slabs * SLAB as u64),
            cells.checked_mul(quantiles + 1),
            columns.checked_mul(self.lines() as u64),
            columns.checked_mul(height + 2),
        ]
    }

    /// Lines of the grid in a column, with those that fill the last look.
    pub(crate) fn lines(&self) -> usize {
        self.kind.cells(self.height) + 1 + LINES
    }

    /// Values in a column.
    pub(crate) const fn stride(&self) -> usize {
        self.height + 2
    }

    pub(crate) fn len(&self) -> Option<u64> {
        self.parts().into_iter().try_fold(HEADER as u64, |sum, part| sum.checked_add(part?))
    }
}
