// Flakes over pigment under a bumpy clear coat, what paints with sparkles and with counted flakes share: `asperity_shading::MetallicPaint`.

struct MetallicPaint {
    orange_peel: Fbm,
    passive: Fbm,
    // The keys of sparkles, for seven numbers of a flake.
    keys: vec4<u32>,
    more_keys: vec4<u32>,
    // The specular colour of the flakes, and their Beckmann's alpha.
    specular: vec3<f32>,
    flake_roughness: f32,
    // The colour of the pigment, and the strength of the orange peel.
    pigment: vec3<f32>,
    peel_strength: f32,
    // The target of a sparkle's colour, and its boost.
    boost_target: vec3<f32>,
    boost: f32,
    // The width of a sparkle in pixels, its greatest width, its tilt, the share that is left out.
    pixel_size: f32,
    physical_size: f32,
    variation: f32,
    elimination: f32,
    // The inverse of the unit by which fewer are left out from afar; 0 where as many are.
    per_unit: f32,
    passive_strength: f32,
    // The relative index of the coat, and its Beckmann's alpha, 0 for a smooth one.
    coat_index: f32,
    coat_roughness: f32,
}

// The flakes' reflectance of a colour at directions in their frame.
fn metallic_paint_flakes(paint: MetallicPaint, colour: vec3<f32>, wi: vec3<f32>, wo: vec3<f32>) -> vec3<f32> {
    return cook_torrance_beckmann(vec2<f32>(paint.flake_roughness), wi, wo).x * math_shares(colour);
}

// The clear coat with its orange peel, as the pixel sees it.
fn metallic_paint_coat(paint: MetallicPaint, point: SurfacePoint) -> Coat {
    let footprint = point.pixel.widths.x;
    let slope = fbm_sample(paint.orange_peel, point.position, footprint).gradient;
    let gradient = surface_gradient_tangential(point.normal, slope) * paint.peel_strength;
    let removed = fbm_removed_slope(paint.orange_peel, footprint, FBM_SLOPE_VARIANCE);
    let normal = frame_to_local(surface_point_frame(point), surface_gradient_normal(point.normal, gradient));
    let variance = paint.peel_strength * paint.peel_strength * removed;
    return coat_varnish(paint.coat_index, paint.coat_roughness, normal, variance);
}

// The specular colour of the flakes at a point, with passive flakes; in [0, 1].
fn metallic_paint_specular(paint: MetallicPaint, point: SurfacePoint) -> vec3<f32> {
    let noise = fbm_sample(paint.passive, point.position, point.pixel.widths.x).value;
    return min(paint.specular * max(1.0 + paint.passive_strength * noise, 0.0), vec3<f32>(1.0));
}

// Reflectance times cosine of flakes of this reflectance over the pigment, under the coat; for directions above the surface.
fn metallic_paint_coated(
    paint: MetallicPaint,
    point: SurfacePoint,
    specular: vec3<f32>,
    flakes: vec3<f32>,
    wo: vec3<f32>,
    wi: vec3<f32>,
) -> vec3<f32> {
    let pigment = energy_preserving_value(min(paint.pigment, 1.0 - specular), 0.2, wi, wo);
    return coat_over(metallic_paint_coat(paint, point), (flakes + pigment) * wi.z, wo, wi);
}

// What a smooth coat mirrors, by a facet that uniform numbers choose: the first of `Bsdf::deltas`; dark for a rough one.
fn metallic_paint_mirrored(paint: MetallicPaint, point: SurfacePoint, wo: vec3<f32>, u: vec2<f32>) -> CoatDelta {
    return coat_deltas(metallic_paint_coat(paint, point), wo, u).mirrored;
}
