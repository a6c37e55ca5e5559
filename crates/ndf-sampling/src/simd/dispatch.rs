//! The SIMD level of this machine.

/// A level of instructions; none without the feature `simd`.
#[cfg(feature = "simd")]
pub(crate) type Level = fearless_simd::Level;
#[cfg(not(feature = "simd"))]
pub(crate) type Level = core::convert::Infallible;

/// The best level of this machine; without `std`, the best that the program was built for.
#[cfg(feature = "simd")]
pub(crate) fn best_level() -> Level {
    #[cfg(feature = "std")]
    return Level::new();
    #[cfg(not(feature = "std"))]
    return Level::baseline();
}
