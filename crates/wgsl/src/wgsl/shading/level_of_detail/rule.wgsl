// The two rules of level of detail of a bump map: `asperity_shading::LevelOfDetail`, without
// Fresnel term and shadowing, in 1/sr. The far field is the normal distribution itself. z, share
// and fade belong to the resolved octaves, `asperity_shading::level_of_detail::Coordinates`.

// Gaussian coordinates of the center of the normals within a pixel under the exact rule; T maps
// them to its normal.
fn level_of_detail_exact_coordinates(z: vec2<f32>, share: f32) -> vec2<f32> {
    let bounded = clamp(elementary_number(share), 0.0, 1.0);
    return z * sqrt(bounded);
}

// Gaussian coordinates of the fractal rule's facet: the noise with its first octave faded in from
// z_flat, where T is (0, 0, 1). z_flat is 0 for a distribution that is symmetric in x and y. If
// nothing is resolved, fade = 0, the facet is (0, 0, 1) itself.
fn level_of_detail_fractal_coordinates(z: vec2<f32>, fade: f32, z_flat: vec2<f32>) -> vec2<f32> {
    if fade >= 1.0 {
        return z;
    }
    return z_flat + (z - z_flat) * clamp(elementary_number(fade), 0.0, 1.0);
}

// The half vector h in the frame of a facet's normal. The fractal rule reflects the density at it,
// 0 for h.z <= 0.
fn level_of_detail_fractal_half_vector(normal: vec3<f32>, h: vec3<f32>) -> vec3<f32> {
    return frame_to_local(frame_from_normal(normal), h);
}

// The exact rule of GGX: the conditional distribution of normals. Its mean over the surface is the
// far field at every zoom.
fn level_of_detail_exact_ggx(alpha: vec2<f32>, h: vec3<f32>, z: vec2<f32>, share: f32) -> f32 {
    return ggx_conditional_density(alpha, h, gaussian_split(z, share));
}

// The fractal rule of GGX: the whole distribution in the frame of the facet.
fn level_of_detail_fractal_ggx(alpha: vec2<f32>, h: vec3<f32>, z: vec2<f32>, fade: f32) -> f32 {
    if !(h.z > 0.0) {
        return 0.0;
    }
    var normal = vec3<f32>(0.0, 0.0, 1.0);
    if fade > 0.0 {
        normal = ggx_from_gaussian(alpha, level_of_detail_fractal_coordinates(z, fade, vec2<f32>(0.0, 0.0)));
    }
    return ggx_density(alpha, level_of_detail_fractal_half_vector(normal, h));
}

// The exact rule of Beckmann.
fn level_of_detail_exact_beckmann(alpha: vec2<f32>, h: vec3<f32>, z: vec2<f32>, share: f32) -> f32 {
    return beckmann_conditional_density(alpha, h, gaussian_split(z, share));
}

// The fractal rule of Beckmann.
fn level_of_detail_fractal_beckmann(alpha: vec2<f32>, h: vec3<f32>, z: vec2<f32>, fade: f32) -> f32 {
    if !(h.z > 0.0) {
        return 0.0;
    }
    var normal = vec3<f32>(0.0, 0.0, 1.0);
    if fade > 0.0 {
        normal = beckmann_from_gaussian(alpha, level_of_detail_fractal_coordinates(z, fade, vec2<f32>(0.0, 0.0)));
    }
    return beckmann_density(alpha, level_of_detail_fractal_half_vector(normal, h));
}
