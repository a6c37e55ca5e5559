// The directional albedo of white GGX facets: `asperity_shading::reflectance::GgxAlbedo`.

// The entries from `base` on, at a roughness and a place of the cosine.
fn ggx_albedo_look_up(base: u32, alpha: f32, place: f32) -> f32 {
    let across = energy_spline(place, 24u);
    let down = energy_spline(sqrt(alpha), 16u);
    var sum = 0.0;
    for (var i = 0u; i < 3u; i++) {
        let at = base + (down.first + i) * 24u + across.first;
        let row = vec3<f32>(ggx_albedo_number(at), ggx_albedo_number(at + 1u), ggx_albedo_number(at + 2u));
        sum += down.weights[i] * dot(across.weights, row);
    }
    return sum;
}

// The entries from `base` on, at a roughness.
fn ggx_albedo_look_up_mean(base: u32, alpha: f32) -> f32 {
    let down = energy_spline(sqrt(energy_alpha(alpha)), 16u);
    let at = base + down.first;
    return dot(down.weights, vec3<f32>(ggx_albedo_number(at), ggx_albedo_number(at + 1u), ggx_albedo_number(at + 2u)));
}

// E of isotropic roughness at this cosine of the view.
fn ggx_albedo_isotropic(alpha: f32, cos_theta: f32) -> f32 {
    let a = energy_alpha(alpha);
    return ggx_albedo_look_up(0u, a, energy_place(math_clamped(cos_theta, 1.0), 2.0 * a));
}

// E(wo): `GgxAlbedo::albedo`.
fn ggx_albedo(alpha: vec2<f32>, wo: vec3<f32>) -> f32 {
    let x = ggx_albedo_isotropic(alpha.x, wo.z);
    if alpha.x == alpha.y {
        return clamp(x, 0.001, 1.0);
    }
    return clamp(0.5 * (x + ggx_albedo_isotropic(alpha.y, wo.z)), 0.001, 1.0);
}

// E_avg: `GgxAlbedo::mean_albedo`.
fn ggx_mean_albedo(alpha: vec2<f32>) -> f32 {
    let mean = 0.5 * (ggx_albedo_look_up_mean(384u, alpha.x) + ggx_albedo_look_up_mean(384u, alpha.y));
    return clamp(mean, 0.001, 1.0);
}

fn ggx_schlick_moment_isotropic(alpha: f32, cos_theta: f32) -> f32 {
    let place = sqrt(math_clamped(cos_theta, 1.0));
    let angle = 1.0 - clamp(ggx_albedo_look_up(400u, energy_alpha(alpha), place), 0.0, 1.0);
    let squared = angle * angle;
    return clamp(ggx_albedo_isotropic(alpha, cos_theta), 0.001, 1.0) * squared * squared * angle;
}

// The albedo with the facet reflectance (1 − wo·h)⁵: `GgxAlbedo::schlick_moment`.
fn ggx_schlick_moment(alpha: vec2<f32>, wo: vec3<f32>) -> f32 {
    let x = ggx_schlick_moment_isotropic(alpha.x, wo.z);
    if alpha.x == alpha.y {
        return x;
    }
    return 0.5 * (x + ggx_schlick_moment_isotropic(alpha.y, wo.z));
}

// Its mean over views: `GgxAlbedo::mean_schlick_moment`.
fn ggx_mean_schlick_moment(alpha: vec2<f32>) -> f32 {
    return clamp(0.5 * (ggx_albedo_look_up_mean(784u, alpha.x) + ggx_albedo_look_up_mean(784u, alpha.y)), 0.0, 1.0);
}
