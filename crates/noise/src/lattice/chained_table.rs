//! The chained lookups of Nilsson 2008: a permutation in a texture, read once per axis.

use asperity_core::SplitMix64;

use crate::{lattice::lattice::Lattice, lattice::permutation_table::PermutationTable};

/// A random permutation in a texture of 256 texels, read once per axis.
///
/// Each lookup starts where the previous lookup leads.
///
/// ```text
/// v = 0;  for each axis: v = T(xᵢ/(256 size) + v),   T(u) = entry[⌊256 (u − ⌊u⌋)⌋]/255
/// ```
///
/// T is a texture of bytes, sampled at points and repeated. The first axis is read first. A byte of
/// 255 is v = 1, one whole turn. Any other byte k moves by k + k/255 texels: cells of different
/// columns are shifted by k/255 of a cell. Only 256 different values exist. The period is 256·size
/// along each axis.
///
/// [`prng`](Self::prng) is the original function. As a [`Lattice`] the table is read at integers,
/// with size 1 and one addition per dimension. Byte and seed are mixed to a word as in
/// [`PermutationTable`]. Use [`IntegerHash`](crate::IntegerHash) unless you reproduce the original.
///
/// Nilsson 2008, "Procedural Generation of Natural Variations in Materials and Surfaces", section
/// 4.1.2. The text does not define the format of the texture. Bytes are the 256 values that it
/// mentions.
///
/// ```
/// use asperity_noise::lattice::{ChainedTable, PermutationTable};
///
/// let table = ChainedTable(PermutationTable::new(7));
/// let cell = f32::from(table.index([3, -1, 40])) / 255.0;
/// assert_eq!(table.prng([3.0, -1.0, 40.0], 1.0), cell);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChainedTable(
    /// The texture.
    pub PermutationTable,
);

impl ChainedTable {
    /// Evaluates the original function: v after the lookups of all axes, in [0, 1].
    ///
    /// Products, quotients and sums are rounded to `f32`, in the order of the listing. A coordinate
    /// that is not finite reads the first texel.
    #[must_use]
    #[inline]
    pub fn prng<const N: usize>(&self, position: [f32; N], size: f32) -> f32 {
        let mut v = 0.0;
        for x in position {
            v = self.texel(x / (size * 256.0) + v);
        }
        v
    }

    /// The texture at u, repeated; bytes are fractions of 255.
    #[inline]
    fn texel(&self, u: f32) -> f32 {
        let mut texel = 0;
        // From 2²³ on every `f32` is an integer.
        if u.abs() < 8_388_608.0 {
            let truncated = u as i32 as f32;
            let floor = if u < truncated { truncated - 1.0 } else { truncated };
            // Just under an integer the fraction rounds to 1.
            texel = ((u - floor) * 256.0) as u32 & 255;
        }
        f32::from(self.0.entries()[texel as usize]) / 255.0
    }

    /// Returns the byte of a cell: the original at the cell's corner, size 1, without rounding.
    #[must_use]
    #[inline]
    pub fn index<const N: usize>(&self, cell: [i32; N]) -> u8 {
        let mut byte = 0;
        for x in cell {
            // A byte k moves by 256 k/255 texels.
            let shift = i32::from(byte) + i32::from(byte == 255);
            byte = self.0.entries()[(x.wrapping_add(shift) & 255) as usize];
        }
        byte
    }
}

impl Lattice for ChainedTable {
    #[inline]
    fn word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
        (SplitMix64::nth((u64::from(seed) << 8) | u64::from(self.index(cell))) >> 32) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chained_table_matches_prng_at_integers() {
        let table = ChainedTable(PermutationTable::new(3));
        let mut whole_turns = 0;
        for i in -2000..2000_i16 {
            let cell = [i, 7 - i / 3, i % 19, -i / 5];
            let position = cell.map(f32::from);
            let byte = table.index(cell.map(i32::from));
            assert_eq!(table.prng(position, 1.0), f32::from(byte) / 255.0, "{cell:?}");
            // A power of two as size is exact, too.
            assert_eq!(table.prng(position.map(|x| 4.0 * x), 4.0), f32::from(byte) / 255.0, "{cell:?}");
            whole_turns += u32::from(table.index([i32::from(i)]) == 255);
        }
        assert!(whole_turns > 10);
    }

    #[test]
    fn chained_table_first_lookup() {
        let table = ChainedTable(PermutationTable::new(9));
        for x in -300..300_i32 {
            assert_eq!(table.index([x]), table.0.entries()[(x & 255) as usize]);
        }
        assert_eq!(table.index([5, 9]), table.index([5 + 256, 9 - 512]));
        assert_ne!(table.word([5, 9, 1], 1), table.word([5, 9, 1], 2));
    }

    #[test]
    fn chained_table_is_total() {
        let table = ChainedTable(PermutationTable::new(3));
        let first = f32::from(table.0.entries()[0]) / 255.0;
        for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX] {
            assert_eq!(table.prng([x], 1.0), first);
        }
        assert_eq!(table.prng([-1e-12], 1.0), first);
        assert_eq!(table.prng([3.0], 0.0), first);
    }
}
