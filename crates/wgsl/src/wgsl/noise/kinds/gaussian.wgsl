// Noise that is N(0, 1) at every point, `asperity_noise::GaussianNoise`: value-gradient noise divided by
// its standard deviation at the point.

// Two channels, independent of each other.
struct GaussianPair2d {
    value: vec2<f32>,
    dx: vec2<f32>,
    dy: vec2<f32>,
}

struct GaussianPair3d {
    value: vec2<f32>,
    dx: vec2<f32>,
    dy: vec2<f32>,
    dz: vec2<f32>,
}

// The terms of the variance along each axis: p = sum w^2, q = sum w^2 d^2, and their derivatives.
struct GaussianVariance {
    p: vec3<f32>,
    q: vec3<f32>,
    dp: vec3<f32>,
    dq: vec3<f32>,
}

fn gaussian_variance(t: vec3<f32>, high: vec3<f32>, slope: vec3<f32>) -> GaussianVariance {
    let low = 1.0 - high;
    let rest = 1.0 - t;
    let low_t = low * t;
    let high_rest = high * rest;
    return GaussianVariance(
        low * low + high * high,
        low_t * low_t + high_rest * high_rest,
        2.0 * slope * (high - low),
        2.0 * (low_t * (low - slope * t) + high_rest * (slope * rest - high)),
    );
}

// The variance of the sum of variates, 1 at lattice points, and its gradient.
fn gaussian_variance_2d(t: vec2<f32>, w: vec2<f32>, slope: vec2<f32>) -> Sample2d {
    let v = gaussian_variance(vec3<f32>(t, 0.0), vec3<f32>(w, 0.0), vec3<f32>(slope, 0.0));
    let pq = v.p.y + 4.0 * v.q.y;
    let p = 4.0 * v.p.y;
    return Sample2d(
        v.p.x * pq + v.q.x * p,
        vec2<f32>(v.dp.x * pq + v.dq.x * p, v.p.x * (v.dp.y + 4.0 * v.dq.y) + v.q.x * (4.0 * v.dp.y)),
    );
}

fn gaussian_variance_3d(t: vec3<f32>, w: vec3<f32>, slope: vec3<f32>) -> Sample3d {
    let v = gaussian_variance(t, w, slope);
    let q = v.q.y * v.p.z + v.p.y * v.q.z;
    let p = v.p.y * v.p.z;
    let dq = vec2<f32>(v.dq.y * v.p.z + v.dp.y * v.q.z, v.q.y * v.dp.z + v.p.y * v.dq.z);
    let dp = vec2<f32>(v.dp.y * v.p.z, v.p.y * v.dp.z);
    let pq = p + 4.0 * q;
    return Sample3d(
        v.p.x * pq + v.q.x * (4.0 * p),
        vec3<f32>(
            v.dp.x * pq + v.dq.x * (4.0 * p),
            v.p.x * (dp + 4.0 * dq) + v.q.x * (4.0 * dp),
        ),
    );
}

// n / sqrt(v), and its gradient.
fn gaussian_normalized_2d(n: Sample2d, v: Sample2d) -> Sample2d {
    let inverse = 1.0 / sqrt(v.value);
    let z = n.value * inverse;
    return Sample2d(z, n.gradient * inverse - (z * (0.5 * inverse * inverse)) * v.gradient);
}

fn gaussian_normalized_3d(n: Sample3d, v: Sample3d) -> Sample3d {
    let inverse = 1.0 / sqrt(v.value);
    let z = n.value * inverse;
    return Sample3d(z, n.gradient * inverse - (z * (0.5 * inverse * inverse)) * v.gradient);
}

// The noise at a position in [0, 1]^2 of a cell.
fn gaussian_in_cell_2d(cell: vec2<i32>, t: vec2<f32>, key: u32) -> Sample2d {
    let w = fade_quintic(vec4<f32>(t, 0.0, 0.0)).xy;
    let slope = fade_quintic_slope(vec4<f32>(t, 0.0, 0.0)).xy;
    let words = integer_hash_words(integer_hash_joined(integer_hash_ends_2d(cell)), key);
    let sum = columns_blend(gaussian_first_corners_2d(words), t, w, slope);
    return gaussian_normalized_2d(sum, gaussian_variance_2d(t, w, slope));
}

