// The microfacet model of Torrance and Sparrow over V-grooves: `asperity_shading::TorranceSparrow`.

// Half vector, and the factor of its density D(h): min(1, 2 h_z cos_o/(wo.h), 2 h_z
// cos_i/(wo.h))/(4 cos_i cos_o).
struct TorranceSparrow {
    h: vec3<f32>,
    factor: f32,
    // The cosine of either direction with h, the argument of the Fresnel reflectance.
    cosine: f32,
}

// For any distribution f_r is `torrance_sparrow_eval` of D(h), times the Fresnel reflectance at
// `cosine`.
fn torrance_sparrow(wi: vec3<f32>, wo: vec3<f32>) -> TorranceSparrow {
    if !direction_are_above(wi, wo) {
        return TorranceSparrow(vec3<f32>(0.0), 0.0, 0.0);
    }
    let h = direction_half(wi, wo);
    let sum = wi + wo;
    // Both cosines with h are equal, but rounding would make the two products differ.
    let cosine = 0.5 * sqrt(dot(sum, sum));
    let low = min(wi.z, wo.z);
    let high = max(wi.z, wo.z);
    return TorranceSparrow(h, min(1.0 / low, 2.0 * h.z / cosine) / high, cosine);
}

// D(h) times the factor, 1/sr.
fn torrance_sparrow_eval(grooves: TorranceSparrow, density: f32) -> f32 {
    return brdf_finite(density * grooves.factor * 0.25);
}
