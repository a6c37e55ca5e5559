// Keys of lattices whose seeds are drawn in the shader: `IntegerHash.key` of asperity-noise. Words
// of 64 bits are pairs, the lower word first.

fn lattice_key_product(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    let a_low = a.x & 0xffffu;
    let a_high = a.x >> 16u;
    let b_low = b.x & 0xffffu;
    let b_high = b.x >> 16u;
    let low = a_low * b_low;
    let middle = a_high * b_low + (low >> 16u);
    let other = a_low * b_high + (middle & 0xffffu);
    let high = a_high * b_high + (middle >> 16u) + (other >> 16u);
    return vec2<u32>((other << 16u) | (low & 0xffffu), high + a.x * b.y + a.y * b.x);
}

// z ^ z >> shift, for shifts below 32.
fn lattice_key_folded(z: vec2<u32>, shift: u32) -> vec2<u32> {
    return z ^ vec2<u32>((z.x >> shift) | (z.y << (32u - shift)), z.y >> shift);
}

// The key of a seed.
fn lattice_key(seed: u32) -> u32 {
    let counter = vec2<u32>(seed + 1u, select(0u, 1u, seed == 0xffffffffu));
    var z = lattice_key_product(counter, vec2<u32>(0x7f4a7c15u, 0x9e3779b9u));
    z = lattice_key_product(lattice_key_folded(z, 30u), vec2<u32>(0x1ce4e5b9u, 0xbf58476du));
    z = lattice_key_product(lattice_key_folded(z, 27u), vec2<u32>(0x133111ebu, 0x94d049bbu));
    return lattice_key_folded(z, 31u).y;
}
