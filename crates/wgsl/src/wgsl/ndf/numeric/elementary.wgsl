// Exponential, logarithm, sine and cosine from operations that compilers cannot transform:
// `simd/elementary.rs` of asperity-ndf-sampling. They have the same bits if sums and products are
// rounded one by one.
//
// Built-in functions are less accurate: on some drivers exp has errors of 4e-6 relative and sin of
// 2e-4.

const ELEMENTARY_LARGEST: f32 = 3.4028234663852886e38;
const ELEMENTARY_LEAST_NORMAL: f32 = 1.1754944e-38;

// x, or 0 if it is NaN. Compares bits, as compilers may assume that no float is NaN.
fn elementary_number(x: f32) -> f32 {
    return select(x, 0.0, (bitcast<u32>(x) & 0x7fffffffu) > 0x7f800000u);
}

// x clamped to -limit ... limit; 0 for NaN.
fn elementary_bounded(x: f32, limit: f32) -> f32 {
    return clamp(elementary_number(x), -limit, limit);
}

// Uniform numbers clamped to [0, 1 - 2^-24]; 0 for NaN.
fn elementary_probabilities(u: vec2<f32>) -> vec2<f32> {
    let numbers = vec2<f32>(elementary_number(u.x), elementary_number(u.y));
    return clamp(numbers, vec2<f32>(0.0), vec2<f32>(0.99999994));
}

// exp(x) for x at most 87; 0 below -87. 2e-7 relative.
//
// x = k ln 2 + r with |r| at most ln(2)/2. ln 2 is in two parts, and the product of the first with
// k is exact.
fn elementary_exp(x: f32) -> f32 {
    let bounded = clamp(x, -87.0, 87.0);
    let k = round(bounded * 1.442695);
    let r = (bounded - k * 0.69314575) - k * 1.4286068e-6;
    let r_squared = r * r;
    let low = (1.0 + r) + r_squared * (0.5 + r * (1.0 / 6.0));
    let high = (1.0 / 24.0 + r * (1.0 / 120.0)) + r_squared * (1.0 / 720.0 + r * (1.0 / 5040.0));
    let fraction = low + (r_squared * r_squared) * high;
    let power = bitcast<f32>(u32(i32(k) + 127) << 23u);
    return select(0.0, fraction * power, x > -87.0);
}

// (1 - exp(-t))/t for t >= 0, 1 at 0; `root` is exp(-t/2). 3e-7 relative.
fn elementary_one_minus_exp_ratio(t: f32, root: f32) -> f32 {
    let square = t * t * 0.25;
    let fourth = square * square;
    let series = (1.0 + square * (1.0 / 6.0))
        + fourth * ((1.0 / 120.0 + square * (1.0 / 5040.0)) + fourth * (1.0 / 362880.0));
    let far = (1.0 - root * root) / max(t, 1.0);
    return select(far, root * series, t < 1.0);
}

// k ln 2 + ln(1 + f), for 1 + f from 1/sqrt(2) to sqrt(2).
fn elementary_ln_of_parts(k: f32, f: f32) -> f32 {
    let q = f / (2.0 + f);
    let square = q * q;
    let fourth = square * square;
    let series = (2.0 / 3.0 + square * (2.0 / 5.0)) + fourth * (2.0 / 7.0 + square * (2.0 / 9.0));
    let ln_of_mantissa = q * 2.0 + q * (square * series);
    return k * 0.6931472 + ln_of_mantissa;
}

// ln x for normal, positive, finite x. 3e-7 relative.
fn elementary_ln(x: f32) -> f32 {
    let shifted = bitcast<u32>(x) + (0x3f800000u - 0x3f3504f3u);
    let k = f32(i32(shifted >> 23u) - 127);
    let m = bitcast<f32>((shifted & 0x007fffffu) + 0x3f3504f3u);
    return elementary_ln_of_parts(k, m - 1.0);
}

// ln(1 + x) for finite x > -1. 3e-7 relative; near 0 it uses x itself, so that the rounding of the
// sum does not matter.
fn elementary_ln_1p(x: f32) -> f32 {
    let shifted = bitcast<u32>(1.0 + x) + (0x3f800000u - 0x3f3504f3u);
    let k = f32(i32(shifted >> 23u) - 127);
    let m = bitcast<f32>((shifted & 0x007fffffu) + 0x3f3504f3u);
    return elementary_ln_of_parts(k, select(m - 1.0, x, k == 0.0));
}

// (cos 2 pi u, sin 2 pi u) for |u| < 2^21. 1.2e-7 absolute.
fn elementary_cos_sin_turns(u: f32) -> vec2<f32> {
    let quarters = round(u * 4.0);
    let x = (u - quarters * 0.25) * 6.2831855;
    let square = x * x;
    let fourth = square * square;
    let cos_series = (1.0 - square * 0.5)
        + fourth * ((1.0 / 24.0 - square * (1.0 / 720.0)) + fourth * (1.0 / 40320.0 - square * (1.0 / 3628800.0)));
    let sin_series = (1.0 - square * (1.0 / 6.0))
        + fourth * ((1.0 / 120.0 - square * (1.0 / 5040.0)) + fourth * (1.0 / 362880.0));
    let sin_value = sin_series * x;
    // Quarter 1: (-sin, cos), 2: (-cos, -sin), 3: (sin, -cos).
    let quarter = bitcast<u32>(i32(quarters));
    let is_odd = (quarter & 1u) == 1u;
    let a = select(cos_series, sin_value, is_odd);
    let b = select(sin_value, cos_series, is_odd);
    return vec2<f32>(
        select(a, -a, ((quarter + 1u) & 2u) != 0u),
        select(b, -b, (quarter & 2u) != 0u),
    );
}
