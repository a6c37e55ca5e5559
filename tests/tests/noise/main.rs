//! Noise: properties, references, statistics and independence.

mod anchors;
mod checked;
mod continuity;
mod custom;
mod errors;
mod gaussian;
mod gaussian_tails;
mod gradient;
mod hessian;
mod independence;
mod lattices;
mod lecture;
mod mint;
mod moments;
mod precision;
mod robustness;
mod shapes;
mod spectrum;
mod statistics;
mod sums;
mod tiled_sums;
mod warp_curl;
mod whitened;
