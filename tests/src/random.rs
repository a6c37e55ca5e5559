//! Reproducible random numbers: SplitMix64.

/// SplitMix64 of Steele, Lea and Flood 2014, seeded by its state.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// Returns the next 64 bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        bits ^ (bits >> 31)
    }

    /// Returns a uniform number in [0, 1) with 53 bits.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (-53f64).exp2()
    }

    /// Returns a uniform number in a box of 128 cells per side.
    pub const fn coordinate(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / 131_072.0 - 64.0
    }

    /// Returns two independent standard Gaussians, by the Box–Muller transform.
    pub fn gaussians(&mut self) -> [f64; 2] {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        let (sin, cos) = (core::f64::consts::TAU * self.uniform()).sin_cos();
        [radius * cos, radius * sin]
    }
}
