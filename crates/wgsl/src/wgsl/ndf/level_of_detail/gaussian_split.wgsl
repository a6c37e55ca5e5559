// Gaussian coordinates split into a resolved part and the rest:
// `asperity_ndf_sampling::GaussianSplit`.

struct GaussianSplit {
    // The resolved coordinates, in standard deviations.
    z_b: vec2<f32>,
    // The root of their fraction of the variance, and 1 minus the fraction.
    root: f32,
    rest: f32,
}

// The split of the coordinates z_b with the fraction s of the variance; s is clamped to 0 ... 1 -
// 2^-20, 0 for NaN.
fn gaussian_split(z_b: vec2<f32>, s: f32) -> GaussianSplit {
    let variance = clamp(elementary_number(s), 0.0, 0.99999905);
    let bounded = vec2<f32>(elementary_bounded(z_b.x, 13.0), elementary_bounded(z_b.y, 13.0));
    return GaussianSplit(bounded, sqrt(variance), 1.0 - variance);
}

// p_s(h | z_b) of any distribution, from the density D(h) and from z, the inverse of T at h.
fn gaussian_split_weigh(split: GaussianSplit, density: f32, z: vec2<f32>) -> f32 {
    let x = split.root * elementary_bounded(z.x, 13.0) - split.z_b.x;
    let y = split.root * elementary_bounded(z.y, 13.0) - split.z_b.y;
    let near = (x * x + y * y) / split.rest;
    let square = split.z_b.x * split.z_b.x + split.z_b.y * split.z_b.y;
    // Half of the exponent twice. The whole would overflow where the density is small and the
    // product is not.
    let half_falloff = elementary_exp(0.25 * (square - near));
    return min(density * half_falloff * half_falloff / split.rest, ELEMENTARY_LARGEST);
}

// The coordinates of the whole, with xi for the unresolved part.
fn gaussian_split_join(split: GaussianSplit, xi: vec2<f32>) -> vec2<f32> {
    let bounded = vec2<f32>(elementary_bounded(xi.x, 13.0), elementary_bounded(xi.y, 13.0));
    return split.z_b * split.root + bounded * sqrt(split.rest);
}

// The unresolved part of the coordinates z of the whole, within 13.
fn gaussian_split_rest(split: GaussianSplit, z: vec2<f32>) -> vec2<f32> {
    let bounded = vec2<f32>(elementary_bounded(z.x, 13.0), elementary_bounded(z.y, 13.0));
    let rest = (bounded - split.z_b * split.root) / sqrt(split.rest);
    return clamp(rest, vec2<f32>(-13.0), vec2<f32>(13.0));
}
