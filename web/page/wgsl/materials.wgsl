// A surface of a material under environment light, relative to its focus. A material defines its
// appearance for a pixel, `material_seen`, and its reflection of a lamp and of the rest of the
// light.

struct MaterialsView {
    eye: vec3<f32>,
    pixel_angle: f32,
    right: vec3<f32>,
    // Side of the image in pixels.
    size: f32,
    up: vec3<f32>,
    exposure: f32,
    forward: vec3<f32>,
    // Meters per unit of length.
    metres: f32,
    focus: vec3<f32>,
    lamps: f32,
    // Clip depth with near plane `depth.x`: depth.x + depth.y w.
    depth: vec2<f32>,
    // 1 if pixel rows count from the bottom, -1 from the top.
    rows: f32,
    // 1 for a car, which has windows; 2 for a room, whose walls are invisible from behind; 3 for
    // painted objects in a room.
    kind: f32,
    // Radius of the visible ground, half of the object's extent along and across; background: 0
    // bright paper, -1 dark, 1 the light.
    ground: vec4<f32>,
}

struct MaterialsCorner {
    @builtin(position) position: vec4<f32>,
    @location(0) normal: vec3<f32>,
    @location(1) tangent: vec3<f32>,
    @location(2) @interpolate(flat, either) plane: vec4<f32>,
    @location(3) uv: vec2<f32>,
}

@vertex
fn materials_corner(
    @location(0) p: vec3<f32>,
    @location(1) plane: vec4<f32>,
    @location(2) normal: vec3<f32>,
    @location(3) tangent: vec3<f32>,
    @location(4) uv: vec2<f32>,
) -> MaterialsCorner {
    let v = p - materials_view.eye;
    let x = dot(v, materials_view.right) / dot(materials_view.right, materials_view.right);
    let y = dot(v, materials_view.up) / dot(materials_view.up, materials_view.up);
    let w = dot(v, materials_view.forward);
    return MaterialsCorner(vec4<f32>(x, y, materials_view.depth.x + materials_view.depth.y * w, w), normal, tangent, plane, uv);
}

// The direction of a pixel from the camera, one unit along the axis.
fn materials_ray(position: vec4<f32>) -> vec3<f32> {
    let x = position.x / materials_view.size * 2.0 - 1.0;
    let y = (position.y / materials_view.size * 2.0 - 1.0) * materials_view.rows;
    return materials_view.forward + x * materials_view.right + y * materials_view.up;
}

// Display mapping of radiance: the Naka–Rushton response.
fn materials_color(radiance: vec3<f32>) -> vec4<f32> {
    return display_color(pow(max(radiance * materials_view.exposure, vec3<f32>(0.0)), vec3<f32>(1.3)));
}

// The background: the environment, or bright or dark paper.
fn materials_behind(direction: vec3<f32>) -> vec3<f32> {
    if materials_view.ground.w > 0.0 {
        return light_seen(direction);
    }
    let up = smoothstep(-0.3, 0.45, direction.z);
    let bright = mix(vec3<f32>(3.4, 3.3, 3.1), vec3<f32>(1.7, 1.75, 1.8), up);
    let dark = mix(vec3<f32>(0.13, 0.14, 0.16), vec3<f32>(0.02, 0.022, 0.028), up);
    return select(bright, dark, materials_view.ground.w < 0.0) / materials_view.exposure;
}

// A pixel's position on a surface.
struct MaterialsHit {
    point: SurfacePoint,
    // Relative to the focus, in units of the mesh.
    p: vec3<f32>,
    // Direction to the viewer in the local frame, never quite tangential.
    wo: vec3<f32>,
    frame: Frame,
    direction: vec3<f32>,
    is_back: bool,
}

fn materials_hit(corner: MaterialsCorner) -> MaterialsHit {
    let ray = materials_ray(corner.position);
    let plane = corner.plane;
    let t = (plane.w - dot(plane.xyz, materials_view.eye)) / dot(plane.xyz, ray);
    let p = materials_view.eye + t * ray;
    let long = sqrt(dot(ray, ray));
    let direction = ray / long;
    // For either orientation of a triangle's corners.
    let is_back = dot(plane.xyz, direction) * dot(plane.xyz, corner.normal) > 0.0;
    let normal = frame_direction(corner.normal) * select(1.0, -1.0, is_back);
    let frame = frame_from_normal_tangent(normal, corner.tangent);
    var wo = frame_to_local(frame, -direction);
    wo = frame_direction(vec3<f32>(wo.xy, max(wo.z, 0.03)));
    // The pixel's width, and its length on an inclined surface.
    let width = t * long * materials_view.pixel_angle * materials_view.metres;
    let along = frame_to_world(frame, vec3<f32>(direction_unit_or_2d(wo.xy, vec2<f32>(1.0, 0.0)), 0.0));
    let pixel = pixel_ellipse_from_derivatives(along * (width / wo.z), cross(normal, along) * width);
    let position = (p + materials_view.focus) * materials_view.metres;
    var uv = corner.uv;
    if materials_view.kind == 2.0 {
        // Coordinates of the focus, because interpolation over such large triangles is imprecise.
        uv += vec2<f32>(dot(p, corner.tangent), dot(p, cross(corner.normal, corner.tangent)));
    }
    let point = SurfacePoint(position, normal, uv * materials_view.metres, frame.tangent, frame.bitangent, pixel);
    return MaterialsHit(point, p, wo, frame, direction, is_back);
}

