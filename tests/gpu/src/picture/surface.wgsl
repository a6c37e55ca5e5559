// A bump-mapped surface under one light, up to ten thousandfold zoom. Everything is relative to the
// focus.

struct SurfaceView {
    eye: vec3<f32>,
    pixel_angle: f32,
    right: vec3<f32>,
    // Cells of the first octave per unit.
    frequency: f32,
    up: vec3<f32>,
    // The binary logarithm of the lacunarity.
    log_lacunarity: f32,
    forward: vec3<f32>,
    max_octaves: f32,
    light: vec3<f32>,
    // Maximum resolved fraction: what the light's disc covers is not resolved.
    share: f32,
    alpha: vec2<f32>,
    exposure: f32,
    // Side of the image in pixels.
    size: f32,
}

struct SurfaceCorner {
    @builtin(position) position: vec4<f32>,
    @location(0) normal: vec3<f32>,
    @location(1) tangent: vec3<f32>,
    @location(2) @interpolate(flat) plane: vec4<f32>,
    @location(3) uv: vec2<f32>,
}

@vertex
fn surface_corner(
    @location(0) p: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec3<f32>,
    @location(3) plane: vec4<f32>,
    @location(4) uv: vec2<f32>,
) -> SurfaceCorner {
    let v = p - surface_view.eye;
    let x = dot(v, surface_view.right) / dot(surface_view.right, surface_view.right);
    let y = dot(v, surface_view.up) / dot(surface_view.up, surface_view.up);
    // Depth runs from 1 at the camera to 0 at infinity.
    return SurfaceCorner(vec4<f32>(x, y, 1e-9, dot(v, surface_view.forward)), normal, tangent, plane, uv);
}

// A sky by the elevation of a direction, with a broad glow about the light.
fn surface_sky(direction: vec3<f32>) -> f32 {
    let glow = max(frame_product(direction, surface_view.light), 0.0);
    let square = glow * glow;
    return 0.05 + 0.1 * max(direction.z, 0.0) + 0.5 * square * square * square;
}

// Radiance of a surface: the lamp with the exact rule, the sky reflected by the mean facet of the
// unresolved part.
fn surface_light(p: vec3<f32>, uv: vec2<f32>, frame: Frame, wo: vec3<f32>, distance: f32) -> f32 {
    let cos_eye = frame_product(wo, frame.normal);
    let cos_light = frame_product(surface_view.light, frame.normal);
    if !(cos_eye > 0.0) {
        return 0.0;
    }
    let footprint = distance * surface_view.pixel_angle / cos_eye;
    let limits = FrequencyClamp(surface_view.frequency, surface_view.log_lacunarity, surface_view.max_octaves);
    let seen = surface_bumps(p * surface_view.frequency, uv, frame, frequency_clamp_octaves(footprint, limits));
    let h = frame_to_local(frame, frame_direction(surface_view.light + wo));
    let z = seen.xy;
    let resolved = min(seen.z, surface_view.share);
    let lamp = level_of_detail_exact_ggx(surface_view.alpha, h, z, resolved) * max(cos_light, 0.0);
    let facet = surface_facet(level_of_detail_exact_coordinates(z, resolved));
    let m = frame_to_world(frame, facet);
    return lamp + surface_sky(m * (2.0 * frame_product(m, wo)) - wo);
}

// sRGB of radiance compressed into [0, 1).
fn surface_tone(light: f32) -> vec3<f32> {
    let linear = light * vec3<f32>(1.0, 0.62, 0.36) + vec3<f32>(0.012, 0.009, 0.008);
    let bounded = linear / (1.0 + linear);
    let low = bounded * 12.92;
    let high = 1.055 * pow(bounded, vec3<f32>(1.0 / 2.4)) - 0.055;
    return select(high, low, bounded <= vec3<f32>(0.0031308));
}

@fragment
fn surface_pixel(corner: SurfaceCorner) -> @location(0) vec4<f32> {
    let x = corner.position.x / surface_view.size * 2.0 - 1.0;
    let y = 1.0 - corner.position.y / surface_view.size * 2.0;
    let direction = surface_view.forward + x * surface_view.right + y * surface_view.up;
    let plane = corner.plane;
    let t = (plane.w - dot(plane.xyz, surface_view.eye)) / dot(plane.xyz, direction);
    let p = surface_view.eye + t * direction;
    let toward = -direction;
    let distance = t * sqrt(dot(direction, direction));
    let frame = frame_from_normal_tangent(corner.normal, corner.tangent);
    let light = surface_light(p, corner.uv, frame, frame_direction(toward), distance);
    return vec4<f32>(surface_tone(light * surface_view.exposure), 1.0);
}
