// Directions of reflection: `direction.rs` of asperity-shading. Directions are unit vectors that
// point away from the surface.

// Whether all components are finite. Compares bits, as compilers may assume that every float is
// finite.
fn direction_is_finite(v: vec3<f32>) -> bool {
    let bits = bitcast<vec3<u32>>(v) & vec3<u32>(0x7fffffffu);
    return max(max(bits.x, bits.y), bits.z) < 0x7f800000u;
}

// Whether the square of a length is above 0 and finite, also by bits.
fn direction_is_length(square: f32) -> bool {
    return bitcast<u32>(square) - 1u < 0x7f7fffffu;
}

// v over its length; zero if v has no direction.
fn direction_unit_or_zero(v: vec3<f32>) -> vec3<f32> {
    let square = dot(v, v);
    if !direction_is_length(square) {
        return vec3<f32>(0.0);
    }
    return v * (1.0 / sqrt(square));
}

// v times the power of two that scales its longest component to about 1, so that products stay in
// range without rounding.
fn direction_near_one(v: vec3<f32>) -> vec3<f32> {
    let bits = bitcast<vec3<u32>>(v) & vec3<u32>(0x7f800000u);
    let longest = max(max(bits.x, bits.y), bits.z);
    // The exponents sum to the exponent of 1, except for the largest, whose counterpart is
    // subnormal.
    return v * bitcast<f32>(0x7f000000u - min(longest, 0x7e800000u));
}

// v over its length in the plane; `otherwise` if v has no direction.
fn direction_unit_or_2d(v: vec2<f32>, otherwise: vec2<f32>) -> vec2<f32> {
    let square = dot(v, v);
    if !direction_is_length(square) {
        return otherwise;
    }
    return v * (1.0 / sqrt(square));
}

// v rotated by a quarter turn to the left.
fn direction_left_2d(v: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(-v.y, v.x);
}

// The half vector of two directions; zero if they are opposite: `half_vector`.
fn direction_half(wi: vec3<f32>, wo: vec3<f32>) -> vec3<f32> {
    let sum = wi + wo;
    // Opposite directions leave only rounding errors without a meaningful direction.
    if !(dot(sum, sum) > 1e-12) {
        return vec3<f32>(0.0);
    }
    return direction_unit_or_zero(sum);
}

// The direction in which a mirror with the unit normal m reflects light from w: `reflect`.
fn direction_reflect(w: vec3<f32>, m: vec3<f32>) -> vec3<f32> {
    return 2.0 * dot(w, m) * m - w;
}

// Whether both directions are above the horizon, and finite.
fn direction_are_above(wi: vec3<f32>, wo: vec3<f32>) -> bool {
    return wi.z > 0.0 && wo.z > 0.0 && direction_is_finite(wi) && direction_is_finite(wo);
}

// Whether neither direction is on the horizon, and both are finite.
fn direction_have_sides(wi: vec3<f32>, wo: vec3<f32>) -> bool {
    return wi.z != 0.0 && wo.z != 0.0 && direction_is_finite(wi) && direction_is_finite(wo);
}
