//! SplitMix64.

/// Difference of consecutive states: 2⁶⁴/φ, rounded to an odd number.
const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

/// Random numbers as a function of a state: SplitMix64 of Steele, Lea and Flood 2014.
#[derive(Clone, Debug)]
pub struct SplitMix64 {
    /// The state; any number.
    pub state: u64,
}

impl SplitMix64 {
    /// The output at an index of the sequence that starts from the state 0: a bijection with full
    /// avalanche.
    #[inline(always)]
    #[must_use]
    pub const fn nth(index: u64) -> u64 {
        Self::finalized(index.wrapping_add(1).wrapping_mul(STEP))
    }

    #[inline(always)]
    const fn finalized(bits: u64) -> u64 {
        let bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        bits ^ (bits >> 31)
    }

    /// The next 64 bits.
    #[inline]
    pub fn word(&mut self) -> u64 {
        self.state = self.state.wrapping_add(STEP);
        Self::finalized(self.state)
    }

    /// The next number, uniform in [0, 1).
    #[inline]
    pub fn uniform(&mut self) -> f32 {
        (self.word() >> 40) as f32 / 16_777_216.0
    }
}
