//! The fuzz target `density`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("density"), |data: &[u8]| asperity_fuzz::attack("density", data));
