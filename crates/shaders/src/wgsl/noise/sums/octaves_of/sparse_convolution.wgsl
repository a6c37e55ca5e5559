// Octaves of sparse convolution noise of one impulse per cell, asperity_noise::Sparse: what `octaves_sum_3d` and its like are made of.

// One octave from its own coordinates, with cells counted from another; 0 where a coordinate is not finite.
fn octaves_noise_3d(cell: vec3<i32>, q: vec3<f32>, key: u32) -> Sample3d {
    let at = cell_place_3d(q);
    return sample_known_3d(sparse_in_cell_3d(cell + at.cell, at.place, 1u, key), at.known);
}

// One octave in the plane.
fn octaves_noise_2d(cell: vec2<i32>, q: vec2<f32>, key: u32) -> Sample2d {
    let at = cell_place_2d(q);
    return sample_known_2d(sparse_in_cell_2d(cell + at.cell, at.place, 1u, key), at.known);
}
