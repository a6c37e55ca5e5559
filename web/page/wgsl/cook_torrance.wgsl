// The microfacet model of Cook and Torrance over Beckmann's density in few operations, in place of the crate's: its masking is that of
// Walter et al. 2007, equation 15, within 0.35 % of the exact one.

fn cook_torrance_lambda(alpha: vec2<f32>, w: vec3<f32>) -> f32 {
    let across = alpha * w.xy;
    let a = w.z / max(sqrt(dot(across, across)), 1e-9);
    if a > 1.6 {
        return 0.0;
    }
    return (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 * a + 2.181 * a * a);
}

// D G/(4 cos cos) in 1/sr, and the cosine of either direction with the half vector, where Fresnel's reflectance is to be taken.
fn cook_torrance_beckmann(alpha: vec2<f32>, wi: vec3<f32>, wo: vec3<f32>) -> vec2<f32> {
    if !(min(wi.z, wo.z) > 0.0) {
        return vec2<f32>(0.0);
    }
    let h = direction_half(wi, wo);
    let slope = h.xy / (h.z * alpha);
    let square = h.z * h.z;
    let density = exp(-dot(slope, slope)) / (3.1415927 * alpha.x * alpha.y * square * square);
    let masking = 1.0 / (1.0 + cook_torrance_lambda(alpha, wi) + cook_torrance_lambda(alpha, wo));
    return vec2<f32>(density * masking / (4.0 * wi.z * wo.z), dot(wo, h));
}
