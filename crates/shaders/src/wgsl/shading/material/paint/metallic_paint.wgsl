// Metallic paint: a bumpy clear coat over flakes that sparkle and flakes that vary the colour: `asperity_shading::MetallicPaint`.

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

// A sparkle at a point.
struct MetallicPaintSparkle {
    there: bool,
    tilt: vec3<f32>,
}

// The flake that sparkles at a point whose pixel is so wide: `Sparkles::flake`.
fn metallic_paint_sparkle(
    paint: MetallicPaint,
    position: vec3<f32>,
    n: vec3<f32>,
    footprint: f32,
) -> MetallicPaintSparkle {
    let none = MetallicPaintSparkle(false, vec3<f32>(0.0));
    let pixel = footprint * paint.pixel_size;
    let fade = 1.0 - frequency_clamp_removed_share(pixel, 1.0 / paint.physical_size);
    if !(fade > 0.0) {
        return none;
    }
    // As long along the axis nearest to the normal as a cell.
    let m = abs(n);
    var width = vec3<f32>(min(pixel, paint.physical_size));
    if m.x > max(m.y, m.z) {
        width.x = paint.physical_size;
    } else if m.y > m.z {
        width.y = paint.physical_size;
    } else {
        width.z = paint.physical_size;
    }
    let flake = flake_patch(position, paint.physical_size, width, 1.0, paint.keys, paint.more_keys);
    var eliminated = paint.elimination;
    if paint.per_unit > 0.0 {
        eliminated *= 1.0 - frequency_clamp_removed_share(pixel, paint.per_unit);
    }
    return MetallicPaintSparkle(flake.there && flake.value >= eliminated, flake.tilt * (paint.variation * fade));
}

// The flakes' reflectance of a colour at directions in their frame.
fn metallic_paint_flakes(paint: MetallicPaint, colour: vec3<f32>, wi: vec3<f32>, wo: vec3<f32>) -> vec3<f32> {
    return cook_torrance_beckmann(vec2<f32>(paint.flake_roughness), wi, wo).x * math_shares(colour);
}

// The normal of the clear coat in the frame of the surface, and the variance of its slopes that the pixel does not resolve.
fn metallic_paint_coat(paint: MetallicPaint, point: SurfacePoint, frame: Frame) -> vec4<f32> {
    let footprint = point.pixel.widths.x;
    let slope = fbm_sample(paint.orange_peel, point.position, footprint).gradient;
    let gradient = surface_gradient_tangential(point.normal, slope) * paint.peel_strength;
    let removed = fbm_removed_slope(paint.orange_peel, footprint, FBM_SLOPE_VARIANCE);
    let normal = frame_to_local(frame, surface_gradient_normal(point.normal, gradient));
    return vec4<f32>(normal, paint.peel_strength * paint.peel_strength * removed);
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
    let coat = metallic_paint_coat(paint, point, surface_point_frame(point));
    let through = coat_varnish_through(paint.coat_index, coat.xyz, wo, wi);
    let mirrored = coat_varnish_scattered(paint.coat_index, paint.coat_roughness, coat.xyz, coat.w, wo, wi);
    return brdf_finite_channels((flakes + pigment) * wi.z * through + vec3<f32>(mirrored));
}

// Reflectance times cosine, `Bsdf::scattered` of a point of paint whose flakes sparkle; wo and wi are in its frame,
// `surface_point_frame`. What a smooth coat mirrors is `metallic_paint_mirrored`.
fn metallic_paint_scattered(paint: MetallicPaint, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let frame = surface_point_frame(point);
    let footprint = point.pixel.widths.x;
    let specular = metallic_paint_specular(paint, point);
    let h = direction_half(wi, wo);
    let sparkle = metallic_paint_sparkle(paint, point.position, point.normal, footprint);
    var tilted = direction_unit_or_zero(point.normal + sparkle.tilt);
    if tilted.x == 0.0 && tilted.y == 0.0 && tilted.z == 0.0 {
        tilted = point.normal;
    }
    let flake = frame_to_local(frame, tilted);
    var flakes = vec3<f32>(0.0);
    if sparkle.there && dot(flake, h) > h.z {
        let own = frame_from_normal(flake);
        let i = frame_to_local(own, wi);
        let boosted = specular + (paint.boost_target - specular) * math_clamped(paint.boost, 1.0);
        // The cosine with the flake instead of the surface.
        flakes = metallic_paint_flakes(paint, boosted, i, frame_to_local(own, wo)) * min(max(i.z, 0.0) / max(wi.z, 0.001), 4.0);
    } else {
        flakes = metallic_paint_flakes(paint, specular, wi, wo);
    }
    return metallic_paint_coated(paint, point, specular, flakes, wo, wi);
}

// What a smooth coat mirrors, by a facet that uniform numbers choose: the first of `Bsdf::deltas`.
fn metallic_paint_mirrored(paint: MetallicPaint, point: SurfacePoint, wo: vec3<f32>, u: vec2<f32>) -> CoatDelta {
    let coat = metallic_paint_coat(paint, point, surface_point_frame(point));
    var delta = coat_varnish_delta(paint.coat_index, coat_facet(coat.xyz, coat.w, wo, u), wo);
    if paint.coat_roughness > 0.0 {
        delta.weight = vec3<f32>(0.0);
    }
    return delta;
}

// Of the material in the uniform.
fn metallic_paint(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return metallic_paint_scattered(metallic_paint_uniform, point, wo, wi);
}
