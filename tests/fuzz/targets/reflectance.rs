//! The fuzz target `reflectance`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("reflectance"), |data: &[u8]| asperity_fuzz::attack("reflectance", data));
