//! The builder of Asperity: `cargo xtask gallery` and its smaller sisters.

mod cli;
mod densities;
mod figure;
mod figures;
mod image;
mod scene;
mod output;
mod plot;

fn main() {}
