//! Branch-free floor.

/// 1.5 · 2⁵²: sums from here on are the nearest integers, and so are the last bits of their
/// mantissas.
pub(crate) const WHOLE: f64 = 6_755_399_441_055_744.0;

/// Floor as both types, for `0 ≤ x < 2³¹`; at an integer it or the one before.
#[inline(always)]
pub(crate) fn floor(x: f64) -> (f64, usize) {
    let sum = (x - 0.5) + WHOLE;
    (sum - WHOLE, sum.to_bits() as u32 as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floor_of_small_numbers() {
        for x in [0.0, 1e-300, 0.3, 0.5, 0.999, 1.5, 1_023.0, 1_023.999_999, 2_147_483_646.5] {
            let (whole, number) = floor(x);
            assert_eq!(whole, number as f64);
            assert!(whole <= x && x <= whole + 1.0, "{x}: {whole}");
        }
    }
}
