// A rough diffuse surface with gloss, the filtered model of carpets and plastic panels:
// `material/glossy.rs` of asperity-shading.

struct Glossy {
    // Colors, in [0, 1].
    diffuse: vec3<f32>,
    specular: vec3<f32>,
    // The unit normal with bumps.
    normal: vec3<f32>,
    // The variance of the slope along each axis that filtering removed from the bumps.
    slope_variance: f32,
    // The deviation of the slope that filtering removed from ridges, in the direction across them;
    // zero without ridges.
    ridges: vec3<f32>,
}

// Reflectance times cosine, for directions in the frame of the surface: facets of a roughness under
// a gloss of Beckmann's alpha.
fn glossy_eval_cos(
    surface: Glossy,
    frame: Frame,
    roughness: f32,
    alpha: f32,
    wo: vec3<f32>,
    wi: vec3<f32>,
) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let n = vec3<f32>(0.0, 0.0, 1.0);
    // Specular reflection reduces diffuse reflection.
    let diffuse = min(surface.diffuse, 1.0 - surface.specular);
    let specular = math_shares(surface.specular);
    let across = frame_to_local(frame, surface.ridges);
    let ridge = dot(across, across);
    let even = max(surface.slope_variance, 0.0);
    var u = vec3<f32>(1.0, 0.0, 0.0) * sqrt(even);
    var v = vec3<f32>(0.0, 1.0, 0.0) * sqrt(even);
    if ridge > 0.0 {
        let direction = across / sqrt(ridge);
        u = direction * sqrt(even + ridge);
        v = cross(n, direction) * sqrt(even);
    }
    let facets = slope_facets(n, frame_to_local(frame, surface.normal), u, v);
    let valid = clamp(vec2<f32>(alpha), vec2<f32>(1e-6), vec2<f32>(1e6));
    var sum = vec3<f32>(0.0);
    for (var k = 0u; k < 7u; k++) {
        let facet = slope_facets_along(facets, 0.5, k);
        let light = facet_light(facet.weight, facet.normal, wi, wo);
        if light.factor > 0.0 {
            let base = energy_preserving_oren_nayar_eval(diffuse, roughness, light.wi, light.wo);
            let gloss = cook_torrance_beckmann(valid, light.wi, light.wo).x * specular;
            sum += (base + gloss) * light.factor;
        }
    }
    return brdf_finite_channels(sum);
}
