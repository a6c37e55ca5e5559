//! Words of lattice points and numbers drawn from them, as documented.

/// Further word k of a lattice point.
pub(crate) fn further(word: u32, k: u32) -> u32 {
    let h = word.wrapping_add(0x9e37_79b9_u32.wrapping_mul(k));
    let h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    h ^ (h >> 16)
}

/// A number uniform in (−1, 1).
pub(crate) fn uniform(word: u32) -> f32 {
    (word >> 8) as f32 / 8_388_608.0 + (0.5 / 8_388_608.0 - 1.0)
}
