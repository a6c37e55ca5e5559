//! Packed maps: the part, its uniform and its table.

use asperity_ndf_sampling::PackedMapRef;

use crate::ndf::density::{ELEMENTARY, GAUSSIAN_SPLIT, NORMAL_DISTRIBUTION};
use crate::part::{Binding, Element, Part, part};

/// A painted or computed distribution on the map of normals, from one array, [`PackedMapRef`].
///
/// Density, samples, distribution functions, bijection and inverse, conditional density. Bound to
/// [`PackedMapUniform`] as `packed_map_grid`, and to the bits of the array as the table
/// `packed_map_word`.
pub static PACKED_MAP: Part = part!("ndf/map/packed_map", ELEMENTARY, NORMAL_DISTRIBUTION, GAUSSIAN_SPLIT)
    .with_bindings(&[
        Binding::Uniform { name: "packed_map_grid", of: "PackedMapGrid" },
        Binding::Table { name: "packed_map_word", element: Element::Word, width: PackedMapUniform::WIDTH },
    ]);

/// Uniform of a packed map: its grid, and the offsets of the parts of its array.
///
/// ```
/// use asperity_wgsl::ndf::PackedMapUniform;
/// # #[cfg(feature = "alloc")] {
/// use asperity_ndf_sampling::{Ggx, NdfMap, Reconstruction};
///
/// let map = NdfMap::from_ndf(64, 32, Reconstruction::Bilinear, &Ggx::new(0.3, 0.5)?)?;
/// let words = PackedMapUniform::new(&map.view()).words();
/// // 64 columns over the disk's diameter of 2, 32 rows.
/// assert_eq!([words[0], words[1]].map(f32::from_bits), [32.0, 16.0]);
/// // The table is the bits of the array, padded to whole rows of texels.
/// let table: Vec<u32> = map.array().iter().map(|x| x.to_bits()).collect();
/// let rows = table.len().div_ceil(PackedMapUniform::WIDTH as usize);
/// assert!(rows < 2048);
/// # }
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PackedMapUniform([u32; 24]);

impl PackedMapUniform {
    /// Texels per row of the table.
    pub const WIDTH: u32 = 1024;

    /// Packs the uniform of a map.
    #[must_use]
    pub fn new(map: &PackedMapRef<'_>) -> Self {
        let (floats, words) = map.grid_and_parts();
        let mut uniform = [0; 24];
        let floats = floats.iter().map(|x| x.to_bits());
        for (word, from) in uniform.iter_mut().zip(floats.chain(words)) {
            *word = from;
        }
        Self(uniform)
    }

    /// Returns the 96 bytes of the structure `PackedMapGrid` as words.
    ///
    /// ```text
    /// density.xy  size.xy  origin.xy  last.xy  margin  guide  quantiles                        floats
    /// last_row  sides  ranks  stride  texel_stride  by_weight  by_place  leaves  heads  nodes  texels  quantiles  number of leaves
    /// ```
    #[must_use]
    pub const fn words(&self) -> [u32; 24] {
        self.0
    }
}
