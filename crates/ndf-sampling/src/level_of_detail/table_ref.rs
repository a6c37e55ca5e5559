//! Look-ups in a texture of half vectors that somebody else owns.

use glam::{Vec2, Vec3, Vec3A};

use crate::coordinates::GaussianSplit;
use crate::normal_table::error::NormalTableError;
use asperity_core::math;

/// A `ConditionalTable` in borrowed storage, such as flash: `(z₁, z₂, D^¼)` of `size · size` half vectors.
///
/// ```text
/// p = (h_x/c_x, h_y/c_y)/(h′ + h_z),   h′ = √(h_x²/c_x² + h_y²/c_y² + h_z²),      texture coordinate (p + 1)/2
/// ```
///
/// Entries are at the centres of the texels, row by row from `p_y = −1`, and interpolated bilinearly; those beyond the rim of the
/// disk |p| ≤ 1 hold the half vector on it.
///
/// - **Total:** half vectors below the horizon and NaN have the density 0; entries that are no numbers give some number that is
///   at least 0.
///
/// ```
/// use asperity_ndf_sampling::{ConditionalTableRef, GaussianSplit, glam::{Vec2, Vec3}};
///
/// // A density of 16 everywhere, whose coordinates are 0.
/// static FLASH: [[f32; 3]; 1] = [[0.0, 0.0, 2.0]];
/// let table = ConditionalTableRef::new(1, Vec2::ONE, &FLASH)?;
/// assert_eq!(table.density(Vec3::Z, GaussianSplit::new(Vec2::ONE, 0.0)), 16.0);
/// # Ok::<(), asperity_ndf_sampling::NormalTableError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConditionalTableRef<'a> {
    pub(crate) size: usize,
    pub(crate) stretch: Vec2,
    pub(crate) entries: &'a [[f32; 3]],
}

impl<'a> ConditionalTableRef<'a> {
    /// The table of `size · size` entries with the stretch `c`; a stretch that is not positive counts as 1.
    ///
    /// # Errors
    /// A `size` of 0 or above 4096; another number of entries.
    pub fn new(size: usize, stretch: Vec2, entries: &'a [[f32; 3]]) -> Result<Self, NormalTableError> {
        let positive = |c: f32| if c > 0.0 && c.is_finite() { c } else { 1.0 };
        NormalTableError::check(size, Some(entries.len()))?;
        Ok(Self { size, stretch: Vec2::new(positive(stretch.x), positive(stretch.y)), entries })
    }

    /// The number of entries along a side.
    #[inline]
    #[must_use]
    pub const fn size(self) -> usize {
        self.size
    }

    /// The stretch `c` along x and y.
    #[inline]
    #[must_use]
    pub const fn stretch(self) -> Vec2 {
        self.stretch
    }

    /// The entries, row by row.
    #[inline]
    #[must_use]
    pub const fn entries(self) -> &'a [[f32; 3]] {
        self.entries
    }

    /// `p_s(h | z_b)` for what the pixel resolves, in sr⁻¹; its mean over the surface is that of `s = 0`, to rounding.
    #[inline]
    #[must_use]
    pub fn density(self, h: Vec3, split: GaussianSplit) -> f32 {
        let [z1, z2, root] = self.interpolated(h);
        let density = (root * root) * (root * root);
        if h.z > 0.0 && density > 0.0 { split.weigh(density.min(f32::MAX), Vec2::new(z1, z2)) } else { 0.0 }
    }

    /// `T⁻¹(h)`, interpolated.
    #[inline]
    #[must_use]
    pub fn to_gaussian(self, h: Vec3) -> Vec2 {
        let [z1, z2, _] = self.interpolated(h);
        Vec2::new(z1, z2)
    }

    #[inline]
    fn interpolated(self, h: Vec3) -> [f32; 3] {
        let (x, y) = (h.x / self.stretch.x, h.y / self.stretch.y);
        let length = math::sqrt(x * x + y * y + h.z * h.z);
        let last = (self.size - 1) as f32;
        // Zero, NaN and what overflows is NaN here, which `max` takes to the first entry.
        let position = |c: f32| {
            let p = c / (length + h.z.max(0.0));
            ((0.5 * p + 0.5) * self.size as f32 - 0.5).max(0.0).min(last)
        };
        let (x, y) = (position(x), position(y));
        let before_last = self.size.saturating_sub(2);
        let (column, row) = ((x as usize).min(before_last), (y as usize).min(before_last));
        let (right, up) = (x - column as f32, y - row as f32);
        let below = row * self.size + column;
        let (Some(&[a, b, ..]), Some(&[c, d, ..])) =
            (self.entries.get(below..), self.entries.get(below + self.size..))
        else {
            // A table of one entry.
            return self.entries.first().copied().unwrap_or_default();
        };
        let [a, b, c, d] = [a, b, c, d].map(Vec3A::from_array);
        let (low, high) = (a + (b - a) * right, c + (d - c) * right);
        (low + (high - low) * up).to_array()
    }
}

/// The half vector at a place among the texels, in units of them; beyond the rim that on it, above the horizon.
#[cfg(feature = "alloc")]
pub(crate) fn entry_half_vector([column, row]: [f64; 2], size: usize, stretch: Vec2) -> Vec3 {
    let [x, y] = [column, row].map(|k| 2.0 * k / size as f64 - 1.0);
    let r = math::sqrt_f64(x * x + y * y);
    // A quarter of a texel within the rim: at the horizon densities may be 0 or infinite.
    let rim = 1.0 - 0.5 / size as f64;
    let inside = if r > rim { rim / r } else { 1.0 };
    let (x, y) = (x * inside, y * inside);
    let r2 = x * x + y * y;
    let (x, y) = (2.0 * x * f64::from(stretch.x), 2.0 * y * f64::from(stretch.y));
    let up = 1.0 - r2;
    let length = math::sqrt_f64(x * x + y * y + up * up);
    Vec3::new((x / length) as f32, (y / length) as f32, (up / length) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn total_on_every_input() {
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1e-40, 1e38, -1.0];
        let entries =
            [[f32::NAN, 1.0, 2.0], [1.0, f32::INFINITY, 1e30], [0.0, 0.0, f32::NAN], [1e38, -1e38, -1.0]];
        for stretch in [Vec2::ONE, Vec2::new(1e-6, f32::NAN), Vec2::new(-1.0, 0.0)] {
            let table = ConditionalTableRef::new(2, stretch, &entries).unwrap();
            for (x, y) in bad.into_iter().flat_map(|x| bad.map(|y| (x, y))) {
                for z in bad {
                    let p = table.density(Vec3::new(x, y, z), GaussianSplit::new(Vec2::ONE, 0.5));
                    assert!(p.is_finite() && p >= 0.0, "{x} {y} {z}: {p}");
                }
            }
        }
    }
}
