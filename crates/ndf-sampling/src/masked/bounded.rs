//! Densities with a bound over any part of the hemisphere.

use core::ops::Deref;

use crate::density::isotropic::{IsotropicIn, Node};
use crate::map::packed::ndf_map::NdfMap;
use crate::masked::wedge::Wedge;
use crate::ndf::Ndf;

/// A density whose largest value over a part of the hemisphere is known, as rejection needs it.
///
/// Implemented by tables and maps, and open for densities of one's own: [`Masked`](crate::Masked) gives them masking and visible
/// normals.
///
/// ```
/// use asperity_ndf_sampling::{Bounded, Ggx, Measure, Ndf, NdfMap, Reconstruction, Wedge, glam::Vec3};
///
/// let ggx = Ggx::isotropic(0.5)?;
/// let map = NdfMap::from_ndf(32, 32, Reconstruction::Bilinear, &ggx)?;
/// assert!(map.most(Wedge::HEMISPHERE) >= map.density(Vec3::Z));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "no bound of the density `{Self}` is known",
    note = "`NdfMap` and `Isotropic` have one; for another density take `NdfMap::from_ndf`, or implement `most`"
)]
pub trait Bounded: Ndf {
    /// At least the largest `D(m)` in the wedge; the nearer to it, the fewer tries. Infinity asks for narrower wedges first.
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

impl<S: Deref<Target = [Node]>> Bounded for IsotropicIn<S> {
    fn most(&self, wedge: Wedge) -> f32 {
        self.most_between(1.0 - wedge.tilts[1], 1.0 - wedge.tilts[0])
    }
}
