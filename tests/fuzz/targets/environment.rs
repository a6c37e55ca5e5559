//! The fuzz target `environment`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("environment"), |data: &[u8]| asperity_fuzz::attack("environment", data));
