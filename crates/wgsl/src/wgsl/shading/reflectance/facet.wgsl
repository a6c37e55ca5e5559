// Light from a facet of a surface, as summed by `asperity_shading::Bsdf`.

// Both directions in the frame of a facet, and the factor of the facet's reflectance, its weight
// times the cosine of the light. The factor is 0 if either direction is on different sides of the
// facet and the surface.
struct FacetLight {
    wi: vec3<f32>,
    wo: vec3<f32>,
    factor: f32,
}

// The light from a facet of this weight and unit normal, rotated so that its mirror direction of
// the view is visible. All in the frame of the surface.
fn facet_light(share: f32, normal: vec3<f32>, wi: vec3<f32>, wo: vec3<f32>) -> FacetLight {
    let m = surface_gradient_facing(vec3<f32>(0.0, 0.0, 1.0), normal, wo);
    var i = wi;
    var o = wo;
    if !(m.x == 0.0 && m.y == 0.0 && m.z == 1.0) {
        let frame = frame_from_normal_tangent(m, vec3<f32>(1.0, 0.0, 0.0));
        i = frame_to_local(frame, wi);
        o = frame_to_local(frame, wo);
    }
    let lit = share > 0.0 && share <= MATH_LARGEST && i.z * wi.z > 0.0 && o.z * wo.z > 0.0;
    return FacetLight(i, o, select(0.0, share * abs(i.z), lit));
}

// The reflectance of mirror facets with this density around h, for directions above the surface;
// limited to the number of facets.
fn facet_shown(density: f32, h: vec3<f32>, wi: vec3<f32>, wo: vec3<f32>) -> f32 {
    let cosine = dot(wo, h);
    let ratio = select(1.0, h.z / select(1.0, cosine, cosine != 0.0), cosine != 0.0);
    return brdf_finite(density * (min(ratio, 1.0) / (4.0 * max(wi.z, wo.z))));
}
