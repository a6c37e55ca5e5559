//! The fuzz target `mesh`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("mesh"), |data: &[u8]| asperity_fuzz::attack("mesh", data));
