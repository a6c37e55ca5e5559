// Normals of surfaces over a plane.

// The upward unit normal for a gradient; steep slopes do not overflow.
fn upward_normal(gradient: vec2<f32>) -> vec3<f32> {
    let largest = max(max(abs(gradient.x), abs(gradient.y)), 1.0);
    let n = vec3<f32>(-gradient.x / largest, -gradient.y / largest, 1.0 / largest);
    return n / sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
}
