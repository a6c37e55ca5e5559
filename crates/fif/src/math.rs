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

/// `ln x`.
#[inline]
#[must_use]
#[cfg(any(feature = "std", feature = "libm"))]
pub(crate) fn ln(x: f64) -> f64 {
    #[cfg(feature = "libm")]
    return libm::log(x);
    #[cfg(not(feature = "libm"))]
    x.ln()
}

/// `xʸ`.
#[inline]
#[must_use]
#[cfg(any(feature = "std", feature = "libm"))]
pub(crate) fn pow(x: f64, y: f64) -> f64 {
    #[cfg(feature = "libm")]
    return libm::pow(x, y);
    #[cfg(not(feature = "libm"))]
    x.powf(y)
}

// Without a backend the crate's own message is the only error.
#[cfg(not(any(feature = "std", feature = "libm")))]
pub(crate) fn sqrt(x: f64) -> f64 {
    x
}

#[cfg(not(any(feature = "std", feature = "libm")))]
pub(crate) fn ln(x: f64) -> f64 {
    x
}

#[cfg(not(any(feature = "std", feature = "libm")))]
pub(crate) fn pow(x: f64, _: f64) -> f64 {
    x
}
