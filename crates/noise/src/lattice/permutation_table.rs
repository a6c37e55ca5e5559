//! The permutation table of 256 entries of Ebert (ed.) 1994, the classic lattice with its period.

use asperity_core::SplitMix64;

use crate::{error::NoiseError, lattice::lattice::Lattice};

/// A random permutation of 0…255 that hashes a cell to a byte, with period 256 along each axis.
///
/// ```text
/// index = perm[(x + perm[(y + perm[z & 255]) & 255]) & 255]
/// word  = SplitMix64(index, seed)
/// ```
///
/// Only 256 different words exist per seed, and cells that are equal for one seed are equal for
/// every seed. Two seeds correlate by ±0.04, which is the spread of 256 samples. Use
/// [`IntegerHash`](crate::IntegerHash) unless you need the classic look or its period. In 2-D z is
/// 0.
///
/// Ebert (ed.) 1994, "Texturing and Modeling"; Perlin 1985.
///
/// ```
/// use asperity_noise::{Lattice, lattice::PermutationTable};
///
/// let table = PermutationTable::new(7);
/// assert_eq!(table.word([1, 2, 3], 0), table.word([1 + 256, 2 - 256, 3], 0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PermutationTable {
    entries: [u8; 256],
}

impl PermutationTable {
    /// Creates the permutation of a seed by a Fisher–Yates shuffle with SplitMix64.
    #[must_use]
    pub fn new(seed: u32) -> Self {
        let mut entries = [0_u8; 256];
        for (entry, value) in entries.iter_mut().zip(0..=u8::MAX) {
            *entry = value;
        }
        for last in (1..256_usize).rev() {
            let random = SplitMix64::nth((u64::from(seed) << 8) | last as u64) >> 32;
            entries.swap(last, ((random * (last as u64 + 1)) >> 32) as usize);
        }
        Self { entries }
    }

    /// Creates a table from a given permutation, such as a published permutation.
    ///
    /// # Errors
    ///
    /// If a number occurs twice.
    ///
    /// ```
    /// use asperity_noise::lattice::PermutationTable;
    ///
    /// let reversed = core::array::from_fn(|i| 255 - i as u8);
    /// assert_eq!(PermutationTable::from_entries(reversed)?.index(1, 0, 0), 254);
    /// assert!(PermutationTable::from_entries([7; 256]).is_err());
    /// # Ok::<(), asperity_noise::NoiseError>(())
    /// ```
    pub const fn from_entries(entries: [u8; 256]) -> Result<Self, NoiseError> {
        let mut seen = [false; 256];
        let mut i = 0;
        while i < 256 {
            let entry = entries[i];
            if seen[entry as usize] {
                return Err(NoiseError::DuplicateEntry { index: i, entry });
            }
            seen[entry as usize] = true;
            i += 1;
        }
        Ok(Self { entries })
    }

    /// Returns the permutation.
    #[must_use]
    pub const fn entries(&self) -> &[u8; 256] {
        &self.entries
    }

    /// Returns the byte of a lattice point, the index of the formula.
    #[must_use]
    #[inline]
    pub const fn index(&self, x: i32, y: i32, z: i32) -> u8 {
        let z = self.entries[(z & 255) as usize] as i32;
        let y = self.entries[(y.wrapping_add(z) & 255) as usize] as i32;
        self.entries[(x.wrapping_add(y) & 255) as usize]
    }
}

impl Lattice for PermutationTable {
    #[inline]
    fn word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
        let mut coordinates = cell.iter().copied();
        let [x, y, z, w] = [(); 4].map(|()| coordinates.next().unwrap_or(0));
        // Below 4-D w is 0, and the inner lookup of the formula is omitted.
        let z = if N > 3 { z.wrapping_add(i32::from(self.entries[(w & 255) as usize])) } else { z };
        (SplitMix64::nth((u64::from(seed) << 8) | u64::from(self.index(x, y, z))) >> 32) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_permutations_are_accepted() {
        let table = PermutationTable::new(5);
        assert_eq!(PermutationTable::from_entries(*table.entries()), Ok(table));
        let mut entries = *table.entries();
        entries[200] = entries[17];
        let error = NoiseError::DuplicateEntry { index: 200, entry: entries[17] };
        assert_eq!(PermutationTable::from_entries(entries), Err(error));
    }

    #[test]
    fn entries_are_a_permutation() {
        for seed in 0..64 {
            let mut seen = [false; 256];
            for &entry in PermutationTable::new(seed).entries() {
                seen[usize::from(entry)] = true;
            }
            assert_eq!(seen, [true; 256], "seed {seed}");
        }
        assert_ne!(PermutationTable::new(0), PermutationTable::new(1));
    }

    #[test]
    fn index_matches_formula() {
        let table = PermutationTable::new(3);
        let perm = |i: i32| i32::from(table.entries()[(i & 255) as usize]);
        for (x, y, z) in [(0, 0, 0), (1, 2, 3), (-1, -300, 77), (1000, -2000, 255), (250, 250, 250)] {
            let expected = perm((x + perm((y + perm(z & 255)) & 255)) & 255);
            assert_eq!(i32::from(table.index(x, y, z)), expected, "({x}, {y}, {z})");
        }
        assert_eq!(table.index(i32::MAX, i32::MAX, i32::MAX), table.index(-1, -1, -1));
    }
}
