// What a slice of noise is seen by, and its colours.

struct NoiseView {
    // The point in the middle of the picture, and the ways from it to the right border and to the upper one, in cells.
    centre: vec4<f32>,
    right: vec4<f32>,
    up: vec4<f32>,
    // The number of octaves, a real one, and the footprint that they are clamped to; 0 clamps nothing.
    octaves: f32,
    footprint: f32,
    // Of a ridged multifractal.
    feedback: f32,
    // Of the warp.
    strength: f32,
    // The value that is black, and 1 over that from there to white.
    black: f32,
    contrast: f32,
    // 1 over the velocity that is shown in full colour; 0 shows values.
    flow: f32,
    // Of cellular noise.
    jitter: f32,
    basis: u32,
    metric: u32,
    // 1 where the field is a ridged multifractal.
    ridged: u32,
    // What a pixel tells: 0 a colour, 1 the value's bits, 2 and 3 those of the slopes to the right and up, or of the flow.
    told: u32,
}

// The point of a pixel.
fn noise_point(at: vec2<f32>) -> vec4<f32> {
    return noise_view.centre + at.x * noise_view.right + at.y * noise_view.up;
}

// A number's bits in the four bytes of a pixel.
fn noise_bits(x: f32) -> vec4<f32> {
    let bits = bitcast<u32>(x);
    return vec4<f32>(vec4<u32>(bits & 255u, (bits >> 8u) & 255u, (bits >> 16u) & 255u, bits >> 24u)) / 255.0;
}

// What is asked of a point: a value as grey, or a velocity as a colour, red to the right, green up, blue towards the eye.
fn noise_shown(value: f32, way: vec2<f32>, velocity: vec3<f32>) -> vec4<f32> {
    if noise_view.told > 0u {
        return noise_bits(select(select(way.y, way.x, noise_view.told == 2u), value, noise_view.told == 1u));
    }
    let grey = vec3<f32>((value - noise_view.black) * noise_view.contrast);
    let colour = select(grey, 0.5 + 0.5 * noise_view.flow * velocity, noise_view.flow > 0.0);
    return vec4<f32>(clamp(colour, vec3<f32>(0.0), vec3<f32>(1.0)), 1.0);
}
