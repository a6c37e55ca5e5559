//! The fuzz target `shader`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("shader"), |data: &[u8]| asperity_fuzz::attack("shader", data));
