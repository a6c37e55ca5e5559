//! The fuzz target `json`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("json"), |data: &[u8]| asperity_fuzz::attack("json", data));
