// The two rules of level of detail of a bump map: `asperity_shading::LevelOfDetail`, without
// Fresnel term and shadowing, in 1/sr. The far field is the normal distribution itself. z,
// variance and blend belong to the resolved octaves,
// `asperity_shading::level_of_detail::ResolvedBumps`.

// Gaussian coordinates of the center of the normals within a pixel under the exact rule; T maps
// them to its normal.
fn level_of_detail_exact_coordinates(z: vec2<f32>, variance: f32) -> vec2<f32> {
    let bounded = clamp(elementary_number(variance), 0.0, 1.0);
    return z * sqrt(bounded);
}

// Gaussian coordinates of the fractal rule's facet: the noise with its first octave faded in from
// z_flat, where T is (0, 0, 1). z_flat is 0 for a distribution that is symmetric in x and y. If
// nothing is resolved, blend = 0, the facet is (0, 0, 1) itself.
fn level_of_detail_fractal_coordinates(z: vec2<f32>, blend: f32, z_flat: vec2<f32>) -> vec2<f32> {
    if blend >= 1.0 {
        return z;
    }
    return z_flat + (z - z_flat) * clamp(elementary_number(blend), 0.0, 1.0);
}

// The half vector h in the frame of a facet's normal. The fractal rule reflects the density at it,
// 0 for h.z <= 0.
fn level_of_detail_fractal_half_vector(normal: vec3<f32>, h: vec3<f32>) -> vec3<f32> {
    return frame_to_local(frame_from_normal(normal), h);
}

// The exact rule of GGX: the conditional distribution of normals. Its mean over the surface is the
// far field at every zoom.
fn level_of_detail_exact_ggx(alpha: vec2<f32>, h: vec3<f32>, z: vec2<f32>, variance: f32) -> f32 {
    return ggx_residual_ndf(alpha, h, gaussian_split(z, variance));
}

// The fractal rule of GGX: the whole distribution in the frame of the facet.
fn level_of_detail_fractal_ggx(alpha: vec2<f32>, h: vec3<f32>, z: vec2<f32>, blend: f32) -> f32 {
    if !(h.z > 0.0) {
        return 0.0;
    }
    var normal = vec3<f32>(0.0, 0.0, 1.0);
    if blend > 0.0 {
        normal = ggx_warp_gaussian(alpha, level_of_detail_fractal_coordinates(z, blend, vec2<f32>(0.0, 0.0)));
    }
    return ggx_d(alpha, level_of_detail_fractal_half_vector(normal, h));
}

// The exact rule of Beckmann.
fn level_of_detail_exact_beckmann(alpha: vec2<f32>, h: vec3<f32>, z: vec2<f32>, variance: f32) -> f32 {
    return beckmann_residual_ndf(alpha, h, gaussian_split(z, variance));
}

// The fractal rule of Beckmann.
fn level_of_detail_fractal_beckmann(alpha: vec2<f32>, h: vec3<f32>, z: vec2<f32>, blend: f32) -> f32 {
    if !(h.z > 0.0) {
        return 0.0;
    }
    var normal = vec3<f32>(0.0, 0.0, 1.0);
    if blend > 0.0 {
        normal = beckmann_warp_gaussian(alpha, level_of_detail_fractal_coordinates(z, blend, vec2<f32>(0.0, 0.0)));
    }
    return beckmann_d(alpha, level_of_detail_fractal_half_vector(normal, h));
}