// The approximate fraction of light that passes through a glass coat and back.
fn materials_fresnel(cosine: f32) -> f32 {
    let left = 1.0 - clamp(cosine, 0.0, 1.0);
    let square = left * left;
    return 0.04 + 0.96 * square * square * left;
}

// Reflection of a diffuse and a glossy color, except of the lamps; the normal includes bumps, in
// the local frame.
fn materials_ambient(hit: MaterialsHit, normal: vec3<f32>, diffuse: vec3<f32>, specular: vec3<f32>, alpha: f32) -> vec3<f32> {
    let m = surface_gradient_facing(vec3<f32>(0.0, 0.0, 1.0), normal, hit.wo);
    let world = frame_to_world(hit.frame, m);
    let mirrored = frame_to_world(hit.frame, direction_reflect(hit.wo, m));
    return light_diffuse(world) * diffuse + light_glossy(mirrored, alpha) * specular;
}

// Dark glass of a car's windows, and the black wheel arches. The last number is whether there is
// either.
fn materials_of_car(hit: MaterialsHit) -> vec4<f32> {
    let at = hit.p + materials_view.focus;
    let n = hit.point.normal;
    let rear_wheel = vec2<f32>(at.x + 1.28, at.z - 0.325);
    let front_wheel = vec2<f32>(at.x - 1.32, at.z - 0.325);
    if min(dot(rear_wheel, rear_wheel), dot(front_wheel, front_wheel)) < 0.140625 && abs(at.y) > 0.4 {
        return vec4<f32>(light_diffuse(n) * 0.01, 1.0);
    }
    let rise = at.z - 0.86;
    var depth = min(rise - 0.02, 1.335 - at.z);
    if abs(n.y) > 0.55 {
        depth = min(min(depth, 0.62 - 0.95 * rise - at.x), min(at.x + 1.32 - 0.85 * rise, abs(at.x + 0.42) - 0.035));
    } else {
        depth = min(min(depth, max(at.x - 0.12, -1.02 - at.x)), 0.6 - abs(at.y));
    }
    if depth < 0.0 {
        return vec4<f32>(0.0);
    }
    // Panes have a black printed edge.
    let mirrored = direction_reflect(-hit.direction, n);
    let within = select(0.0, 0.03, depth > 0.025);
    return vec4<f32>(light_seen(mirrored) * materials_fresnel(hit.wo.z) + light_diffuse(n) * within, 1.0);
}

// Ambient visibility of a position in the room: lower in its edges and around the block.
fn materials_open(at: vec3<f32>, n: vec3<f32>) -> f32 {
    let walls = 2.0 - abs(at.xy) + 9.0 * abs(n.xy);
    let apart = max(abs(at - vec3<f32>(0.7, 0.9, 0.25)) - vec3<f32>(0.5, 0.5, 0.25), vec3<f32>(0.0));
    // Points on the block itself count as next to it.
    let block = sqrt(dot(apart, apart)) + select(0.0, 9.0, dot(apart, apart) < 1e-6);
    let near = exp(vec4<f32>(walls, at.z + 9.0 * abs(n.z), block) * -vec4<f32>(3.5, 3.5, 5.0, 5.0));
    return (1.0 - 0.35 * near.x) * (1.0 - 0.35 * near.y) * (1.0 - 0.35 * near.z) * (1.0 - 0.45 * near.w);
}

// Whether the block in the room shades a position from a direction.
fn materials_shaded(at: vec3<f32>, direction: vec3<f32>) -> bool {
    let safe = select(direction, vec3<f32>(1e-6), abs(direction) < vec3<f32>(1e-6));
    let low = (vec3<f32>(0.2, 0.4, -1.0) - at) / safe;
    let high = (vec3<f32>(1.2, 1.4, 0.5) - at) / safe;
    let first = min(low, high);
    let last = max(low, high);
    return max(max(first.x, first.y), max(first.z, 1e-3)) < min(last.x, min(last.y, last.z)) - 1e-3;
}

@fragment
fn materials_pixel(corner: MaterialsCorner) -> @location(0) vec4<f32> {
    let hit = materials_hit(corner);
    let in_room = materials_view.kind >= 2.0;
    if hit.is_back && in_room {
        discard;
    }
    if materials_view.kind == 1.0 {
        let other = materials_of_car(hit);
        if other.w > 0.0 {
            return materials_color(other.xyz);
        }
    }
    let seen = material_seen(hit.point, hit.frame, hit.wo);
    let at = hit.p + materials_view.focus;
    var sum = material_ambience(seen, hit);
    if in_room {
        sum *= materials_open(at, hit.point.normal);
    }
    for (var k = 0u; k < u32(materials_view.lamps); k++) {
        if in_room && materials_shaded(at, light.lamps[k].direction) {
            continue;
        }
        let wi = frame_to_local(hit.frame, light.lamps[k].direction);
        sum += material_lamp(seen, hit.wo, wi) * light.lamps[k].irradiance;
    }
    return materials_color(sum);
}
