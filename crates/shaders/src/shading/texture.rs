//! Procedural textures: brick, bevel.

use asperity_shading::Brick;
use asperity_shading::texture::Bevel;

use crate::part::{Part, part};
use crate::shading::DIRECTION;

/// Bricks with grooves of mortar, at points and over boxes, [`Brick`].
pub static BRICK: Part = part!("shading/texture/brick", DIRECTION);

/// Ridges along the edges of a tile, at points and as facets, [`Bevel`].
pub static BEVEL: Part = part!("shading/texture/bevel", DIRECTION);

/// A wall of bricks as the words of the structure `Brick`.
///
/// Sides of a brick with its mortar in texture coordinates, and half the mortar as a share of either side.
///
/// ```
/// use asperity_shaders::shading::texture::BrickUniform;
/// use asperity_shading::Brick;
///
/// let words = BrickUniform::new(&Brick::new(0.2, 0.1, 0.05)?).words();
/// assert_eq!(words.map(f32::from_bits), [0.25, 0.15, 0.1, 0.025 / 0.15]);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BrickUniform([u32; Self::WORDS]);

impl BrickUniform {
    /// Words of a wall.
    pub const WORDS: usize = 4;

    /// The words of a wall.
    #[must_use]
    pub fn new(wall: &Brick) -> Self {
        let (cell, margin) = (wall.cell(), wall.margin());
        Self([cell.x, cell.y, margin.x, margin.y].map(f32::to_bits))
    }

    /// The words, in the layout of `Brick`.
    #[must_use]
    pub const fn words(&self) -> [u32; Self::WORDS] {
        self.0
    }
}

/// A ridge as the words of the structure `Bevel`.
///
/// Widths of the plateau and of the flank, and the flank's slopes at its top and its bottom.
///
/// ```
/// use asperity_shaders::shading::texture::BevelUniform;
/// use asperity_shading::texture::Bevel;
///
/// let words = BevelUniform::new(&Bevel::new(0.25, 0.75, 0.0, 1.0)?).words();
/// assert_eq!(words.map(f32::from_bits), [0.25, 0.5, 0.0, 1.0]);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BevelUniform([u32; Self::WORDS]);

impl BevelUniform {
    /// Words of a ridge.
    pub const WORDS: usize = 4;

    /// The words of a ridge.
    #[must_use]
    pub fn new(ridge: &Bevel) -> Self {
        Self([ridge.plateau(), ridge.flank(), ridge.top(), ridge.bottom()].map(f32::to_bits))
    }

    /// The words, in the layout of `Bevel`.
    #[must_use]
    pub const fn words(&self) -> [u32; Self::WORDS] {
        self.0
    }
}
