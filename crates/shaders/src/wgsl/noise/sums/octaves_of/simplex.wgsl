// Octaves of simplex noise of the continuous kernel, asperity_noise::Simplex: what `octaves_sum_3d` and its like are made of.

// One octave from its own coordinates, with cells of the skewed lattice counted from another; 0 beyond the kind's reach.
fn octaves_noise_3d(cell: vec3<i32>, q: vec3<f32>, key: u32) -> Sample3d {
    return simplex_in_cell_3d(cell, q, key);
}

// One octave in the plane.
fn octaves_noise_2d(cell: vec2<i32>, q: vec2<f32>, key: u32) -> Sample2d {
    return simplex_in_cell_2d(cell, q, key);
}

// One octave in four dimensions.
fn octaves_noise_4d(cell: vec4<i32>, q: vec4<f32>, key: u32) -> Sample4d {
    return simplex_in_cell_4d(cell, q, key);
}
