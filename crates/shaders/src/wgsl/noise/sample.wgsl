// Value and gradient of a noise.

struct Sample2d {
    value: f32,
    gradient: vec2<f32>,
}

struct Sample3d {
    value: f32,
    gradient: vec3<f32>,
}

struct Sample4d {
    value: f32,
    gradient: vec4<f32>,
}
