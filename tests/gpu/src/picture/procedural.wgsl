// Bumps from noise in space: both channels and their resolved fraction.
fn surface_bumps(p: vec3<f32>, uv: vec2<f32>, octaves: f32) -> vec3<f32> {
    let seen = gaussian_fbm_3d(p, octaves, 0u);
    return vec3<f32>(seen.pair.value, seen.resolved_variance);
}

// The facet of two Gaussian numbers.
fn surface_facet(z: vec2<f32>) -> vec3<f32> {
    return ggx_warp_gaussian(surface_view.alpha, z);
}
