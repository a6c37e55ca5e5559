//! The fuzz target `fif`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("fif"), |data: &[u8]| asperity_fuzz::attack("fif", data));
