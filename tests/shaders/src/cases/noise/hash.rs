//! The hash of lattice points.

use asperity_noise::{IntegerHash, Lattice};
use asperity_wgsl::noise;

use crate::case::{Bound, Case, INPUTS, OUTPUTS, Output, any};

pub(super) fn cases() -> Vec<Case> {
    vec![hash()]
}

fn hash() -> Case {
    Case {
        name: "noise/lattice/integer_hash".into(),
        parts: vec![&noise::WHITE],
        body: "\
    let x = integer_hash_term(0u, i32(c.x));
    let y = integer_hash_term(1u, i32(c.y));
    let z = integer_hash_term(2u, i32(c.z));
    let w = integer_hash_term(3u, i32(c.w));
    outcome.a = vec4<u32>(
        integer_hash_word(x ^ y, d.x),
        integer_hash_word(x ^ y ^ z ^ w, d.x),
        integer_hash_upper_word(x, y, d.x),
        integer_hash_upper_word(x, y ^ z ^ w, d.x),
    );"
        .into(),
        resources: vec![],
        input: Box::new(|i| {
            let mut words: [u32; INPUTS] = std::array::from_fn(|k| any(i, k as u32));
            words[12] = IntegerHash::gpu_key(words[13]);
            words
        }),
        reference: Box::new(|words| {
            let (cell, seed) = ([8, 9, 10, 11].map(|k| words[k] as i32), words[13]);
            let mut outputs = [0; OUTPUTS];
            outputs[0] = IntegerHash.word([cell[0], cell[1]], seed);
            outputs[1] = IntegerHash.word(cell, seed);
            outputs[2] = IntegerHash.upper_word([cell[0], cell[1]], seed);
            outputs[3] = IntegerHash.upper_word(cell, seed);
            outputs
        }),
        outputs: vec![Output::new("words", 0..4, Bound::Equal, Bound::Equal)],
    }
}
