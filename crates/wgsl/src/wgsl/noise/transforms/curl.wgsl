// Divergence-free velocities, from the gradients of fields: asperity_noise::curl.

// The flow along the level lines of a stream function: Curl2.
fn curl_velocity_2d(gradient: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(gradient.y, -gradient.x);
}

// The flow along the intersections of the level surfaces of two fields, the cross product of their
// gradients: Curl3.
fn curl_velocity_3d(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// The curl of a vector potential, from the gradients of its three components: CurlPotential.
fn curl_potential_velocity(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(c.y - b.z, a.z - c.x, b.x - a.y);
}
