// The directional albedo of rough GGX glass: `asperity_shading::reflectance::GlassAlbedo`.

// Three entries from `at` on.
fn glass_albedo_entries(at: u32) -> vec3<f32> {
    return vec3<f32>(glass_albedo_number(at), glass_albedo_number(at + 1u), glass_albedo_number(at + 2u));
}

// The entries from `base` on, in slices of `counts.y` rows of `counts.z`.
fn glass_albedo_look_up(base: u32, counts: vec3<u32>, index: f32, row: f32, column: f32) -> f32 {
    let through = energy_spline(index, counts.x);
    let down = energy_spline(row, counts.y);
    let across = energy_spline(column, counts.z);
    var sum = 0.0;
    for (var k = 0u; k < 3u; k++) {
        for (var i = 0u; i < 3u; i++) {
            let at = base + ((through.first + k) * counts.y + down.first + i) * counts.z + across.first;
            sum += through.weights[k] * down.weights[i] * dot(across.weights, glass_albedo_entries(at));
        }
    }
    return sum;
}

// The albedo of isotropic facets at the place `index` of the index, for a critical angle with this sine
// and cosine.
fn glass_albedo_isotropic(alpha: f32, index: f32, critical: vec2<f32>, mu: f32, dense: bool) -> f32 {
    let root = sqrt(alpha);
    if !dense {
        let at = 0.8 * energy_place(mu, 2.0 * alpha) + 0.2 * (1.0 - energy_place(1.0 - mu, 1.0));
        return glass_albedo_look_up(0u, vec3<u32>(10u, 13u, 15u), index, root, at);
    }
    let fine = root < 0.6;
    let edge = select(critical.x, critical.y, fine);
    let row = select((root - 0.6) / (1.0 - 0.6), root / 0.6, fine);
    if mu >= edge {
        let above = 1.0 - edge;
        let at = energy_place((mu - edge) / above, 6.0 * alpha / above);
        if fine {
            return glass_albedo_look_up(1950u, vec3<u32>(12u, 10u, 12u), index, row, at);
        }
        return glass_albedo_look_up(5550u, vec3<u32>(12u, 6u, 10u), index, row, at);
    }
    let t = mu / edge;
    let narrow = alpha / edge;
    let width = select(2.0 * critical.y * critical.y, 3.0 * narrow, fine);
    let at = 0.7 * energy_place(t, width) + 0.3 * (1.0 - energy_place(1.0 - t, 4.0 * narrow));
    if fine {
        return glass_albedo_look_up(3390u, vec3<u32>(12u, 10u, 18u), index, row, at);
    }
    return glass_albedo_look_up(6270u, vec3<u32>(12u, 6u, 18u), index, row, at);
}

// The albedo of anisotropic facets over that of isotropic facets, for the larger roughness, the smaller
// over the larger, and the share of the rough axis in the azimuth of the view. The entries from `base`
// on are for this number of indices, azimuths and cosines.
fn glass_albedo_factor(base: u32, counts: vec3<u32>, index: f32, rough: f32, smaller: f32, share: f32, mu: f32) -> f32 {
    let ratio = max(smaller, 0.25);
    let towards = sqrt(share + (1.0 - share) * ratio * ratio);
    let through = energy_spline(index, counts.x);
    let around = energy_spline(share * (1.0 + 0.5 * ratio) / (towards + 0.5 * ratio), counts.y);
    let down = energy_spline((sqrt(rough) - 0.28) / (1.0 - 0.28), 5u);
    let along = energy_spline(2.0 * sqrt(ratio) - 1.0, 4u);
    let across = energy_spline(sqrt(mu), counts.z);
    var sum = 0.0;
    for (var k = 0u; k < 3u; k++) {
        for (var g = 0u; g < 3u; g++) {
            for (var j = 0u; j < 3u; j++) {
                let row = (((through.first + k) * counts.y + around.first + g) * 5u + down.first + j) * 4u + along.first;
                let weight = through.weights[k] * around.weights[g] * down.weights[j];
                for (var i = 0u; i < 3u; i++) {
                    let entries = glass_albedo_entries(base + (row + i) * counts.z + across.first);
                    sum += weight * along.weights[i] * dot(across.weights, entries);
                }
            }
        }
    }
    return sum;
}

// E(wo) on the side of wo: `GlassAlbedo::albedo`, for the relative index eta > 0.
fn glass_albedo(alpha: vec2<f32>, eta: f32, wo: vec3<f32>) -> f32 {
    let x = energy_alpha(alpha.x);
    let y = energy_alpha(alpha.y);
    let rough = max(x, y);
    let ratio = min(x, y) / rough;
    let step = clamp(max(eta, 1.0 / eta), 1.05, 2.5);
    let low = sqrt(sqrt(1.05 - 1.0));
    let index = (sqrt(sqrt(step - 1.0)) - low) / (sqrt(sqrt(2.5 - 1.0)) - low);
    let critical = vec2<f32>(1.0 / step, sqrt(1.0 - 1.0 / (step * step)));
    let mu = math_clamped(abs(wo.z), 1.0);
    let dense = (wo.z < 0.0) == (eta >= 1.0);
    if ratio == 1.0 {
        return clamp(glass_albedo_isotropic(rough, index, critical, mu, dense), 0.001, 1.0);
    }
    let along = select(wo.yx, wo.xy, x >= y);
    let share = math_clamped(along.x * along.x / (along.x * along.x + along.y * along.y), 1.0);
    let fine = rough * ratio;
    let towards = (1.0 - mu * mu) * (share - 0.5) * (rough * rough - fine * fine);
    let round = sqrt(0.5 * (rough * rough + fine * fine) + towards);
    var factor = 0.0;
    if dense {
        factor = glass_albedo_factor(10446u, vec3<u32>(8u, 7u, 10u), index, rough, ratio, share, mu);
    } else {
        factor = glass_albedo_factor(7566u, vec3<u32>(4u, 4u, 9u), index, rough, ratio, share, mu);
    }
    return clamp(glass_albedo_isotropic(round, index, critical, mu, dense) * factor, 0.001, 1.0);
}
