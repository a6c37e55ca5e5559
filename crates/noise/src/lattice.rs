//! The source of a lattice's random values: what a hash of cell and seed must offer.

/// A hash of lattice points, the only randomness of every noise of this crate.
///
/// All 64 bits of a word must look independent of one another, of the words of other points and of other seeds.
/// [`IntegerHash`](crate::IntegerHash) is the default, [`PermutationTable`](crate::PermutationTable) the classic one.
pub trait Lattice {
    /// The random word of the lattice point (x, y).
    fn hash2(&self, x: i32, y: i32, seed: u32) -> u64;

    /// The random word of the lattice point (x, y, z).
    fn hash3(&self, x: i32, y: i32, z: i32, seed: u32) -> u64;
}

/// Below 2²³ a finite coordinate may have a fraction, and its integer part fits an `i32`.
const FRACTIONLESS: f32 = 8_388_608.0;

/// The cell of a coordinate and the place in the cell, in [0, 1].
///
/// Cells wrap modulo 2³² for |x| < 2⁶³; beyond that every x falls in one cell per sign. The place is NaN if x is not
/// finite. It reaches 1 when x lies closer under an integer than `f32` can resolve; noises are continuous there.
#[inline(always)]
pub(crate) fn cell(x: f32) -> (i32, f32) {
    if x > -FRACTIONLESS && x < FRACTIONLESS {
        // ⌊x⌋ by truncation and correction, which spares a call of the library.
        let truncated = x as i32;
        let floor = truncated - i32::from(x < truncated as f32);
        (floor, x - floor as f32)
    } else {
        (x as i64 as i32, if x.is_finite() { 0.0 } else { f32::NAN })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_floors() {
        assert_eq!(cell(2.25), (2, 0.25));
        assert_eq!(cell(-0.25), (-1, 0.75));
        assert_eq!(cell(-3.0), (-3, 0.0));
        assert_eq!(cell(-0.0), (0, 0.0));
        assert_eq!(cell(-1e-20), (-1, 1.0));
        assert_eq!(cell(8_388_607.5), (8_388_607, 0.5));
        assert_eq!(cell(-8_388_607.5), (-8_388_608, 0.5));
    }

    #[test]
    fn huge_coordinates_wrap() {
        assert_eq!(cell(16_777_216.0), (16_777_216, 0.0));
        assert_eq!(cell(2_147_483_648.0), (i32::MIN, 0.0));
        assert_eq!(cell(4_294_967_296.0 + 1024.0), (1024, 0.0));
        assert_eq!(cell(f32::MAX), (-1, 0.0));
        assert_eq!(cell(f32::MIN), (0, 0.0));
        assert!(cell(f32::INFINITY).1.is_nan());
        assert!(cell(f32::NAN).1.is_nan());
    }
}
