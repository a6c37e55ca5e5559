// Any material with small variations, blemishes and dents: `asperity_shading::Variations`.

// The surface filtered over a pixel, independent of the light.
fn variations_surface(variations: Variations, point: SurfacePoint) -> Glossy {
    let at = point.position;
    let n = point.normal;
    let footprint = point.pixel.widths.x;
    let bump = variations.blemish_bump;
    let dent = variations.dent_strength;
    let blemish_slope = sized_fbm_sample(variations.blemishes, at, footprint).gradient;
    let dent_slope = dents_sample(variations.dents, variations.dropped, at, footprint).gradient;
    let gradient = surface_gradient_tangential(n, blemish_slope) * bump
        + surface_gradient_tangential(n, dent_slope) * dent;
    let specular = blemishes_color(
        variations.blemishes, variations.half_mean, variations.specular, variations.blemish_color, at, footprint,
    );
    let variance = bump * bump * sized_fbm_removed_slope(variations.blemishes, footprint, SIZED_FBM_SLOPE_VARIANCE)
        + dent * dent * sized_fbm_removed_slope(variations.dents, footprint, SIZED_FBM_SLOPE_VARIANCE * variations.dent_cover);
    return Glossy(
        variations.diffuse,
        clamp(specular, vec3<f32>(0.0), vec3<f32>(1.0)),
        surface_gradient_normal(n, gradient),
        variance,
        vec3<f32>(0.0),
    );
}

// Reflectance times cosine, `Bsdf::eval_cos` of a point; wo and wi are in its frame,
// `surface_point_frame`.
fn variations_eval_cos(variations: Variations, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    let surface = variations_surface(variations, point);
    return glossy_eval_cos(
        surface, surface_point_frame(point), variations.roughness, variations.gloss_roughness, wo, wi,
    );
}

// The material in the uniform.
fn variations(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return variations_eval_cos(variations_uniform, point, wo, wi);
}