// The noise before normalization at a position in [0, 1]^3 of a cell, with weights and slopes of the
// axes: `GaussianNoise::unnormalized`.
fn gaussian_sum_in_cell_3d(cell: vec3<i32>, t: vec3<f32>, w: vec3<f32>, slope: vec3<f32>, key: u32) -> Sample3d {
    let ends = integer_hash_ends_3d(cell);
    let joined = integer_hash_joined(ends);
    let low = gaussian_first_corners_3d(integer_hash_words(joined ^ vec4<u32>(ends.low.z), key));
    let high = gaussian_first_corners_3d(integer_hash_words(joined ^ vec4<u32>(ends.high.z), key));
    return corners_blend_3d(low, high, t, w, slope);
}

// The noise at a position in [0, 1]^3 of a cell.
fn gaussian_in_cell_3d(cell: vec3<i32>, t: vec3<f32>, key: u32) -> Sample3d {
    let w = fade_quintic(vec4<f32>(t, 0.0)).xyz;
    let slope = fade_quintic_slope(vec4<f32>(t, 0.0)).xyz;
    return gaussian_normalized_3d(gaussian_sum_in_cell_3d(cell, t, w, slope, key), gaussian_variance_3d(t, w, slope));
}

// Both channels at a position in [0, 1]^2 of a cell, from one pass over the lattice and one
// variance.
fn gaussian_pair_in_cell_2d(cell: vec2<i32>, t: vec2<f32>, key: u32) -> GaussianPair2d {
    let w = fade_quintic(vec4<f32>(t, 0.0, 0.0)).xy;
    let slope = fade_quintic_slope(vec4<f32>(t, 0.0, 0.0)).xy;
    let words = integer_hash_words(integer_hash_joined(integer_hash_ends_2d(cell)), key);
    let variance = gaussian_variance_2d(t, w, slope);
    let first = gaussian_normalized_2d(columns_blend(gaussian_first_corners_2d(words), t, w, slope), variance);
    let second = gaussian_normalized_2d(columns_blend(gaussian_second_corners_2d(words), t, w, slope), variance);
    return GaussianPair2d(
        vec2<f32>(first.value, second.value),
        vec2<f32>(first.gradient.x, second.gradient.x),
        vec2<f32>(first.gradient.y, second.gradient.y),
    );
}

// Both channels at a position in [0, 1]^3 of a cell.
fn gaussian_pair_in_cell_3d(cell: vec3<i32>, t: vec3<f32>, key: u32) -> GaussianPair3d {
    let ends = integer_hash_ends_3d(cell);
    let w = fade_quintic(vec4<f32>(t, 0.0)).xyz;
    let slope = fade_quintic_slope(vec4<f32>(t, 0.0)).xyz;
    let joined = integer_hash_joined(ends);
    let low = integer_hash_words(joined ^ vec4<u32>(ends.low.z), key);
    let high = integer_hash_words(joined ^ vec4<u32>(ends.high.z), key);
    let variance = gaussian_variance_3d(t, w, slope);
    let first = gaussian_normalized_3d(
        corners_blend_3d(gaussian_first_corners_3d(low), gaussian_first_corners_3d(high), t, w, slope), variance,
    );
    let second = gaussian_normalized_3d(
        corners_blend_3d(gaussian_second_corners_3d(low), gaussian_second_corners_3d(high), t, w, slope), variance,
    );
    return GaussianPair3d(
        vec2<f32>(first.value, second.value),
        vec2<f32>(first.gradient.x, second.gradient.x),
        vec2<f32>(first.gradient.y, second.gradient.y),
        vec2<f32>(first.gradient.z, second.gradient.z),
    );
}

// The noise at any point; 0 if a coordinate is not finite.
fn gaussian_noise_2d(p: vec2<f32>, key: u32) -> Sample2d {
    let at = cell_place_2d(p);
    return sample_known_2d(gaussian_in_cell_2d(at.cell, at.place, key), at.known);
}

fn gaussian_noise_3d(p: vec3<f32>, key: u32) -> Sample3d {
    let at = cell_place_3d(p);
    return sample_known_3d(gaussian_in_cell_3d(at.cell, at.place, key), at.known);
}

// Both channels at any point; 0 if a coordinate is not finite.
fn gaussian_pair_2d(p: vec2<f32>, key: u32) -> GaussianPair2d {
    let at = cell_place_2d(p);
    if at.known {
        return gaussian_pair_in_cell_2d(at.cell, at.place, key);
    }
    return GaussianPair2d(vec2<f32>(0.0), vec2<f32>(0.0), vec2<f32>(0.0));
}

fn gaussian_pair_3d(p: vec3<f32>, key: u32) -> GaussianPair3d {
    let at = cell_place_3d(p);
    if at.known {
        return gaussian_pair_in_cell_3d(at.cell, at.place, key);
    }
    return GaussianPair3d(vec2<f32>(0.0), vec2<f32>(0.0), vec2<f32>(0.0), vec2<f32>(0.0));
}
