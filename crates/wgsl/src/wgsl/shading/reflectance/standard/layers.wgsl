// The layers of the standard materials: fuzz over a coat over gloss, diffuse light and glass.
// Directions are in the frame of the surface, wo and wi above it. Light that crosses the surface is
// not part of it.

// Schlick's approximation between two colors, with the dip of metals, and the light of all further
// bounces between facets.
struct StandardReflectance {
    normal: vec3<f32>,
    grazing: vec3<f32>,
    dip: vec3<f32>,
    bounces: vec3<f32>,
}

struct StandardLayers {
    // Cosine and sine of the azimuth of the facets.
    turn: vec2<f32>,
    // The fuzz of Zeltner and others, or Charlie sheen.
    is_zeltner: bool,
    fuzz_weight: f32,
    fuzz_color: vec3<f32>,
    fuzz_alpha: f32,
    coat_weight: f32,
    coat_index: f32,
    coat_alpha: vec2<f32>,
    coat: StandardReflectance,
    // The transmittance of one pass through the coat at normal incidence.
    coat_tint: vec3<f32>,
    // The factor of everything below the coat.
    below_coat: vec3<f32>,
    alpha: vec2<f32>,
    gloss: StandardReflectance,
    // The fraction of the surface that is not glass, and that is glass.
    opaque: f32,
    glass: f32,
    glass_index: f32,
    is_thin: bool,
    // The reflectance of the interface over the diffuse light.
    surface: StandardReflectance,
    diffuse: vec3<f32>,
    diffuse_roughness: f32,
    emitted: vec3<f32>,
}

// A roughness of facets that f32 resolves well.
fn standard_smoothest(alpha: f32) -> f32 {
    return max(alpha, 0.001);
}

fn standard_mix(a: vec3<f32>, b: vec3<f32>, t: f32) -> vec3<f32> {
    return a * (1.0 - t) + b * t;
}

fn standard_reflectance(normal: vec3<f32>, grazing: vec3<f32>, dip: vec3<f32>, alpha: vec2<f32>) -> StandardReflectance {
    let mean = math_shares((20.0 * normal + grazing) / 21.0 - dip / 126.0);
    return StandardReflectance(normal, grazing, dip, energy_bounces(mean, ggx_mean_albedo(alpha)));
}

// The reflectance of a facet seen at this angle.
fn standard_fresnel(reflectance: StandardReflectance, cos_theta: f32) -> vec3<f32> {
    let c = math_clamped(cos_theta, 1.0);
    let x = 1.0 - c;
    let fifth = x * x * (x * x) * x;
    return math_shares(reflectance.normal + (reflectance.grazing - reflectance.normal) * fifth - reflectance.dip * (c * fifth * x));
}

// The directional albedo without the dip, from `ggx_albedo_moments`.
fn standard_albedo(reflectance: StandardReflectance, seen: vec2<f32>) -> vec3<f32> {
    return math_shares((reflectance.normal * (seen.x - seen.y) + reflectance.grazing * seen.y) * energy_factor(reflectance.bounces, seen.x));
}

// The fuzz's albedo in each channel.
fn standard_fuzz_albedo(layers: StandardLayers, cos_theta: f32) -> vec3<f32> {
    if layers.fuzz_weight <= 0.0 {
        return vec3<f32>(0.0);
    }
    if layers.is_zeltner {
        return layers.fuzz_weight * layers.fuzz_color * zeltner_fuzz_albedo(layers.fuzz_alpha, cos_theta);
    }
    return layers.fuzz_weight * layers.fuzz_color * charlie_sheen_albedo(layers.fuzz_alpha, cos_theta);
}

fn standard_largest(color: vec3<f32>) -> f32 {
    return max(color.x, max(color.y, color.z));
}

// f of GGX mirrors without Fresnel term whose unresolved part the split gives, and the cosine with
// the half vector.
fn standard_facets(alpha: vec2<f32>, wi: vec3<f32>, wo: vec3<f32>, split: GaussianSplit) -> vec2<f32> {
    let facets = cook_torrance_ggx(alpha, wi, wo);
    if split.root <= 0.0 {
        return facets;
    }
    let z = ggx_invert_visible(alpha, wo, direction_half(wi, wo));
    return vec2<f32>(brdf_finite(gaussian_split_weigh(split, facets.x, z)), facets.y);
}

// The irradiance of a point of the resolved bumps over its mean over the surface.
fn standard_relief(alpha: vec2<f32>, wi: vec3<f32>, split: GaussianSplit) -> f32 {
    if split.root <= 0.0 {
        return 1.0;
    }
    let along = alpha * wi.xy * (split.root * 0.70710678 / wi.z);
    let deviation = sqrt(dot(along, along));
    var mean = 1.0;
    if deviation > 0.2 {
        let z = 1.0 / deviation;
        mean = gaussian_cdf(z) + deviation * gaussian_pdf(z);
    }
    return brdf_finite((1.0 + dot(along, split.z_b)) / mean);
}

// A direction along the axes of the facets.
fn standard_to_facets(layers: StandardLayers, w: vec3<f32>) -> vec3<f32> {
    let turn = layers.turn;
    return vec3<f32>(turn.x * w.x + turn.y * w.y, turn.x * w.y - turn.y * w.x, w.z);
}

