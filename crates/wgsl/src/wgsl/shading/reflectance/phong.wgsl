// Cosine-power lobes, in 1/sr per specular color: `asperity_shading::Phong`,
// `asperity_shading::reflectance::BlinnPhongLobe`.

// c^n of Phong, computed from 1 - c, half the square of the chord; n in [0, 1e6].
fn phong_eval(exponent: f32, wi: vec3<f32>, wo: vec3<f32>) -> f32 {
    if !direction_are_above(wi, wo) {
        return 0.0;
    }
    // Uses the chord, as the power magnifies the rounding of a cosine near 1.
    let apart = wi - vec3<f32>(-wo.x, -wo.y, wo.z);
    let chord = dot(apart, apart);
    if !(chord < 2.0) {
        return 0.0;
    }
    return (exponent + 2.0) / 6.2831855 * elementary_exp(exponent * elementary_ln_1p(-0.5 * chord));
}

// `factor` (n.h)^n of Blinn, with `blinn_phong_brdf_factor` or the factor of `BlinnPhongLobe`; n in
// [0, 1e6].
fn blinn_phong_brdf_eval(exponent: f32, factor: f32, wi: vec3<f32>, wo: vec3<f32>) -> f32 {
    if !direction_are_above(wi, wo) {
        return 0.0;
    }
    // The logarithm of the cosine, from the tangent.
    let x = (wi.x + wo.x) / (wi.z + wo.z);
    let y = (wi.y + wo.y) / (wi.z + wo.z);
    let square = min(x * x + y * y, 1e37);
    return brdf_finite(factor * elementary_exp(-0.5 * exponent * elementary_ln_1p(square)));
}

// The factor for an albedo of at most 1: (n + 2)(n + 4)/(8 pi (2^(-n/2) + n)),
// `BlinnPhongNormalization::Albedo`.
fn blinn_phong_brdf_factor(exponent: f32) -> f32 {
    let n = exponent;
    return (n + 2.0) * (n + 4.0) / (elementary_exp(n * -0.3465736) + n) * 0.039788734;
}
