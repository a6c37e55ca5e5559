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
