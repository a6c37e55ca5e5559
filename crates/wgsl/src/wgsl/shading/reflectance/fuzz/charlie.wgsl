// Charlie sheen: `asperity_shading::reflectance::CharlieSheen`.

fn charlie_sheen_fit(alpha: f32, x: f32) -> f32 {
    let smooth_part = (1.0 - alpha) * (1.0 - alpha);
    let a = 21.5473 + smooth_part * (25.3245 - 21.5473);
    let b = 3.82987 + smooth_part * (3.32435 - 3.82987);
    let c = 0.19823 + smooth_part * (0.16801 - 0.19823);
    let d = -1.9776 + smooth_part * (-1.27393 + 1.9776);
    let e = -4.32054 + smooth_part * (-4.85967 + 4.32054);
    var power = 0.0;
    if x > 0.0 {
        power = elementary_exp(c * elementary_ln(x));
    }
    return a / (1.0 + b * power) + d * x + e;
}

// Lambda of a cosine in (0, 1].
fn charlie_sheen_lambda(alpha: f32, cos_theta: f32) -> f32 {
    if cos_theta < 0.5 {
        return elementary_exp(charlie_sheen_fit(alpha, cos_theta));
    }
    return elementary_exp(2.0 * charlie_sheen_fit(alpha, 0.5) - charlie_sheen_fit(alpha, max(1.0 - cos_theta, 0.0)));
}

// f_r per color, in 1/sr, for alpha in [0.07, 1].
fn charlie_sheen_eval(alpha: f32, wi: vec3<f32>, wo: vec3<f32>) -> f32 {
    if !direction_are_above(wi, wo) {
        return 0.0;
    }
    let h = direction_half(wi, wo);
    let across = min(h.x * h.x + h.y * h.y, 1.0);
    let inverse = 1.0 / alpha;
    var d = 0.0;
    if across > 1e-37 {
        d = (2.0 + inverse) * elementary_exp(0.5 * inverse * elementary_ln(across)) * 0.15915494;
    }
    let both = 1.0 + charlie_sheen_lambda(alpha, min(wi.z, 1.0)) + charlie_sheen_lambda(alpha, min(wo.z, 1.0));
    return brdf_finite(d / (4.0 * wi.z * wo.z * both));
}

// The albedo per color seen at this angle: `CharlieSheen::albedo`.
fn charlie_sheen_albedo(alpha: f32, cos_theta: f32) -> f32 {
    let across = energy_spline(sqrt(sqrt(math_clamped(cos_theta, 1.0))), 20u);
    let down = energy_spline((sqrt(alpha) - 0.26457512) / 0.73542488, 12u);
    var sum = 0.0;
    for (var i = 0u; i < 3u; i++) {
        let at = (down.first + i) * 20u + across.first;
        let row = vec3<f32>(charlie_albedo_number(at), charlie_albedo_number(at + 1u), charlie_albedo_number(at + 2u));
        sum += down.weights[i] * dot(across.weights, row);
    }
    return math_clamped(sum, 1.0);
}
