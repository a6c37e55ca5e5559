//! The `Microfacet` trait.

use glam::{Vec2, Vec3};

use crate::ndf::{Ndf, forward};

/// An NDF with Smith masking and sampling of visible normals.
///
/// ```text
/// σ(v) = ∫ D(m) max(0, v·m) dω = v_z (1 + Λ(v))          the projected area of the facets, per macro area
/// D_v(m) = D(m) max(0, v·m) / σ(v)                       the density of visible normals, ∫ D_v dω = 1
/// G₁ = 1/(1 + Λ(v)),   G₂ = 1/(1 + Λ(v) + Λ(w))          masking, masking and shadowing of the same heights
/// ```
///
/// - **Directions:** unit vectors `v`, `w` away from the surface, in the frame of the normals.
/// - **Views from below:** where `v.z ≤ 0`, and for NaN, `Λ` is ∞, so that `G₁` and `G₂` are 0. The
///   projected area and the visible normals use the view at the horizon with the same azimuth, for
///   which they are finite. A NaN coordinate is read as 0. A vector without a direction is read as
///   the zenith.
/// - **Backfaces:** `G₁` and `G₂` do not depend on the normal `m`. The caller discards facets with
///   `v·m ≤ 0`.
/// - The trait is dyn-compatible. References to implementations implement it.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Microfacet, Ndf, glam::{Vec2, Vec3}};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let v = Vec3::new(0.6, 0.0, 0.8);
/// let m = ggx.sample_visible(v, Vec2::new(0.3, 0.8));
/// assert!(v.dot(m) > 0.0 && ggx.visible_pdf(v, m) > 0.0);
/// assert!((ggx.projected_area(v) - v.z / ggx.g1(v)).abs() < 1e-6);
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// Smith 1967; Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based
/// BRDFs", eq. 43 (G₁), 83 (D_v) and 99 (G₂); <https://jcgt.org/published/0003/02/03/>.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not implement `Microfacet`",
    label = "`Microfacet` is not implemented for this",
    note = "analytic densities such as `Ggx` implement it; `Masked::new` gives them to maps and tables"
)]
#[doc(alias = "smith")]
#[doc(alias = "masking")]
#[doc(alias = "shadowing")]
pub trait Microfacet: Ndf {
    /// Smith's `Λ(v)`: the ratio of hidden to visible projected area of the facets, in `[0, ∞]`.
    #[must_use]
    fn lambda(&self, v: Vec3) -> f32;

    /// `σ(v)`: the projected area of the facets seen from `v`, per area of the macro surface.
    #[must_use]
    fn projected_area(&self, v: Vec3) -> f32;

    /// Samples a visible normal, for a uniform `u` in `[0, 1)²`.
    ///
    /// The density over solid angle is [`visible_pdf`](Self::visible_pdf).
    #[must_use]
    #[doc(alias = "vndf")]
    fn sample_visible(&self, v: Vec3, u: Vec2) -> Vec3;

    /// The density of visible normals, `D_v(m) = D(m) max(0, v·m)/σ(v)`, in sr⁻¹.
    #[inline]
    #[must_use]
    #[doc(alias = "vndf")]
    fn visible_pdf(&self, v: Vec3, m: Vec3) -> f32 {
        let v = above(v);
        let density = self.d(m) * v.dot(m).max(0.0) / self.projected_area(v);
        if density >= 0.0 { density.min(f32::MAX) } else { 0.0 }
    }

    /// Samples a visible normal for reflections of `v`, for a uniform `u` in `[0, 1)²`.
    ///
    /// The density over solid angle is [`reflecting_pdf`](Self::reflecting_pdf). NDFs leave out
    /// visible normals that reflect `v` below the horizon where they can, so that fewer samples are
    /// wasted. The default is [`sample_visible`](Self::sample_visible).
    #[inline]
    #[must_use]
    #[doc(alias = "bounded vndf")]
    fn sample_reflecting(&self, v: Vec3, u: Vec2) -> Vec3 {
        self.sample_visible(v, u)
    }

    /// The density of [`sample_reflecting`](Self::sample_reflecting), in sr⁻¹.
    ///
    /// It is at least `D_v(m)` where `m` reflects `v` above the horizon. The default is
    /// [`visible_pdf`](Self::visible_pdf).
    #[inline]
    #[must_use]
    #[doc(alias = "bounded vndf")]
    fn reflecting_pdf(&self, v: Vec3, m: Vec3) -> f32 {
        self.visible_pdf(v, m)
    }

    /// `G₁(v)`: the visible fraction of the facets that face `v`, in `[0, 1]`.
    #[inline]
    #[must_use]
    fn g1(&self, v: Vec3) -> f32 {
        1.0 / (1.0 + self.lambda(v))
    }

    /// `G₂(v, w)`: the fraction of the facets visible from both, height-correlated, in `[0, 1]`.
    #[inline]
    #[must_use]
    fn g2(&self, v: Vec3, w: Vec3) -> f32 {
        1.0 / (1.0 + self.lambda(v) + self.lambda(w))
    }

    /// `G₁(v) G₁(w)`: the same with independent masking; at most [`g2`](Self::g2).
    #[inline]
    #[must_use]
    fn g2_separable(&self, v: Vec3, w: Vec3) -> f32 {
        self.g1(v) * self.g1(w)
    }
}

impl<N: Microfacet + ?Sized> Microfacet for &N {
    forward! { |ndf| **ndf;
        lambda(v: Vec3) -> f32;
        projected_area(v: Vec3) -> f32;
        sample_visible(v: Vec3, u: Vec2) -> Vec3;
        visible_pdf(v: Vec3, m: Vec3) -> f32;
        sample_reflecting(v: Vec3, u: Vec2) -> Vec3;
        reflecting_pdf(v: Vec3, m: Vec3) -> f32;
    }
}

