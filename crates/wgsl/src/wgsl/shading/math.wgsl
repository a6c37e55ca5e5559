// Floats clamped to their ranges, and the angle of a vector: `math.rs` of asperity-shading.

const MATH_LARGEST: f32 = 3.4028234663852886e38;

// x clamped to [0, most]; 0 for NaN.
fn math_clamped(x: f32, most: f32) -> f32 {
    return select(0.0, min(x, most), x > 0.0);
}

// x clamped to [0, 1] along each axis; 0 for NaN.
fn math_shares(x: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(math_clamped(x.x, 1.0), math_clamped(x.y, 1.0), math_clamped(x.z, 1.0));
}

// Whether x is finite. Compares bits, as compilers may assume that every float is finite.
fn math_is_finite(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7fffffffu) < 0x7f800000u;
}

// atan x for x in [0, 1]. 2e-7 relative.
fn math_arctangent(x: f32) -> f32 {
    // Beyond tan(pi/8), from the difference to pi/4.
    let far = x > 0.41421357;
    let t = select(x, (x - 1.0) / (x + 1.0), far);
    let square = t * t;
    let series = ((square * 0.080537446 - 0.13877685) * square + 0.19977711) * square - 0.3333295;
    return select(0.0, 0.7853982, far) + (series * square * t + t);
}

// The angle of (x, y) in [-pi, pi] from the x axis; 0 for (0, 0). 3e-7 absolute and, for x > 0,
// relative.
fn math_angle(y: f32, x: f32) -> f32 {
    let across = abs(y);
    let along = abs(x);
    let high = max(across, along);
    if !(high > 0.0) {
        return 0.0;
    }
    let acute = math_arctangent(min(across, along) / high);
    let steep = select(acute, 1.5707964 - acute, across > along);
    let angle = select(steep, 3.1415927 - steep, x < 0.0);
    return select(angle, -angle, y < 0.0);
}
