// Density functions for bumps: Beckmann.

fn bumps_density(m: vec3<f32>) -> f32 {
    return beckmann_density(bumps_view.alpha, m);
}

fn bumps_from_gaussian(z: vec2<f32>) -> vec3<f32> {
    return beckmann_from_gaussian(bumps_view.alpha, z);
}

fn bumps_conditional_density(h: vec3<f32>, split: GaussianSplit) -> f32 {
    return beckmann_conditional_density(bumps_view.alpha, h, split);
}

// Gaussian coordinates of (0, 0, 1).
fn bumps_flat() -> vec2<f32> {
    return vec2<f32>(0.0);
}
