// Domain warping, a field evaluated at displaced points: asperity_noise::Warp. The shader samples
// the fields: first the displacing fields, then the warped field at `point`.

// The displaced point, and the gradients of its coordinates, the rows of the Jacobian.
struct WarpDisplacement3d {
    point: vec3<f32>,
    row_x: vec3<f32>,
    row_y: vec3<f32>,
    row_z: vec3<f32>,
}

struct WarpDisplacement2d {
    point: vec2<f32>,
    row_x: vec2<f32>,
    row_y: vec2<f32>,
}

// p + strength * w(p), with one field per axis: `Warp::displacement`.
fn warp_displacement_3d(p: vec3<f32>, strength: f32, x: Sample3d, y: Sample3d, z: Sample3d) -> WarpDisplacement3d {
    return WarpDisplacement3d(
        p + strength * vec3<f32>(x.value, y.value, z.value),
        vec3<f32>(1.0, 0.0, 0.0) + strength * x.gradient,
        vec3<f32>(0.0, 1.0, 0.0) + strength * y.gradient,
        vec3<f32>(0.0, 0.0, 1.0) + strength * z.gradient,
    );
}

// p + strength * w(p) in 2-D.
fn warp_displacement_2d(p: vec2<f32>, strength: f32, x: Sample2d, y: Sample2d) -> WarpDisplacement2d {
    return WarpDisplacement2d(
        p + strength * vec2<f32>(x.value, y.value),
        vec2<f32>(1.0, 0.0) + strength * x.gradient,
        vec2<f32>(0.0, 1.0) + strength * y.gradient,
    );
}

// The warped field, from the field's sample at the displaced point, with its gradient transformed
// by the Jacobian.
fn warp_sample_3d(displacement: WarpDisplacement3d, field: Sample3d) -> Sample3d {
    let g = field.gradient;
    return Sample3d(field.value, displacement.row_x * g.x + displacement.row_y * g.y + displacement.row_z * g.z);
}

// The warped field in 2-D.
fn warp_sample_2d(displacement: WarpDisplacement2d, field: Sample2d) -> Sample2d {
    let g = field.gradient;
    return Sample2d(field.value, displacement.row_x * g.x + displacement.row_y * g.y);
}
