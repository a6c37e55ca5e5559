//! Float functions of the standard library or of `libm`, which takes precedence.
//!
//! With `libm` the results have the same bits on every platform. Names with `_f64` take `f64`, all
//! others `f32`.

macro_rules! back_ends {
    ($($(#[$doc:meta])* $name:ident($first:ident $(, $other:ident)?: $type:ty) = $libm:ident, $std:ident;)*) => {$(
        $(#[$doc])*
        #[inline(always)]
        #[must_use]
        pub fn $name($first: $type $(, $other: $type)?) -> $type {
            #[cfg(feature = "libm")]
            { libm::$libm($first $(, $other)?) }
            #[cfg(all(feature = "std", not(feature = "libm")))]
            { $first.$std($($other)?) }
            // The compile error of the crate root is the only error.
            #[cfg(not(any(feature = "std", feature = "libm")))]
            { $(let _ = $other;)? $first }
        }
    )*};
}

back_ends! {
    /// The angle of (x, y).
    atan2(y, x: f32) = atan2f, atan2;
    /// cos x.
    cos(x: f32) = cosf, cos;
    /// eˣ.
    exp(x: f32) = expf, exp;
    /// 2ˣ.
    exp2(x: f32) = exp2f, exp2;
    /// eˣ − 1.
    exp_m1(x: f32) = expm1f, exp_m1;
    /// ⌊x⌋.
    floor(x: f32) = floorf, floor;
    /// ln(1 + x).
    ln_1p(x: f32) = log1pf, ln_1p;
    /// log₂ x.
    log2(x: f32) = log2f, log2;
    /// xʸ.
    pow(x, y: f32) = powf, powf;
    /// sin x.
    sin(x: f32) = sinf, sin;
    /// √x, correctly rounded.
    sqrt(x: f32) = sqrtf, sqrt;

    /// arcsin x.
    asin_f64(x: f64) = asin, asin;
    /// The angle of (x, y).
    atan2_f64(y, x: f64) = atan2, atan2;
    /// cos x.
    cos_f64(x: f64) = cos, cos;
    /// eˣ.
    exp_f64(x: f64) = exp, exp;
    /// eˣ − 1.
    exp_m1_f64(x: f64) = expm1, exp_m1;
    /// ⌊x⌋.
    floor_f64(x: f64) = floor, floor;
    /// ln x.
    ln_f64(x: f64) = log, ln;
    /// ln(1 + x).
    ln_1p_f64(x: f64) = log1p, ln_1p;
    /// xʸ.
    pow_f64(x, y: f64) = pow, powf;
    /// sin x.
    sin_f64(x: f64) = sin, sin;
    /// √x, correctly rounded.
    sqrt_f64(x: f64) = sqrt, sqrt;
}
