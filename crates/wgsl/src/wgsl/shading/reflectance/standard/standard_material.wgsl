// The material of glTF 2.0 with its extensions: `asperity_shading::StandardMaterial`.

// The layers of the parameters, which are in their ranges:
//
//     let layers = standard_material_layers(material);
//     let f_r = standard_layers_eval(layers, wo, wi, bumps.xy, bumps.z);
fn standard_material_layers(p: StandardMaterial) -> StandardLayers {
    let a = standard_smoothest(p.roughness * p.roughness);
    let alpha = vec2<f32>(a + (1.0 - a) * p.anisotropy * p.anisotropy, a);
    let root = (p.ior - 1.0) / (p.ior + 1.0);
    let normal = min(root * root * p.specular_color, vec3<f32>(1.0)) * p.specular;
    let transmitted = (1.0 - p.metallic) * p.transmission;
    let opaque = 1.0 - transmitted;
    let t = select(0.0, p.metallic / opaque, opaque > 0.0);
    let grazing = standard_mix(vec3<f32>(p.specular), vec3<f32>(1.0), t);
    let none = vec3<f32>(0.0);
    let coat_alpha = vec2<f32>(standard_smoothest(p.clearcoat_roughness * p.clearcoat_roughness));
    let sheen_alpha = max(p.sheen_roughness * p.sheen_roughness, 0.07);
    return StandardLayers(
        vec2<f32>(cos(p.anisotropy_rotation), sin(p.anisotropy_rotation)),
        false,
        select(0.0, 1.0, standard_largest(p.sheen_color) > 0.0),
        p.sheen_color,
        sheen_alpha,
        p.clearcoat,
        1.5,
        coat_alpha,
        standard_reflectance(vec3<f32>(0.04), vec3<f32>(1.0), none, coat_alpha),
        vec3<f32>(1.0),
        vec3<f32>(1.0),
        alpha,
        standard_reflectance(standard_mix(normal, p.base_color, t), grazing, none, alpha),
        opaque,
        transmitted,
        p.ior,
        p.thickness <= 0.0,
        standard_reflectance(normal, vec3<f32>(p.specular), none, alpha),
        p.base_color * ((1.0 - p.metallic) * (1.0 - p.transmission)),
        0.0,
        p.emissive,
    );
}
