//! Light from lamps, from all around, and behind a picture.

pub mod background;
pub mod environments;
pub mod lamps;
