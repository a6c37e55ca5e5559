// Elliptical pixel footprints: `asperity_shading::PixelEllipse`. Without axes it is round, for any
// direction.

struct PixelEllipse {
    // The axes, along the length and the width of the pixel; zero for a round pixel.
    major: vec3<f32>,
    minor: vec3<f32>,
    // Widths along them, footprints.
    widths: vec2<f32>,
}

// A round pixel.
fn pixel_ellipse_round(width: f32) -> PixelEllipse {
    let footprint = footprint_from_width(width);
    return PixelEllipse(vec3<f32>(0.0), vec3<f32>(0.0), vec2<f32>(footprint, footprint));
}

// The ellipse spanned by the derivatives of the position to the next pixel on the right and below,
// `dpdx(position)` and `dpdy(position)` in a fragment shader.
fn pixel_ellipse_from_derivatives(dx: vec3<f32>, dy: vec3<f32>) -> PixelEllipse {
    let a = max(abs(dx), abs(dy));
    let scale = max(max(a.x, a.y), a.z);
    if !(direction_is_finite(dx) && direction_is_finite(dy) && scale > 0.0) {
        return pixel_ellipse_round(footprint_from_derivatives(dx, dy));
    }
    let right = dx / scale;
    let down = dy / scale;
    let e = dot(right, right);
    let f = dot(right, down);
    let g = dot(down, down);
    let root = sqrt((e - g) * (e - g) + 4.0 * f * f);
    let long = 0.5 * (e + g + root);
    // The eigenvector by its larger component, and the smaller eigenvalue by the determinant, which
    // preserves its digits.
    var at = vec2<f32>(f, 0.5 * (g - e + root));
    if e > g {
        at = vec2<f32>(0.5 * (e - g + root), f);
    }
    // All axes of a circle are equivalent.
    if at.x == 0.0 && at.y == 0.0 {
        at = vec2<f32>(1.0, 0.0);
    }
    let major = direction_unit_or_zero(at.x * right + at.y * down) * sqrt(long);
    let normal = cross(right, down);
    let short = sqrt(dot(normal, normal)) / sqrt(long);
    let minor = direction_unit_or_zero(cross(normal, major)) * short;
    return PixelEllipse(
        scale * major,
        scale * minor,
        vec2<f32>(footprint_from_width(scale * sqrt(long)), footprint_from_width(scale * short)),
    );
}

// A box along the first two axes: a pixel in texture coordinates.
fn pixel_ellipse_aligned(widths: vec2<f32>) -> PixelEllipse {
    let u = footprint_from_width(widths.x);
    let v = footprint_from_width(widths.y);
    let along_u = vec3<f32>(u, 0.0, 0.0);
    let along_v = vec3<f32>(0.0, v, 0.0);
    if u >= v {
        return PixelEllipse(along_u, along_v, vec2<f32>(u, v));
    }
    return PixelEllipse(along_v, along_u, vec2<f32>(v, u));
}

// The change of a function with this gradient across the pixel; the largest float if there is no
// gradient.
fn pixel_ellipse_change(pixel: PixelEllipse, gradient: vec3<f32>) -> f32 {
    if !direction_is_finite(gradient) || (gradient.x == 0.0 && gradient.y == 0.0 && gradient.z == 0.0) {
        return MATH_LARGEST;
    }
    let round = pixel.major.x == 0.0 && pixel.major.y == 0.0 && pixel.major.z == 0.0;
    let along_axes = abs(dot(gradient, pixel.major)) + abs(dot(gradient, pixel.minor));
    return footprint_from_width(select(along_axes, sqrt(dot(gradient, gradient)) * pixel.widths.x, round));
}

// Sides of the bounding box of the pixel along the first two axes.
fn pixel_ellipse_sides(pixel: PixelEllipse) -> vec2<f32> {
    if pixel.major.x == 0.0 && pixel.major.y == 0.0 && pixel.major.z == 0.0 {
        return vec2<f32>(pixel.widths.x);
    }
    return abs(pixel.major.xy) + abs(pixel.minor.xy);
}

// The number of round footprints along the long axis that cover the pixel, at most `most`, which is
// from 1 to 64.
fn pixel_ellipse_tap_count(pixel: PixelEllipse, most: u32) -> u32 {
    let bound = clamp(most, 1u, 64u);
    if pixel.major.x == 0.0 && pixel.major.y == 0.0 && pixel.major.z == 0.0 {
        return 1u;
    }
    var ratio = MATH_LARGEST;
    if pixel.widths.y > 0.0 {
        ratio = pixel.widths.x / pixel.widths.y;
    }
    if !(ratio < f32(bound)) {
        return bound;
    }
    return max(u32(ratio + 0.999), 1u);
}

// Footprint k of `count` that cover the pixel: its offset from the middle of the pixel, and its
// width.
fn pixel_ellipse_tap(pixel: PixelEllipse, count: u32, k: u32) -> vec4<f32> {
    let width = select(max(pixel.widths.y, pixel.widths.x / f32(count)), pixel.widths.x, count == 1u);
    return vec4<f32>(pixel.major * ((f32(k) + 0.5) / f32(count) - 0.5), footprint_from_width(width));
}
