//! Procedural textures of Cohen's lecture: brick, bevel, stars, perturbed images, marble, gas.

mod bevel;
mod brick;
mod brick_facets;
mod gas;
mod marble;
mod perturbed;
mod star_wallpaper;

pub use bevel::{Bevel, BevelError, Edge};
pub use brick::{Brick, BrickError, BrickSample};
pub use gas::{Gas, GasError, Seen, Steam, march};
pub use marble::{Marble, MarbleError};
pub use perturbed::{PerturbedLookUp, PerturbedTexture};
pub use star_wallpaper::{StarWallpaper, StarWallpaperError};
