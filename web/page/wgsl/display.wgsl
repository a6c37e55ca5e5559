// Converts radiance to display colors, and to bytes of a texture.

// sRGB of radiance compressed into [0, 1).
fn display_color(light: vec3<f32>) -> vec4<f32> {
    let linear = max(light, vec3<f32>(0.0));
    let bounded = linear / (1.0 + linear);
    let low = bounded * 12.92;
    let high = 1.055 * pow(bounded, vec3<f32>(1.0 / 2.4)) - 0.055;
    return vec4<f32>(select(high, low, bounded <= vec3<f32>(0.0031308)), 1.0);
}

// Encodes a nonnegative number in three bytes, its logarithm in steps of 2^-19. `decoded` of the
// page reads it back.
fn display_encoded(light: f32) -> vec4<f32> {
    let steps = u32(clamp((log2(max(light, 1e-9)) + 30.0) * 262144.0, 0.0, 16777215.0));
    let bytes = vec3<u32>(steps >> 16u, (steps >> 8u) & 255u, steps & 255u);
    return vec4<f32>(vec3<f32>(bytes) / 255.0, 1.0);
}
