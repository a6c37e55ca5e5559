//! Points of the unit square for every random decision of a pixel's sample: scrambled Sobol' pairs.

use glam::{Vec2, Vec3};

/// The points of one sample of a pixel, one per decision along its path.
///
/// Each decision uses a separate (0, 2)-sequence over the samples of the pixel: Sobol's first two
/// dimensions with Owen scrambling and a shuffled order, with the hashes of Burley 2020, "Practical
/// Hash-based Owen Scrambling".
pub struct Sampler {
    index: u32,
    seed: u32,
    choices: u32,
}

impl Sampler {
    /// Creates sample `index` of the pixel whose hash is `seed`.
    pub const fn new(index: u32, seed: u32) -> Self {
        Self { index, seed, choices: 0 }
    }

    /// Returns the point for the next decision.
    pub fn point(&mut self) -> Vec2 {
        self.choices += 1;
        let seed = hash(self.seed ^ hash(self.choices));
        let index = scrambled(self.index.reverse_bits(), seed).reverse_bits();
        let unit = |bits: u32| (bits.reverse_bits() >> 8) as f32 / 16_777_216.0;
        let (first, second) = (hash(seed ^ 1), hash(seed ^ 2));
        Vec2::new(unit(scrambled(index, first)), unit(scrambled(by_pascal(index), second)))
    }
}

/// C. Wellons' two-round multiply-xorshift `lowbias32`.
pub fn hash(mut x: u32) -> u32 {
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// Returns a number in [0, 1) that follows from the bits of a position.
pub fn of_position(position: Vec3) -> f32 {
    let [x, y, z] = position.to_array().map(f32::to_bits);
    (hash(x ^ hash(y ^ hash(z))) >> 8) as f32 / 16_777_216.0
}

/// Fractional digits of Sobol's second dimension, the first in the lowest bit. Digit j is the sum
/// of C(k, j) times bit k of the index, where C(k, j) is even unless k has every bit of j.
const fn by_pascal(mut index: u32) -> u32 {
    index ^= (index >> 1) & 0x5555_5555;
    index ^= (index >> 2) & 0x3333_3333;
    index ^= (index >> 4) & 0x0f0f_0f0f;
    index ^= (index >> 8) & 0x00ff_00ff;
    index ^ (index >> 16)
}

/// Owen scrambling of the fractional binary digits, the first in the lowest bit, by a hash in which
/// every bit affects only higher bits.
const fn scrambled(mut x: u32, seed: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_samples_fill_every_stratum() {
        for seed in 0..20 {
            for choice in 0..3 {
                for [columns, rows] in [[16, 1], [4, 4], [1, 16], [8, 2]] {
                    let mut cells = [0; 16];
                    for index in 0..16 {
                        let mut sampler = Sampler::new(index, seed);
                        let p = (0..=choice).map(|_| sampler.point()).last().unwrap();
                        let [x, y] = [(p.x * columns as f32) as usize, (p.y * rows as f32) as usize];
                        cells[y * columns + x] += 1;
                    }
                    assert_eq!(cells, [1; 16], "{seed}, {choice}: {columns} by {rows}");
                }
            }
        }
    }

    #[test]
    fn second_dimension_is_sobol() {
        for index in (0..2000).chain([0x8000_0000, 0xdead_beef, u32::MAX]) {
            // Each direction number is the previous one times 1 + x⁻¹.
            let (sum, _) = (0..32).fold((0_u32, 1_u32 << 31), |(sum, direction), bit| {
                (if index >> bit & 1 == 1 { sum ^ direction } else { sum }, direction ^ (direction >> 1))
            });
            assert_eq!(by_pascal(index).reverse_bits(), sum, "{index}");
        }
    }

    #[test]
    fn decisions_are_uncorrelated() {
        let mut sum = Vec2::ZERO;
        for index in 0..1024 {
            let mut sampler = Sampler::new(index, 9);
            let (a, b) = (sampler.point() - 0.5, sampler.point() - 0.5);
            sum += Vec2::new(a.x * b.x, a.x * b.y);
        }
        // For independent decisions 1/12 of the root of their number: 2.7; four times that.
        assert!(sum.abs().max_element() < 10.7, "{sum}");
    }
}
