// Scratched metal for a pixel.

struct MaterialSeen {
    surface: ScratchesSurface,
}

fn material_seen(point: SurfacePoint, frame: Frame, wo: vec3<f32>) -> MaterialSeen {
    return MaterialSeen(scratches_surface(scratches_uniform, point));
}

fn material_lamp(seen: MaterialSeen, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return scratches_lit(scratches_uniform, seen.surface, wo, wi);
}

fn material_ambience(seen: MaterialSeen, hit: MaterialsHit) -> vec3<f32> {
    let normal = frame_to_local(hit.frame, seen.surface.normal);
    return materials_ambient(hit, normal, vec3<f32>(0.0), math_shares(scratches_uniform.specular), scratches_uniform.roughness);
}
