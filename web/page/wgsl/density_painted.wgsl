// Density functions for bumps: a painted map.

fn bumps_density(m: vec3<f32>) -> f32 {
    return packed_map_density(m);
}

fn bumps_from_gaussian(z: vec2<f32>) -> vec3<f32> {
    return packed_map_from_gaussian(z);
}

fn bumps_conditional_density(h: vec3<f32>, split: GaussianSplit) -> f32 {
    return packed_map_conditional_density(h, split);
}

// Gaussian coordinates of (0, 0, 1).
fn bumps_flat() -> vec2<f32> {
    return packed_map_to_gaussian(vec3<f32>(0.0, 0.0, 1.0));
}
