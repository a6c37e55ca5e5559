//! Modules shared by the workspace's tests, for testing every noise at every SIMD level.

#[path = "../../../crates/noise/tests/lanes/compare.rs"]
pub mod compare;
#[path = "../../src/noise_kinds.rs"]
pub mod noise_kinds;
