// Widths of pixels on a surface, in units of its positions: `asperity_shading::Footprint`. The
// largest float replaces infinity, for which nothing is resolved.

// A width by its magnitude; the largest float for NaN.
fn footprint_from_width(width: f32) -> f32 {
    let bits = bitcast<u32>(width) & 0x7fffffffu;
    return bitcast<f32>(min(bits, 0x7f7fffffu));
}

// The width of a pixel of `pixel_angle` rad at a distance, on a surface seen at `cos_theta`.
fn footprint_from_distance(distance: f32, pixel_angle: f32, cos_theta: f32) -> f32 {
    if !(abs(cos_theta) > 0.0) {
        return MATH_LARGEST;
    }
    return footprint_from_width(distance * pixel_angle / cos_theta);
}

// The longest axis of the ellipse spanned by the derivatives of the position to the next pixels.
fn footprint_from_derivatives(dx: vec3<f32>, dy: vec3<f32>) -> f32 {
    if !(direction_is_finite(dx) && direction_is_finite(dy)) {
        return MATH_LARGEST;
    }
    let a = max(abs(dx), abs(dy));
    let scale = max(max(a.x, a.y), a.z);
    if scale == 0.0 {
        return 0.0;
    }
    // Scaled, as the squares of small or large derivatives leave the range of floats.
    let x = dx / scale;
    let y = dy / scale;
    let e = dot(x, x);
    let f = dot(x, y);
    let g = dot(y, y);
    let root = sqrt((e - g) * (e - g) + 4.0 * f * f);
    return footprint_from_width(scale * sqrt(0.5 * (e + g + root)));
}

// The fraction of a frequency that is kept, in cycles per unit of length: 1 - smoothstep(0.2, 0.6,
// width * frequency).
fn footprint_kept(width: f32, frequency: f32) -> f32 {
    return 1.0 - frequency_clamp_filtered_fraction(width, frequency);
}
