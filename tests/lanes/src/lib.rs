//! Modules that the workspace's tests share, for the test of every kind at every SIMD level.

#[path = "../../../crates/noise/tests/lanes/compare.rs"]
pub mod compare;
#[path = "../../src/noise_kinds.rs"]
pub mod noise_kinds;
