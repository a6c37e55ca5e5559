//! The fuzz target `png`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("png"), |data: &[u8]| asperity_fuzz::attack("png", data));
