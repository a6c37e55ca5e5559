// Coats under environment light with one facet: slopes that a pixel does not resolve widen the
// lobe.

// Beckmann's alpha of a coat's reflection of lamps, as wide as the distance between lamps.
fn material_coat_alpha(coat: Coat) -> f32 {
    return sqrt(coat.roughness * coat.roughness + 2.0 * coat.slope_variance + 0.01);
}

// Layers under a varnish, and the varnish's reflection of a lamp by a lobe about a facet. A smooth
// varnish reflects the light's map instead.
fn material_varnished(coat: Coat, below: vec3<f32>, lobe: vec2<f32>, factor: f32, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    let mirrored = lobe.x * dielectric_reflectance(coat.index, lobe.y) * factor;
    return brdf_finite_channels(below * coat_transmittance(coat, wi) * coat_transmittance(coat, wo) + mirrored);
}

// Layers of a diffuse and a glossy color under a varnish, and the varnish's reflection, which
// includes lamps only if the coat is smooth.
fn material_under_coat(coat: Coat, hit: MaterialsHit, diffuse: vec3<f32>, specular: vec3<f32>, alpha: f32) -> vec3<f32> {
    let up = vec3<f32>(0.0, 0.0, 1.0);
    let mirrors = 1.0 - coat_transmittance(coat, hit.wo);
    let below = materials_ambient(hit, up, min(diffuse, 1.0 - specular), specular, alpha) * ((1.0 - mirrors) * coat_transmittance(coat, up));
    let m = surface_gradient_facing(up, coat.normal, hit.wo);
    let mirrored = frame_to_world(hit.frame, direction_reflect(hit.wo, m));
    if coat.roughness > 0.0 {
        return below + light_glossy(mirrored, coat.roughness) * mirrors;
    }
    return below + light_seen(mirrored) * dielectric_reflectance(coat.index, dot(hit.wo, m));
}
