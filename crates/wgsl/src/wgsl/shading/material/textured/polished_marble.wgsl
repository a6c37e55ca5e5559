// Blue marble under a polish of relative IOR 1.5: `asperity_shading::material::PolishedMarble`.

// Reflectance times cosine, `Bsdf::eval_cos` of a point; wo and wi are in its frame,
// `surface_point_frame`.
fn polished_marble_eval_cos(stone: PolishedMarble, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let color = stone.tint * marble_color(stone.marble, point.position, point.pixel.widths.x);
    let light = energy_preserving_oren_nayar_eval(color, 0.0, wi, wo) * wi.z;
    if stone.polish > 0.0 {
        let polish = coat_clearcoat(1.5, math_clamped(stone.polish, 1.0), vec3<f32>(0.0, 0.0, 1.0), 0.0);
        return coat_over(polish, light, wo, wi);
    }
    return brdf_finite_channels(light);
}

// The material in the uniform.
fn polished_marble(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return polished_marble_eval_cos(polished_marble_uniform, point, wo, wi);
}
