// Density functions for bumps: a painted map.

fn bumps_d(m: vec3<f32>) -> f32 {
    return packed_map_d(m);
}

fn bumps_warp_gaussian(z: vec2<f32>) -> vec3<f32> {
    return packed_map_warp_gaussian(z);
}

fn bumps_residual_ndf(h: vec3<f32>, split: GaussianSplit) -> f32 {
    return packed_map_residual_ndf(h, split);
}

// Gaussian coordinates of (0, 0, 1).
fn bumps_flat() -> vec2<f32> {
    return packed_map_invert(vec3<f32>(0.0, 0.0, 1.0));
}
