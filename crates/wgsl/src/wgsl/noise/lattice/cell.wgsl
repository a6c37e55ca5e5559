// Cells of the lattice, for every point. `asperity_noise::Field` documents points far from the
// origin.
//
// From |x| = 2^23 on points are lattice points, and from 2^31 on cells repeat modulo 2^32.
// Infinities and NaN have no cell, and noises are 0 there. Bits are compared, since compilers may
// assume that no number is infinite.

struct CellPlace2d {
    cell: vec2<i32>,
    place: vec2<f32>,
    // Whether the coordinates are finite.
    known: bool,
}

struct CellPlace3d {
    cell: vec3<i32>,
    place: vec3<f32>,
    known: bool,
}

struct CellPlace4d {
    cell: vec4<i32>,
    place: vec4<f32>,
    known: bool,
}

const CELL_LIMIT_BITS: u32 = 0x4f000000u;
const CELL_INFINITE_BITS: u32 = 0x7f800000u;

// The maximum of the bits of magnitudes.
fn cell_magnitude_bits(p: vec4<f32>) -> u32 {
    let bits = bitcast<vec4<u32>>(p) & vec4<u32>(0x7fffffffu);
    return max(max(bits.x, bits.y), max(bits.z, bits.w));
}

// The cell of a coordinate modulo 2^32; 0 for infinities and NaN.
fn cell_wrapped(x: f32) -> i32 {
    let bits = bitcast<u32>(x);
    let exponent = (bits >> 23u) & 0xffu;
    if exponent < 158u {
        return i32(floor(x));
    }
    if exponent > 181u {
        return 0;
    }
    let magnitude = ((bits & 0x7fffffu) | 0x800000u) << (exponent - 150u);
    return bitcast<i32>(select(magnitude, 0u - magnitude, bits > 0x7fffffffu));
}

// The position in the cell; 0 from 2^31 on.
fn cell_fraction(x: f32) -> f32 {
    if (bitcast<u32>(x) & 0x7fffffffu) < CELL_LIMIT_BITS {
        return x - floor(x);
    }
    return 0.0;
}

// The cell of a point and the position in it, from 0 to 1.
fn cell_place_2d(p: vec2<f32>) -> CellPlace2d {
    let bits = cell_magnitude_bits(vec4<f32>(p, 0.0, 0.0));
    if bits < CELL_LIMIT_BITS {
        let corner = floor(p);
        return CellPlace2d(vec2<i32>(corner), p - corner, true);
    }
    return CellPlace2d(
        vec2<i32>(cell_wrapped(p.x), cell_wrapped(p.y)),
        vec2<f32>(cell_fraction(p.x), cell_fraction(p.y)),
        bits < CELL_INFINITE_BITS,
    );
}

fn cell_place_3d(p: vec3<f32>) -> CellPlace3d {
    let bits = cell_magnitude_bits(vec4<f32>(p, 0.0));
    if bits < CELL_LIMIT_BITS {
        let corner = floor(p);
        return CellPlace3d(vec3<i32>(corner), p - corner, true);
    }
    return CellPlace3d(
        vec3<i32>(cell_wrapped(p.x), cell_wrapped(p.y), cell_wrapped(p.z)),
        vec3<f32>(cell_fraction(p.x), cell_fraction(p.y), cell_fraction(p.z)),
        bits < CELL_INFINITE_BITS,
    );
}

fn cell_place_4d(p: vec4<f32>) -> CellPlace4d {
    let bits = cell_magnitude_bits(p);
    if bits < CELL_LIMIT_BITS {
        let corner = floor(p);
        return CellPlace4d(vec4<i32>(corner), p - corner, true);
    }
    return CellPlace4d(
        vec4<i32>(cell_wrapped(p.x), cell_wrapped(p.y), cell_wrapped(p.z), cell_wrapped(p.w)),
        vec4<f32>(cell_fraction(p.x), cell_fraction(p.y), cell_fraction(p.z), cell_fraction(p.w)),
        bits < CELL_INFINITE_BITS,
    );
}
