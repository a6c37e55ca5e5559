//! The fuzz target `noise`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("noise"), |data: &[u8]| asperity_fuzz::attack("noise", data));
