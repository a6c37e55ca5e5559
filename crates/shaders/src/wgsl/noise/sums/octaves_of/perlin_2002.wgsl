// Octaves of Perlin's noise of 2002, asperity_noise::Perlin2002: what `octaves_sum_3d` and its like are made of.

// One octave from its own coordinates, with cells counted from another; 0 where a coordinate is not finite.
fn octaves_noise_3d(cell: vec3<i32>, q: vec3<f32>, key: u32) -> Sample3d {
    let at = cell_place_3d(q);
    return sample_known_3d(perlin_2002_in_cell_3d(cell + at.cell, at.place, key), at.known);
}

// One octave in the plane.
fn octaves_noise_2d(cell: vec2<i32>, q: vec2<f32>, key: u32) -> Sample2d {
    let at = cell_place_2d(q);
    return sample_known_2d(perlin_2002_in_cell_2d(cell + at.cell, at.place, key), at.known);
}

// One octave in four dimensions.
fn octaves_noise_4d(cell: vec4<i32>, q: vec4<f32>, key: u32) -> Sample4d {
    let at = cell_place_4d(q);
    return sample_known_4d(perlin_2002_in_cell_4d(cell + at.cell, at.place, key), at.known);
}
