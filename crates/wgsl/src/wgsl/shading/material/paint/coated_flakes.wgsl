// Flakes over pigment under a bumpy clearcoat, common to paints with sparkles and with counted
// flakes: `asperity_shading::MetallicPaint`.

// The reflectance of flakes of a color for directions in their frame.
fn metallic_paint_flakes(paint: MetallicPaint, color: vec3<f32>, wi: vec3<f32>, wo: vec3<f32>) -> vec3<f32> {
    return cook_torrance_beckmann(vec2<f32>(paint.flake_roughness), wi, wo).x * math_shares(color);
}

// The clearcoat with its orange peel, filtered over the pixel.
fn metallic_paint_coat(paint: MetallicPaint, point: SurfacePoint) -> Coat {
    let footprint = point.pixel.widths.x;
    let slope = sized_fbm_sample(paint.orange_peel, point.position, footprint).gradient;
    let gradient = surface_gradient_tangential(point.normal, slope) * paint.peel_strength;
    let removed = sized_fbm_removed_slope(paint.orange_peel, footprint, SIZED_FBM_SLOPE_VARIANCE);
    let normal = frame_to_local(surface_point_frame(point), surface_gradient_normal(point.normal, gradient));
    let variance = paint.peel_strength * paint.peel_strength * removed;
    return coat_clearcoat(paint.coat_index, paint.coat_roughness, normal, variance);
}

// The specular color of the flakes at a point, including passive flakes; in [0, 1].
fn metallic_paint_specular(paint: MetallicPaint, point: SurfacePoint) -> vec3<f32> {
    let noise = sized_fbm_sample(paint.passive, point.position, point.pixel.widths.x).value;
    return min(paint.specular * max(1.0 + paint.passive_strength * noise, 0.0), vec3<f32>(1.0));
}

// Reflectance times cosine of flakes with this reflectance over the pigment, under the coat; for
// directions above the surface.
fn metallic_paint_coated(
    paint: MetallicPaint,
    point: SurfacePoint,
    specular: vec3<f32>,
    flakes: vec3<f32>,
    wo: vec3<f32>,
    wi: vec3<f32>,
) -> vec3<f32> {
    let pigment = energy_preserving_oren_nayar_eval(min(paint.pigment, 1.0 - specular), 0.2, wi, wo);
    return coat_over(metallic_paint_coat(paint, point), (flakes + pigment) * wi.z, wo, wi);
}

// Reflection of a smooth coat at a facet chosen by uniform numbers, the first of `Bsdf::specular_samples`; 0
// for a rough coat.
fn metallic_paint_mirrored(paint: MetallicPaint, point: SurfacePoint, wo: vec3<f32>, u: vec2<f32>) -> CoatSpecularSample {
    return coat_specular_samples(metallic_paint_coat(paint, point), wo, u).mirrored;
}
