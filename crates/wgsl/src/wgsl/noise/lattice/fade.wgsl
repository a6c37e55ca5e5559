// Weights by which noises blend the ends of a cell, and their derivatives, along each axis.

// 6 t^5 - 15 t^4 + 10 t^3, which is C2 across cells.
fn fade_quintic(t: vec4<f32>) -> vec4<f32> {
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

fn fade_quintic_slope(t: vec4<f32>) -> vec4<f32> {
    let rest = t - 1.0;
    return 30.0 * (t * t) * (rest * rest);
}

// 3 t^2 - 2 t^3, which is C1 across cells.
fn fade_cubic(t: vec4<f32>) -> vec4<f32> {
    return t * t * (3.0 - 2.0 * t);
}

fn fade_cubic_slope(t: vec4<f32>) -> vec4<f32> {
    return 6.0 * t * (1.0 - t);
}
