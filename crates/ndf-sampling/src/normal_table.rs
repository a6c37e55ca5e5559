//! Table L: tangent frames over a square of Gaussian coordinates, for normals by one look-up.

use alloc::vec::Vec;
use core::fmt;

use glam::{Vec2, Vec3};

use crate::frame::Frame;
use crate::math;
use crate::ndf::Ndf;

/// The table `L` of a normal density: the frames of `T(z)` on a square grid over ±[`NormalTable::RANGE`].
///
/// ```text
/// z_k = RANGE · ((2k + 1)/size − 1),   k = 0 … size − 1;     L[k₂ size + k₁] = frame of T(z_k₁, z_k₂)
/// ```
///
/// - **Index:** Gaussian coordinates, which keep the tails that an index by uniform numbers cuts to a fifth. Coordinates
///   beyond the outermost entries give those, NaN the middle.
/// - **Half a texel:** entries are at the centres of `size²` equal texels, as in a texture whose coordinate is
///   `(z/RANGE + 1)/2`. A table of even size has no entry at `z = 0`: [`nearest`](NormalTable::nearest) to the flat bump map
///   is tilted by half a texel (0.018 standard deviations at 256), [`bilinear`](NormalTable::bilinear) is not. An odd size
///   has that entry.
/// - **Error**, GGX (0.2, 0.4) at 256, against its exact bins: total variation 0.0185 for the nearest entry, 0.0004 bilinear, of
///   which 0.0003 are the sampling's; (n_x, n_y) is off by up to 0.012 and 1.2e-4 where `z₂ = 0` and `|z₁| ≤ 3.3`.
/// - **Frames** are minimal rotations from (0, 0, 1), see [`Frame::from_normal`], continuous over the table.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Ndf, NormalTable, glam::Vec2};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let table = NormalTable::new(&ggx, 65)?;
/// assert_eq!(table.nearest(Vec2::ZERO).normal, ggx.from_gaussian(Vec2::ZERO));
/// let z = Vec2::new(0.4, -1.1);
/// assert!(table.bilinear(z).normal.abs_diff_eq(ggx.from_gaussian(z), 1e-3));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, section 4. The paper indexes by the noise value with G inside and looks up the nearest
/// entry; this table is indexed by `z`, so that one table serves every noise.
#[derive(Clone, Debug, PartialEq)]
pub struct NormalTable {
    size: usize,
    frames: Vec<Frame>,
}

impl NormalTable {
    /// The table covers this many standard deviations to each side; 7·10⁻⁶ of a Gaussian is beyond.
    pub const RANGE: f32 = 4.5;

    /// The usual size of a side.
    pub const SIZE: usize = 256;

    /// The longest side; the table then takes 600 MB.
    pub const MAX_SIZE: usize = 4096;

    /// The table of `ndf` with `size · size` entries.
    ///
    /// # Errors
    /// A `size` of 0 or above [`NormalTable::MAX_SIZE`].
    pub fn new<N: Ndf + ?Sized>(ndf: &N, size: usize) -> Result<Self, NormalTableError> {
        match size {
            0 => Err(NormalTableError::Empty),
            1..=Self::MAX_SIZE => Ok(Self::build(ndf, size)),
            _ => Err(NormalTableError::TooLarge { size }),
        }
    }

    /// The table of `ndf` of the usual size, 256 × 256.
    #[must_use]
    pub fn standard<N: Ndf + ?Sized>(ndf: &N) -> Self {
        Self::build(ndf, Self::SIZE)
    }

    fn build<N: Ndf + ?Sized>(ndf: &N, size: usize) -> Self {
        let at = |k: usize| ((2 * k + 1) as f64 / size as f64 - 1.0) as f32 * Self::RANGE;
        let frames = (0..size)
            .flat_map(|row| (0..size).map(move |column| Vec2::new(at(column), at(row))))
            .map(|z| Frame::from_normal(ndf.from_gaussian(z)))
            .collect();
        Self { size, frames }
    }

    /// The number of entries along a side.
    #[inline]
    #[must_use]
    pub const fn size(&self) -> usize {
        self.size
    }

    /// The entries, row by row: `z₁` runs along a row, and the first row has the least `z₂`.
    #[inline]
    #[must_use]
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// The entry nearest to `z`.
    #[inline]
    #[must_use]
    pub fn nearest(&self, z: Vec2) -> Frame {
        self.entry((self.position(z.x) + 0.5) as usize, (self.position(z.y) + 0.5) as usize)
    }

