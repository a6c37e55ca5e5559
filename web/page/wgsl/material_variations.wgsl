// A material with blemishes and dents for a pixel.

struct MaterialSeen {
    surface: Glossy,
    frame: Frame,
}

fn material_seen(point: SurfacePoint, frame: Frame, wo: vec3<f32>) -> MaterialSeen {
    return MaterialSeen(variations_surface(variations_uniform, point), frame);
}

fn material_lamp(seen: MaterialSeen, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return material_glossy(seen.surface, seen.frame, variations_uniform.roughness, variations_uniform.gloss_roughness, wo, wi);
}

fn material_ambience(seen: MaterialSeen, hit: MaterialsHit) -> vec3<f32> {
    return material_glossy_ambience(seen.surface, hit, variations_uniform.gloss_roughness);
}
