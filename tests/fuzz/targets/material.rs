//! The fuzz target `material`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("material"), |data: &[u8]| asperity_fuzz::attack("material", data));
