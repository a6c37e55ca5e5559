// Carpet for a pixel.

struct MaterialSeen {
    surface: Glossy,
    frame: Frame,
    rim: vec3<f32>,
}

fn material_seen(point: SurfacePoint, frame: Frame, wo: vec3<f32>) -> MaterialSeen {
    return MaterialSeen(carpet_surface(carpet_uniform, point), frame, carpet_emitted(carpet_uniform, point, wo));
}

fn material_lamp(seen: MaterialSeen, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return material_glossy(seen.surface, seen.frame, carpet_uniform.roughness, carpet_uniform.specular_roughness, wo, wi);
}

fn material_ambience(seen: MaterialSeen, hit: MaterialsHit) -> vec3<f32> {
    let lit = material_glossy_ambience(seen.surface, hit, carpet_uniform.specular_roughness);
    return lit + seen.rim * light_diffuse(hit.point.normal);
}
