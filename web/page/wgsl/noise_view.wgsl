// View parameters and colors of a slice of noise.

struct NoiseView {
    // The center of the image, and the vectors to its right and upper border, in cells.
    center: vec4<f32>,
    right: vec4<f32>,
    up: vec4<f32>,
    // The number of octaves, which may be fractional, and the footprint to which they are clamped;
    // 0 disables clamping.
    octaves: f32,
    footprint: f32,
    // Feedback of a ridged multifractal.
    feedback: f32,
    // Strength of the warp.
    strength: f32,
    // The value of black, and 1 over the range from black to white.
    black: f32,
    contrast: f32,
    // 1 over the velocity of full color; 0 displays values.
    flow: f32,
    // Parameters of cellular noise.
    jitter: f32,
    basis: u32,
    metric: u32,
    // 1 if the field is a ridged multifractal.
    ridged: u32,
    // Output of a pixel: 0 a color, 1 the value's bits, 2 and 3 bits of the slopes to the right and
    // up, or of the flow.
    told: u32,
}

// The point of a pixel.
fn noise_point(at: vec2<f32>) -> vec4<f32> {
    return noise_view.center + at.x * noise_view.right + at.y * noise_view.up;
}

// A number's bits in the four bytes of a pixel.
fn noise_bits(x: f32) -> vec4<f32> {
    let bits = bitcast<u32>(x);
    return vec4<f32>(vec4<u32>(bits & 255u, (bits >> 8u) & 255u, (bits >> 16u) & 255u, bits >> 24u)) / 255.0;
}

// Output at a point: a value as gray, or a velocity as a color: red right, green up, blue toward
// the viewer.
fn noise_shown(value: f32, way: vec2<f32>, velocity: vec3<f32>) -> vec4<f32> {
    if noise_view.told > 0u {
        return noise_bits(select(select(way.y, way.x, noise_view.told == 2u), value, noise_view.told == 1u));
    }
    let gray = vec3<f32>((value - noise_view.black) * noise_view.contrast);
    let color = select(gray, 0.5 + 0.5 * noise_view.flow * velocity, noise_view.flow > 0.0);
    return vec4<f32>(clamp(color, vec3<f32>(0.0), vec3<f32>(1.0)), 1.0);
}
