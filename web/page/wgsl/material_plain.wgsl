// Objects around the material: ground, tires, painted walls, china, in the palette's colors. The
// first texture coordinate selects the color.

struct MaterialSeen {
    diffuse: vec3<f32>,
    specular: f32,
    alpha: f32,
    // Shade of objects on the ground, and the opacity of the ground.
    shade: f32,
    ground: f32,
}

fn material_seen(point: SurfacePoint, frame: Frame, wo: vec3<f32>) -> MaterialSeen {
    let place = u32(point.uv.x / materials_view.metres + 0.5);
    let gloss = materials_fresnel(wo.z);
    if place == 0u {
        let at = point.position / materials_view.metres;
        let outside = max(abs(at.xy) - materials_view.ground.yz * 0.6, vec2<f32>(0.0)) / (materials_view.ground.yz * 0.55);
        let shade = 1.0 - 0.85 * exp(-dot(outside, outside));
        let r = sqrt(dot(at.xy, at.xy)) / materials_view.ground.x;
        let dark = select(1.0, 0.2, materials_view.ground.w < 0.0);
        return MaterialSeen(vec3<f32>(0.6, 0.59, 0.575) * dark, 0.0, 1.0, shade, 1.0 - smoothstep(0.45, 1.0, r));
    }
    if place == 1u {
        return MaterialSeen(vec3<f32>(0.015), 0.5 * gloss, 0.5, 1.0, 1.0);
    }
    if place == 2u {
        return MaterialSeen(vec3<f32>(0.05), 0.6, 0.25, 1.0, 1.0);
    }
    if place == 3u {
        return MaterialSeen(vec3<f32>(0.74, 0.72, 0.68), 0.0, 1.0, 1.0, 1.0);
    }
    if place == 4u {
        return MaterialSeen(vec3<f32>(0.42, 0.31, 0.22), 0.3 * gloss, 0.4, 1.0, 1.0);
    }
    if place == 5u {
        return MaterialSeen(vec3<f32>(0.75, 0.74, 0.72), gloss, 0.2, 1.0, 1.0);
    }
    return MaterialSeen(vec3<f32>(0.09, 0.03, 0.008), gloss, 0.1, 1.0, 1.0);
}

fn material_lamp(seen: MaterialSeen, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !(wi.z > 0.0) {
        return vec3<f32>(0.0);
    }
    var gloss = 0.0;
    if seen.specular > 0.0 {
        gloss = cook_torrance_beckmann(vec2<f32>(sqrt(seen.alpha * seen.alpha + 0.01)), wi, wo).x * seen.specular;
    }
    return (seen.diffuse * 0.31830987 + gloss) * (wi.z * seen.shade * seen.ground);
}

fn material_ambience(seen: MaterialSeen, hit: MaterialsHit) -> vec3<f32> {
    let lit = materials_ambient(hit, vec3<f32>(0.0, 0.0, 1.0), seen.diffuse, vec3<f32>(seen.specular), seen.alpha);
    if seen.ground < 1.0 {
        return lit * seen.shade * seen.ground + materials_behind(hit.direction) * (1.0 - seen.ground);
    }
    return lit * seen.shade;
}