// The tint of the coat on the ways in and out.
fn standard_coat_tint(layers: StandardLayers, wi_z: f32, wo_z: f32) -> vec3<f32> {
    let tint = layers.coat_tint;
    if layers.coat_weight <= 0.0 || all(tint == vec3<f32>(1.0)) {
        return vec3<f32>(1.0);
    }
    let index = layers.coat_index;
    let both = rough_dielectric_through_wall(tint, wi_z, index) * rough_dielectric_through_wall(tint, wo_z, index);
    return standard_mix(vec3<f32>(1.0), both, layers.coat_weight);
}

// f_s(wo, wi) in 1/sr of which the fraction `variance` of the bumps is resolved as z: 0 from afar.
fn standard_layers_eval(
    layers: StandardLayers,
    wo_surface: vec3<f32>,
    wi_surface: vec3<f32>,
    z: vec2<f32>,
    variance: f32,
) -> vec3<f32> {
    let wo = standard_to_facets(layers, wo_surface);
    let wi = standard_to_facets(layers, wi_surface);
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let split = gaussian_split(standard_to_facets(layers, vec3<f32>(z, 0.0)).xy, variance);
    var sum = vec3<f32>(0.0);
    let fuzz = standard_fuzz_albedo(layers, wo.z);
    if layers.fuzz_weight > 0.0 {
        var value = 0.0;
        if layers.is_zeltner {
            value = zeltner_fuzz_eval(layers.fuzz_alpha, wi, wo);
        } else {
            value = charlie_sheen_eval(layers.fuzz_alpha, wi, wo);
        }
        sum += layers.fuzz_weight * layers.fuzz_color * value;
    }
    var passed = 1.0 - standard_largest(fuzz);
    if layers.coat_weight > 0.0 {
        let seen = ggx_albedo_moments(layers.coat_alpha, wo);
        let facets = standard_facets(layers.coat_alpha, wi, wo, split);
        let factor = passed * layers.coat_weight * energy_factor(layers.coat.bounces, seen.x);
        sum += factor * facets.x * standard_fresnel(layers.coat, facets.y);
        passed *= 1.0 - layers.coat_weight * standard_largest(standard_albedo(layers.coat, seen));
    }
    let seen = ggx_albedo_moments(layers.alpha, wo);
    var base = vec3<f32>(0.0);
    if layers.opaque > 0.0 {
        let facets = standard_facets(layers.alpha, wi, wo, split);
        let factor = layers.opaque * energy_factor(layers.gloss.bounces, seen.x);
        base += factor * facets.x * standard_fresnel(layers.gloss, facets.y);
    }
    if standard_largest(layers.diffuse) > 0.0 {
        let left = 1.0 - standard_largest(standard_albedo(layers.surface, seen));
        let value = energy_preserving_oren_nayar_eval(layers.diffuse, layers.diffuse_roughness, wi, wo);
        base += left * value * standard_relief(layers.alpha, wi, split);
    }
    if layers.glass > 0.0 {
        base += vec3<f32>(standard_glass(layers, wi, wo, seen.x, split));
    }
    sum += passed * layers.below_coat * standard_coat_tint(layers, wi.z, wo.z) * base;
    return brdf_finite_channels(sum);
}

// The reflection of the glass.
fn standard_glass(layers: StandardLayers, wi: vec3<f32>, wo: vec3<f32>, mirror: f32, split: GaussianSplit) -> f32 {
    let h = direction_half(wi, wo);
    var masking = ggx_masking(layers.alpha, wi) * ggx_masking(layers.alpha, wo);
    if layers.is_thin {
        masking = ggx_masking_shadowing(layers.alpha, wi, wo);
    }
    var facets = ggx_d(layers.alpha, h) * masking / (4.0 * wi.z * wo.z);
    if split.root > 0.0 {
        facets = gaussian_split_weigh(split, facets, ggx_invert_visible(layers.alpha, wo, h));
    }
    let index = rough_dielectric_index(layers.glass_index);
    let once = dielectric_reflectance(index, dot(wo, h));
    if layers.is_thin {
        return layers.glass * brdf_finite(facets) * (2.0 * once / (1.0 + once)) / mirror;
    }
    return layers.glass * brdf_finite(facets) * once / glass_albedo(layers.alpha, index, wo);
}

// The radiance emitted towards wo, after fuzz and coat.
fn standard_layers_emitted(layers: StandardLayers, wo_surface: vec3<f32>) -> vec3<f32> {
    let wo = standard_to_facets(layers, wo_surface);
    if !(wo.z > 0.0) {
        return vec3<f32>(0.0);
    }
    var passed = 1.0 - standard_largest(standard_fuzz_albedo(layers, wo.z));
    if layers.coat_weight > 0.0 {
        let seen = ggx_albedo_moments(layers.coat_alpha, wo);
        passed *= 1.0 - layers.coat_weight * standard_largest(standard_albedo(layers.coat, seen));
    }
    let once = rough_dielectric_through_wall(layers.coat_tint, wo.z, layers.coat_index);
    let tint = standard_mix(vec3<f32>(1.0), once, layers.coat_weight);
    return layers.emitted * passed * tint;
}
