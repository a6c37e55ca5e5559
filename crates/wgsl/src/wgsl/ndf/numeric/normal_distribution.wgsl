// The Gaussian distribution function, its tail and its quantile in 32 bits:
// `density/gaussian_lanes.rs` of asperity-ndf-sampling. `asperity_ndf_sampling::gaussian_cdf`
// and `inverse_gaussian_cdf` use 64 bits.

// The density of a standard Gaussian.
fn gaussian_pdf(x: f32) -> f32 {
    return elementary_exp(x * x * -0.5) * 0.3989423;
}

// Mills' ratio, the ratio of the tail to the density, for x >= 0. Fitted to 7e-8 relative; 5e-7
// including rounding.
fn gaussian_mills_ratio(x: f32) -> f32 {
    let t = 1.0 / (1.0 + x * 0.33);
    let square = t * t;
    let fourth = square * square;
    let low = (0.32999998 + t * 0.33000374) + square * (0.29397006 + t * 0.22290614);
    let middle = (0.12540516 + t * 0.012852157) + square * (0.053225066 + t * -0.2777539);
    let high = 0.21499502 + t * -0.052289367;
    return t * (low + fourth * (middle + fourth * high));
}

// The probability that a standard Gaussian is at most x. 2.5e-7 absolute, for x < 0 also 5e-7 +
// 6e-8 x^2 relative.
fn gaussian_cdf(x: f32) -> f32 {
    let tail = gaussian_pdf(x) * gaussian_mills_ratio(min(abs(x), 40.0));
    // Exactly one half at 0.
    return select(select(tail, 1.0 - tail, x > 0.0), 0.5, abs(x) < 1e-7);
}

// The quantile of a standard Gaussian, for u in [2^-32, 1 - 2^-24]. 1e-6 relative to 1 +
// |quantile|.
fn inverse_gaussian_cdf(u: f32) -> f32 {
    let x = (u + u) - 1.0;
    let w = -elementary_ln(u * (1.0 - u) * 4.0);
    let central = w < 5.4;
    let t = select(sqrt(max(w, 0.0)) - 3.0, w - 2.5, central);
    var sum = select(9.556487e-6, 1.5843083e-8, central);
    sum = sum * t + select(-2.238207e-4, 3.2836306e-7, central);
    sum = sum * t + select(0.0012503641, -3.379765e-6, central);
    sum = sum * t + select(-0.0033815682, -4.2312986e-6, central);
    sum = sum * t + select(0.0057325307, 2.1807557e-4, central);
    sum = sum * t + select(-0.007702142, -0.0012542037, central);
    sum = sum * t + select(0.009442821, -0.0041771512, central);
    sum = sum * t + select(1.0016799, 0.24664108, central);
    sum = sum * t + select(2.8329768, 1.5014093, central);
    return sum * x * 1.4142135;
}

// The mean excess E[max(0, X - z)] of a standard Gaussian X, for z >= 0; 0 beyond 13.1. 1e-6 + 6e-8
// z^2 relative.
//
// The density times 1 - z M(z), with Mills' ratio M, by a polynomial in t = 1/(1 + 0.33 z), as the
// difference itself would cancel.
fn gaussian_excess(z: f32) -> f32 {
    let t = 1.0 / (1.0 + min(z, 15.0) * 0.33);
    let square = t * t;
    let fourth = square * square;
    let low = (0.10890179 + t * 0.21771704) + square * (0.29271844 + t * 0.27646753);
    let middle = (0.31625116 + t * -0.38768554) + square * (1.1048845 + t * -2.200834);
    let high = (1.9736118 + t * -0.846749) + square * 0.1447163;
    let share = square * (low + fourth * (middle + fourth * high));
    return select(0.0, gaussian_pdf(z) * share, z <= 15.0);
}
