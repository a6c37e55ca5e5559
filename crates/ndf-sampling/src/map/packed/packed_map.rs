//! A map of normals in one borrowed array of `f32`.

use glam::{Vec2, Vec3};

use crate::map::packed::error::PackedMapError;
use crate::map::packed::grid::Grid;
use crate::map::packed::layout::Layout;
use crate::map::packed::record::{HEADER, LEAF, Rows};
use crate::map::reconstruction::Reconstruction;
use crate::math;
use crate::ndf::Ndf;
use crate::numeric::normal_distribution::{inverse_phi, phi};
use crate::simd::lanes::Scalar;

/// A normal density on the map, sampled and inverted in `f32` from one array that it borrows: from flash, a file or a `Vec`.
///
/// The array is made by `NdfMap::pack` (feature `alloc`). Everything that it says of the density holds here too; the
/// distribution functions are rounded to `f32`, so what is not within 10⁻⁷ of the whole is lost.
///
/// - **Accuracy:** `forward(sample(u)) = u` within 1e-6, and what the rounding of the normal's coordinates makes of it: 6e-8
///   times the marginal, or the conditional density, per `dn`. The rim is the circle; parts of the marginal are cubics that are
///   within 5e-7 of it.
/// - **Resolution:** that of `f32`: columns and rows beyond 2²² are not told apart.
/// - **Total:** uniform numbers are moved to `[0, 1 − 2⁻²⁴]`, NaN is read as 0; directions as for [`Ndf`].
/// - An array whose header is sound but whose numbers were changed gives other normals, and never panics.
///
/// ```
/// # #[cfg(feature = "alloc")] {
/// use asperity_ndf_sampling::{Ggx, Ndf, NdfMap, PackedMapRef, Reconstruction, glam::Vec2};
///
/// let map = NdfMap::from_ndf(64, 64, Reconstruction::Bilinear, &Ggx::new(0.3, 0.5)?)?;
/// let array = map.pack();
/// let packed = PackedMapRef::new(&array)?;
/// let u = Vec2::new(0.2, 0.7);
/// let m = packed.sample(u);
/// assert!(packed.forward(m.truncate()).abs_diff_eq(u, 1e-6));
/// # }
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "gpu")]
#[doc(alias = "flash")]
pub struct PackedMapRef<'a> {
    pub(crate) layout: Layout,
    pub(crate) grid: Grid,
    pub(crate) by_weight: &'a [f32],
    /// `M` where the leaves after the first begin.
    pub(crate) weights: &'a [f32],
    pub(crate) leaves: &'a [[f32; LEAF]],
    pub(crate) cubics: &'a [Rows],
    pub(crate) quantiles: &'a [f32],
    /// For each line across a column the integral up to it and the value on it.
    pub(crate) nodes: &'a [f32],
}

impl<'a> PackedMapRef<'a> {
    /// The map that `NdfMap::pack` wrote into `array`.
    ///
    /// # Errors
    /// An array without the header of a packed map, with a size in the header that is none, or of another length than these
    /// sizes need.
    pub fn new(array: &'a [f32]) -> Result<Self, PackedMapError> {
        let (layout, len) = Layout::read(array)?;
        let mut rest = array.get(HEADER..).unwrap_or_default();
        let mut parts = [&array[..0]; 6];
        for (part, length) in parts.iter_mut().zip(layout.parts()) {
            let length = length.and_then(|length| usize::try_from(length).ok());
            let Some((first, others)) = length.and_then(|length| rest.split_at_checked(length)) else {
                return Err(PackedMapError::Length { expected: u64::MAX, got: len });
            };
            (*part, rest) = (first, others);
        }
        let [by_weight, weights, leaves, cubics, quantiles, nodes] = parts;
        let leaves = leaves.as_chunks().0;
        let cubics = cubics.as_chunks().0.as_chunks().0;
        Ok(Self { layout, grid: Grid::new(&layout), by_weight, weights, leaves, cubics, quantiles, nodes })
    }

    /// The number of texels along x.
    #[inline]
    #[must_use]
    pub const fn width(&self) -> usize {
        self.layout.width
    }

    /// The number of texels along y.
    #[inline]
    #[must_use]
    pub const fn height(&self) -> usize {
        self.layout.height
    }

    /// Reconstruction between the texels' centres.
    #[inline]
    #[must_use]
    pub const fn reconstruction(&self) -> Reconstruction {
        self.layout.kind
    }

    /// `(M, C)⁻¹(u)`: the first two coordinates of the normal.
    #[must_use]
    pub fn inverse(&self, u: Vec2) -> Vec2 {
        let [x, y] = match self.layout.kind {
            Reconstruction::Constant => self.inverse_in::<_, 1, 1>(Scalar, u.to_array()),
            Reconstruction::Bilinear => self.inverse_in::<_, 1, 2>(Scalar, u.to_array()),
        };
        Vec2::new(x, y)
    }

    /// `(M, C)`: the uniform numbers of a normal by its first two coordinates, each in [0, 1].
    #[must_use]
    pub fn forward(&self, n: Vec2) -> Vec2 {
        let [u1, u2] = match self.layout.kind {
            Reconstruction::Constant => self.forward_in::<_, 1, 1>(Scalar, n.to_array()),
            Reconstruction::Bilinear => self.forward_in::<_, 1, 2>(Scalar, n.to_array()),
        };
        Vec2::new(u1, u2)
    }
}

impl Ndf for PackedMapRef<'_> {
    fn density(&self, m: Vec3) -> f32 {
        let density = match self.layout.kind {
            Reconstruction::Constant => self.density_in::<_, 1, 1>(Scalar, [m.x, m.y]),
            Reconstruction::Bilinear => self.density_in::<_, 1, 2>(Scalar, [m.x, m.y]),
        };
        if m.z > 0.0 { density } else { 0.0 }
    }

    /// `(M, C)⁻¹(u)`, without the detour over Gaussian numbers.
    fn sample(&self, u: Vec2) -> Vec3 {
        let n = self.inverse(u);
        n.extend(math::sqrt((1.0 - n.x * n.x - n.y * n.y).max(1e-15)))
    }

    fn from_gaussian(&self, z: Vec2) -> Vec3 {
        let u = z.to_array().map(|z| if z.is_nan() { 0.5 } else { phi(f64::from(z)) as f32 });
        self.sample(Vec2::from(u))
    }

    fn to_gaussian(&self, m: Vec3) -> Vec2 {
        const LEAST: f64 = 1.0 / (1u32 << 25) as f64;
        let u = self.forward(Vec2::new(m.x, m.y)).to_array();
        Vec2::from(u.map(|u| inverse_phi(f64::from(u).clamp(LEAST, 1.0 - LEAST)) as f32))
    }
}
