//! Uniform numbers that are a function of a state: SplitMix64.

/// Uniform numbers from the bits of others: SplitMix64 of Steele, Lea and Flood 2014.
pub(crate) struct Hashed {
    pub(crate) state: u64,
}

impl Hashed {
    /// 64 bits.
    pub(crate) fn word(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let bits = (self.state ^ (self.state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        bits ^ (bits >> 31)
    }

    /// Uniform in `[0, 1)`.
    pub(crate) fn uniform(&mut self) -> f32 {
        (self.word() >> 40) as f32 / 16_777_216.0
    }
}
