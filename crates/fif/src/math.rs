//! The float functions that this crate calls; each line names both backends, and `libm` wins.

/// `√x`.
#[inline]
#[must_use]
pub(crate) fn sqrt(x: f64) -> f64 {
    #[cfg(feature = "libm")]
    return libm::sqrt(x);
    #[cfg(not(feature = "libm"))]
    x.sqrt()
}
