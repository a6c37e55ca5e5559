// The Blinn-Phong normal distribution of an exponent n: `asperity_ndf_sampling::BlinnPhong`. It is
// Student's t with gamma = n/2 + 2 and the roughness sqrt(2/(n + 2)), whose functions compute
// everything else.

// An exponent clamped to the valid range, 0 to 2e12; NaN becomes 0.
fn blinn_phong_clamped(exponent: f32) -> f32 {
    return clamp(elementary_number(exponent), 0.0, 2e12);
}

// The roughness of an exponent, along both axes.
fn blinn_phong_roughness(exponent: f32) -> vec2<f32> {
    return vec2<f32>(max(sqrt(2.0 / (exponent + 2.0)), ROUGHNESS_LEAST));
}

// D(m) = (n + 2)/(2 pi) cos^n theta, in 1/sr.
fn blinn_phong_d(exponent: f32, m: vec3<f32>) -> f32 {
    return student_t_d(blinn_phong_roughness(exponent), 0.5 * exponent + 2.0, m);
}

// T(z): the normal of Gaussian coordinates.
fn blinn_phong_warp_gaussian(exponent: f32, z: vec2<f32>) -> vec3<f32> {
    return student_t_warp_gaussian(blinn_phong_roughness(exponent), 0.5 * exponent + 2.0, z);
}

// The inverse of T.
fn blinn_phong_invert(exponent: f32, m: vec3<f32>) -> vec2<f32> {
    return student_t_invert(blinn_phong_roughness(exponent), 0.5 * exponent + 2.0, m);
}

// A normal with the density D over the macro surface, from uniform u in the unit square.
fn blinn_phong_sample(exponent: f32, u: vec2<f32>) -> vec3<f32> {
    return student_t_sample(blinn_phong_roughness(exponent), 0.5 * exponent + 2.0, u);
}