    /// The frame of the normal that is interpolated between the four entries around `z`.
    ///
    /// `(n_x, n_y)` is interpolated bilinearly, `n_z = √(1 − n_x² − n_y²)`: as the disk is convex, it is never left. The
    /// frame is made anew, orthonormal.
    #[inline]
    #[must_use]
    pub fn bilinear(&self, z: Vec2) -> Frame {
        let (x, y) = (self.position(z.x), self.position(z.y));
        let (column, row) = (x as usize, y as usize);
        let (right, up) = (x - column as f32, y - row as f32);
        let across = |row: usize| {
            let (a, b) = (self.entry(column, row).normal, self.entry(column + 1, row).normal);
            Vec2::new(a.x + (b.x - a.x) * right, a.y + (b.y - a.y) * right)
        };
        let (a, b) = (across(row), across(row + 1));
        let n = Vec2::new(a.x + (b.x - a.x) * up, a.y + (b.y - a.y) * up);
        let up = math::sqrt((1.0 - n.x * n.x - n.y * n.y).max(0.0));
        Frame::from_normal(Vec3::new(n.x, n.y, up))
    }

    /// The place of a coordinate among the entries, in `0..=size − 1`.
    #[inline]
    fn position(&self, z: f32) -> f32 {
        let z = if z.is_nan() { 0.0 } else { z };
        let last = (self.size - 1) as f32;
        ((z / Self::RANGE * 0.5 + 0.5) * self.size as f32 - 0.5).clamp(0.0, last)
    }

    #[inline]
    fn entry(&self, column: usize, row: usize) -> Frame {
        let last = self.size - 1;
        let index = row.min(last) * self.size + column.min(last);
        self.frames.get(index).copied().unwrap_or(Frame::IDENTITY)
    }
}

/// Why a table of normals was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NormalTableError {
    /// The size is 0.
    Empty,
    /// The size is above [`NormalTable::MAX_SIZE`].
    TooLarge {
        /// Its value.
        size: usize,
    },
}

impl fmt::Display for NormalTableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "size must be at least 1, got 0"),
            Self::TooLarge { size } => {
                write!(f, "size must be at most {}, got {size}", NormalTable::MAX_SIZE)
            }
        }
    }
}

impl core::error::Error for NormalTableError {}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::Ggx;
    use std::string::ToString;

    #[test]
    fn refusals_name_the_size() {
        let ggx = Ggx::isotropic(0.5).unwrap();
        assert_eq!(NormalTable::new(&ggx, 0).unwrap_err().to_string(), "size must be at least 1, got 0");
        let error = NormalTable::new(&ggx, 4097).unwrap_err();
        assert_eq!(error.to_string(), "size must be at most 4096, got 4097");
    }

    #[test]
    fn both_look_ups_agree_on_the_entries() {
        let table = NormalTable::new(&Ggx::new(0.2, 0.6).unwrap(), 9).unwrap();
        for (k, frame) in table.frames().iter().enumerate() {
            let z = Vec2::new((k % 9) as f32 - 4.0, (k / 9) as f32 - 4.0);
            assert_eq!(table.nearest(z), *frame, "{z}");
            // Next to the horizon √(1 − r²) magnifies the rounding of r; measured 4e-6.
            assert!(table.bilinear(z).normal.abs_diff_eq(frame.normal, 2e-5), "{z}");
        }
    }

    #[test]
    fn even_table_tilts_the_nearest_flat_normal_by_half_a_texel() {
        let ggx = Ggx::isotropic(0.3).unwrap();
        let table = NormalTable::standard(&ggx);
        assert!(table.bilinear(Vec2::ZERO).normal.abs_diff_eq(Vec3::Z, 1e-7));
        let half = NormalTable::RANGE / 256.0;
        let expected = ggx.from_gaussian(Vec2::splat(half));
        assert!(table.nearest(Vec2::ZERO).normal.abs_diff_eq(expected, 1e-6));
    }

    #[test]
    fn total_on_every_input() {
        let ggx = Ggx::isotropic(1.0).unwrap();
        for size in [1, 2, 3] {
            let table = NormalTable::new(&ggx, size).unwrap();
            for (x, y) in [(f32::NAN, 0.0), (f32::INFINITY, f32::NEG_INFINITY), (1e38, -1e38)] {
                let z = Vec2::new(x, y);
                assert!((table.nearest(z).normal.length() - 1.0).abs() < 1e-6);
                assert!((table.bilinear(z).normal.length() - 1.0).abs() < 1e-6);
            }
            let nowhere = Vec2::new(0.3, f32::NAN);
            assert_eq!(table.nearest(nowhere), table.nearest(Vec2::new(0.3, 0.0)));
            assert_eq!(table.bilinear(nowhere), table.bilinear(Vec2::new(0.3, 0.0)));
        }
    }
}
