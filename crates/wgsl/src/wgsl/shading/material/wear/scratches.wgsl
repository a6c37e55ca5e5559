// Scratches of wear and tear on metal: `asperity_shading::Scratches`.

// Scratches filtered over a pixel: mean slope, covered fraction, and mean squares of the unresolved
// slopes.
struct ScratchesGrooves {
    slope: vec2<f32>,
    covered: f32,
    removed: vec3<f32>,
}

// The fraction of a pixel covered by a groove at this distance.
fn scratches_overlap(d: f32, half_width: f32, width: f32) -> f32 {
    if width > 0.0001 * half_width {
        let low = max(d - 0.5 * width, -half_width);
        let high = min(d + 0.5 * width, half_width);
        return math_clamped((high - low) / width, 1.0);
    }
    return select(0.0, 1.0, abs(d) < half_width);
}

// The grooves filtered over a pixel of this width in texture coordinates.
fn scratches_grooves(scratches: Scratches, uv: vec2<f32>, width: f32) -> ScratchesGrooves {
    let kept = 1.0 - frequency_clamp_filtered_fraction(width, 1.0 / scratches.segments.cell);
    let far = ScratchesGrooves(vec2<f32>(0.0), scratches.covered_far, scratches.removed_far);
    if kept <= 0.0 || !direction_is_finite(vec3<f32>(uv, 0.0)) {
        return far;
    }
    let half_width = scratches.half_width;
    let wide = sqrt(half_width * half_width + 0.25 * width * width);
    let shallow = half_width / wide;
    let strength = scratches.strength;
    let lost = (1.0 - kept * shallow * shallow * shallow) * strength * strength * 1.2190477;
    var bare = 1.0;
    var slope = vec2<f32>(0.0);
    var removed = vec3<f32>(0.0);
    // Includes grooves whose own width overlaps the pixel.
    let place = segments_place(scratches.segments, uv, half_width + 0.5 * width);
    for (var i = 0u; i < 9u; i++) {
        if !segments_reaches(place, i) {
            continue;
        }
        for (var k = 0u; k < 4u; k++) {
            let groove = segments_near(scratches.segments, place, i, k);
            let s = groove.across / wide;
            let t = groove.along;
            let side = 1.0 - s * s;
            let taper = 1.0 - t * t;
            if groove.there && taper > 0.0 {
                bare *= 1.0 - scratches_overlap(groove.across, half_width, width);
                if side > 0.0 {
                    let across = direction_left_2d(groove.direction);
                    let by_across = -4.0 * s * side * taper / wide;
                    let by_along = side * side * -2.0 * t / (0.5 * scratches.segments.length);
                    slope += (across * by_across + groove.direction * by_along) * shallow;
                    let spread = side * side * shallow * 1.875;
                    removed += vec3<f32>(across.x * across.x, across.x * across.y, across.y * across.y)
                        * (lost * spread * taper * taper);
                }
            }
        }
    }
    let depth = strength * half_width;
    return ScratchesGrooves(
        slope * (-depth * kept),
        far.covered + kept * ((1.0 - bare) - far.covered),
        far.removed + kept * (removed - far.removed),
    );
}

// The first principal axis of a matrix of second moments, with the deviation as its length.
// `scratches_minor_axis` is the axis to its left.
fn scratches_axes(moments: vec3<f32>) -> vec4<f32> {
    let middle = 0.5 * (moments.x + moments.z);
    let half_difference = 0.5 * (moments.x - moments.z);
    let apart = sqrt(half_difference * half_difference + moments.y * moments.y);
    // The eigenvector by its larger component.
    var first = vec2<f32>(moments.y, apart - half_difference);
    if half_difference > 0.0 {
        first = vec2<f32>(half_difference + apart, moments.y);
    }
    let unit = direction_unit_or_2d(first, vec2<f32>(1.0, 0.0));
    return vec4<f32>(unit * sqrt(middle + apart), direction_left_2d(unit) * sqrt(max(middle - apart, 0.0)));
}

// The metal filtered over a pixel, independent of the light.
struct ScratchesSurface {
    frame: Frame,
    // The mean normal, and the fraction covered by grooves, with the unresolved slopes in them.
    normal: vec3<f32>,
    covered: f32,
    facets: SlopeFacets,
}

fn scratches_surface(scratches: Scratches, point: SurfacePoint) -> ScratchesSurface {
    let grooves = scratches_grooves(scratches, point.uv, surface_point_uv_pixel(point).widths.x);
    let normal = surface_gradient_normal(point.normal, surface_point_slope(point, grooves.slope));
    var axes = vec4<f32>(0.0);
    if grooves.covered > 0.0 {
        axes = scratches_axes(grooves.removed / grooves.covered);
    }
    let facets = slope_facets(
        point.normal, normal, surface_point_slope(point, axes.xy), surface_point_slope(point, axes.zw),
    );
    return ScratchesSurface(surface_point_frame(point), normal, grooves.covered, facets);
}

// Reflectance times cosine of the filtered surface; wo and wi are in its frame.
fn scratches_lit(scratches: Scratches, surface: ScratchesSurface, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let alpha = vec2<f32>(scratches.roughness);
    var sum = 0.0;
    // The smooth metal, then the facets of the grooves.
    for (var k = 0u; k < 8u; k++) {
        var share = 1.0 - surface.covered;
        var m = surface.normal;
        if k > 0u {
            let facet = slope_facets_along(surface.facets, 0.2, k - 1u);
            share = facet.weight * surface.covered;
            m = facet.normal;
        }
        let light = facet_light(share, frame_to_local(surface.frame, m), wi, wo);
        if light.factor > 0.0 {
            sum += cook_torrance_beckmann(alpha, light.wi, light.wo).x * light.factor;
        }
    }
    return brdf_finite_channels(math_shares(scratches.specular) * sum);
}

// Reflectance times cosine, `Bsdf::eval_cos` of a point; wo and wi are in its frame,
// `surface_point_frame`.
fn scratches_eval_cos(scratches: Scratches, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return scratches_lit(scratches, scratches_surface(scratches, point), wo, wi);
}

// The material in the uniform.
fn scratches(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return scratches_eval_cos(scratches_uniform, point, wo, wi);
}
