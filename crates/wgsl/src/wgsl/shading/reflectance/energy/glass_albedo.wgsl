// The directional albedo of rough GGX glass: `asperity_shading::reflectance::GlassAlbedo`.

// The entries from `base` on, in slices of `rows` rows of `columns`, at a place of the cosine.
fn glass_albedo_look_up(base: u32, slices: u32, rows: u32, columns: u32, index: f32, alpha: f32, place: f32) -> f32 {
    let through = energy_spline(index, slices);
    let down = energy_spline(sqrt(alpha), rows);
    let across = energy_spline(place, columns);
    var sum = 0.0;
    for (var k = 0u; k < 3u; k++) {
        for (var i = 0u; i < 3u; i++) {
            let at = base + ((through.first + k) * rows + down.first + i) * columns + across.first;
            let row = vec3<f32>(glass_albedo_number(at), glass_albedo_number(at + 1u), glass_albedo_number(at + 2u));
            sum += through.weights[k] * down.weights[i] * dot(across.weights, row);
        }
    }
    return clamp(sum, 0.001, 1.0);
}

// E(wo) on the side of wo: `GlassAlbedo::albedo`, for the relative index eta > 0.
fn glass_albedo(alpha: vec2<f32>, eta: f32, wo: vec3<f32>) -> f32 {
    let x = energy_alpha(alpha.x) * energy_alpha(alpha.x);
    let y = energy_alpha(alpha.y) * energy_alpha(alpha.y);
    let along = wo.x * wo.x;
    let share = math_clamped(along / (along + wo.y * wo.y), 1.0);
    // The roughness of isotropic facets with about the same albedo.
    let a = sqrt(0.5 * (y + share * (x - y)) + 0.25 * (x + y));
    let index = clamp(max(eta, 1.0 / eta), 1.05, 2.5);
    let at = (sqrt(index - 1.0) - sqrt(1.05 - 1.0)) / (sqrt(2.5 - 1.0) - sqrt(1.05 - 1.0));
    let mu = math_clamped(abs(wo.z), 1.0);
    if (wo.z < 0.0) != (eta >= 1.0) {
        return glass_albedo_look_up(0u, 10u, 10u, 17u, at, a, energy_place(mu, 2.0 * a));
    }
    let critical = sqrt(1.0 - 1.0 / (index * index));
    if mu >= critical {
        let above = 1.0 - critical;
        let place = energy_place((mu - critical) / above, 4.0 * a / above);
        return glass_albedo_look_up(1700u, 18u, 14u, 10u, at, a, place);
    }
    let t = mu / critical;
    let narrow = a / critical;
    let both = energy_place(t, 2.0 * narrow) + 1.0 - energy_place(1.0 - t, 4.0 * narrow);
    return glass_albedo_look_up(4220u, 18u, 14u, 14u, at, a, 0.5 * both);
}
