// Fuzz by linearly transformed cosines: `asperity_shading::reflectance::ZeltnerFuzz`.

// The albedo per color seen at this angle, for alpha in [0.01, 1].
fn zeltner_fuzz_albedo(alpha: f32, cos_theta: f32) -> f32 {
    let x = math_clamped(cos_theta, 1.0);
    let y = alpha;
    let s = y * (0.0206607 + 1.58491 * y) / (0.0379424 + y * (1.32227 + y));
    let m = y * (-0.193854 + y * (-1.14885 + y * (1.7932 - 0.95943 * y * y))) / (0.046391 + y);
    let o = y * (0.000654023 + (-0.0207818 + 0.119681 * y) * y) / (1.26264 + y * (-1.92021 + y));
    let away = (x - m) / s;
    return math_clamped(elementary_exp(-0.5 * away * away) / (s * 2.5066283) + o, 1.0);
}

// f_r per color, in 1/sr.
fn zeltner_fuzz_eval(alpha: f32, wi: vec3<f32>, wo: vec3<f32>) -> f32 {
    if !direction_are_above(wi, wo) {
        return 0.0;
    }
    let x = math_clamped(wo.z, 1.0);
    let y = alpha;
    let a = (2.58126 * x + 0.813703 * y) * y / (1.0 + 0.310327 * x * x + 2.60994 * x * y);
    let b = sqrt(1.0 - x) * (y - 1.0) * y * y * y / (0.0000254053 + 1.71228 * x - 1.71506 * x * y + 1.34174 * y * y);
    let azimuth = direction_unit_or_2d(wo.xy, vec2<f32>(1.0, 0.0));
    let along = a * dot(azimuth, wi.xy) + b * wi.z;
    let across = a * (azimuth.x * wi.y - azimuth.y * wi.x);
    let ratio = a / (along * along + across * across + wi.z * wi.z);
    return brdf_finite(zeltner_fuzz_albedo(alpha, x) * brdf_finite(ratio * ratio * 0.31830987));
}
