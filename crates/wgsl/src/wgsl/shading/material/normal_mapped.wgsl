// A glossy surface with an authored normal map: `asperity_shading::material::NormalMapped`.

// Reflectance times cosine, `Bsdf::eval_cos` of a point; wo and wi are in its frame,
// `surface_point_frame`.
fn normal_mapped_eval_cos(stone: NormalMapped, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let h = direction_half(wi, wo);
    let pixel = surface_point_uv_pixel(point);
    let far = gaussian_split(vec2<f32>(0.0), 0.0);
    var sum = vec3<f32>(0.0);
    for (var k = 0u; k < stone.map.groups; k++) {
        let lobe = slope_pyramid_sample_along(stone.map, point.uv, pixel, 8u, k);
        if lobe.weight > 0.0 {
            let slopes = slope_moments_detailed(lobe.moments, vec2<f32>(stone.alpha_x, stone.alpha_y), far);
            let weight = max(stone.color * lobe.weight, vec3<f32>(0.0));
            sum += weight * facet_shown(offset_beckmann_d(slopes, h), h, wi, wo);
        }
    }
    return brdf_finite_channels(sum * wi.z);
}

// The material in the uniform.
fn normal_mapped(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return normal_mapped_eval_cos(normal_mapped_uniform, point, wo, wi);
}
