// Polished marble for a pixel.

struct MaterialSeen {
    color: vec3<f32>,
    polish: Coat,
}

fn material_seen(point: SurfacePoint, frame: Frame, wo: vec3<f32>) -> MaterialSeen {
    let stone = polished_marble_uniform;
    let color = stone.tint * marble_color(stone.marble, point.position, point.pixel.widths.x);
    return MaterialSeen(color, coat_clearcoat(1.5, math_clamped(stone.polish, 1.0), vec3<f32>(0.0, 0.0, 1.0), 0.0));
}

fn material_lamp(seen: MaterialSeen, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !(wi.z > 0.0) {
        return vec3<f32>(0.0);
    }
    let below = energy_preserving_oren_nayar_eval(seen.color, 0.0, wi, wo) * wi.z;
    if seen.polish.roughness > 0.0 {
        let light = facet_light(1.0, seen.polish.normal, wi, wo);
        let lobe = cook_torrance_beckmann(vec2<f32>(material_coat_alpha(seen.polish)), light.wi, light.wo);
        return material_varnished(seen.polish, below, lobe, light.factor, wo, wi);
    }
    return brdf_finite_channels(below);
}

fn material_ambience(seen: MaterialSeen, hit: MaterialsHit) -> vec3<f32> {
    if seen.polish.roughness > 0.0 {
        return material_under_coat(seen.polish, hit, seen.color, vec3<f32>(0.0), 1.0);
    }
    return materials_ambient(hit, vec3<f32>(0.0, 0.0, 1.0), seen.color, vec3<f32>(0.0), 1.0);
}
