// Metallic paint with counted flakes: `asperity_shading::MetallicPaint` of `PaintFlakes::Counted`.

// Reflectance times cosine, `Bsdf::eval_cos` of a point; wo and wi are in its frame,
// `surface_point_frame`. The reflection of a smooth coat is `metallic_paint_mirrored`.
fn counted_flakes_eval_cos(
    counted: CountedFlakes,
    point: SurfacePoint,
    wo: vec3<f32>,
    wi: vec3<f32>,
) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let paint = counted.paint;
    let specular = metallic_paint_specular(paint, point);
    let z = beckmann_invert(vec2<f32>(paint.flake_roughness), direction_half(wi, wo));
    let number = glint_field_relative_over(counted.flakes, z, 0.0, point.position, point.pixel);
    let flakes = metallic_paint_flakes(paint, specular, wi, wo) * number;
    return metallic_paint_coated(paint, point, specular, flakes, wo, wi);
}

// The material in the uniform.
fn counted_flakes(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return counted_flakes_eval_cos(counted_flakes_uniform, point, wo, wi);
}
