//! The hash of lattice points, word for word what the crate draws from.

use asperity_noise::{IntegerHash, Lattice};

use crate::interpreter;

#[test]
fn words_of_the_integer_hash_are_those_of_the_crate() {
    let wgsl = "
        const P = vec3<u32>(0xdb4f0b91u, 0xbbe05633u, 0xa0f2ec75u);
        const SHIFT = vec3<u32>(0u, 0x2545f491u, 0x3c6ef372u) * P;
        fn folded(t: vec3<u32>) -> vec3<u32> { return t ^ (t >> vec3<u32>(16u)); }
        fn word(cell: vec3<i32>, key: u32) -> u32 {
            let terms = folded(vec3<u32>(cell) * P + SHIFT);
            var h = (terms.x ^ terms.y ^ terms.z) * 0x7feb352du + key;
            h = (h ^ (h >> 15u)) * 0x846ca68bu;
            return h ^ (h >> 16u);
        }";
    let shader = interpreter(wgsl);
    let seed = 7;
    let key = IntegerHash.key(seed);
    let step = |at: u32, by: u32| at.wrapping_mul(by).rotate_left(at % 32);
    let inputs: Vec<[u32; 4]> = (0..10_000)
        .map(|at| [step(at, 0x9e37_79b9), step(at, 0x85eb_ca6b), step(at, 0xc2b2_ae35), key])
        .collect();
    let words = shader.call_many("word", &inputs).unwrap();
    for (input, word) in inputs.iter().zip(words) {
        let cell = [0, 1, 2].map(|axis| input[axis].cast_signed());
        assert_eq!(word.u32(), IntegerHash.word(cell, seed), "{cell:?}");
    }
}
