//! An integer hash of cell and seed without a visible period, the default lattice.

use asperity_core::SplitMix64;

use crate::{
    lanes::Lanes,
    lattice::lattice::{IS_FULL, Lattice, words_by_terms},
};

/// A 32-bit hash of cell and seed.
///
/// ```text
/// h = f(x·P₁) ^ f((y + D₂)·P₂) ^ f((z + D₃)·P₃) ^ f((w + D₄)·P₄)   mod 2³²,   f(t) = t ^ t ≫ 16
/// h = h·M₁ + key(seed)
/// h = (h ^ h ≫ 15)·M₂,   word = h ^ h ≫ 16
/// ```
///
/// P are 2³² times the fractional parts of g⁻¹ … g⁻⁴ with g⁵ = g + 1, made odd, which keeps small
/// cells far apart. They are joined by exclusive or, because a sum has translations that map the
/// lattice onto itself. However, −a ^ −b is a ^ b for a third of all words, so a lattice has
/// reflections of two axes at once that preserve a third of it. The offsets D put their centers
/// more than 2²⁸ cells away. M₁ and M₂ are the multipliers of Wellons's search for 32-bit mixers of
/// minimum bias (2018). key is SplitMix64's finalizer of the seed (Steele, Lea, Flood 2014). It is
/// added between two rounds, so no seed's lattice is a translation of another.
///
/// In fewer dimensions the missing coordinates are −D: the 2-D lattice is a section of the 3-D
/// lattice.
///
/// [`ValueNoise`](crate::ValueNoise), [`Perlin`](crate::Perlin) and [`Simplex`](crate::Simplex) use
/// [`upper_word`](Lattice::upper_word), which takes one product per point, the square of the joined
/// terms:
/// ```text
/// h = (f(x·P₁) + key(seed)) ^ f((y + D₂)·P₂) ^ …,   upper = h·(h | 1)   mod 2³²
/// ```
///
/// In a square the upper bits depend on all of h, in contrast to a product with a constant. In 1-D,
/// where nothing is joined, h = h ^ h ≫ 15 precedes it.
///
/// - **Measured avalanche:** flipping one bit of a coordinate or the seed flips each bit of the
///   word with probability 0.5 ± 0.1. For the upper word this holds for its upper eight bits and
///   the coordinates' bits below 2²⁰.
///
/// ```
/// use asperity_noise::{IntegerHash, Lattice};
///
/// let flipped = IntegerHash.word([4, -7, 0], 1) ^ IntegerHash.word([-7, 4, 0], 1);
/// assert!((6..=26).contains(&flipped.count_ones()));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct IntegerHash;

const P: [u32; 4] = [0xdb4f_0b91, 0xbbe0_5633, 0xa0f2_ec75, 0x89e1_8285];
/// D·P, 0 for one axis; no two axes have their centers close together.
const SHIFT: [u32; 4] = [
    0,
    0x2545_f491_u32.wrapping_mul(P[1]),
    0x3c6e_f372_u32.wrapping_mul(P[2]),
    0x1b87_3593_u32.wrapping_mul(P[3]),
];
const M1: u32 = 0x7feb_352d;
const M2: u32 = 0x846c_a68b;
/// 2³² over the golden ratio, made odd.
const GOLDEN: u32 = 0x9e37_79b9;

impl Lattice for IntegerHash {
    const STANDARD: bool = IS_FULL;

    words_by_terms!();

    #[inline(always)]
    fn copied(&self) -> Option<Self> {
        Some(*self)
    }

    /// SplitMix64's finalizer of the seed.
    #[inline(always)]
    fn key(&self, seed: u32) -> u32 {
        (SplitMix64::nth(u64::from(seed)) >> 32) as u32
    }

    #[inline(always)]
    fn term<S: Lanes>(&self, s: S, axis: usize, cell: S::U) -> S::U {
        folded(s, cell * s.word(P[axis & 3]) + s.word(SHIFT[axis & 3]))
    }

    #[inline(always)]
    fn terms<S: Lanes>(&self, s: S, axis: usize, cell: S::U) -> [S::U; 2] {
        let low = cell * s.word(P[axis & 3]) + s.word(SHIFT[axis & 3]);
        [folded(s, low), folded(s, low + s.word(P[axis & 3]))]
    }

    #[inline(always)]
    fn words<S: Lanes, const N: usize>(&self, s: S, terms: [S::U; N], seed: u32) -> S::U {
        let mut h = terms[0];
        for axis in 1..N {
            h = h ^ terms[axis];
        }
        let h = h * s.word(M1) + s.keys(|| self.key(seed));
        let h = (h ^ s.shr::<15>(h)) * s.word(M2);
        h ^ s.shr::<16>(h)
    }

