// Bump mapping by surface gradients: `bump::surface_gradient` of asperity-shading.

// Beyond this slope the rounding of the gradient's component along the normal would exceed the
// component.
const SURFACE_GRADIENT_STEEPEST: f32 = 10000.0;

fn surface_gradient_finite(gradient: vec3<f32>) -> vec3<f32> {
    return select(vec3<f32>(0.0), gradient, direction_is_finite(gradient));
}

// The surface gradient of a height with these derivatives in two parameters, where p_u and p_v are
// the derivatives of the position; zero if there is none.
fn surface_gradient(n: vec3<f32>, p_u: vec3<f32>, p_v: vec3<f32>, slope: vec2<f32>) -> vec3<f32> {
    let area = dot(n, cross(p_u, p_v));
    if !(abs(area) > 0.0) {
        return vec3<f32>(0.0);
    }
    return surface_gradient_finite((slope.x * cross(p_v, n) + slope.y * cross(n, p_u)) / area);
}

// The component of a 3-D gradient along a surface: `tangential`.
fn surface_gradient_tangential(n: vec3<f32>, g: vec3<f32>) -> vec3<f32> {
    return surface_gradient_finite(g - n * dot(n, g));
}

// The surface gradient that tilts the normal of a frame to the unit normal m of a normal map:
// `gradient_of_normal`.
fn surface_gradient_of_normal(tangent: vec3<f32>, bitangent: vec3<f32>, m: vec3<f32>) -> vec3<f32> {
    if (bitcast<u32>(m.z) & 0x7fffffffu) > 0x7f800000u {
        return vec3<f32>(0.0);
    }
    return surface_gradient_finite((m.x * tangent + m.y * bitangent) / -max(m.z, 0.0009765625));
}

// The unit normal of a surface with this surface gradient of its height; n if there is none:
// `bumped_normal`.
fn surface_gradient_normal(n: vec3<f32>, gradient: vec3<f32>) -> vec3<f32> {
    if !direction_is_finite(gradient) {
        return n;
    }
    let steepest = max(abs(gradient.x), max(abs(gradient.y), abs(gradient.z)));
    var g = gradient;
    if steepest > SURFACE_GRADIENT_STEEPEST {
        g = gradient * (SURFACE_GRADIENT_STEEPEST / steepest);
    }
    let bumped = direction_unit_or_zero(n - (g - n * dot(n, g)));
    return select(bumped, n, bumped.x == 0.0 && bumped.y == 0.0 && bumped.z == 0.0);
}

// The bumped normal, rotated minimally so that a mirror reflects the view `wo` above the horizon of
// n: `facing`.
fn surface_gradient_facing(n: vec3<f32>, bumped: vec3<f32>, wo: vec3<f32>) -> vec3<f32> {
    if !direction_is_finite(bumped) {
        return n;
    }
    let mirrored = direction_reflect(wo, bumped);
    // Compares bits, because either may be NaN: above 0, and below.
    let sides = vec2<u32>(bitcast<u32>(dot(wo, n)) - 1u, bitcast<u32>(dot(mirrored, n)) - 0x80000001u);
    if max(sides.x, sides.y) >= 0x7f800000u {
        return bumped;
    }
    // Squares of a view much shorter than 1 would leave the range.
    let level = direction_near_one(surface_gradient_tangential(n, mirrored));
    let square = dot(level, level);
    var along = vec3<f32>(0.0);
    if square > 0.0 {
        along = level / sqrt(square);
    }
    let turned = direction_unit_or_zero(wo + along);
    return select(turned, n, turned.x == 0.0 && turned.y == 0.0 && turned.z == 0.0);
}
