// Value-gradient noise, `asperity_noise::ValueGradient`: value and gradient noise on one lattice.
// The weight of gradient noise is in [0, 1]. Values are clamped to [-1, 1].

const VALUE_GRADIENT_SCALE: vec3<f32> = vec3<f32>(0.999998, 1.4142107, 1.1546981);

fn value_gradient_values(words: vec4<u32>, weight: f32) -> vec4<f32> {
    return variates_uniform(integer_hash_further_words(words, 6u)) * (VALUE_GRADIENT_SCALE.x * (1.0 - weight));
}

fn value_gradient_corners_3d(terms: vec4<u32>, weight: f32, key: u32) -> Corners3d {
    let words = integer_hash_words(terms, key);
    let g = variate_directions_3d(words, VALUE_GRADIENT_SCALE.z * weight);
    return Corners3d(value_gradient_values(words, weight), g.x, g.y, g.z);
}

// The noise at a position in [0, 1]^2 of a cell.
fn value_gradient_in_cell_2d(cell: vec2<i32>, t: vec2<f32>, weight: f32, key: u32) -> Sample2d {
    let w = fade_quintic(vec4<f32>(t, 0.0, 0.0));
    let slope = fade_quintic_slope(vec4<f32>(t, 0.0, 0.0));
    let words = integer_hash_words(integer_hash_joined(integer_hash_ends_2d(cell)), key);
    let g = variate_directions_2d(words, VALUE_GRADIENT_SCALE.y * weight);
    let blend = columns_blend(Columns(value_gradient_values(words, weight), g.x, g.y), t, w.xy, slope.xy);
    return Sample2d(clamp(blend.value, -1.0, 1.0), blend.gradient);
}

// The noise at a position in [0, 1]^3 of a cell.
fn value_gradient_in_cell_3d(cell: vec3<i32>, t: vec3<f32>, weight: f32, key: u32) -> Sample3d {
    let ends = integer_hash_ends_3d(cell);
    let w = fade_quintic(vec4<f32>(t, 0.0));
    let slope = fade_quintic_slope(vec4<f32>(t, 0.0));
    let joined = integer_hash_joined(ends);
    let low = value_gradient_corners_3d(joined ^ vec4<u32>(ends.low.z), weight, key);
    let high = value_gradient_corners_3d(joined ^ vec4<u32>(ends.high.z), weight, key);
    let blend = corners_blend_3d(low, high, t, w.xyz, slope.xyz);
    return Sample3d(clamp(blend.value, -1.0, 1.0), blend.gradient);
}

// The noise at any point; 0 if a coordinate is not finite.
fn value_gradient_noise_2d(p: vec2<f32>, weight: f32, key: u32) -> Sample2d {
    let at = cell_place_2d(p);
    return sample_known_2d(value_gradient_in_cell_2d(at.cell, at.place, weight, key), at.known);
}

fn value_gradient_noise_3d(p: vec3<f32>, weight: f32, key: u32) -> Sample3d {
    let at = cell_place_3d(p);
    return sample_known_3d(value_gradient_in_cell_3d(at.cell, at.place, weight, key), at.known);
}
