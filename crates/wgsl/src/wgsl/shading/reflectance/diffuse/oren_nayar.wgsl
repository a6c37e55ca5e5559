// Oren-Nayar reflectance in three forms, in 1/sr: `asperity_shading::reflectance::OrenNayar`.

// The full model, including one interreflection; sigma in [0, pi/2] rad.
fn oren_nayar_full(albedo: vec3<f32>, sigma: f32, wi: vec3<f32>, wo: vec3<f32>) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let below = wi.z < wo.z;
    let low = select(wo, wi, below);
    let high = select(wi, wo, below);
    let sin_alpha = rough_sine(low);
    let sin_beta = rough_sine(high);
    let alpha = math_angle(sin_alpha, low.z);
    let beta = math_angle(sin_beta, high.z);
    let product = sin_alpha * sin_beta;
    var cos_phi = 0.0;
    if product > 0.0 {
        cos_phi = clamp(dot(wi.xy, wo.xy) / product, -1.0, 1.0);
    }
    let square = sigma * sigma;
    let rough = square / (square + 0.09);
    let turned = 2.0 * beta * 0.31830987;
    let first = 1.0 - 0.5 * square / (square + 0.33);
    let second = 0.45 * rough * select(sin_alpha - turned * turned * turned, sin_alpha, cos_phi >= 0.0);
    let both = 4.0 * alpha * beta * 0.101321176;
    let third = 0.125 * rough * (both * both);
    let mean_tangent = (sin_alpha + sin_beta) / (low.z + high.z);
    let direct = first + cos_phi * second * (sin_beta / high.z) + (1.0 - abs(cos_phi)) * third * mean_tangent;
    let again = 0.17 * square / (square + 0.13) * (1.0 - cos_phi * turned * turned);
    let value = albedo * 0.31830987 * max(vec3<f32>(direct) + albedo * again, vec3<f32>(0.0));
    return brdf_finite_channels(value);
}

// The qualitative model, without interreflection; sigma in [0, pi/2] rad.
fn oren_nayar_qualitative(albedo: vec3<f32>, sigma: f32, wi: vec3<f32>, wo: vec3<f32>) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let square = sigma * sigma;
    let a = 1.0 - 0.5 * square / (square + 0.33);
    let b = 0.45 * square / (square + 0.09);
    return brdf_finite_channels(albedo * (0.31830987 * (a + b * max(rough_stretched(wi, wo), 0.0))));
}

// Fujii's form, whose albedo is the albedo of its facets; sigma in [0, 1].
fn oren_nayar_fujii(albedo: vec3<f32>, sigma: f32, wi: vec3<f32>, wo: vec3<f32>) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let scale = 1.0 / (3.1415927 + 0.9041297 * sigma);
    return brdf_finite_channels(albedo * (scale * (1.0 + sigma * rough_stretched(wi, wo))));
}
