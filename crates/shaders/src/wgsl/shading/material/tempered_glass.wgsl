// Tempered glass with the waves that rollers leave: `asperity_shading::TemperedGlass`.

struct TemperedGlass {
    noise: Fbm,
    // The unit direction in which waves travel; their frequency in rad per unit of length.
    direction: vec3<f32>,
    frequency: f32,
    // The share that a pane lets through straight; the waves' amplitude.
    tint: vec3<f32>,
    amplitude: f32,
    // The relative index, and Beckmann's alpha of the surfaces, 0 for smooth ones.
    index: f32,
    roughness: f32,
    // 1 for waves of noise, 0 for a sine; 1 for the surface of a body, 0 for a pane.
    is_noisy: u32,
    is_solid: u32,
}

// The surface that a pixel sees, in its frame.
struct TemperedGlassSurface {
    normal: vec3<f32>,
    // The steepest slope of the part of a sine that is not resolved; zero for noise.
    swing: vec3<f32>,
    // The variance of the slopes of noise that are not resolved.
    slope_variance: f32,
}

// Normal and lost slopes of a pixel. A sine of more than 2^21 periods from the origin is level.
fn tempered_glass_surface(glass: TemperedGlass, point: SurfacePoint, frame: Frame) -> TemperedGlassSurface {
    let n = point.normal;
    let steepest = glass.frequency * glass.amplitude;
    if glass.is_noisy != 0u {
        let footprint = point.pixel.widths.x;
        let slope = fbm_sample(glass.noise, point.position, footprint).gradient;
        let removed = fbm_removed_slope(glass.noise, footprint, FBM_SLOPE_VARIANCE);
        let normal = surface_gradient_normal(n, surface_gradient_tangential(n, slope) * steepest);
        return TemperedGlassSurface(frame_to_local(frame, normal), vec3<f32>(0.0), steepest * steepest * removed);
    }
    let across = surface_gradient_tangential(n, glass.direction);
    let level = across.x == 0.0 && across.y == 0.0 && across.z == 0.0;
    let cycles = pixel_ellipse_change(point.pixel, across) * glass.frequency / 6.2831855;
    let kept = select(1.0 - frequency_clamp_removed_share(cycles, 1.0), 1.0, level);
    let turns = dot(point.position, glass.direction) * glass.frequency * 0.15915494;
    var slope = 0.0;
    if abs(turns) < 2097152.0 {
        slope = steepest * elementary_cos_sin_turns(turns).x;
    }
    let swing = across * (steepest * sqrt(max(1.0 - kept * kept, 0.0)));
    let normal = surface_gradient_normal(n, across * slope * kept);
    return TemperedGlassSurface(frame_to_local(frame, normal), frame_to_local(frame, swing), 0.0);
}

// Reflectance times cosine, `Bsdf::scattered` of a point; 0 for smooth glass, of which `tempered_glass_deltas` has all. wo and wi are
// in its frame, `surface_point_frame`, either below the surface too.
fn tempered_glass_scattered(glass: TemperedGlass, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !(glass.roughness > 0.0 && direction_have_sides(wi, wo)) {
        return vec3<f32>(0.0);
    }
    let surface = tempered_glass_surface(glass, point, surface_point_frame(point));
    var widened = vec2<f32>(glass.roughness, surface.slope_variance);
    if glass.is_solid != 0u {
        widened = coat_widened(glass.roughness, surface.slope_variance);
    }
    let alpha = clamp(widened.x, 0.000001, 1000000.0);
    let rough = RoughDielectric(alpha, rough_dielectric_index(glass.index), glass.is_solid == 0u, glass.tint);
    let n = vec3<f32>(0.0, 0.0, 1.0);
    let facets = coat_facets(surface.normal, widened.y);
    let swing = 0.8660254 * surface.swing;
    let swings = (swing.x != 0.0 || swing.y != 0.0 || swing.z != 0.0) && surface.normal.z > 0.0;
    let share = select(1.0, 0.33333334, swings);
    var sum = vec3<f32>(0.0);
    for (var k = 0u; k < 15u; k++) {
        var facet = SlopeFacet(0.0, surface.normal);
        if k < 13u {
            facet = slope_facets_gaussian(facets, k);
            facet.share *= share;
        } else if swings {
            let side = select(swing, -swing, k == 13u);
            facet = SlopeFacet(share, surface_gradient_normal(n, n - surface.normal / surface.normal.z + side));
        }
        let light = facet_light(facet.share, facet.normal, wi, wo);
        if light.factor > 0.0 {
            sum += rough_dielectric_value(rough, light.wi, light.wo) * light.factor;
        }
    }
    return brdf_finite_channels(sum);
}

// Both directions of `Bsdf::deltas` of smooth glass.
struct TemperedGlassDeltas {
    mirrored: CoatDelta,
    transmitted: CoatDelta,
}

// What smooth glass mirrors and transmits, by a facet that uniform numbers choose; dark for rough glass.
fn tempered_glass_deltas(glass: TemperedGlass, point: SurfacePoint, wo: vec3<f32>, u: vec2<f32>) -> TemperedGlassDeltas {
    let dark = CoatDelta(vec3<f32>(0.0), vec3<f32>(0.0));
    if glass.roughness > 0.0 || wo.z == 0.0 || !direction_is_finite(wo) {
        return TemperedGlassDeltas(dark, dark);
    }
    let surface = tempered_glass_surface(glass, point, surface_point_frame(point));
    // From below everything is the other way up.
    let inside = wo.z < 0.0;
    let side = vec3<f32>(1.0, 1.0, select(1.0, -1.0, inside));
    let up = wo * side;
    let normal = surface.normal * select(vec3<f32>(1.0), vec3<f32>(-1.0, -1.0, 1.0), inside);
    let n = vec3<f32>(0.0, 0.0, 1.0);
    var m = coat_facet(normal, surface.slope_variance, up, u);
    if (surface.swing.x != 0.0 || surface.swing.y != 0.0 || surface.swing.z != 0.0) && normal.z > 0.0 {
        let swing = surface.swing * elementary_cos_sin_turns(math_clamped(u.x, 1.0)).x;
        m = surface_gradient_facing(n, surface_gradient_normal(n, n - normal / normal.z + swing), up);
    }
    let cosine = dot(up, m);
    let mirrored = direction_reflect(up, m) * side;
    if glass.is_solid == 0u {
        let once = dielectric_reflectance(glass.index, cosine);
        let both = 2.0 * once / (1.0 + once);
        let through = rough_dielectric_through_wall(glass.tint, cosine, glass.index) * (1.0 - both);
        return TemperedGlassDeltas(CoatDelta(mirrored, vec3<f32>(both)), CoatDelta(-wo, math_shares(through)));
    }
    let index = select(glass.index, dielectric_reversed(glass.index), inside);
    let share = dielectric_reflectance(index, cosine);
    let eta = 1.0 / index;
    // Snell: sin of the refracted angle is that of the incident one over the index.
    let below = 1.0 - eta * eta * max(1.0 - cosine * cosine, 0.0);
    let refracted = (eta * cosine - sqrt(max(below, 0.0))) * m - eta * up;
    let kept = select(0.0, 1.0 - share, below > 0.0 && refracted.z < 0.0);
    return TemperedGlassDeltas(CoatDelta(mirrored, vec3<f32>(share)), CoatDelta(refracted * side, vec3<f32>(kept)));
}

// Of the material in the uniform.
fn tempered_glass(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return tempered_glass_scattered(tempered_glass_uniform, point, wo, wi);
}
