// A triangle that covers the image, and the position of a pixel: x right and y up, from -1 to 1.

struct Screen {
    @builtin(position) position: vec4<f32>,
    @location(0) at: vec2<f32>,
}

@vertex
fn screen_corner(@builtin(vertex_index) corner: u32) -> Screen {
    let at = vec2<f32>(f32((corner << 1u) & 2u), f32(corner & 2u)) * 2.0 - 1.0;
    return Screen(vec4<f32>(at, 0.0, 1.0), at);
}
