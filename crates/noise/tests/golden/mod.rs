//! Golden bits: every kind and sum has the same bits with every feature, at every SIMD level, on
//! every machine.

mod computed;
mod pinned;

use std::fmt::Write;

use computed::Golden;
use pinned::{FIELDS, NUMBERS};

#[test]
fn golden_bits_of_kinds_and_sums() {
    let (mut rows, mut text) = (Vec::new(), String::new());
    computed::fields(&mut |name, golden| rows.push((name, golden)));
    for (name, Golden { dimension, sample, digest }) in &rows {
        let words = sample.map(grouped).join(", ");
        let _ = writeln!(
            text,
            "    ({name:?}, Golden {{ dimension: {dimension}, sample: [{words}], digest: {} }}),",
            grouped(*digest)
        );
    }
    assert!(rows == FIELDS, "the bits are now\n{text}{}", first_difference(&rows, FIELDS));
}

#[test]
fn golden_bits_of_batches_at_every_level() {
    computed::batches(&mut |name, golden| assert!(FIELDS.contains(&(name, golden)), "{name}: {golden:?}"));
}

#[test]
fn golden_bits_of_words_directions_and_spectra() {
    let (mut rows, mut text) = (Vec::new(), String::new());
    computed::numbers(&mut |name, digest| rows.push((name, digest)));
    for (name, digest) in &rows {
        let _ = writeln!(text, "    ({name:?}, {}),", grouped(*digest));
    }
    assert!(rows == NUMBERS, "the bits are now\n{text}{}", first_difference(&rows, NUMBERS));
}

fn grouped(word: u32) -> String {
    format!("0x{:04x}_{:04x}", word >> 16, word & 0xffff)
}

fn first_difference<T: PartialEq + std::fmt::Debug>(now: &[T], pinned: &[T]) -> String {
    let pair = now.iter().zip(pinned).find(|(now, pinned)| now != pinned);
    pair.map_or_else(
        || format!("{} rows, {} pinned", now.len(), pinned.len()),
        |(now, pinned)| format!("first other: {now:?}, pinned {pinned:?}"),
    )
}
