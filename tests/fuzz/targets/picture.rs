//! The fuzz target `picture`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("picture"), |data: &[u8]| asperity_fuzz::attack("picture", data));
