// Energy-preserving Oren-Nayar reflectance, in 1/sr: `asperity_shading::EnergyPreservingOrenNayar`.

// k - G(theta)/pi: the loss of single scattering in a direction compared with the normal.
fn energy_preserving_lacking(w: vec3<f32>) -> f32 {
    let s = rough_sine(w);
    let sc = s * w.z;
    let theta = math_angle(s, w.z);
    let g = s * (theta - sc) + 0.6666667 * (sc * (1.0 + s + s * s) / (1.0 + s) - s);
    return max(0.2877934 - g * 0.31830987, 0.0);
}

// f_r from the albedo of the facets and the roughness, both clamped to [0, 1] as by `new_clamped`.
fn energy_preserving_oren_nayar_eval(albedo: vec3<f32>, roughness: f32, wi: vec3<f32>, wo: vec3<f32>) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let rho = math_shares(albedo);
    let r = math_clamped(roughness, 1.0);
    let share = 1.0 / (1.0 + 0.2877934 * r);
    let lost = share * r * 0.21530516;
    let multiple = rho * rho * (1.0 - lost) / (1.0 - rho * lost) * (share * r * 0.31830987 / 0.21530516);
    let single = 0.31830987 * (1.0 + r * rough_stretched(wi, wo)) / (1.0 + 0.2877934 * r);
    return rho * brdf_finite(single) + multiple * (energy_preserving_lacking(wi) * energy_preserving_lacking(wo));
}
