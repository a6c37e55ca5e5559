// Geometry of two directions for rough diffuse reflectances: `reflectance/diffuse/rough.rs` of
// asperity-shading.

// s/t of Oren and Nayar: s = wi.wo - cos cos, t the larger cosine for positive s, otherwise 1.
fn rough_stretched(wi: vec3<f32>, wo: vec3<f32>) -> f32 {
    let s = dot(wi.xy, wo.xy);
    let high = max(wi.z, wo.z);
    return select(s, s / high, s > 0.0);
}

// sin theta of a unit direction, from its horizontal part, as near the normal 1 - cos^2 has no
// digits.
fn rough_sine(w: vec3<f32>) -> f32 {
    return min(sqrt(dot(w.xy, w.xy)), 1.0);
}
