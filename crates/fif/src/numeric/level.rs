//! The SIMD level of the machine.

use fearless_simd::Level;

/// The best level of this machine; without `std`, the best that the program was built for.
pub(crate) fn best_level() -> Level {
    #[cfg(feature = "std")]
    return Level::new();
    #[cfg(not(feature = "std"))]
    return Level::baseline();
}