    #[inline(always)]
    fn upper_words<S: Lanes, const N: usize>(&self, s: S, terms: [S::U; N], seed: u32) -> S::U {
        let mut h = terms[0] + s.keys(|| self.key(seed));
        if N == 1 {
            h = h ^ s.shr::<15>(h);
        }
        for axis in 1..N {
            h = h ^ terms[axis];
        }
        h * (h | s.word(1))
    }
}

/// t ^ t ≫ 16 of a product, once for all points with the same term; the shift commutes with
/// exclusive or.
#[inline(always)]
fn folded<S: Lanes>(s: S, t: S::U) -> S::U {
    t ^ s.shr::<16>(t)
}

/// Another word of a lattice point, for noises that need more than 32 bits of it.
///
/// ```text
/// h = word + K·⌊2³²/φ⌋,   h = (h ^ h ≫ 15)·M₂,   h ^ h ≫ 16
/// ```
///
/// A bijection for every K. Pairs of K = 1, 2, 3 and 6 are almost independent: Cramér's V is at
/// most 8e-4 over 64 × 64 classes of 16-bit fields, 2²⁷ words.
#[inline(always)]
pub(crate) fn further<S: Lanes, const K: u32>(s: S, word: S::U) -> S::U {
    let h = word + s.word(GOLDEN.wrapping_mul(K));
    let h = (h ^ s.shr::<15>(h)) * s.word(M2);
    h ^ s.shr::<16>(h)
}

/// Multipliers of other hashes.
pub(crate) const MULTIPLIERS: [u32; 5] = [0x846c_a68b, 0x9e37_79b1, 0xc2b2_ae3d, 0x2c1b_3c6d, 0x297a_2d39];

