// Tempered glass with roller waves: `asperity_shading::TemperedGlass`.

// The surface filtered over a pixel, in its frame.
struct TemperedGlassSurface {
    normal: vec3<f32>,
    // The steepest slope of the unresolved part of a sine; zero for noise.
    swing: vec3<f32>,
    // The variance of the unresolved slopes of noise.
    slope_variance: f32,
}

// Normal and unresolved slopes of a pixel. A sine is flat beyond 2^21 periods from the origin.
fn tempered_glass_surface(glass: TemperedGlass, point: SurfacePoint, frame: Frame) -> TemperedGlassSurface {
    let n = point.normal;
    let steepest = glass.frequency * glass.amplitude;
    if glass.is_noisy != 0u {
        let footprint = point.pixel.widths.x;
        let slope = sized_fbm_sample(glass.noise, point.position, footprint).gradient;
        let removed = sized_fbm_removed_slope(glass.noise, footprint, SIZED_FBM_SLOPE_VARIANCE);
        let normal = surface_gradient_normal(n, surface_gradient_tangential(n, slope) * steepest);
        return TemperedGlassSurface(frame_to_local(frame, normal), vec3<f32>(0.0), steepest * steepest * removed);
    }
    let across = surface_gradient_tangential(n, glass.direction);
    let level = across.x == 0.0 && across.y == 0.0 && across.z == 0.0;
    let cycles = pixel_ellipse_change(point.pixel, across) * glass.frequency / 6.2831855;
    let kept = select(1.0 - frequency_clamp_filtered_fraction(cycles, 1.0), 1.0, level);
    let turns = dot(point.position, glass.direction) * glass.frequency * 0.15915494;
    var slope = 0.0;
    if abs(turns) < 2097152.0 {
        slope = steepest * elementary_cos_sin_turns(turns).x;
    }
    let swing = across * (steepest * sqrt(max(1.0 - kept * kept, 0.0)));
    let normal = surface_gradient_normal(n, across * slope * kept);
    return TemperedGlassSurface(frame_to_local(frame, normal), frame_to_local(frame, swing), 0.0);
}

// The coat filtered over a pixel.
fn tempered_glass_coat(glass: TemperedGlass, point: SurfacePoint) -> Coat {
    let surface = tempered_glass_surface(glass, point, surface_point_frame(point));
    let kind = select(COAT_THIN_DIELECTRIC, COAT_DIELECTRIC, glass.is_solid != 0u);
    return Coat(
        surface.normal,
        surface.slope_variance,
        surface.swing,
        glass.roughness,
        glass.tint,
        glass.index,
        kind,
    );
}

// Reflectance times cosine, `Bsdf::eval_cos` of a point; 0 for smooth glass, whose light is all in
// `tempered_glass_specular_samples`. wo and wi are in its frame, `surface_point_frame`, and may be below the
// surface.
fn tempered_glass_eval_cos(glass: TemperedGlass, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return brdf_finite_channels(coat_eval_cos(tempered_glass_coat(glass, point), wo, wi));
}

// Reflection and transmission of smooth glass at a facet chosen by uniform numbers; 0 for rough
// glass.
fn tempered_glass_specular_samples(glass: TemperedGlass, point: SurfacePoint, wo: vec3<f32>, u: vec2<f32>) -> CoatSpecularSamples {
    return coat_specular_samples(tempered_glass_coat(glass, point), wo, u);
}

// The material in the uniform.
fn tempered_glass(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return tempered_glass_eval_cos(tempered_glass_uniform, point, wo, wi);
}
