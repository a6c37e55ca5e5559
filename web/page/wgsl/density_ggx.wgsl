// Density functions for bumps: GGX.

fn bumps_d(m: vec3<f32>) -> f32 {
    return ggx_d(bumps_view.alpha, m);
}

fn bumps_warp_gaussian(z: vec2<f32>) -> vec3<f32> {
    return ggx_warp_gaussian(bumps_view.alpha, z);
}

fn bumps_residual_ndf(h: vec3<f32>, split: GaussianSplit) -> f32 {
    return ggx_residual_ndf(bumps_view.alpha, h, split);
}

// Gaussian coordinates of (0, 0, 1).
fn bumps_flat() -> vec2<f32> {
    return vec2<f32>(0.0);
}
