// A bump-mapped surface under one lamp and a sky. Everything is relative to the focus, for ten
// thousandfold zoom.

struct BumpsView {
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
    // Maximum resolved fraction: what the lamp's disc covers is not resolved.
    share: f32,
    alpha: vec2<f32>,
    exposure: f32,
    // Side of the image in pixels.
    size: f32,
    // Rules to the left and to the right of `divide`: 0 is exact, 1 fractal.
    rule: vec2<f32>,
    divide: f32,
    // Shape parameter of Student's t.
    gamma: f32,
    // Clip depth with near plane `depth.x`: depth.x + depth.y w.
    depth: vec2<f32>,
    // 1 if pixel rows count from the bottom, -1 from the top.
    rows: f32,
    padding: f32,
}

struct BumpsCorner {
    @builtin(position) position: vec4<f32>,
    @location(0) normal: vec3<f32>,
    @location(1) tangent: vec3<f32>,
    @location(2) @interpolate(flat, either) plane: vec4<f32>,
}

@vertex
fn bumps_corner(
    @location(0) p: vec3<f32>,
    @location(1) plane: vec4<f32>,
    @location(2) normal: vec3<f32>,
    @location(3) tangent: vec3<f32>,
) -> BumpsCorner {
    let v = p - bumps_view.eye;
    let x = dot(v, bumps_view.right) / dot(bumps_view.right, bumps_view.right);
    let y = dot(v, bumps_view.up) / dot(bumps_view.up, bumps_view.up);
    let w = dot(v, bumps_view.forward);
    return BumpsCorner(vec4<f32>(x, y, bumps_view.depth.x + bumps_view.depth.y * w, w), normal, tangent, plane);
}

// A sky by the elevation of a direction, with a broad glow about the lamp.
fn bumps_sky(direction: vec3<f32>) -> f32 {
    let glow = max(frame_product(direction, bumps_view.light), 0.0);
    let square = glow * glow;
    return 0.05 + 0.1 * max(direction.z, 0.0) + 0.5 * square * square * square;
}

// The bumps at a point in cells, which lean downhill, as resolved by a footprint.
fn bumps_seen(p: vec3<f32>, frame: Frame, footprint: f32, anchor: u32) -> GaussianSlopes {
    let limits = FrequencyClamp(bumps_view.frequency, bumps_view.log_lacunarity, bumps_view.max_octaves);
    let octaves = frequency_clamp_octaves(footprint, limits);
    var seen = gaussian_slopes_3d(p, frame.tangent, frame.bitangent, octaves, anchor);
    seen.z = -seen.z;
    return seen;
}

// Radiance with the exact rule: of the lamp, and of the sky reflected by the mean facet of the
// unresolved part.
fn bumps_exact(seen: GaussianSlopes, frame: Frame, wo: vec3<f32>, h: vec3<f32>, cos_light: f32) -> f32 {
    let resolved = min(seen.resolved_variance, bumps_view.share);
    let z = seen.z;
    let lamp = bumps_residual_ndf(h, gaussian_split(z, resolved)) * cos_light;
    let m = frame_to_world(frame, bumps_warp_gaussian(level_of_detail_exact_coordinates(z, resolved)));
    return lamp + bumps_sky(m * (2.0 * frame_product(m, wo)) - wo);
}

// Radiance with the fractal rule of 2001: the whole density about every facet.
fn bumps_fractal(seen: GaussianSlopes, frame: Frame, wo: vec3<f32>, h: vec3<f32>, cos_light: f32) -> f32 {
    var facet = vec3<f32>(0.0, 0.0, 1.0);
    if seen.fade > 0.0 {
        facet = bumps_warp_gaussian(level_of_detail_fractal_coordinates(seen.z, seen.fade, bumps_flat()));
    }
    let lamp = bumps_d(level_of_detail_fractal_half_vector(facet, h)) * cos_light;
    let m = frame_to_world(frame, facet);
    return lamp + bumps_sky(m * (2.0 * frame_product(m, wo)) - wo);
}

