// The hash of lattice points, with the words of `asperity_noise::IntegerHash`.
//
// Seeds are passed as keys, which the host computes with 64 bits.

const INTEGER_HASH_FACTORS: vec4<u32> = vec4<u32>(0xdb4f0b91u, 0xbbe05633u, 0xa0f2ec75u, 0x89e18285u);
const INTEGER_HASH_SHIFTS: vec4<u32> = vec4<u32>(0x00000000u, 0xd6f86ee3u, 0x48e65b1au, 0xb7a67b5fu);
const INTEGER_HASH_GOLDEN: u32 = 0x9e3779b9u;

fn integer_hash_folded(products: vec4<u32>) -> vec4<u32> {
    return products ^ (products >> vec4<u32>(16u));
}

// The contribution of a cell's coordinate along an axis to its words.
fn integer_hash_term(axis: u32, cell: i32) -> u32 {
    let product = bitcast<u32>(cell) * INTEGER_HASH_FACTORS[axis] + INTEGER_HASH_SHIFTS[axis];
    return product ^ (product >> 16u);
}

// The contributions of four coordinates along one axis.
fn integer_hash_terms(axis: u32, cells: vec4<i32>) -> vec4<u32> {
    return integer_hash_folded(bitcast<vec4<u32>>(cells) * INTEGER_HASH_FACTORS[axis] + INTEGER_HASH_SHIFTS[axis]);
}

// The terms of the lower and the upper end of a cell along each axis.
struct IntegerHashEnds {
    low: vec4<u32>,
    high: vec4<u32>,
}

fn integer_hash_ends(cell: vec4<i32>) -> IntegerHashEnds {
    let low = bitcast<vec4<u32>>(cell) * INTEGER_HASH_FACTORS + INTEGER_HASH_SHIFTS;
    return IntegerHashEnds(integer_hash_folded(low), integer_hash_folded(low + INTEGER_HASH_FACTORS));
}

fn integer_hash_ends_2d(cell: vec2<i32>) -> IntegerHashEnds {
    return integer_hash_ends(vec4<i32>(cell, 0, 0));
}

fn integer_hash_ends_3d(cell: vec3<i32>) -> IntegerHashEnds {
    return integer_hash_ends(vec4<i32>(cell, 0));
}

// The exclusive or of the terms of the four ends of the first two axes: low and low, high and low,
// low and high, high and high.
fn integer_hash_joined(ends: IntegerHashEnds) -> vec4<u32> {
    return vec4<u32>(ends.low.x, ends.high.x, ends.low.x, ends.high.x)
        ^ vec4<u32>(ends.low.y, ends.low.y, ends.high.y, ends.high.y);
}

// The same, combined with the key, for upper words.
fn integer_hash_keyed(ends: IntegerHashEnds, key: u32) -> vec4<u32> {
    let low = ends.low.x + key;
    let high = ends.high.x + key;
    return vec4<u32>(low, high, low, high) ^ vec4<u32>(ends.low.y, ends.low.y, ends.high.y, ends.high.y);
}

// The word of a lattice point from the exclusive or of its terms.
fn integer_hash_word(terms: u32, key: u32) -> u32 {
    var h = terms * 0x7feb352du + key;
    h = (h ^ (h >> 15u)) * 0x846ca68bu;
    return h ^ (h >> 16u);
}

// The words of four lattice points.
fn integer_hash_words(terms: vec4<u32>, key: u32) -> vec4<u32> {
    var h = terms * 0x7feb352du + key;
    h = (h ^ (h >> vec4<u32>(15u))) * 0x846ca68bu;
    return integer_hash_folded(h);
}

// The word with good upper bits, from the term of the first axis and the exclusive or of the other
// terms.
fn integer_hash_upper_word(first: u32, others: u32, key: u32) -> u32 {
    let h = (first + key) ^ others;
    return h * (h | 1u);
}

// The upper words of four lattice points, from their terms combined with the key.
fn integer_hash_upper_words(keyed: vec4<u32>) -> vec4<u32> {
    return keyed * (keyed | vec4<u32>(1u));
}

// The k-th further word of a lattice point.
fn integer_hash_further(word: u32, k: u32) -> u32 {
    var h = word + k * INTEGER_HASH_GOLDEN;
    h = (h ^ (h >> 15u)) * 0x846ca68bu;
    return h ^ (h >> 16u);
}

// The k-th further words of four lattice points.
fn integer_hash_further_words(words: vec4<u32>, k: u32) -> vec4<u32> {
    var h = words + k * INTEGER_HASH_GOLDEN;
    h = (h ^ (h >> vec4<u32>(15u))) * 0x846ca68bu;
    return integer_hash_folded(h);
}

// Words of four lattice points times a multiplier, the source of Gaussian variates.
fn integer_hash_multiplied(words: vec4<u32>, multiplier: u32) -> vec4<u32> {
    return integer_hash_folded((words ^ (words >> vec4<u32>(15u))) * multiplier);
}
