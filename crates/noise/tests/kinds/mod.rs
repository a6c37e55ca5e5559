//! Kinds, sums and transforms through their public API.

mod cellular;
mod cellular_search;
mod curl;
mod gaussian;
mod lecture;
mod perlin;
mod perlin_table;
mod power;
mod range;
mod ridged_multifractal;
mod rows;
mod sparse;
mod tiled;
mod tiled_simplex;
mod value_gradient;
mod warp;
mod words;
