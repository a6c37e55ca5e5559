//! The fuzz target `map`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("map"), |data: &[u8]| asperity_fuzz::attack("map", data));
