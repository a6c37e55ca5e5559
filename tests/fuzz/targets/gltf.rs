//! The fuzz target `gltf`.
#![no_main]

libfuzzer_sys::fuzz_target!(init: asperity_fuzz::seeds::write("gltf"), |data: &[u8]| asperity_fuzz::attack("gltf", data));
