//! What the workspace's tests share, for the test of every kind at every SIMD level.

#[path = "../../src/noise_kinds.rs"]
pub mod noise_kinds;
#[path = "../../src/noise_lanes.rs"]
pub mod noise_lanes;
#[path = "../../src/random.rs"]
pub mod random;
