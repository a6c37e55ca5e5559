// A rough surface under one lamp. All positions are relative to the focus, a surface point that
// anchors the octaves.

struct View {
    eye: vec3<f32>,
    // Angle of a pixel in radians.
    pixel_angle: f32,
    right: vec3<f32>,
    // Cells of the first octave per unit of length.
    frequency: f32,
    up: vec3<f32>,
    // Side of the image in pixels.
    size: f32,
    forward: vec3<f32>,
    log_lacunarity: f32,
    light: vec3<f32>,
    max_octaves: f32,
}

struct Corner {
    @builtin(position) position: vec4<f32>,
    @location(0) normal: vec3<f32>,
    @location(1) tangent: vec3<f32>,
    @location(2) @interpolate(flat) plane: vec4<f32>,
}

@vertex
fn corner(
    @location(0) p: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec3<f32>,
    @location(3) plane: vec4<f32>,
) -> Corner {
    let v = p - view.eye;
    let across = vec2<f32>(dot(v, view.right) / dot(view.right, view.right), dot(v, view.up) / dot(view.up, view.up));
    // Depth is 1 at the camera and 0 at infinity.
    return Corner(vec4<f32>(across, 1e-9, dot(v, view.forward)), normal, tangent, plane);
}

@fragment
fn pixel(at: Corner) -> @location(0) vec4<f32> {
    // A triangle's corners may be ten thousand image widths away, so intersect the ray with its
    // plane.
    let x = at.position.x / view.size * 2.0 - 1.0;
    let y = 1.0 - at.position.y / view.size * 2.0;
    let direction = view.forward + x * view.right + y * view.up;
    let t = (at.plane.w - dot(at.plane.xyz, view.eye)) / dot(at.plane.xyz, direction);
    let p = view.eye + t * direction;
    let frame = frame_from_normal_tangent(at.normal, at.tangent);
    let wo = normalize(-direction);
    let cos_eye = dot(wo, frame.normal);
    let cos_light = max(dot(view.light, frame.normal), 0.0);

    // Octaves that the pixel resolves become bumps. The rest stays in the density, so nothing
    // flickers or gets duller.
    let footprint = t * length(direction) * view.pixel_angle / max(cos_eye, 1e-3);
    let limits = FrequencyClamp(view.frequency, view.log_lacunarity, view.max_octaves);
    let octaves = frequency_clamp_octaves(footprint, limits);
    let seen = gaussian_slopes_3d(p * view.frequency, frame.tangent, frame.bitangent, octaves, 0u);
    let resolved = min(seen.resolved_variance, 0.97);
    let alpha = vec2<f32>(0.2, 0.4);
    // The normal leans downhill.
    let z = -seen.z;
    let h = frame_to_local(frame, normalize(view.light + wo));
    let lamp = level_of_detail_exact_ggx(alpha, h, z, resolved) * cos_light;

    // A sky with a glow about the lamp, reflected by the mean facet of the unresolved part.
    let m = frame_to_world(frame, ggx_warp_gaussian(alpha, level_of_detail_exact_coordinates(z, resolved)));
    let mirrored = m * (2.0 * dot(m, wo)) - wo;
    let glow = pow(max(dot(mirrored, view.light), 0.0), 6.0);
    let sky = 0.05 + 0.1 * max(mirrored.z, 0.0) + 0.5 * glow;

    let light = (lamp + sky) * 1.4 * vec3<f32>(1.0, 0.6, 0.34);
    return vec4<f32>(pow(light / (1.0 + light), vec3<f32>(1.0 / 2.2)), 1.0);
}
