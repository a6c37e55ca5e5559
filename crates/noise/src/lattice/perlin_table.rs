//! The lattice of Perlin's reference implementation of 2002: its permutation, lookup order and
//! gradients.

use asperity_core::SplitMix64;

use crate::{lattice::edges::EDGE_MAXIMUM, lattice::lattice::Lattice, lattice::variates::MARGIN};

/// The lattice of Perlin's reference implementation of 2002, with period 256 along each axis.
///
/// Twelve gradients fill a table of sixteen.
///
/// ```text
/// h = p[p[p[x] + y] + z] mod 16,   gradient h of his listing
/// ```
///
/// With this lattice [`Perlin`](crate::Perlin) in 3-D is the reference noise divided by
/// [`SCALE`](Self::SCALE). Seed 0 gives the seedless reference. Another seed moves the lattice by
/// that number of cells along x. The reference does not define other dimensions. There, words are
/// drawn from the last of one lookup per axis.
///
/// Perlin 2002, "Improved Noise reference implementation", <https://mrl.cs.nyu.edu/~perlin/noise/>.
///
/// ```
/// use asperity_noise::{Field, Perlin, glam::Vec3, lattice::PerlinTable, ops::ScaleBias};
///
/// let noise = ScaleBias(Perlin::new(0).with_lattice(PerlinTable), PerlinTable::SCALE, 0.0);
/// assert!((noise.value(Vec3::new(3.14, 42.0, 7.0)) - 0.136_919_95).abs() < 3e-7);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PerlinTable;

impl PerlinTable {
    /// Scale of the reference noise relative to [`Perlin`](crate::Perlin), whose range is
    /// [−1, 1].
    pub const SCALE: f32 = EDGE_MAXIMUM[2] / MARGIN;

    /// Returns the byte `p[…p[p[x] + y]…]` of a cell.
    #[must_use]
    #[inline]
    pub fn index<const N: usize>(&self, cell: [i32; N]) -> u8 {
        cell.into_iter().fold(0, |byte, x| PERMUTATION[(x.wrapping_add(i32::from(byte)) & 255) as usize])
    }
}

impl Lattice for PerlinTable {
    #[inline]
    fn word<const N: usize>(&self, mut cell: [i32; N], seed: u32) -> u32 {
        if let Some(x) = cell.first_mut() {
            *x = x.wrapping_add(seed as i32);
        }
        let byte = self.index(cell);
        if N == 3 { WORDS[usize::from(byte) & 15] } else { (SplitMix64::nth(u64::from(byte)) >> 32) as u32 }
    }
}

/// The words from which [`Perlin::gradient`](crate::Perlin::gradient) makes the gradients of the
/// reference.
const WORDS: [u32; 16] = {
    // The axis along which the gradient is 0, and the axes with a minus sign as bits from the
    // lowest.
    const GRADIENTS: [(u32, u32); 16] = [
        (2, 0b000),
        (2, 0b001),
        (2, 0b010),
        (2, 0b011),
        (1, 0b000),
        (1, 0b001),
        (1, 0b100),
        (1, 0b101),
        (0, 0b000),
        (0, 0b010),
        (0, 0b100),
        (0, 0b110),
        (2, 0b000),
        (0, 0b010),
        (2, 0b001),
        (0, 0b110),
    ];
    let mut words = [0; 16];
    let mut h = 0;
    while h < 16 {
        let (axis, signs) = GRADIENTS[h];
        // The middle of the third of signed numbers that selects the axis.
        let third = 0x2aaa_aaaa_u32.wrapping_add(0x5555_5555 * axis) ^ 0x8000_0000;
        words[h] = third >> 3 | (signs & 1) << 31 | (signs >> 1 & 1) << 30 | (signs >> 2) << 29;
        h += 1;
    }
    words
};

/// The permutation that is printed in the reference implementation.
#[rustfmt::skip]
const PERMUTATION: [u8; 256] = [
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225, 140, 36, 103, 30, 69, 142, 8, 99, 37, 240, 21, 10, 23,
    190, 6, 148, 247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219, 203, 117, 35, 11, 32, 57, 177, 33, 88, 237, 149, 56, 87, 174, 20,
    125, 136, 171, 168, 68, 175, 74, 165, 71, 134, 139, 48, 27, 166, 77, 146, 158, 231, 83, 111, 229, 122, 60, 211, 133, 230, 220,
    105, 92, 41, 55, 46, 245, 40, 244, 102, 143, 54, 65, 25, 63, 161, 1, 216, 80, 73, 209, 76, 132, 187, 208, 89, 18, 169, 200,
    196, 135, 130, 116, 188, 159, 86, 164, 100, 109, 198, 173, 186, 3, 64, 52, 217, 226, 250, 124, 123, 5, 202, 38, 147, 118, 126,
    255, 82, 85, 212, 207, 206, 59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213, 119, 248, 152, 2, 44, 154, 163, 70,
    221, 153, 101, 155, 167, 43, 172, 9, 129, 22, 39, 253, 19, 98, 108, 110, 79, 113, 224, 232, 178, 185, 112, 104, 218, 246, 97,
    228, 251, 34, 242, 193, 238, 210, 144, 12, 191, 179, 162, 241, 81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31, 181, 199,
    106, 157, 184, 84, 204, 176, 115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93, 222, 114, 67, 29, 24, 72, 243, 141, 128,
    195, 78, 66, 215, 61, 156, 180,
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{Arithmetic, Scalar};
    use crate::lattice::edges::{Lengths, edge_direction};
    use crate::lattice::permutation_table::PermutationTable;

    #[test]
    fn perlin_table_gradients_match_reference() {
        assert!(PermutationTable::from_entries(PERMUTATION).is_ok());
        let p = [0.25, 4.0, -64.0];
        for (h, word) in WORDS.into_iter().enumerate() {
            let [x, y, z] = p;
            let u = if h < 8 { x } else { y };
            let v = if h < 4 {
                y
            } else if h == 12 || h == 14 {
                x
            } else {
                z
            };
            let listed = if h & 1 == 0 { u } else { -u } + if h & 2 == 0 { v } else { -v };
            let gradient = edge_direction::<_, 3>(Scalar, Scalar.word(word), &Lengths::new(1.0));
            let drawn: f32 = gradient.iter().zip(p).map(|(g, x)| g * x).sum();
            assert_eq!(drawn, listed, "{h}");
        }
    }
}
