// A rough diffuse surface with gloss under a lamp and the rest of the light, with one facet: slopes
// that a pixel does not resolve widen the gloss.

fn material_glossy(s: Glossy, frame: Frame, roughness: f32, alpha: f32, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !(wi.z > 0.0) {
        return vec3<f32>(0.0);
    }
    let light = facet_light(1.0, frame_to_local(frame, s.normal), wi, wo);
    let lost = s.slope_variance + 0.5 * dot(s.ridges, s.ridges);
    let gloss = cook_torrance_beckmann(vec2<f32>(sqrt(alpha * alpha + 2.0 * lost)), light.wi, light.wo).x;
    let diffuse = energy_preserving_oren_nayar_eval(min(s.diffuse, 1.0 - s.specular), roughness, light.wi, light.wo);
    return brdf_finite_channels((diffuse + gloss * s.specular) * light.factor);
}

fn material_glossy_ambience(s: Glossy, hit: MaterialsHit, alpha: f32) -> vec3<f32> {
    return materials_ambient(hit, frame_to_local(hit.frame, s.normal), min(s.diffuse, 1.0 - s.specular), s.specular, alpha);
}
