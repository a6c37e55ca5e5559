//! Pseudo-random numbers: SplitMix64, Steele, Lea and Flood 2014.

use glam::Vec2;

/// A stream of numbers, the same for the same state.
pub struct Random(pub u64);

impl Random {
    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    pub fn uniform(&mut self) -> f64 {
        (self.word() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// In a box of 128 cells a side.
    pub fn coordinate(&mut self) -> f32 {
        (self.word() >> 40) as f32 / 131_072.0 - 64.0
    }

    /// Two independent Gaussian numbers, by Box and Muller.
    pub fn gaussians(&mut self) -> Vec2 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        let (sin, cos) = (std::f64::consts::TAU * self.uniform()).sin_cos();
        Vec2::new((radius * cos) as f32, (radius * sin) as f32)
    }
}
