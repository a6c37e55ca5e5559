// Roughness along x and y, and vectors stretched by it: `density/roughness.rs` and
// `density/closed_form.rs` of asperity-ndf-sampling.

const ROUGHNESS_LEAST: f32 = 1e-6;
const ROUGHNESS_LARGEST: f32 = 1e6;

// A roughness clamped to the valid range, so 0 becomes 1e-6. NaN becomes 1, dull rather than a
// mirror.
fn roughness_clamped_along(alpha: f32) -> f32 {
    let is_number = (bitcast<u32>(alpha) & 0x7fffffffu) <= 0x7f800000u;
    return select(1.0, clamp(alpha, ROUGHNESS_LEAST, ROUGHNESS_LARGEST), is_number);
}

// Both roughnesses clamped to the valid range, like `Ggx::new_clamped`. All densities require valid
// roughnesses.
fn roughness_clamped(alpha: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(roughness_clamped_along(alpha.x), roughness_clamped_along(alpha.y));
}

// v in the space where the roughnesses are 1, with z at least 0; NaN coordinates are taken as 0.
fn roughness_stretched(alpha: vec2<f32>, v: vec3<f32>) -> vec3<f32> {
    let x = elementary_bounded(v.x, 1e12) * alpha.x;
    let y = elementary_bounded(v.y, 1e12) * alpha.y;
    return vec3<f32>(x, y, clamp(elementary_number(v.z), 0.0, 1e12));
}

// v over its length, for a length that is not 0 and whose square is finite.
fn roughness_unit(v: vec3<f32>) -> vec3<f32> {
    let scale = 1.0 / sqrt((v.x * v.x + v.y * v.y) + v.z * v.z);
    return vec3<f32>(v.x * scale, v.y * scale, v.z * scale);
}

// The standard deviation of Beckmann slopes along v, times the length of v in the plane.
fn roughness_spread(alpha: vec2<f32>, v: vec3<f32>) -> f32 {
    let x = alpha.x * v.x;
    let y = alpha.y * v.y;
    return sqrt(0.5 * (x * x + y * y));
}
