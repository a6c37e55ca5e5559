//! The float functions that this crate calls; each line names both backends, and `libm` wins.
//! Both round exactly, so the backend never changes a bit of a noise.

/// √x, correctly rounded.
#[inline(always)]
pub(crate) fn sqrt(x: f32) -> f32 {
    #[cfg(feature = "libm")]
    return libm::sqrtf(x);
    #[cfg(not(feature = "libm"))]
    return x.sqrt();
}

/// √x, correctly rounded; for checks.
#[cfg(feature = "check")]
pub(crate) fn sqrt_f64(x: f64) -> f64 {
    #[cfg(feature = "libm")]
    return libm::sqrt(x);
    #[cfg(not(feature = "libm"))]
    return x.sqrt();
}

/// ln x, for the limits of checks: no noise depends on it.
#[cfg(feature = "check")]
pub(crate) fn ln_f64(x: f64) -> f64 {
    #[cfg(feature = "libm")]
    return libm::log(x);
    #[cfg(not(feature = "libm"))]
    return x.ln();
}
