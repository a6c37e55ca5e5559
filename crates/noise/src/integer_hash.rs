//! An integer hash of cell and seed without visible period: the default lattice.

use crate::lattice::Lattice;

/// A 64-bit hash of cell and seed; the lattice has no period under 2³² cells.
///
/// ```text
/// h = x·P₁ + y·P₂ + z·P₃                          mod 2⁶⁴
/// h = (h ^ h ≫ 32)·M₁ ^ key(seed)
/// h = (h ^ h ≫ 29)·M₂,   word = h ^ h ≫ 32
/// ```
///
/// P are the fractions of g⁻¹, g⁻², g⁻³ with g⁴ = g + 1, which keep small cells far apart modulo 2⁶⁴; M₁ and M₂ are
/// the multipliers of SplitMix64 (Steele, Lea, Flood 2014); key is SplitMix64's finaliser of the seed. The seed enters
/// between two rounds, so no lattice is another one's translate. In 2-D z is 0.
///
/// - **Measured:** flipping one bit of x, y, z or the seed flips each bit of the word with probability 0.5.
///
/// ```
/// use asperity_noise::{IntegerHash, Lattice};
///
/// let flipped = IntegerHash.hash3(4, -7, 0, 1) ^ IntegerHash.hash3(-7, 4, 0, 1);
/// assert!((16..=48).contains(&flipped.count_ones()));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct IntegerHash;

impl Lattice for IntegerHash {
    #[inline(always)]
    fn hash2(&self, x: i32, y: i32, seed: u32) -> u64 {
        hash(term(x, P1).wrapping_add(term(y, P2)), seed)
    }

    #[inline(always)]
    fn hash3(&self, x: i32, y: i32, z: i32, seed: u32) -> u64 {
        hash(term(x, P1).wrapping_add(term(y, P2)).wrapping_add(term(z, P3)), seed)
    }
}

const P1: u64 = 0xd1b5_4a32_d192_ed03;
const P2: u64 = 0xabc9_8388_fb8f_ac03;
const P3: u64 = 0x8cb9_2ba7_2f3d_8dd7;
const M1: u64 = 0xbf58_476d_1ce4_e5b9;
const M2: u64 = 0x94d0_49bb_1331_11eb;
/// The increment of SplitMix64, 2⁶⁴ over the golden ratio.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

#[inline(always)]
fn term(coordinate: i32, multiplier: u64) -> u64 {
    (i64::from(coordinate) as u64).wrapping_mul(multiplier)
}

#[inline(always)]
fn hash(point: u64, seed: u32) -> u64 {
    let h = (point ^ (point >> 32)).wrapping_mul(M1) ^ mix(u64::from(seed));
    let h = (h ^ (h >> 29)).wrapping_mul(M2);
    h ^ (h >> 32)
}

/// SplitMix64's output for the state `counter`·γ: a bijection with full avalanche.
#[inline(always)]
pub(crate) fn mix(counter: u64) -> u64 {
    let z = counter.wrapping_add(1).wrapping_mul(GOLDEN);
    let z = (z ^ (z >> 30)).wrapping_mul(M1);
    let z = (z ^ (z >> 27)).wrapping_mul(M2);
    z ^ (z >> 31)
}

/// A second word from a first, for the second channel of a noise.
///
/// ```text
/// h = word·⌊2⁶⁴/φ⌋,   second = h ^ h ≫ 32          φ = (1 + √5)/2
/// ```
///
/// A bijection, but the bits that a variate is made of show no dependence on those of any variate of the first word.
#[must_use]
#[inline(always)]
pub const fn second_word(word: u64) -> u64 {
    let h = word.wrapping_mul(GOLDEN);
    h ^ (h >> 32)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The shares of flips of each bit of the word over `COUNT` points when one bit of an input is flipped.
    #[test]
    fn every_input_bit_flips_every_output_bit_half_the_time() {
        const COUNT: u32 = 1024;
        // 6 standard errors of ½ over 1024 trials, for 8192 pairs of bits.
        const TOLERANCE: f64 = 6.0 * 0.5 / 32.0;
        for input in 0..128 {
            let mut flips = [0_u32; 64];
            for i in 0..COUNT {
                let near = [(i & 31) as i32 - 16, (i >> 5) as i32 - 16, (i % 7) as i32, (i % 5) as i32];
                let mut far = near;
                far[input / 32] ^= 1 << (input % 32);
                let word = |[x, y, z, seed]: [i32; 4]| IntegerHash.hash3(x, y, z, seed as u32);
                let flipped = word(near) ^ word(far);
                for (bit, flips) in flips.iter_mut().enumerate() {
                    *flips += (flipped >> bit & 1) as u32;
                }
            }
            for (bit, flips) in flips.into_iter().enumerate() {
                let share = f64::from(flips) / f64::from(COUNT);
                assert!((share - 0.5).abs() < TOLERANCE, "input bit {input}, output bit {bit}: {share}");
            }
        }
    }

    #[test]
    fn variates_of_both_words_are_independent() {
        // The twelve-bit fields from bits 4, 16, 28, 40 and 52, by their upper four bits.
        let fields = |word: u64| [12, 24, 36, 48, 60].map(|shift| (word >> shift & 15) as usize);
        let mut tables = [[[[0_u32; 16]; 16]; 5]; 5];
        for i in 0..65_536 {
            let word = IntegerHash.hash3(i & 255, i >> 8, 3, 1);
            for (first, tables) in fields(word).into_iter().zip(&mut tables) {
                for (second, table) in fields(second_word(word)).into_iter().zip(tables) {
                    table[first][second] += 1;
                }
            }
        }
        for table in tables.as_flattened() {
            let chi_square: f64 = table
                .as_flattened()
                .iter()
                .map(|&n| (f64::from(n) - 256.0) * (f64::from(n) - 256.0) / 256.0)
                .sum();
            // The quantile 1 − 0.001/25 of χ² with 255 degrees of freedom is 354.
            assert!(chi_square < 354.0, "chi square {chi_square}");
        }
    }

    #[test]
    fn the_plane_is_space_at_zero() {
        assert_eq!(IntegerHash.hash2(5, -9, 3), IntegerHash.hash3(5, -9, 0, 3));
    }
}
