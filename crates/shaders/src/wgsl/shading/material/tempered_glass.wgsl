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

// The coat that a pixel sees.
fn tempered_glass_coat(glass: TemperedGlass, point: SurfacePoint) -> Coat {
    let surface = tempered_glass_surface(glass, point, surface_point_frame(point));
    let kind = select(COAT_PANE, COAT_BODY, glass.is_solid != 0u);
    return Coat(
        surface.normal,
        surface.slope_variance,
        surface.swing,
        glass.roughness,
        glass.tint,
        glass.index,
        kind,
        0u,
        vec2<u32>(0u),
    );
}

// Reflectance times cosine, `Bsdf::scattered` of a point; 0 for smooth glass, of which `tempered_glass_deltas` has all. wo and wi are
// in its frame, `surface_point_frame`, either below the surface too.
fn tempered_glass_scattered(glass: TemperedGlass, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return brdf_finite_channels(coat_scattered(tempered_glass_coat(glass, point), wo, wi));
}

// What smooth glass mirrors and transmits, by a facet that uniform numbers choose; dark for rough glass.
fn tempered_glass_deltas(glass: TemperedGlass, point: SurfacePoint, wo: vec3<f32>, u: vec2<f32>) -> CoatDeltas {
    return coat_deltas(tempered_glass_coat(glass, point), wo, u);
}

// Of the material in the uniform.
fn tempered_glass(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return tempered_glass_scattered(tempered_glass_uniform, point, wo, wi);
}
