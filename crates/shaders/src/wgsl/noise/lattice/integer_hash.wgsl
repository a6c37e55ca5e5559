// The hash of lattice points, word for word that of `asperity_noise::IntegerHash`.
//
// A seed comes as its key, which takes 64 bits: the host computes it.

const INTEGER_HASH_FACTORS: vec4<u32> = vec4<u32>(0xdb4f0b91u, 0xbbe05633u, 0xa0f2ec75u, 0x89e18285u);
const INTEGER_HASH_SHIFTS: vec4<u32> = vec4<u32>(0x00000000u, 0xd6f86ee3u, 0x48e65b1au, 0xb7a67b5fu);
const INTEGER_HASH_GOLDEN: u32 = 0x9e3779b9u;

fn integer_hash_folded(product: u32) -> u32 {
    return product ^ (product >> 16u);
}

// What the coordinate of a cell along an axis contributes to its words.
fn integer_hash_term(axis: u32, cell: i32) -> u32 {
    return integer_hash_folded(bitcast<u32>(cell) * INTEGER_HASH_FACTORS[axis] + INTEGER_HASH_SHIFTS[axis]);
}

// The word of a lattice point from the exclusive or of its terms.
fn integer_hash_word(terms: u32, key: u32) -> u32 {
    var h = terms * 0x7feb352du + key;
    h = (h ^ (h >> 15u)) * 0x846ca68bu;
    return h ^ (h >> 16u);
}

// The word whose upper bits are good, from the term of the first axis and the exclusive or of the others'.
fn integer_hash_upper_word(first: u32, others: u32, key: u32) -> u32 {
    let h = (first + key) ^ others;
    return h * (h | 1u);
}

// A further word of a lattice point, the k-th.
fn integer_hash_further(word: u32, k: u32) -> u32 {
    var h = word + k * INTEGER_HASH_GOLDEN;
    h = (h ^ (h >> 15u)) * 0x846ca68bu;
    return h ^ (h >> 16u);
}

// A word of a lattice point by a multiplier of its own, what Gaussian variates are drawn from.
fn integer_hash_multiplied(word: u32, multiplier: u32) -> u32 {
    let h = (word ^ (word >> 15u)) * multiplier;
    return h ^ (h >> 16u);
}