/// An NDF whose visible normals are a map of two Gaussian numbers.
///
/// For a view `v` the map `T_v` takes standard Gaussian pairs to normals with the density
/// [`visible_pdf`](Microfacet::visible_pdf). It is continuous in the view, and at the zenith it is
/// [`Ndf::warp_gaussian`]. A bump map with the coordinates `z` therefore has the visible normals
/// `T_v(z)`. [`VisibleFacets`](crate::VisibleFacets) resolves a part of them.
///
/// The map is exact for closed forms. For tables it is approximate, and its density is
/// [`warp_visible_pdf`](Self::warp_visible_pdf).
///
/// - **Domain:** views as for [`Microfacet`]. Every `z` is valid, as for [`Ndf::warp_gaussian`].
/// - **Invisible normals**, with `v·m ≤ 0`, have the density 0. Their coordinates are finite and
///   without meaning.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Microfacet, Ndf, VisibleWarp, glam::{Vec2, Vec3}};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let (v, z) = (Vec3::new(0.6, 0.0, 0.8), Vec2::new(0.7, -1.2));
/// let m = ggx.warp_visible(v, z);
/// assert!(v.dot(m) > 0.0 && ggx.invert_visible(v, m).abs_diff_eq(z, 1e-5));
/// assert!(ggx.warp_visible(Vec3::Z, z).abs_diff_eq(ggx.warp_gaussian(z), 1e-6));
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
#[doc(alias = "vndf")]
pub trait VisibleWarp: Microfacet {
    /// `T_v(z)`: the visible normal of two Gaussian numbers.
    #[must_use]
    fn warp_visible(&self, v: Vec3, z: Vec2) -> Vec3;

    /// `T_v⁻¹(m)`: the Gaussian numbers of a visible normal.
    #[must_use]
    fn invert_visible(&self, v: Vec3, m: Vec3) -> Vec2;

    /// The density over solid angle of `T_v(z)` for standard Gaussian `z`, in sr⁻¹.
    ///
    /// The default is [`visible_pdf`](Microfacet::visible_pdf). Maps whose `T_v` is approximate
    /// return the density of their samples.
    #[inline]
    #[must_use]
    fn warp_visible_pdf(&self, v: Vec3, m: Vec3) -> f32 {
        self.visible_pdf(v, m)
    }
}

impl<N: VisibleWarp + ?Sized> VisibleWarp for &N {
    forward! { |ndf| **ndf;
        warp_visible(v: Vec3, z: Vec2) -> Vec3;
        invert_visible(v: Vec3, m: Vec3) -> Vec2;
        warp_visible_pdf(v: Vec3, m: Vec3) -> f32;
    }
}

/// Returns `v` above the horizon, normalized if its length was far from 1.
///
/// Below the horizon it returns the direction of the horizon with the same azimuth. Without a
/// direction it returns the zenith.
#[inline]
pub(crate) fn above(v: Vec3) -> Vec3 {
    if v.z > 0.0 && (0.25..=4.0).contains(&v.length_squared()) {
        return v;
    }
    let number = |c: f32| if c.is_nan() { 0.0 } else { c };
    Vec3::new(number(v.x), number(v.y), v.z.max(0.0)).try_normalize().unwrap_or(Vec3::Z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Beckmann, Ggx};

    #[test]
    fn views_are_clamped_to_the_horizon() {
        assert_eq!(above(Vec3::new(0.6, 0.0, 0.8)), Vec3::new(0.6, 0.0, 0.8));
        assert_eq!(above(Vec3::new(0.0, -0.6, -0.8)), Vec3::NEG_Y);
        for v in [Vec3::NAN, Vec3::NEG_Z, Vec3::ZERO, Vec3::splat(f32::INFINITY)] {
            assert_eq!(above(v), Vec3::Z, "{v}");
        }
    }

    #[test]
    fn g_is_zero_only_for_views_from_below() {
        let (ggx, beckmann) = (Ggx::new(0.2, 0.4).unwrap(), Beckmann::new(0.2, 0.4).unwrap());
        for ndf in [&ggx as &dyn Microfacet, &beckmann] {
            let (v, w) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.9, 0.3, 0.3).normalize());
            assert!(ndf.g2(v, w) >= ndf.g2_separable(v, w) && ndf.g2(v, w) <= ndf.g1(v).min(ndf.g1(w)));
            assert_eq!(ndf.g1(Vec3::Z), 1.0);
            for below in [Vec3::X, Vec3::NEG_Z, -v, Vec3::NAN] {
                assert_eq!((ndf.g1(below), ndf.g2(v, below)), (0.0, 0.0), "{below}");
                assert!(ndf.projected_area(below) > 0.0 && ndf.projected_area(below).is_finite(), "{below}");
            }
        }
    }
}

/// Tests that NDFs with masking accept every input.
#[cfg(test)]
pub(crate) mod totality {
    use super::*;
    use crate::ndf::totality::{self, BAD, facet};

    /// Asserts that every method returns a valid number, or an infinite Λ, for every input.
    pub(crate) fn check(ndf: &impl Microfacet) {
        totality::check(ndf);
        for (x, y) in BAD.into_iter().flat_map(|x| BAD.map(|y| (x, y))) {
            let (u, v) = (Vec2::new(x, y), Vec3::new(x, 0.3, y));
            facet(ndf.sample_visible(v, u), v);
            facet(ndf.sample_reflecting(v, u), v);
            assert!(ndf.lambda(v) >= 0.0 && ndf.projected_area(v) >= 0.0, "{v}");
            assert!(ndf.visible_pdf(v, v).is_finite() && ndf.reflecting_pdf(v, v) >= 0.0, "{v}");
        }
    }
}
