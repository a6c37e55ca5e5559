// Tempered glass for a pixel, with the environment behind it.

struct MaterialSeen {
    coat: Coat,
}

fn material_seen(point: SurfacePoint, frame: Frame, wo: vec3<f32>) -> MaterialSeen {
    return MaterialSeen(tempered_glass_coat(tempered_glass_uniform, point));
}

fn material_lamp(seen: MaterialSeen, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    // The transmission of lamps by a rough body is included in the mean light.
    let crosses = wi.z < 0.0;
    let glass = tempered_glass_uniform;
    if !(seen.coat.roughness > 0.0) || (crosses && glass.is_solid != 0u) {
        return vec3<f32>(0.0);
    }
    let light = facet_light(1.0, seen.coat.normal, vec3<f32>(wi.xy, abs(wi.z)), wo);
    let value = cook_torrance_beckmann(vec2<f32>(material_coat_alpha(seen.coat)), light.wi, light.wo);
    let once = dielectric_reflectance(glass.index, value.y);
    let mirrors = select(once, 2.0 * once / (1.0 + once), glass.is_solid == 0u);
    let lobe = value.x * light.factor;
    if crosses {
        return rough_dielectric_through_wall(glass.tint, value.y, glass.index) * ((1.0 - mirrors) * lobe);
    }
    return vec3<f32>(mirrors * lobe);
}

fn material_ambience(seen: MaterialSeen, hit: MaterialsHit) -> vec3<f32> {
    var smooth_coat = seen.coat;
    smooth_coat.roughness = 0.0;
    // At the mean of the slopes that the pixel does not resolve.
    let deltas = coat_specular_samples(smooth_coat, hit.wo, vec2<f32>(0.0, 0.25));
    let mirrored = frame_to_world(hit.frame, deltas.mirrored.wi);
    let through = frame_to_world(hit.frame, deltas.transmitted.wi);
    if seen.coat.roughness > 0.0 {
        let rough = seen.coat.roughness;
        return light_glossy(mirrored, rough) * deltas.mirrored.weight + light_glossy(through, rough) * deltas.transmitted.weight;
    }
    return light_seen(mirrored) * deltas.mirrored.weight + materials_behind(through) * deltas.transmitted.weight;
}
