// The carpet of a car, with threads, fibers, seams and dark areas: `asperity_shading::Carpet`.

// A polynomial of degree seven, coefficients of the highest power first.
fn carpet_polynomial(high: vec4<f32>, low: vec4<f32>, c: f32) -> f32 {
    let cubic = ((high.x * c + high.y) * c + high.z) * c + high.w;
    return (((cubic * c + low.x) * c + low.y) * c + low.z) * c + low.w;
}

// The mean of shining threads given the known octaves.
fn carpet_expected_shine(carpet: Carpet, known: u32, p: vec3<f32>) -> f32 {
    let count = f32(known);
    var veins = 0.0;
    if known > 0u {
        veins = simplex_fbm_3d(p, count, 0.0, carpet.shine.sum).value;
    }
    let c = 1.0 - veins * count / 3.0;
    if known == 0u {
        return carpet_polynomial(carpet.coefficients[0], carpet.coefficients[1], c);
    }
    if known == 1u {
        return carpet_polynomial(carpet.coefficients[2], carpet.coefficients[3], c);
    }
    if known == 2u {
        return carpet_polynomial(carpet.coefficients[4], carpet.coefficients[5], c);
    }
    return carpet_polynomial(carpet.coefficients[6], carpet.coefficients[7], c);
}

// The shine of threads filtered over a pixel.
fn carpet_shine(carpet: Carpet, position: vec3<f32>, footprint: f32) -> f32 {
    let p = position * carpet.shine.frequency;
    let width = footprint * carpet.shine.frequency;
    var value = 0.0;
    var before = 1.0;
    for (var j = 0u; j < 4u; j++) {
        var kept = 0.0;
        if j < 3u {
            kept = 1.0 - frequency_clamp_filtered_fraction(width, f32(1u << j));
        }
        // Only levels with a weight are evaluated.
        let weight = before - kept;
        if weight > 0.0 {
            value += weight * carpet_expected_shine(carpet, j, p);
        }
        before = kept;
    }
    return value;
}

// The factor of dark areas.
fn carpet_dark(carpet: Carpet, position: vec3<f32>, footprint: f32) -> f32 {
    let removed = frequency_clamp_filtered_fraction(footprint, carpet.dark.frequency);
    var near = 0.0;
    if removed < 1.0 {
        near = max(sized_fbm_value(carpet.dark, position), 0.0);
    }
    return 1.0 - carpet.dark_strength * (near + removed * (carpet.half_mean - near));
}

// A color with threads, in [0, 1].
fn carpet_lit(color: vec3<f32>, by: f32, factor: f32) -> vec3<f32> {
    let threads = clamp(color + vec3<f32>(by), vec3<f32>(0.0), vec3<f32>(1.0));
    return min(threads * factor, vec3<f32>(1.0));
}

// The carpet filtered over a pixel.
fn carpet_surface(carpet: Carpet, point: SurfacePoint) -> Glossy {
    let n = point.normal;
    let at = point.position;
    let footprint = point.pixel.widths.x;
    let threads = sized_fbm_sample(carpet.threads, at, footprint);
    let shine = carpet_shine(carpet, at, footprint);
    let crossing = sized_fbm_sample(carpet.crossover, at, footprint).value;
    let disturb = 0.5 * (crossing + 1.0) * carpet.crossover_strength;

    let along_gradient = surface_point_gradient(point, carpet.seams_direction * carpet.seams_frequency);
    let other_gradient = surface_point_gradient(point, direction_left_2d(carpet.seams_direction) * carpet.seams_frequency);
    let widths = min(
        vec2<f32>(pixel_ellipse_change(point.pixel, along_gradient), pixel_ellipse_change(point.pixel, other_gradient)),
        vec2<f32>(1e10),
    );
    let crease = seams_crease(carpet.seams_pattern, carpet.seams_direction, point.uv * carpet.seams_frequency, widths);
    let seam = 1.0 - carpet.seams_amplitude * (1.0 - crease.x);
    let amount = seam + (1.0 - seam) * disturb;

    let texture_width = surface_point_uv_pixel(point).widths.x;
    let fiber = fibers_sample(carpet.fibers, point.uv, texture_width);
    let fiber_kept = fibers_kept(carpet.fibers, texture_width);
    let fiber_slope = 0.5 * carpet.fiber_square_slope * (1.0 - fiber_kept * fiber_kept);
    let factor = amount * carpet_dark(carpet, at, footprint) * (1.0 + carpet.fiber_strength * (fiber.factor - 1.0));

    let along = direction_unit_or_zero(along_gradient);
    let other = direction_unit_or_zero(other_gradient);
    let seam_bump = (along * crease.y + other * crease.z) * (carpet.seams_bump * (1.0 - disturb));
    let thread_bump = surface_gradient_tangential(n, threads.gradient) * carpet.thread_bump;
    let fiber_bump = surface_point_slope(point, fiber.slope) * carpet.fiber_bump;
    let steep = carpet.seams_bump * (1.0 - disturb);
    let lost = seams_removed_slopes(carpet.seams_pattern, widths) * (steep * steep);
    let even = min(lost.x, lost.y);
    let ridges = select(other * sqrt(lost.y - even), along * sqrt(lost.x - even), lost.x > lost.y);
    let variance = carpet.thread_bump * carpet.thread_bump * sized_fbm_removed_slope(carpet.threads, footprint, SIZED_FBM_SLOPE_VARIANCE)
        + even
        + carpet.fiber_bump * carpet.fiber_bump * fiber_slope;
    return Glossy(
        carpet_lit(carpet.diffuse, carpet.thread_strength * threads.value, factor),
        carpet_lit(carpet.specular, carpet.shine_strength * shine, factor),
        surface_gradient_normal(n, thread_bump + seam_bump + fiber_bump),
        variance,
        ridges,
    );
}

// Reflectance times cosine, `Bsdf::eval_cos` of a point; wo and wi are in its frame,
// `surface_point_frame`.
fn carpet_eval_cos(carpet: Carpet, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    let surface = carpet_surface(carpet, point);
    return glossy_eval_cos(surface, surface_point_frame(point), carpet.roughness, carpet.specular_roughness, wo, wi);
}

// The rim light, which is independent of the light sources: `Bsdf::emitted`.
fn carpet_emitted(carpet: Carpet, point: SurfacePoint, wo: vec3<f32>) -> vec3<f32> {
    if !direction_is_finite(wo) {
        return vec3<f32>(0.0);
    }
    let view = frame_to_world(surface_point_frame(point), wo);
    let x = 1.0 - abs(dot(point.normal, view));
    let low = 1.0 - carpet.rim_width;
    var share = select(0.0, 1.0, x >= 1.0);
    if x > low && x < 1.0 {
        let t = (x - low) / (1.0 - low);
        share = t * t * (3.0 - 2.0 * t);
    }
    return brdf_finite_channels(share * carpet.rim);
}

// The material in the uniform.
fn carpet(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return carpet_eval_cos(carpet_uniform, point, wo, wi);
}
