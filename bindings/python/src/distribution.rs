//! Normal distribution functions of every type behind one pointer.

use std::sync::{Arc, OnceLock};

use asperity_ndf_sampling::glam::{Vec2, Vec3};
use asperity_ndf_sampling::{
    Bounded, ConditionalNdf, GaussianSplit, Masked, Microfacet, Ndf, NdfMap, Rotated,
};

/// An NDF, with masking if it has one.
pub(crate) trait Distribution: Send + Sync {
    /// The NDF.
    fn ndf(&self) -> &dyn Ndf;

    /// The NDF with masking and visible normals.
    fn microfacet(&self) -> Option<&(dyn Microfacet + Send + Sync)>;

    /// The map of an NDF that is an image.
    fn map(&self) -> Option<&NdfMap> {
        None
    }
}

/// A distribution of any type, which is itself an NDF.
#[derive(Clone)]
pub(crate) struct Shared(pub(crate) Arc<dyn Distribution>);

impl Shared {
    pub(crate) fn new(distribution: impl Distribution + 'static) -> Self {
        Self(Arc::new(distribution))
    }
}

impl Ndf for Shared {
    fn d(&self, m: Vec3) -> f32 {
        self.0.ndf().d(m)
    }
    fn warp_gaussian(&self, z: Vec2) -> Vec3 {
        self.0.ndf().warp_gaussian(z)
    }
    fn invert(&self, m: Vec3) -> Vec2 {
        self.0.ndf().invert(m)
    }
    fn slope_density(&self, slope: Vec2) -> f32 {
        self.0.ndf().slope_density(slope)
    }
    fn sample(&self, u: Vec2) -> Vec3 {
        self.0.ndf().sample(u)
    }
    fn pdf(&self, m: Vec3) -> f32 {
        self.0.ndf().pdf(m)
    }
    fn residual_ndf(&self, h: Vec3, split: GaussianSplit) -> f32 {
        self.0.ndf().residual_ndf(h, split)
    }
}

/// Calls a method of the NDF with masking; the second value is for an NDF without masking.
macro_rules! visible {
    ($($name:ident($($argument:ident: $type:ty),+) -> $result:ty, $other:expr;)+) => {$(
        fn $name(&self, $($argument: $type),+) -> $result {
            self.0.microfacet().map_or($other, |ndf| ndf.$name($($argument),+))
        }
    )+};
}

impl Microfacet for Shared {
    visible! {
        lambda(v: Vec3) -> f32, f32::INFINITY;
        projected_area(v: Vec3) -> f32, f32::MAX;
        sample_visible(v: Vec3, u: Vec2) -> Vec3, Vec3::Z;
        visible_pdf(v: Vec3, m: Vec3) -> f32, 0.0;
        sample_reflecting(v: Vec3, u: Vec2) -> Vec3, Vec3::Z;
        reflecting_pdf(v: Vec3, m: Vec3) -> f32, 0.0;
    }
}

/// An NDF in closed form.
pub(crate) struct Analytic<N>(pub(crate) N);

impl<N: Microfacet + Send + Sync> Distribution for Analytic<N> {
    fn ndf(&self) -> &dyn Ndf {
        &self.0
    }
    fn microfacet(&self) -> Option<&(dyn Microfacet + Send + Sync)> {
        Some(&self.0)
    }
}

/// An NDF of a table, whose masking is computed when it is first used.
pub(crate) struct Tabulated<N> {
    ndf: N,
    masked: OnceLock<Masked<N>>,
}

impl<N> Tabulated<N> {
    pub(crate) fn new(ndf: N) -> Self {
        Self { ndf, masked: OnceLock::new() }
    }
}

/// Tables that may be maps.
pub(crate) trait Table: Bounded + Clone + Send + Sync {
    /// The map.
    fn as_map(&self) -> Option<&NdfMap> {
        None
    }
}

impl Table for NdfMap {
    fn as_map(&self) -> Option<&NdfMap> {
        Some(self)
    }
}

impl Table for asperity_ndf_sampling::Isotropic {}

impl<N: Table> Distribution for Tabulated<N> {
    fn ndf(&self) -> &dyn Ndf {
        &self.ndf
    }
    fn microfacet(&self) -> Option<&(dyn Microfacet + Send + Sync)> {
        Some(self.masked.get_or_init(|| Masked::new(self.ndf.clone())))
    }
    fn map(&self) -> Option<&NdfMap> {
        self.ndf.as_map()
    }
}

impl Distribution for Rotated<Shared> {
    fn ndf(&self) -> &dyn Ndf {
        self
    }
    fn microfacet(&self) -> Option<&(dyn Microfacet + Send + Sync)> {
        Some(self)
    }
}

impl Distribution for ConditionalNdf<Shared> {
    fn ndf(&self) -> &dyn Ndf {
        self
    }
    fn microfacet(&self) -> Option<&(dyn Microfacet + Send + Sync)> {
        None
    }
}
