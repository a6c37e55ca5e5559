//! The float functions that this crate calls; each line names both backends, and `libm` wins.

macro_rules! backend {
    ($($name:ident($first:ident $(, $other:ident)?: $type:ty) = $libm:ident, $std:ident;)*) => {$(
        #[inline(always)]
        pub(crate) fn $name($first: $type $(, $other: $type)?) -> $type {
            #[cfg(feature = "libm")]
            { libm::$libm($first $(, $other)?) }
            #[cfg(not(feature = "libm"))]
            { $first.$std($($other)?) }
        }
    )*};
}

backend! {
    exp(x: f32) = expf, exp;
    exp_m1(x: f32) = expm1f, exp_m1;
    ln_1p(x: f32) = log1pf, ln_1p;
    sqrt(x: f32) = sqrtf, sqrt;
    exp_f64(x: f64) = exp, exp;
    ln_f64(x: f64) = log, ln;
    sqrt_f64(x: f64) = sqrt, sqrt;
    floor_f64(x: f64) = floor, floor;
    exp_m1_f64(x: f64) = expm1, exp_m1;
    ln_1p_f64(x: f64) = log1p, ln_1p;
    sin_f64(x: f64) = sin, sin;
    cos_f64(x: f64) = cos, cos;
    atan2_f64(y, x: f64) = atan2, atan2;
}

#[cfg(feature = "alloc")]
backend! {
    asin_f64(x: f64) = asin, asin;
}
