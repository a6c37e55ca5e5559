//! The fuzz target `surface`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("surface"), |data: &[u8]| asperity_fuzz::attack("surface", data));
