// The parameters of OpenPBR Surface 1.1: `asperity_shading::OpenPbr`.

fn open_pbr_alpha(roughness: f32, anisotropy: f32) -> vec2<f32> {
    let across = 1.0 - anisotropy;
    let along = roughness * roughness * sqrt(2.0 / (1.0 + across * across));
    return vec2<f32>(standard_smoothest(along), standard_smoothest(across * along));
}

// The index whose reflectance at normal incidence is the fraction `weight` of that of another.
fn open_pbr_weighted(index: f32, weight: f32) -> f32 {
    let root = sqrt(weight) * (index - 1.0) / (index + 1.0);
    return (1.0 + root) / (1.0 - root);
}

// The mean reflectance of diffuse light: eight nodes of Gauss and Legendre.
fn open_pbr_mean_reflectance(index: f32) -> f32 {
    return 0.0020099 * dielectric_reflectance(index, 0.01985507)
        + 0.02260876 * dielectric_reflectance(index, 0.10166676)
        + 0.07442182 * dielectric_reflectance(index, 0.2372338)
        + 0.1480775 * dielectric_reflectance(index, 0.40828268)
        + 0.21460628 * dielectric_reflectance(index, 0.5917173)
        + 0.23928483 * dielectric_reflectance(index, 0.7627662)
        + 0.19977227 * dielectric_reflectance(index, 0.89833325)
        + 0.0992186 * dielectric_reflectance(index, 0.9801449);
}

// Both ends of Schlick's approximation of a dielectric with this mean reflectance.
fn open_pbr_schlick(index: f32, mean: f32) -> vec2<f32> {
    let normal = dielectric_reflectance(index, 1.0);
    return vec2<f32>(normal, math_clamped(21.0 * mean - 20.0 * normal, 1.0));
}

// The layers of the parameters, which are in their ranges:
//
//     let layers = open_pbr_layers(material);
//     let f_r = standard_layers_eval(layers, wo, wi, bumps.xy, bumps.z);
fn open_pbr_layers(p: OpenPbr) -> StandardLayers {
    let coat = p.coat_weight;
    let r = p.specular_roughness * p.specular_roughness;
    let c = p.coat_roughness * p.coat_roughness;
    let under = sqrt(sqrt(min(r * r + 2.0 * (c * c), 1.0)));
    let roughness = p.specular_roughness + coat * (under - p.specular_roughness);
    let alpha = open_pbr_alpha(roughness, p.specular_roughness_anisotropy);
    let above = 1.0 + coat * (p.coat_ior - 1.0);
    // Inverted below a denser coat, because the coat does not bend light towards total reflection.
    let relative = max(p.specular_ior / above, above / p.specular_ior);
    let index = open_pbr_weighted(relative, p.specular_weight);
    let none = vec3<f32>(0.0);
    let mirrored = open_pbr_mean_reflectance(index);
    let surface = open_pbr_schlick(index, mirrored);
    let normal = surface.x * p.specular_color;
    let grazing = surface.y * p.specular_color;
    let base = p.base_weight * p.base_color;
    // Fractions of 6/7, by which Schlick's approximation is reduced to the tint at a cosine of 1/7.
    let tinted = (base + (1.0 - base) * 0.46266436) * (1.0 - p.specular_color);
    let dip = p.specular_weight * tinted * 17.651384;
    let metal = p.base_metalness;
    let metal_mean = math_shares((20.0 * p.specular_weight * base + p.specular_weight) / 21.0 - dip / 126.0);
    let transmitted = (1.0 - metal) * p.transmission_weight;
    let opaque = 1.0 - transmitted;
    let scattered = 1.0 - metal - transmitted;
    let t = select(0.0, metal / opaque, opaque > 0.0);
    let outer = open_pbr_mean_reflectance(p.coat_ior);
    var below_coat = vec3<f32>(1.0);
    if coat * p.coat_darkening > 0.0 {
        let color = metal * metal_mean + scattered * standard_mix(base, vec3<f32>(1.0), mirrored) + transmitted;
        let rough = 1.0 + (metal + (1.0 - metal) * mirrored) * (roughness - 1.0);
        let inner = 1.0 - (1.0 - outer) / (p.coat_ior * p.coat_ior);
        let k = outer + rough * (inner - outer);
        let darker = (1.0 - k) / (1.0 - min(color, vec3<f32>(1.0)) * k);
        below_coat = standard_mix(vec3<f32>(1.0), darker, coat * p.coat_darkening);
    }
    let coat_alpha = open_pbr_alpha(p.coat_roughness, p.coat_roughness_anisotropy);
    let coat_surface = open_pbr_schlick(p.coat_ior, outer);
    let weight = p.specular_weight;
    return StandardLayers(
        vec2<f32>(1.0, 0.0),
        true,
        p.fuzz_weight,
        p.fuzz_color,
        max(p.fuzz_roughness, 0.01),
        coat,
        p.coat_ior,
        coat_alpha,
        standard_reflectance(vec3<f32>(coat_surface.x), vec3<f32>(coat_surface.y), none, coat_alpha),
        sqrt(p.coat_color),
        below_coat,
        alpha,
        standard_reflectance(
            standard_mix(normal, weight * base, t), standard_mix(grazing, vec3<f32>(weight), t), t * dip, alpha,
        ),
        opaque,
        transmitted,
        open_pbr_weighted(p.specular_ior, p.specular_weight),
        p.geometry_thin_walled != 0u,
        standard_reflectance(normal, grazing, none, alpha),
        base * scattered,
        p.base_diffuse_roughness,
        p.emission_luminance * p.emission_color,
    );
}
