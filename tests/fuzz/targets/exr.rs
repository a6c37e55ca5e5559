//! The fuzz target `exr`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("exr"), |data: &[u8]| asperity_fuzz::attack("exr", data));
