// The microfacet model of Cook and Torrance with GGX: `asperity_shading::CookTorrance<Ggx, _>`.

// D G/(4 cos cos) in 1/sr, and the cosine of either direction with the half vector, the argument of
// the Fresnel reflectance:
//
//     let facets = cook_torrance_ggx(alpha, wi, wo);
//     let f_r = facets.x * schlick_reflectance(normal_incidence, facets.y);
fn cook_torrance_ggx(alpha: vec2<f32>, wi: vec3<f32>, wo: vec3<f32>) -> vec2<f32> {
    if !direction_are_above(wi, wo) {
        return vec2<f32>(0.0);
    }
    let h = direction_half(wi, wo);
    let masking = ggx_masking_shadowing(alpha, wi, wo);
    return vec2<f32>(brdf_finite(ggx_d(alpha, h) * masking / (4.0 * wi.z * wo.z)), dot(wo, h));
}