/// One of five words of a lattice point, its word times one of the [`MULTIPLIERS`]; source of
/// Gaussian variates.
///
/// ```text
/// h = (word ^ word ≫ 15)·Mₖ,   h ^ h ≫ 16
/// ```
///
/// A bijection for every k. No two 16-bit fields of the word and these five show dependence: χ²
/// over 64 × 64 classes is within 4 standard deviations for all 66 pairs and 2³⁰ words.
#[inline(always)]
pub(crate) fn multiplied<S: Lanes>(s: S, word: S::U, multiplier: S::U) -> S::U {
    let h = (word ^ s.shr::<15>(word)) * multiplier;
    h ^ s.shr::<16>(h)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{Arithmetic, Scalar};
    use approx::abs_diff_eq;

    /// The fractions of flips of each bit of the word over `COUNT` points when one bit of an input
    /// is flipped.
    #[test]
    fn integer_hash_avalanche() {
        const COUNT: u32 = 1024;
        // 6 standard errors of ½ over 1024 trials, for 5120 pairs of bits.
        const TOLERANCE: f64 = 6.0 * 0.5 / 32.0;
        for input in 0..160 {
            let mut flips = [0_u32; 32];
            for i in 0..COUNT {
                let near = [
                    (i & 31) as i32 - 16,
                    (i >> 5) as i32 - 16,
                    (i % 7) as i32,
                    (i % 11) as i32,
                    (i % 5) as i32,
                ];
                let mut far = near;
                far[input / 32] ^= 1 << (input % 32);
                let word = |[x, y, z, w, seed]: [i32; 5]| IntegerHash.word([x, y, z, w], seed as u32);
                let flipped = word(near) ^ word(far);
                for (bit, flips) in flips.iter_mut().enumerate() {
                    *flips += flipped >> bit & 1;
                }
            }
            for (bit, flips) in flips.into_iter().enumerate() {
                let fraction = f64::from(flips) / f64::from(COUNT);
                assert!(
                    abs_diff_eq!(fraction, 0.5, epsilon = TOLERANCE),
                    "input bit {input}, output bit {bit}: {fraction}"
                );
            }
        }
    }

    /// χ² of two numbers below 16, one from each of two cells `step` apart, and of two seeds at the
    /// same cells.
    fn chi_square(seeds: [u32; 2], step: [i32; 3], at: impl Fn(i32) -> [i32; 3]) -> f64 {
        let mut table = [0_u32; 256];
        for i in 0..1 << 16 {
            let [x, y, z] = at(i);
            let there = [x + step[0], y + step[1], z + step[2]];
            let [a, b] = [([x, y, z], seeds[0]), (there, seeds[1])]
                .map(|(cell, seed)| IntegerHash.upper_word(cell, seed) >> 28);
            table[(a << 4 | b) as usize] += 1;
        }
        table.map(|n| (f64::from(n) - 256.0).powi(2) / 256.0).iter().sum()
    }

    #[test]
    fn upper_words_of_neighbors_and_seeds_are_independent() {
        // The quantile 1 − 1e-3/310 of χ² with 255 degrees of freedom.
        const MAX_CHI_SQUARE: f64 = 372.0;
        let at = |i| [i & 63, i >> 6 & 63, i >> 12];
        for seed in 0..4 {
            for i in 63..125 {
                let step = [i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2];
                let chi_square = chi_square([seed; 2], step, at);
                assert!(chi_square < MAX_CHI_SQUARE, "seed {seed}, step {step:?}: {chi_square}");
            }
            for other in 0..31 {
                let chi_square = chi_square([seed, seed ^ 1 << other], [0; 3], at);
                assert!(chi_square < MAX_CHI_SQUARE, "seed {seed}, bit {other}: {chi_square}");
            }
        }
    }

    /// The fractions of flips of each of the upper eight bits when one bit of the seed or of a
    /// coordinate below 2²⁰ is flipped.
    #[test]
    fn upper_word_avalanche() {
        for input in (0..20).chain(32..52).chain(64..84).chain(96..128) {
            let mut flips = [0_u32; 8];
            for i in 0..1024 {
                let near = [(i & 31) - 16, (i >> 5) - 16, i % 7, i % 5];
                let mut far = near;
                far[input / 32] ^= 1 << (input % 32);
                let word = |[x, y, z, seed]: [i32; 4]| IntegerHash.upper_word([x, y, z], seed as u32);
                let flipped = word(near) ^ word(far);
                for (bit, flips) in flips.iter_mut().enumerate() {
                    *flips += flipped >> (24 + bit) & 1;
                }
            }
            for (bit, flips) in flips.into_iter().enumerate() {
                // 6 standard errors of ½ over 1024 trials.
                let fraction = f64::from(flips) / 1024.0;
                assert!(
                    abs_diff_eq!(fraction, 0.5, epsilon = 6.0 * 0.5 / 32.0),
                    "input bit {input}, bit {bit}: {fraction}"
                );
            }
        }
    }

    #[test]
    fn bit_fields_of_words_are_independent() {
        // The upper four bits of both halves of six words.
        let mut tables = [[[0_u32; 256]; 12]; 12];
        for i in 0..1 << 21 {
            let word = Scalar.word(IntegerHash.word([i & 2047, i >> 11, 3], 1));
            let by = |k: usize| multiplied(Scalar, word, Scalar.word(MULTIPLIERS[k]));
            let words = [word, by(0), by(1), by(2), by(3), by(4)];
            let mut fields = [0; 12];
            for (fields, word) in fields.chunks_mut(2).zip(words) {
                fields.copy_from_slice(&[word.0 >> 28, word.0 >> 12 & 15].map(|field| field as usize));
            }
            for first in 0..12 {
                for second in 0..first {
                    tables[first][second][fields[first] << 4 | fields[second]] += 1;
                }
            }
        }
        for first in 0..12 {
            for second in 0..first {
                let squares = tables[first][second].map(|n| (f64::from(n) - 8192.0).powi(2) / 8192.0);
                let chi_square: f64 = squares.iter().sum();
                // The quantile 1 − 0.001/66 of χ² with 255 degrees of freedom is 360.
                assert!(chi_square < 360.0, "fields {first} and {second}: chi square {chi_square}");
            }
        }
    }

    #[test]
    fn no_small_translation_maps_the_lattice_onto_itself() {
        // Under a sum of products the shortest such vector in 3-D would have some 1600 cells, and
        // every word would match.
        let mut met = 0;
        for shift in 1..20_000 {
            let same = (0..4)
                .all(|i| IntegerHash.word([i, 2 * i, 1], 7) == IntegerHash.word([i + shift, 2 * i, 1], 7));
            met += u32::from(same);
        }
        assert_eq!(met, 0);
    }

    #[test]
    fn no_near_reflection_maps_the_lattice_onto_itself() {
        // Every pair of axes, mirrored about every half cell near the origin. Without the shifts a
        // third would match.
        for (first, second) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
            for center in -8..8 {
                let mut met = 0;
                for i in 0..400 {
                    let here = [i % 20 - 10, i / 20 - 9, i % 7 - 3, i % 11 - 6];
                    let mut there = here;
                    there[first] = center - there[first];
                    there[second] = center - there[second];
                    let same = here != there && IntegerHash.word(here, 7) == IntegerHash.word(there, 7);
                    met += u32::from(same);
                }
                assert_eq!(met, 0, "axes {first} and {second} about {center}/2");
            }
        }
    }

    #[test]
    fn the_plane_is_a_section_of_space() {
        let [z, w] = [0x3c6e_f372, 0x1b87_3593];
        assert_eq!(IntegerHash.word([5, -9], 3), IntegerHash.word([5, -9, -z, -w], 3));
        let [here, next] = IntegerHash.terms(Scalar, 1, Scalar.word(41));
        assert_eq!(here, folded(Scalar, Scalar.word(41) * Scalar.word(P[1]) + Scalar.word(SHIFT[1])));
        assert_eq!(next, IntegerHash.term(Scalar, 1, Scalar.word(42)));
    }
}
