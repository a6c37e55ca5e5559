// Density functions for bumps: Student's t.

fn bumps_d(m: vec3<f32>) -> f32 {
    return student_t_d(bumps_view.alpha, bumps_view.gamma, m);
}

fn bumps_warp_gaussian(z: vec2<f32>) -> vec3<f32> {
    return student_t_warp_gaussian(bumps_view.alpha, bumps_view.gamma, z);
}

fn bumps_residual_ndf(h: vec3<f32>, split: GaussianSplit) -> f32 {
    return gaussian_split_weigh(split, bumps_d(h), student_t_invert(bumps_view.alpha, bumps_view.gamma, h));
}

// Gaussian coordinates of (0, 0, 1).
fn bumps_flat() -> vec2<f32> {
    return vec2<f32>(0.0);
}
