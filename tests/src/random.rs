//! Reproducible random numbers: SplitMix64.

/// SplitMix64 of Steele, Lea and Flood 2014, seeded by its state.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// The next 64 bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        bits ^ (bits >> 31)
    }

    /// Uniform in [0, 1), of 53 bits.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (-53f64).exp2()
    }

    /// Uniform in a box of 128 cells a side.
    pub const fn coordinate(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / 131_072.0 - 64.0
    }

    /// Two independent standard Gaussians, by the transformation of Box and Muller.
    pub fn gaussians(&mut self) -> [f64; 2] {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        let (sin, cos) = (core::f64::consts::TAU * self.uniform()).sin_cos();
        [radius * cos, radius * sin]
    }
}
