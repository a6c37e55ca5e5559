//! Layout of a packed map: its parts in order.

use crate::error::NdfError;
use crate::map::reconstruction::Reconstruction;

/// Numbers before the first part of a map.
pub(crate) const HEADER: usize = 16;
/// The first number of every packed map, which identifies the format.
///
/// Integers are stored as the floats with their bits.
const FORMAT: f32 = 2003.0;
/// Grid lines that are read together; one fewer follow the last.
pub(crate) const LINES: usize = 4;
/// The maximum number of entries of a part.
const LARGEST: u32 = 1 << 28;

/// The sizes of the parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layout {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) kind: Reconstruction,
    /// Pieces of the marginal.
    pub(crate) leaves: usize,
    /// Entries of each guide to them: a power of two.
    pub(crate) guide: usize,
    /// Quantiles of a column, minus one.
    pub(crate) quantiles: usize,
}

impl Layout {
    /// Reads the layout from the header of an array, which must have the length it requires.
    pub(crate) fn read(array: &[f32]) -> Result<Self, NdfError> {
        let len = array.len();
        let Some(&[format, kind, width, height, leaves, guide, quantiles, ..]) =
            array.first_chunk::<HEADER>()
        else {
            return Err(NdfError::Length { parameter: "array", expected: HEADER, got: len });
        };
        if format != FORMAT {
            return Err(NdfError::Format { value: format });
        }
        let kind = match kind.to_bits() {
            0 => Reconstruction::Constant,
            1 => Reconstruction::Bilinear,
            value => return Err(NdfError::Header { index: 1, value }),
        };
        let mut sizes = [0; 5];
        let values = [width, height, leaves, guide, quantiles].map(f32::to_bits);
        for ((index, value), size) in values.into_iter().enumerate().zip(&mut sizes) {
            let power = index != 3 || value.is_power_of_two();
            if !(power && (1..=LARGEST).contains(&value)) {
                return Err(NdfError::Header { index: index + 2, value });
            }
            *size = value as usize;
        }
        let [width, height, leaves, guide, quantiles] = sizes;
        let layout = Self { width, height, kind, leaves, guide, quantiles };
        // A length that overflows usize does not match any slice.
        match layout.len().and_then(|len| usize::try_from(len).ok()).unwrap_or(usize::MAX) {
            expected if expected == len => Ok(layout),
            expected => Err(NdfError::Length { parameter: "array", expected, got: len }),
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
            [self.width, self.height, self.leaves, self.guide, self.quantiles].map(|size| size as u32);
        let mut header = [0.0; HEADER];
        for (to, from) in header.iter_mut().zip([FORMAT.to_bits(), kind].into_iter().chain(sizes)) {
            *to = f32::from_bits(from);
        }
        header
    }

    /// Lengths of the parts in order.
    ///
    /// They are the guides by weight and by position, leaves, their heads, nodes, texels,
    /// quantiles.
    pub(crate) fn parts(&self) -> [Option<u64>; 7] {
        let [columns, cells, leaves, guide, quantiles] =
            [self.columns(), self.kind.cells(self.width), self.leaves, self.guide, self.quantiles]
                .map(|size| size as u64);
        [
            guide.checked_mul(4),
            guide.checked_mul(4),
            leaves.checked_mul(16),
            leaves.checked_mul(4),
            columns.checked_mul(self.stride() as u64),
            columns.checked_mul(self.texel_stride() as u64),
            cells.checked_mul(quantiles + 1),
        ]
    }

    /// Columns of nodes and texels.
    ///
    /// Bilinear maps repeat the first and the last, so that every cell lies between two.
    pub(crate) const fn columns(&self) -> usize {
        2 * self.kind.cells(self.width) - self.width
    }

    /// Numbers of a column of nodes: for each line an integral, and in bilinear maps a value.
    pub(crate) const fn stride(&self) -> usize {
        self.kind.sides() * (self.kind.cells(self.height) + LINES)
    }

    /// Numbers of a column of texels.
    pub(crate) const fn texel_stride(&self) -> usize {
        2 * self.kind.cells(self.height) - self.height
    }

    pub(crate) fn len(&self) -> Option<u64> {
        self.parts().into_iter().try_fold(HEADER as u64, |sum, part| sum.checked_add(part?))
    }
}
