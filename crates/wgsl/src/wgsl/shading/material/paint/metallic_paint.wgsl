// Metallic paint with sparkling flakes, under a bumpy clearcoat: `asperity_shading::MetallicPaint`.

// The sparkle of a cell at a point.
struct MetallicPaintSparkle {
    there: bool,
    tilt: vec3<f32>,
    // The weight at the point, and the mean over the cell.
    weight: f32,
    mean_weight: f32,
}

// The sparkling flake around a point whose pixel has this width.
fn metallic_paint_sparkle(
    paint: MetallicPaint,
    position: vec3<f32>,
    n: vec3<f32>,
    footprint: f32,
) -> MetallicPaintSparkle {
    let none = MetallicPaintSparkle(false, vec3<f32>(0.0), 0.0, 0.0);
    let pixel = footprint * paint.pixel_size;
    let fade = 1.0 - frequency_clamp_filtered_fraction(pixel, 1.0 / paint.physical_size);
    if !(fade > 0.0) {
        return none;
    }
    // As long as a cell along the axis nearest to the normal.
    let m = abs(n);
    let across = min(pixel, paint.physical_size);
    var width = vec3<f32>(across);
    if m.x > max(m.y, m.z) {
        width.x = paint.physical_size;
    } else if m.y > m.z {
        width.y = paint.physical_size;
    } else {
        width.z = paint.physical_size;
    }
    let covered = flake_patch_covered(position, paint.physical_size, width, footprint, paint.keys, paint.more_keys);
    var kept = 1.0;
    if covered.flake.value < paint.elimination {
        kept = 0.0;
        if paint.per_unit > 0.0 {
            kept = frequency_clamp_filtered_fraction(pixel, paint.per_unit);
        }
    }
    let most = fade * kept;
    let share = across / paint.physical_size;
    return MetallicPaintSparkle(
        covered.flake.there && most > 0.0,
        covered.flake.tilt * (paint.variation * fade),
        covered.cover * most,
        share * share * most,
    );
}

// Reflectance times cosine, `Bsdf::eval_cos` of a point of paint with sparkling flakes; wo and wi
// are in its frame, `surface_point_frame`. The reflection of a smooth coat is
// `metallic_paint_mirrored`.
fn metallic_paint_eval_cos(paint: MetallicPaint, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let frame = surface_point_frame(point);
    let footprint = point.pixel.widths.x;
    let specular = metallic_paint_specular(paint, point);
    let sparkle = metallic_paint_sparkle(paint, point.position, point.normal, footprint);
    var tilted = direction_unit_or_zero(point.normal + sparkle.tilt);
    if tilted.x == 0.0 && tilted.y == 0.0 && tilted.z == 0.0 {
        tilted = point.normal;
    }
    let flake = frame_to_local(frame, tilted);
    var flakes = metallic_paint_flakes(paint, specular, wi, wo);
    if sparkle.there {
        let own = frame_from_normal(flake);
        let i = frame_to_local(own, wi);
        let boosted = specular + (paint.boost_target - specular) * math_clamped(paint.boost, 1.0);
        // Uses the cosine to the flake instead of to the surface.
        let bright = metallic_paint_flakes(paint, boosted, i, frame_to_local(own, wo)) * min(max(i.z, 0.0) / max(wi.z, 0.001), 4.0);
        // The points around contribute at most half of their light.
        let most = flakes * (0.5 / max(sparkle.mean_weight, 1e-6));
        flakes += min(max(bright - flakes, vec3<f32>(0.0)), most) * (sparkle.weight - sparkle.mean_weight);
    }
    return metallic_paint_coated(paint, point, specular, flakes, wo, wi);
}

// The material in the uniform.
fn metallic_paint(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return metallic_paint_eval_cos(metallic_paint_uniform, point, wo, wi);
}