// Radiance of a point for a footprint, in units.
fn bumps_light(p: vec3<f32>, frame: Frame, wo: vec3<f32>, footprint: f32, rule: f32) -> f32 {
    let seen = bumps_seen(p * bumps_view.frequency, frame, footprint, 0u);
    let h = frame_to_local(frame, frame_direction(bumps_view.light + wo));
    let cos_light = max(frame_product(bumps_view.light, frame.normal), 0.0);
    if rule < 0.5 {
        return bumps_exact(seen, frame, wo, h, cos_light);
    }
    return bumps_fractal(seen, frame, wo, h, cos_light);
}

@fragment
fn bumps_pixel(corner: BumpsCorner) -> @location(0) vec4<f32> {
    let x = corner.position.x / bumps_view.size * 2.0 - 1.0;
    let y = (corner.position.y / bumps_view.size * 2.0 - 1.0) * bumps_view.rows;
    let direction = bumps_view.forward + x * bumps_view.right + y * bumps_view.up;
    let plane = corner.plane;
    let t = (plane.w - dot(plane.xyz, bumps_view.eye)) / dot(plane.xyz, direction);
    let p = bumps_view.eye + t * direction;
    let frame = frame_from_normal_tangent(corner.normal, corner.tangent);
    let wo = frame_direction(-direction);
    let cos_eye = frame_product(wo, frame.normal);
    var light = 0.0;
    if cos_eye > 0.0 {
        let footprint = t * sqrt(dot(direction, direction)) * bumps_view.pixel_angle / cos_eye;
        light = bumps_light(p, frame, wo, footprint, select(bumps_view.rule.x, bumps_view.rule.y, x > bumps_view.divide));
    }
    return display_color(light * bumps_view.exposure * vec3<f32>(1.0, 0.62, 0.36) + vec3<f32>(0.012, 0.009, 0.008));
}

fn bumps_flat_frame() -> Frame {
    return Frame(vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 1.0, 0.0), vec3<f32>(0.0, 0.0, 1.0));
}

// A flat patch of the surface, with constant view and light directions, and the left rule.
@fragment
fn bumps_patch(screen: Screen) -> @location(0) vec4<f32> {
    let p = bumps_view.eye + screen.at.x * bumps_view.right + screen.at.y * bumps_view.up;
    let frame = bumps_flat_frame();
    let light = bumps_light(p, frame, bumps_view.forward, bumps_view.pixel_angle, bumps_view.rule.x);
    return display_color(light * bumps_view.exposure * vec3<f32>(1.0, 0.62, 0.36) + vec3<f32>(0.012, 0.009, 0.008));
}

// The lamp's radiance alone at a different position per pixel, within some cells of eight anchors
// all over the surface. Its mean is the mean brightness.
@fragment
fn bumps_scattered(screen: Screen) -> @location(0) vec4<f32> {
    let pixel = vec2<u32>((screen.at * 0.5 + 0.5) * bumps_view.size);
    let word = integer_hash_word(integer_hash_term(0u, i32(pixel.y * 4096u + pixel.x)), 1u);
    let further = integer_hash_further(word, 1u);
    let place = vec2<f32>(f32(word >> 8u), f32(further >> 8u)) / 16777216.0;
    let p = vec3<f32>((place - 0.5) * 6.0, 0.0);
    let anchor = min(pixel.x * 8u / u32(bumps_view.size), 7u);
    let seen = bumps_seen(p, bumps_flat_frame(), bumps_view.pixel_angle, anchor);
    let h = frame_direction(bumps_view.light + bumps_view.forward);
    if bumps_view.rule.x < 0.5 {
        let resolved = min(seen.resolved_variance, bumps_view.share);
        return display_encoded(bumps_residual_ndf(h, gaussian_split(seen.z, resolved)));
    }
    var facet = vec3<f32>(0.0, 0.0, 1.0);
    if seen.fade > 0.0 {
        facet = bumps_warp_gaussian(level_of_detail_fractal_coordinates(seen.z, seen.fade, bumps_flat()));
    }
    return display_encoded(bumps_d(level_of_detail_fractal_half_vector(facet, h)));
}
