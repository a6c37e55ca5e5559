// Corners of a cell in 3-D at one end of the third axis, and the blend of both ends.

struct Corners3d {
    value: vec4<f32>,
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
}

// The sum of value + gradient (p - c) over all corners c with weights w, and its gradient.
fn corners_blend_3d(low: Corners3d, high: Corners3d, t: vec3<f32>, w: vec3<f32>, slope: vec3<f32>) -> Sample3d {
    let start = low.value + low.z * t.z;
    let rise = (high.value + high.z * (t.z - 1.0)) - start;
    let bend_x = high.x - low.x;
    let bend_y = high.y - low.y;
    let columns = Columns(start + w.z * rise, low.x + w.z * bend_x, low.y + w.z * bend_y);
    let derivative = Columns(
        (low.z + w.z * (high.z - low.z)) + slope.z * rise,
        slope.z * bend_x,
        slope.z * bend_y,
    );
    let plane = columns_blend(columns, t.xy, w.xy, slope.xy);
    return Sample3d(plane.value, vec3<f32>(plane.gradient, columns_value(derivative, t.xy, w.xy)));
}
