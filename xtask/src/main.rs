//! The builder of Asperity: `cargo xtask gallery` and its smaller sisters.

mod figure;
mod figures;
mod image;
mod scene;
mod output;
mod plot;

fn main() {}
