//! Procedural textures of Cohen's lecture: brick, bevel, stars, perturbed images, marble, gas.

mod bevel;
mod brick;
mod brick_facets;
mod gas;
mod marble;
mod perturbed;
mod star_wallpaper;

pub use bevel::{Bevel, BevelParameters, Edge};
pub use brick::{Brick, BrickSample};
pub use gas::{Gas, Seen, Steam, march};
pub use marble::Marble;
pub use perturbed::{PerturbedLookUp, PerturbedTexture};
pub use star_wallpaper::{StarWallpaper, StarWallpaperParameters};
