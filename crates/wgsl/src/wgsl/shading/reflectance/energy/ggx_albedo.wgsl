// The directional albedo of white GGX facets: `asperity_shading::reflectance::GgxAlbedo`.

// The larger roughness, the smaller over the larger, the roughness towards a view, and the share of
// the rough axis in its azimuth.
struct GgxAlbedoFacets {
    rough: f32,
    ratio: f32,
    towards: f32,
    share: f32,
}

fn ggx_albedo_facets(alpha: vec2<f32>, wo: vec3<f32>) -> GgxAlbedoFacets {
    let x = energy_alpha(alpha.x);
    let y = energy_alpha(alpha.y);
    let rough = max(x, y);
    let ratio = min(x, y) / rough;
    let along = select(wo.yx, wo.xy, x >= y);
    let share = math_clamped(along.x * along.x / (along.x * along.x + along.y * along.y), 1.0);
    return GgxAlbedoFacets(rough, ratio, rough * sqrt(share + (1.0 - share) * ratio * ratio), share);
}

// Three entries from `at` on.
fn ggx_albedo_entries(at: u32) -> vec3<f32> {
    return vec3<f32>(ggx_albedo_number(at), ggx_albedo_number(at + 1u), ggx_albedo_number(at + 2u));
}

// The entries of isotropic facets from `base` on.
fn ggx_albedo_isotropic(base: u32, alpha: f32, place: f32) -> f32 {
    let across = energy_spline(place, 24u);
    let down = energy_spline(sqrt(alpha), 16u);
    var sum = 0.0;
    for (var i = 0u; i < 3u; i++) {
        sum += down.weights[i] * dot(across.weights, ggx_albedo_entries(base + (down.first + i) * 24u + across.first));
    }
    return sum;
}

// The entries of anisotropic facets from `base` on.
fn ggx_albedo_anisotropic(base: u32, facets: GgxAlbedoFacets, place: f32) -> f32 {
    let around = energy_spline(facets.share, 5u);
    let down = energy_spline(sqrt(facets.rough), 8u);
    let through = energy_spline(facets.ratio, 6u);
    let across = energy_spline(place, 12u);
    var sum = 0.0;
    for (var k = 0u; k < 3u; k++) {
        for (var j = 0u; j < 3u; j++) {
            for (var i = 0u; i < 3u; i++) {
                let row = ((around.first + k) * 8u + down.first + j) * 6u + through.first + i;
                let entries = ggx_albedo_entries(base + row * 12u + across.first);
                sum += around.weights[k] * down.weights[j] * through.weights[i] * dot(across.weights, entries);
            }
        }
    }
    return sum;
}

// The means of isotropic facets from `round` on, or of anisotropic facets from `base` on.
fn ggx_albedo_means(round: u32, base: u32, alpha: vec2<f32>) -> f32 {
    let facets = ggx_albedo_facets(alpha, vec3<f32>(0.0, 0.0, 1.0));
    if facets.ratio == 1.0 {
        let at = energy_spline(sqrt(facets.rough), 16u);
        return dot(at.weights, ggx_albedo_entries(round + at.first));
    }
    let down = energy_spline(sqrt(facets.rough), 8u);
    let through = energy_spline(facets.ratio, 6u);
    var sum = 0.0;
    for (var j = 0u; j < 3u; j++) {
        sum += down.weights[j] * dot(through.weights, ggx_albedo_entries(base + (down.first + j) * 6u + through.first));
    }
    return sum;
}

// E at the place of a cosine.
fn ggx_albedo_at(facets: GgxAlbedoFacets, place: f32) -> f32 {
    var e = ggx_albedo_isotropic(0u, facets.towards, place);
    if facets.ratio < 1.0 {
        e *= 2.0 * ggx_albedo_anisotropic(800u, facets, place);
    }
    return clamp(e, 0.001, 1.0);
}

// E(wo): `GgxAlbedo::albedo`.
fn ggx_albedo(alpha: vec2<f32>, wo: vec3<f32>) -> f32 {
    let facets = ggx_albedo_facets(alpha, wo);
    return ggx_albedo_at(facets, energy_place(math_clamped(wo.z, 1.0), 2.0 * facets.towards));
}

// E_avg: `GgxAlbedo::mean_albedo`.
fn ggx_mean_albedo(alpha: vec2<f32>) -> f32 {
    return clamp(ggx_albedo_means(384u, 3680u, alpha), 0.001, 1.0);
}

// E(wo) and the albedo with the facet reflectance (1 − wo·h)⁵.
fn ggx_albedo_moments(alpha: vec2<f32>, wo: vec3<f32>) -> vec2<f32> {
    let facets = ggx_albedo_facets(alpha, wo);
    let mu = math_clamped(wo.z, 1.0);
    let place = energy_place(mu, 2.0 * facets.towards);
    var cosine = ggx_albedo_isotropic(400u, facets.towards, sqrt(mu));
    if facets.ratio < 1.0 {
        cosine += ggx_albedo_anisotropic(3728u, facets, place) - 0.5;
    }
    let angle = 1.0 - clamp(cosine, 0.0, 1.0);
    let squared = angle * angle;
    let e = ggx_albedo_at(facets, place);
    return vec2<f32>(e, e * squared * squared * angle);
}

// The second of these: `GgxAlbedo::schlick_moment`.
fn ggx_schlick_moment(alpha: vec2<f32>, wo: vec3<f32>) -> f32 {
    return ggx_albedo_moments(alpha, wo).y;
}

// Its mean over views: `GgxAlbedo::mean_schlick_moment`.
fn ggx_mean_schlick_moment(alpha: vec2<f32>) -> f32 {
    return clamp(ggx_albedo_means(784u, 6608u, alpha), 0.0, 1.0);
}
