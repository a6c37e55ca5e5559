//! Points of the unit square for every random choice of a pixel's sample: Sobol' pairs, scrambled.

use glam::Vec2;

/// The points of one sample of a pixel, one for each choice along its path.
///
/// Each choice has a (0, 2)-sequence of its own over the samples of the pixel: Sobol's first two dimensions under Owen's scrambling
/// and in an order of their own, by the hashes of Burley 2020, "Practical Hash-based Owen Scrambling".
pub struct Sampler {
    index: u32,
    seed: u32,
    choices: u32,
}

impl Sampler {
    /// Sample `index` of the pixel whose hash is `seed`.
    pub const fn new(index: u32, seed: u32) -> Self {
        Self { index, seed, choices: 0 }
    }

    /// The point for the next choice.
    pub fn point(&mut self) -> Vec2 {
        self.choices += 1;
        let seed = hash(self.seed ^ hash(self.choices));
        let index = scrambled(self.index, seed);
        let second = (0..32).fold((0_u32, 1_u32 << 31), |(sum, direction), bit| {
            (if index >> bit & 1 == 1 { sum ^ direction } else { sum }, direction ^ (direction >> 1))
        });
        let unit = |bits: u32| (bits >> 8) as f32 / 16_777_216.0;
        Vec2::new(
            unit(scrambled(index.reverse_bits(), hash(seed ^ 1))),
            unit(scrambled(second.0, hash(seed ^ 2))),
        )
    }
}

/// C. Wellons' two-round multiply-xorshift `lowbias32`.
pub fn hash(mut x: u32) -> u32 {
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// Owen's scrambling of the binary digits after the point, by a hash in which every bit acts on those below it only.
fn scrambled(x: u32, seed: u32) -> u32 {
    let mut x = x.reverse_bits();
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_samples_have_one_point_in_every_strip_and_every_square() {
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
    fn choices_do_not_hang_together() {
        let mut sum = Vec2::ZERO;
        for index in 0..1024 {
            let mut sampler = Sampler::new(index, 9);
            let (a, b) = (sampler.point() - 0.5, sampler.point() - 0.5);
            sum += Vec2::new(a.x * b.x, a.x * b.y);
        }
        // Of independent ones 1/12 of the root of their number: 2.7; four of that.
        assert!(sum.abs().max_element() < 10.7, "{sum}");
    }
}
