//! Random numbers from the words of a hash.

/// A number in [0, 1) of 24 bits.
pub(crate) fn unit(word: u32) -> f32 {
    (word >> 8) as f32 / 16_777_216.0
}
