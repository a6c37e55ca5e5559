//! The float functions that this crate calls; each line names both backends, and `libm` wins.

/// `√x`.
#[inline]
#[must_use]
#[cfg(any(feature = "std", feature = "libm"))]
pub(crate) fn sqrt(x: f64) -> f64 {
    #[cfg(feature = "libm")]
    return libm::sqrt(x);
    #[cfg(not(feature = "libm"))]
    x.sqrt()
}

// Without a backend the crate's own message is the only error.
#[cfg(not(any(feature = "std", feature = "libm")))]
pub(crate) fn sqrt(x: f64) -> f64 {
    x
}
