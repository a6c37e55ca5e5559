// The directional albedo of white GGX facets: `asperity_shading::reflectance::GgxAlbedo`.

// E of isotropic roughness at this cosine of the view.
fn ggx_albedo_isotropic(alpha: f32, cos_theta: f32) -> f32 {
    let a = energy_alpha(alpha);
    let across = energy_spline(energy_place(math_clamped(cos_theta, 1.0), 2.0 * a), 24u);
    let down = energy_spline(sqrt(a), 16u);
    var sum = 0.0;
    for (var i = 0u; i < 3u; i++) {
        let at = (down.first + i) * 24u + across.first;
        let row = vec3<f32>(ggx_albedo_number(at), ggx_albedo_number(at + 1u), ggx_albedo_number(at + 2u));
        sum += down.weights[i] * dot(across.weights, row);
    }
    return sum;
}

// E(wo): `GgxAlbedo::albedo`.
fn ggx_albedo(alpha: vec2<f32>, wo: vec3<f32>) -> f32 {
    let x = ggx_albedo_isotropic(alpha.x, wo.z);
    if alpha.x == alpha.y {
        return clamp(x, 0.001, 1.0);
    }
    return clamp(0.5 * (x + ggx_albedo_isotropic(alpha.y, wo.z)), 0.001, 1.0);
}

fn ggx_albedo_isotropic_mean(alpha: f32) -> f32 {
    let down = energy_spline(sqrt(energy_alpha(alpha)), 16u);
    let at = 384u + down.first;
    return dot(down.weights, vec3<f32>(ggx_albedo_number(at), ggx_albedo_number(at + 1u), ggx_albedo_number(at + 2u)));
}

// E_avg: `GgxAlbedo::mean_albedo`.
fn ggx_mean_albedo(alpha: vec2<f32>) -> f32 {
    return clamp(0.5 * (ggx_albedo_isotropic_mean(alpha.x) + ggx_albedo_isotropic_mean(alpha.y)), 0.001, 1.0);
}
