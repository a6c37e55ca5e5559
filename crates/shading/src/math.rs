//! The float functions that this crate calls; each line names both backends, and `libm` wins.

/// Defines one function per line: its name, its arguments, the `libm` function, the `std` method.
macro_rules! backends {
    ($($name:ident($x:ident $(, $y:ident)*) = $libm:ident | $std:ident;)*) => {
        $(
            #[cfg(feature = "libm")]
            #[inline]
            pub(crate) fn $name($x: f32 $(, $y: f32)*) -> f32 {
                libm::$libm($x $(, $y)*)
            }

            #[cfg(all(feature = "std", not(feature = "libm")))]
            #[inline]
            pub(crate) fn $name($x: f32 $(, $y: f32)*) -> f32 {
                f32::$std($x $(, $y)*)
            }
        )*
    };
}

backends! {
    atan2(y, x) = atan2f | atan2;
    cos(x) = cosf | cos;
    exp(x) = expf | exp;
    exp2(x) = exp2f | exp2;
    exp_m1(x) = expm1f | exp_m1;
    floor(x) = floorf | floor;
    ln_1p(x) = log1pf | ln_1p;
    log2(x) = log2f | log2;
    pow(x, y) = powf | powf;
    sin(x) = sinf | sin;
    sqrt(x) = sqrtf | sqrt;
}

/// `x` within `[0, most]`, with NaN as 0, which `clamp` would pass on.
#[inline]
pub(crate) fn clamp_to(x: f32, most: f32) -> f32 {
    if x > 0.0 { x.min(most) } else { 0.0 }
}
