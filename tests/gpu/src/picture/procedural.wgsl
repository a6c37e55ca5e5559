// Bumps from noise in space: downward slopes and their resolved fraction.
fn surface_bumps(p: vec3<f32>, uv: vec2<f32>, frame: Frame, octaves: f32) -> vec3<f32> {
    let seen = gaussian_slopes_3d(p, frame.tangent, frame.bitangent, octaves, 0u);
    return vec3<f32>(-seen.z, seen.resolved_variance);
}

// The facet of two Gaussian numbers.
fn surface_facet(z: vec2<f32>) -> vec3<f32> {
    return ggx_warp_gaussian(surface_view.alpha, z);
}
