// Rough diffuse surfaces with slopes in texture coordinates, facet by facet: `of_slopes` in
// `material/textured.rs` of asperity-shading.

struct TexturedSlopes {
    // The unit normal, the gradients of the texture coordinates, and the frame of directions.
    normal: vec3<f32>,
    gradient_u: vec3<f32>,
    gradient_v: vec3<f32>,
    frame: Frame,
    // Albedo and roughness of the facets.
    color: vec3<f32>,
    roughness: f32,
}

fn textured_slopes(point: SurfacePoint, color: vec3<f32>, roughness: f32) -> TexturedSlopes {
    return TexturedSlopes(
        point.normal,
        surface_point_gradient_u(point),
        surface_point_gradient_v(point),
        surface_point_frame(point),
        color,
        roughness,
    );
}

// Light from a facet of this weight and slope, times the cosine.
fn textured_slopes_light(
    surface: TexturedSlopes,
    share: f32,
    slope: vec2<f32>,
    wo: vec3<f32>,
    wi: vec3<f32>,
) -> vec3<f32> {
    let gradient = surface_gradient_finite(surface.gradient_u * slope.x + surface.gradient_v * slope.y);
    let normal = frame_to_local(surface.frame, surface_gradient_normal(surface.normal, gradient));
    let light = facet_light(share, normal, wi, wo);
    if !(light.factor > 0.0) {
        return vec3<f32>(0.0);
    }
    return energy_preserving_oren_nayar_eval(surface.color, surface.roughness, light.wi, light.wo) * light.factor;
}
