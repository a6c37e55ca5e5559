//! The fuzz target `words`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("words"), |data: &[u8]| asperity_fuzz::attack("words", data));
