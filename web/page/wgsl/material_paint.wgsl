// Metallic paint with sparkling flakes for a pixel.

struct MaterialSeen {
    specular: vec3<f32>,
    coat: Coat,
    sparkles: bool,
    // The flake's normal.
    flake: vec3<f32>,
}

fn material_seen(point: SurfacePoint, frame: Frame, wo: vec3<f32>) -> MaterialSeen {
    let sparkle = metallic_paint_sparkle(metallic_paint_uniform, point.position, point.normal, point.pixel.widths.x);
    let tilted = direction_unit_or_zero(point.normal + sparkle.tilt);
    return MaterialSeen(
        metallic_paint_specular(metallic_paint_uniform, point),
        metallic_paint_coat(metallic_paint_uniform, point),
        sparkle.there && dot(tilted, tilted) > 0.5,
        frame_to_local(frame, tilted),
    );
}

fn material_lamp(seen: MaterialSeen, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !(wi.z > 0.0) {
        return vec3<f32>(0.0);
    }
    let h = direction_half(wi, wo);
    var i = wi;
    var o = wo;
    var color = seen.specular;
    var factor = 1.0;
    if seen.sparkles && dot(seen.flake, h) > h.z {
        let own = frame_from_normal(seen.flake);
        i = frame_to_local(own, wi);
        o = frame_to_local(own, wo);
        let boost = math_clamped(metallic_paint_uniform.boost, 1.0);
        color += (metallic_paint_uniform.boost_target - seen.specular) * boost;
        // The cosine with the flake instead of the surface.
        factor = min(max(i.z, 0.0) / max(wi.z, 0.001), 4.0);
    }
    // The lobes of the flakes and of a rough coat in a loop, because a function is compiled at
    // every call.
    let light = facet_light(1.0, seen.coat.normal, wi, wo);
    let is_rough = seen.coat.roughness > 0.0;
    var flakes = 0.0;
    var lobe = vec2<f32>(0.0);
    for (var k = 0u; k < select(1u, 2u, is_rough); k++) {
        let of_flakes = k == 0u;
        let alpha = select(material_coat_alpha(seen.coat), metallic_paint_uniform.flake_roughness, of_flakes);
        lobe = cook_torrance_beckmann(vec2<f32>(alpha), select(light.wi, i, of_flakes), select(light.wo, o, of_flakes));
        flakes = select(flakes, lobe.x, of_flakes);
    }
    let pigment = energy_preserving_oren_nayar_eval(min(metallic_paint_uniform.pigment, 1.0 - seen.specular), 0.2, wi, wo);
    let below = (flakes * factor * math_shares(color) + pigment) * wi.z;
    return material_varnished(seen.coat, below, select(vec2<f32>(0.0), lobe, is_rough), light.factor, wo, wi);
}

fn material_ambience(seen: MaterialSeen, hit: MaterialsHit) -> vec3<f32> {
    return material_under_coat(seen.coat, hit, metallic_paint_uniform.pigment, seen.specular, metallic_paint_uniform.flake_roughness);
}
