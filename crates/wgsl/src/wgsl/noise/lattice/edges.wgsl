// Directions to the edges of a square, a cube and a hypercube, selected by the upper bits of words:
// `asperity_noise::Perlin::gradient`, four at once.

const EDGES_LONG: f32 = 1.306563;
const EDGES_SHORT: f32 = 0.5411961;
const EDGES_SECOND_THIRD: u32 = 1431655766u;
const EDGES_LAST_THIRD: u32 = 2863311531u;

struct EdgeDirections2d {
    x: vec4<f32>,
    y: vec4<f32>,
}

struct EdgeDirections3d {
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
}

struct EdgeDirections4d {
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
    w: vec4<f32>,
}

// 1 or -1 by the top bit.
fn edge_signs(words: vec4<u32>) -> vec4<f32> {
    return bitcast<vec4<f32>>((words & vec4<u32>(0x80000000u)) | vec4<u32>(0x3f800000u));
}

// The eight at odd multiples of 22.5 degrees, of `length` times the root of 2.
fn edge_directions_2d(words: vec4<u32>, length: f32) -> EdgeDirections2d {
    let steep = words > vec4<u32>(0x7fffffffu);
    let long = vec4<f32>(EDGES_LONG * length);
    let short = vec4<f32>(EDGES_SHORT * length);
    return EdgeDirections2d(
        edge_signs(words << vec4<u32>(1u)) * select(long, short, steep),
        edge_signs(words << vec4<u32>(2u)) * select(short, long, steep),
    );
}

// (1, 1, 0), its mirror images and rotations: twelve.
fn edge_directions_3d(words: vec4<u32>) -> EdgeDirections3d {
    let zero = vec4<f32>(0.0);
    let third = (words << vec4<u32>(3u)) ^ vec4<u32>(0x80000000u);
    let not_first = third >= vec4<u32>(EDGES_SECOND_THIRD);
    let not_last = third < vec4<u32>(EDGES_LAST_THIRD);
    return EdgeDirections3d(
        select(zero, edge_signs(words), not_first),
        select(edge_signs(words << vec4<u32>(1u)), zero, not_first & not_last),
        select(zero, edge_signs(words << vec4<u32>(2u)), not_last),
    );
}

// (0, 1, 1, 1), its mirror images and rotations: 32.
fn edge_directions_4d(words: vec4<u32>) -> EdgeDirections4d {
    let zero = vec4<f32>(0.0);
    let none = words & vec4<u32>(0x0c000000u);
    return EdgeDirections4d(
        select(edge_signs(words), zero, none == vec4<u32>(0x00000000u)),
        select(edge_signs(words << vec4<u32>(1u)), zero, none == vec4<u32>(0x04000000u)),
        select(edge_signs(words << vec4<u32>(2u)), zero, none == vec4<u32>(0x08000000u)),
        select(edge_signs(words << vec4<u32>(3u)), zero, none == vec4<u32>(0x0c000000u)),
    );
}
