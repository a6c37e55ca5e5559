// Value noise with quintic weights, `asperity_noise::ValueNoise`. Values are clamped to [-1, 1].
//
// The corners of a cell at one end of the third axis are a vector. Along the first two axes its
// order is low and low, high and low, low and high, high and high.

// The scale of signed words, just under 2^-31.
const VALUE_UNIT: f32 = 4.6566034e-10;

fn value_numbers(keyed: vec4<u32>) -> vec4<f32> {
    return vec4<f32>(bitcast<vec4<i32>>(integer_hash_upper_words(keyed)));
}

// The blend along the second axis.
fn value_across(ends: vec2<f32>, weight: f32) -> f32 {
    return ends.x + weight * (ends.y - ends.x);
}

// The blend along the first axis, of both ends of the second.
fn value_along(corners: vec4<f32>, weight: f32) -> vec2<f32> {
    return (corners.xz + weight * (corners.yw - corners.xz)) * VALUE_UNIT;
}

fn value_along_slope(corners: vec4<f32>, slope: f32) -> vec2<f32> {
    return (slope * (corners.yw - corners.xz)) * VALUE_UNIT;
}

// The noise at a position in [0, 1]^2 of a cell.
fn value_in_cell_2d(cell: vec2<i32>, t: vec2<f32>, key: u32) -> Sample2d {
    let ends = integer_hash_ends_2d(cell);
    let w = fade_quintic(vec4<f32>(t, 0.0, 0.0));
    let slope = fade_quintic_slope(vec4<f32>(t, 0.0, 0.0));
    let corners = value_numbers(integer_hash_keyed(ends, key));
    let edges = value_along(corners, w.x);
    return Sample2d(
        clamp(value_across(edges, w.y), -1.0, 1.0),
        vec2<f32>(value_across(value_along_slope(corners, slope.x), w.y), slope.y * (edges.y - edges.x)),
    );
}

// The noise at a position in [0, 1]^3 of a cell.
fn value_in_cell_3d(cell: vec3<i32>, t: vec3<f32>, key: u32) -> Sample3d {
    let ends = integer_hash_ends_3d(cell);
    let w = fade_quintic(vec4<f32>(t, 0.0));
    let slope = fade_quintic_slope(vec4<f32>(t, 0.0));
    let keyed = integer_hash_keyed(ends, key);
    let low = value_numbers(keyed ^ vec4<u32>(ends.low.z));
    let rise = value_numbers(keyed ^ vec4<u32>(ends.high.z)) - low;
    let corners = low + w.z * rise;
    let edges = value_along(corners, w.x);
    return Sample3d(
        clamp(value_across(edges, w.y), -1.0, 1.0),
        vec3<f32>(
            value_across(value_along_slope(corners, slope.x), w.y),
            slope.y * (edges.y - edges.x),
            value_across(value_along(slope.z * rise, w.x), w.y),
        ),
    );
}

// The noise at a position in [0, 1]^4 of a cell.
fn value_in_cell_4d(cell: vec4<i32>, t: vec4<f32>, key: u32) -> Sample4d {
    let ends = integer_hash_ends(cell);
    let w = fade_quintic(t);
    let slope = fade_quintic_slope(t);
    let keyed = integer_hash_keyed(ends, key);
    let before = value_numbers(keyed ^ vec4<u32>(ends.low.z ^ ends.low.w));
    let before_rise = value_numbers(keyed ^ vec4<u32>(ends.high.z ^ ends.low.w)) - before;
    let after = value_numbers(keyed ^ vec4<u32>(ends.low.z ^ ends.high.w));
    let after_rise = value_numbers(keyed ^ vec4<u32>(ends.high.z ^ ends.high.w)) - after;
    let low = before + w.z * before_rise;
    let rise = (after + w.z * after_rise) - low;
    let corners = low + w.w * rise;
    let start = slope.z * before_rise;
    let along_third = start + w.w * (slope.z * after_rise - start);
    let edges = value_along(corners, w.x);
    return Sample4d(
        clamp(value_across(edges, w.y), -1.0, 1.0),
        vec4<f32>(
            value_across(value_along_slope(corners, slope.x), w.y),
            slope.y * (edges.y - edges.x),
            value_across(value_along(along_third, w.x), w.y),
            value_across(value_along(slope.w * rise, w.x), w.y),
        ),
    );
}

// The noise at any point; 0 if a coordinate is not finite.
fn value_noise_2d(p: vec2<f32>, key: u32) -> Sample2d {
    let at = cell_place_2d(p);
    return sample_known_2d(value_in_cell_2d(at.cell, at.place, key), at.known);
}

fn value_noise_3d(p: vec3<f32>, key: u32) -> Sample3d {
    let at = cell_place_3d(p);
    return sample_known_3d(value_in_cell_3d(at.cell, at.place, key), at.known);
}

fn value_noise_4d(p: vec4<f32>, key: u32) -> Sample4d {
    let at = cell_place_4d(p);
    return sample_known_4d(value_in_cell_4d(at.cell, at.place, key), at.known);
}
