// Gaussian slopes of any mean and covariance:
// `asperity_ndf_sampling::OffsetBeckmann`.

struct OffsetBeckmann {
    // The mean of the slopes.
    mean: vec2<f32>,
    // The lower triangular root of their covariance: its first column, and the last entry.
    lower: vec3<f32>,
}

// The rest of a Beckmann distribution after the coordinates of a split are resolved.
fn offset_beckmann_conditional(alpha: vec2<f32>, split: GaussianSplit) -> OffsetBeckmann {
    let deviation = alpha * 0.70710677;
    let rest = sqrt(split.rest);
    return OffsetBeckmann(deviation * (split.z_b * split.root), vec3<f32>(deviation.x * rest, 0.0, deviation.y * rest));
}

// Whether |x| is at most the limit. Compares bits, as compilers may assume that no float is NaN.
fn offset_beckmann_within(x: f32, limit: f32) -> bool {
    return (bitcast<u32>(x) & 0x7fffffffu) <= bitcast<u32>(limit);
}

// The covariance of the slopes: xx, xy, yy.
fn offset_beckmann_covariance(slopes: OffsetBeckmann) -> vec3<f32> {
    let l = slopes.lower;
    return vec3<f32>(l.x * l.x, l.x * l.y, l.y * l.y + l.z * l.z);
}

// Slopes of this mean and covariance; `otherwise` if one is invalid.
fn offset_beckmann_of(mean: vec2<f32>, covariance: vec3<f32>, otherwise: OffsetBeckmann) -> OffsetBeckmann {
    let xx = covariance.x;
    let xy = covariance.y;
    let yy = covariance.z;
    let has_mean = offset_beckmann_within(mean.x, 1e9) && offset_beckmann_within(mean.y, 1e9);
    let in_range = offset_beckmann_within(xx, 1e18) && offset_beckmann_within(xy, 1e18) && offset_beckmann_within(yy, 1e18);
    if !(has_mean && in_range && xx >= 1e-24) {
        return otherwise;
    }
    // The rounding of the quotient and the product; without it the smaller axis of a thin ellipse
    // would be lost.
    let ratio = xy / xx;
    let product = xy * ratio;
    let lost = fma(xy, ratio, -product) + xy * (fma(-ratio, xx, xy) / xx);
    let rest = (yy - product) - lost;
    if !(rest >= 1e-24) {
        return otherwise;
    }
    let first = sqrt(xx);
    return OffsetBeckmann(mean, vec3<f32>(first, xy / first, sqrt(rest)));
}

// D(m) in 1/sr, for unit m; 0 for m.z <= 0 and NaN.
fn offset_beckmann_d(slopes: OffsetBeckmann, m: vec3<f32>) -> f32 {
    if !(m.z > 0.0 && offset_beckmann_within(m.x, ELEMENTARY_LARGEST) && offset_beckmann_within(m.y, ELEMENTARY_LARGEST)) {
        return 0.0;
    }
    let l = slopes.lower;
    let x = (m.x / m.z - slopes.mean.x) / l.x;
    let y = (m.y / m.z - slopes.mean.y - l.y * x) / l.z;
    let falloff = elementary_exp(-0.5 * (x * x + y * y));
    if !(falloff > 0.0) {
        return 0.0;
    }
    let square = m.z * m.z;
    let along = 6.2831855 * l.x * square;
    let across = l.z * square;
    if !(along > 0.0 && across > 0.0) {
        return ELEMENTARY_LARGEST;
    }
    // In two steps, as the product of both deviations may leave the range of floats.
    return min(falloff / along / across, ELEMENTARY_LARGEST);
}
