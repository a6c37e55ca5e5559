//! The visible normals of the unresolved facets: evaluated and sampled.

use glam::{Vec2, Vec3};

use crate::coordinates::GaussianSplit;
use crate::microfacet::VisibleWarp;

/// The density of visible normals given the resolved part of the bump map.
///
/// ```text
/// p_v(m | z_b) = D_v(m) · Π_k N(z_k; √s z_b,k, 1 − s) / N(z_k; 0, 1),     z = T_v⁻¹(m),  k = 1, 2
/// ```
///
/// It is the rule of [`residual_ndf`](crate::residual_ndf), applied to the visible normals of the
/// view instead of all normals. Because `∫ N(z; √s z_b, 1 − s) N(z_b; 0, 1) dz_b = N(z; 0, 1)` for
/// each `z`, **the mean over the surface is `D_v(m)`, for every fraction `s` and every map `T_v`**. A
/// microfacet BRDF `F G₂/G₁ p_v(h)/(4 (v·h) cos θ_i)` therefore has the mean
/// `F D G₂/(4 cos θ_i cos θ_o)` for every pair of directions. The map matters at a point: where `T_v`
/// maps Gaussian pairs to `D_v`, as for closed forms, `p_v` integrates to 1. Because `F G₂/G₁ ≤ 1`,
/// the BRDF then reflects at most the light that it receives at every point.
///
/// - **Domain:** views as for [`Microfacet`](crate::Microfacet); `z_b` and `s` as for
///   [`residual_ndf`](crate::residual_ndf).
/// - **Limits:** `s = 0` returns [`visible_pdf`](crate::Microfacet::visible_pdf) exactly; `s → 1` a
///   lobe around `T_v(z_b)` of standard deviation `√(1 − s)` in `z`.
/// - **Reciprocity:** the BRDF above is reciprocal in the mean over the surface, not at a point,
///   because the visible normals depend on the view.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Microfacet, VisibleFacets, VisibleWarp, glam::{Vec2, Vec3}};
///
/// let (ggx, v) = (Ggx::new(0.2, 0.4)?, Vec3::new(0.6, 0.0, 0.8));
/// let seen = VisibleFacets::new(ggx, v, Vec2::new(0.5, 1.5), 0.75);
/// let m = seen.warp_gaussian(Vec2::new(0.3, -0.8));
/// assert!(v.dot(m) > 0.0 && seen.d(m) > ggx.visible_pdf(v, m));
/// // The map of GGX is exact, so its samples have this density.
/// assert_eq!(seen.pdf(m), seen.d(m));
/// // With nothing resolved it is the far field, exactly.
/// let far = VisibleFacets::new(ggx, v, Vec2::new(0.5, 1.5), 0.0);
/// assert_eq!(far.d(m), ggx.visible_pdf(v, m));
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "vndf")]
pub struct VisibleFacets<N> {
    ndf: N,
    view: Vec3,
    split: GaussianSplit,
}

impl<N: VisibleWarp> VisibleFacets<N> {
    /// Creates the visible normals of `ndf` from `v` where `z_b` is resolved with the fraction `s`
    /// of the variance.
    ///
    /// Accepts every input.
    #[inline]
    #[must_use]
    pub fn new(ndf: N, v: Vec3, z_b: Vec2, s: f32) -> Self {
        Self { ndf, view: v, split: GaussianSplit::new(z_b, s) }
    }

    /// `p_v(m | z_b)`, in sr⁻¹; 0 for invisible normals.
    #[inline]
    #[must_use]
    pub fn d(&self, m: Vec3) -> f32 {
        self.weigh(self.ndf.visible_pdf(self.view, m), m)
    }

    /// The density of [`warp_gaussian`](Self::warp_gaussian) over solid angle, in sr⁻¹.
    ///
    /// It is [`d`](Self::d) where `T_v` is exact. For tables it differs, see
    /// [`VisibleWarp::warp_visible_pdf`].
    #[inline]
    #[must_use]
    pub fn pdf(&self, m: Vec3) -> f32 {
        self.weigh(self.ndf.warp_visible_pdf(self.view, m), m)
    }

    fn weigh(&self, density: f32, m: Vec3) -> f32 {
        if density > 0.0 { self.split.weigh(density, self.ndf.invert_visible(self.view, m)) } else { 0.0 }
    }

    /// `T_v(√s z_b + √(1 − s) ξ)`: a normal with the density [`pdf`](Self::pdf) for two standard
    /// Gaussian numbers `ξ`.
    #[inline]
    #[must_use]
    pub fn warp_gaussian(&self, xi: Vec2) -> Vec3 {
        self.ndf.warp_visible(self.view, self.split.join(xi))
    }
}
