// Paper with stars: `asperity_shading::material::Wallpaper`.

// Reflectance times cosine, `Bsdf::eval_cos` of a point; wo and wi are in its frame,
// `surface_point_frame`.
fn wallpaper_eval_cos(paper: Wallpaper, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let share = star_wallpaper_coverage(paper.stars, point.uv, surface_point_uv_pixel(point).widths.x);
    let color = paper.paper * (1.0 - share) + paper.star * share;
    return brdf_finite_channels(energy_preserving_oren_nayar_eval(color, paper.roughness, wi, wo) * wi.z);
}

// The material in the uniform.
fn wallpaper(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return wallpaper_eval_cos(wallpaper_uniform, point, wo, wi);
}
