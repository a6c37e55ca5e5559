// White noise, `asperity_noise::WhiteNoise`: a number per cell, uniform in (-1, 1). Its gradient is 0.

fn white_in_cell_2d(cell: vec2<i32>, key: u32) -> f32 {
    let ends = integer_hash_ends_2d(cell).low;
    return variate_uniform(integer_hash_word(ends.x ^ ends.y, key));
}

fn white_in_cell_3d(cell: vec3<i32>, key: u32) -> f32 {
    let ends = integer_hash_ends_3d(cell).low;
    return variate_uniform(integer_hash_word(ends.x ^ ends.y ^ ends.z, key));
}

// The noise at any point; 0 if a coordinate is not finite.
fn white_noise_2d(p: vec2<f32>, key: u32) -> Sample2d {
    let at = cell_place_2d(p);
    return sample_known_2d(Sample2d(white_in_cell_2d(at.cell, key), vec2<f32>(0.0)), at.known);
}

fn white_noise_3d(p: vec3<f32>, key: u32) -> Sample3d {
    let at = cell_place_3d(p);
    return sample_known_3d(Sample3d(white_in_cell_3d(at.cell, key), vec3<f32>(0.0)), at.known);
}
