// Common functions of reflectances: `reflectance/brdf.rs` of asperity-shading.

// A reflectance clamped to finite, non-negative values; 0 for NaN.
fn brdf_finite(x: f32) -> f32 {
    return select(0.0, min(x, MATH_LARGEST), x > 0.0);
}

// The same for each channel.
fn brdf_finite_channels(x: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(brdf_finite(x.x), brdf_finite(x.y), brdf_finite(x.z));
}
