// Perlin noise of 1985, `asperity_noise::PerlinClassic`: unit gradients, cubic weights. Values are in
// [-1, 1].

const PERLIN_CLASSIC_SCALE: vec2<f32> = vec2<f32>(1.4142107, 1.1546981);

fn perlin_classic_corners_3d(terms: vec4<u32>, key: u32) -> Corners3d {
    let g = variate_directions_3d(integer_hash_words(terms, key), PERLIN_CLASSIC_SCALE.y);
    return Corners3d(vec4<f32>(0.0), g.x, g.y, g.z);
}

// The noise at a position in [0, 1]^2 of a cell.
fn perlin_classic_in_cell_2d(cell: vec2<i32>, t: vec2<f32>, key: u32) -> Sample2d {
    let w = fade_cubic(vec4<f32>(t, 0.0, 0.0));
    let slope = fade_cubic_slope(vec4<f32>(t, 0.0, 0.0));
    let words = integer_hash_words(integer_hash_joined(integer_hash_ends_2d(cell)), key);
    let g = variate_directions_2d(words, PERLIN_CLASSIC_SCALE.x);
    return columns_blend(Columns(vec4<f32>(0.0), g.x, g.y), t, w.xy, slope.xy);
}

// The noise at a position in [0, 1]^3 of a cell.
fn perlin_classic_in_cell_3d(cell: vec3<i32>, t: vec3<f32>, key: u32) -> Sample3d {
    let ends = integer_hash_ends_3d(cell);
    let w = fade_cubic(vec4<f32>(t, 0.0));
    let slope = fade_cubic_slope(vec4<f32>(t, 0.0));
    let joined = integer_hash_joined(ends);
    let low = perlin_classic_corners_3d(joined ^ vec4<u32>(ends.low.z), key);
    let high = perlin_classic_corners_3d(joined ^ vec4<u32>(ends.high.z), key);
    return corners_blend_3d(low, high, t, w.xyz, slope.xyz);
}

// The noise at any point; 0 if a coordinate is not finite.
fn perlin_classic_noise_2d(p: vec2<f32>, key: u32) -> Sample2d {
    let at = cell_place_2d(p);
    return sample_known_2d(perlin_classic_in_cell_2d(at.cell, at.place, key), at.known);
}

fn perlin_classic_noise_3d(p: vec3<f32>, key: u32) -> Sample3d {
    let at = cell_place_3d(p);
    return sample_known_3d(perlin_classic_in_cell_3d(at.cell, at.place, key), at.known);
}
