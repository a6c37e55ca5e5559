// Smooth and rough coats over the layers of a surface: `asperity_shading::reflectance::Coat`.

// A direction to light of which a smooth surface sends a share to the eye; below the surface light that is transmitted.
struct CoatDelta {
    wi: vec3<f32>,
    weight: vec3<f32>,
}

// A lobe narrower than the gaps between facets takes as much of the slopes' variance as makes it as wide: alpha, and what is left.
fn coat_widened(roughness: f32, slope_variance: f32) -> vec2<f32> {
    let square = roughness * roughness;
    if math_is_finite(slope_variance) && square < 1.4 * slope_variance {
        let taken = (1.4 * slope_variance - square) / 3.4;
        return vec2<f32>(sqrt(square + 2.0 * taken), slope_variance - taken);
    }
    return vec2<f32>(roughness, slope_variance);
}

// Slopes of this variance about a normal, in the frame of the surface.
fn coat_facets(normal: vec3<f32>, slope_variance: f32) -> SlopeFacets {
    var deviation = 0.0;
    if slope_variance > 0.0 {
        deviation = sqrt(slope_variance);
    }
    let n = vec3<f32>(0.0, 0.0, 1.0);
    return slope_facets(n, normal, vec3<f32>(deviation, 0.0, 0.0), vec3<f32>(0.0, deviation, 0.0));
}

// What a varnish of the relative index eta over a normal lets through to the layers below and back: (1 - F(wi)) (1 - F(wo)).
fn coat_varnish_through(eta: f32, normal: vec3<f32>, wo: vec3<f32>, wi: vec3<f32>) -> f32 {
    return (1.0 - dielectric_reflectance(eta, dot(wi, normal))) * (1.0 - dielectric_reflectance(eta, dot(wo, normal)));
}

// What a rough varnish mirrors, times the cosine; 0 for a smooth one, of which `coat_varnish_delta` has all.
fn coat_varnish_scattered(
    eta: f32,
    roughness: f32,
    normal: vec3<f32>,
    slope_variance: f32,
    wo: vec3<f32>,
    wi: vec3<f32>,
) -> f32 {
    if !(roughness > 0.0) {
        return 0.0;
    }
    let widened = coat_widened(roughness, slope_variance);
    let facets = coat_facets(normal, widened.y);
    let alpha = clamp(vec2<f32>(widened.x), vec2<f32>(1e-6), vec2<f32>(1e6));
    var sum = 0.0;
    for (var k = 0u; k < 13u; k++) {
        let facet = slope_facets_gaussian(facets, k);
        let light = facet_light(facet.share, facet.normal, wi, wo);
        if light.factor > 0.0 {
            let value = cook_torrance_beckmann(alpha, light.wi, light.wo);
            sum += value.x * dielectric_reflectance(eta, value.y) * light.factor;
        }
    }
    return sum;
}

// The normal of a facet of slopes of this variance about a normal, chosen by uniform numbers, as the view sees it.
fn coat_facet(normal: vec3<f32>, slope_variance: f32, wo: vec3<f32>, u: vec2<f32>) -> vec3<f32> {
    let n = vec3<f32>(0.0, 0.0, 1.0);
    var facet = normal;
    if slope_variance > 0.0 && normal.z > 0.0 {
        let radius = sqrt(-2.0 * slope_variance * elementary_ln_1p(-min(math_clamped(u.x, 1.0), 0.999999)));
        let slope = vec3<f32>(radius * elementary_cos_sin_turns(math_clamped(u.y, 1.0)), 0.0);
        facet = surface_gradient_normal(n, n - normal / normal.z + slope);
    }
    return surface_gradient_facing(n, facet, wo);
}

// What a smooth varnish mirrors, by the normal of one of its facets; dark from below.
fn coat_varnish_delta(eta: f32, facet: vec3<f32>, wo: vec3<f32>) -> CoatDelta {
    if !(wo.z > 0.0 && direction_is_finite(wo)) {
        return CoatDelta(vec3<f32>(0.0), vec3<f32>(0.0));
    }
    let share = dielectric_reflectance(eta, dot(wo, facet));
    return CoatDelta(direction_reflect(wo, facet), vec3<f32>(share));
}
