//! NDFs with an upper bound over any part of the hemisphere.

use core::ops::Deref;

use crate::density::isotropic::{Isotropic, Node};
use crate::map::packed::ndf_map::NdfMap;
use crate::masked::wedge::Wedge;
use crate::ndf::Ndf;

/// An NDF with an upper bound over any part of the hemisphere, for rejection sampling.
///
/// Tables and maps implement it. Implement it for a custom NDF to use [`Masked`](crate::Masked),
/// which adds masking and visible normals.
///
/// ```
/// use asperity_ndf_sampling::{Bounded, Ggx, Measure, Ndf, NdfMap, Reconstruction, Wedge, glam::Vec3};
///
/// let ggx = Ggx::isotropic(0.5)?;
/// let map = NdfMap::from_ndf(32, 32, Reconstruction::Bilinear, &ggx)?;
/// assert!(map.most(Wedge::HEMISPHERE) >= map.d(Vec3::Z));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not implement `Bounded`",
    note = "`NdfMap` and `Isotropic` have one; for another density take `NdfMap::from_ndf`, or implement `most`"
)]
pub trait Bounded: Ndf {
    /// An upper bound of `D(m)` in the wedge.
    ///
    /// Tighter bounds need fewer tries. Infinity requests narrower wedges first.
    #[must_use]
    fn most(&self, wedge: Wedge) -> f32;
}

impl<N: Bounded + ?Sized> Bounded for &N {
    fn most(&self, wedge: Wedge) -> f32 {
        (**self).most(wedge)
    }
}

impl Bounded for NdfMap {
    fn most(&self, wedge: Wedge) -> f32 {
        self.view().most(wedge.sides())
    }
}

impl<S: Deref<Target = [Node]>> Bounded for Isotropic<S> {
    fn most(&self, wedge: Wedge) -> f32 {
        self.most_between(1.0 - wedge.tilts[1], 1.0 - wedge.tilts[0])
    }
}
