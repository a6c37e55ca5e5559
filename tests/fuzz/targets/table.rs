//! The fuzz target `table`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("table"), |data: &[u8]| asperity_fuzz::attack("table", data));
