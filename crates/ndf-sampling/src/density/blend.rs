//! A weighted sum of two NDFs, sampled by choosing one of them.

use glam::{Vec2, Vec3};

use crate::error::{NdfError, in_range};
use crate::microfacet::{Microfacet, above};
use crate::ndf::{Ndf, unit_square};

/// The density `w D_a + (1 − w) D_b` of any two NDFs, without a map from Gaussian coordinates.
///
/// ```text
/// D = w D_a + (1 − w) D_b,   σ = w σ_a + (1 − w) σ_b,   Λ = w Λ_a + (1 − w) Λ_b
/// ```
///
/// In general the sum has no bijection in closed form. If both NDFs are isotropic, use
/// [`Mixture`](crate::Mixture), which has one. For others `NdfMap::from_fn(width, height,
/// Measure::ProjectedSolidAngle, Reconstruction::Constant, |m| blend.d(m))` computes one.
/// Samples choose an NDF by `u.x` and reuse the remainder of that number, so the map from `u` is
/// discontinuous there.
///
/// ```
/// use asperity_ndf_sampling::{Blend, BlinnPhong, Ggx, glam::{Vec2, Vec3}};
///
/// // A glossy lobe on a third of the surface, a diffuse one on the rest.
/// let blend = Blend::new(Ggx::new(0.1, 0.3)?, BlinnPhong::new(0.0)?, 1.0 / 3.0)?;
/// assert!(blend.d(Vec3::X) == 0.0 && blend.sample(Vec2::new(0.9, 0.2)).z > 0.0);
/// assert!(blend.lambda(Vec3::new(0.6, 0.0, 0.8)) > 0.0);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, section 6, add a diffuse lobe to a distribution. Projected areas
/// are integrals of the density, so they and Λ add up the same way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blend<A, B> {
    pub(crate) a: A,
    pub(crate) b: B,
    /// The weight of the first NDF.
    pub(crate) weight: f32,
}

impl<A, B> Blend<A, B> {
    /// Creates the sum of `weight · a` and `(1 − weight) · b`.
    ///
    /// # Errors
    /// A weight that is not between 0 and 1.
    pub fn new(a: A, b: B, weight: f32) -> Result<Self, NdfError> {
        in_range("weight", weight, [0.0, 1.0]).map(|weight| Self { a, b, weight })
    }

    /// `w f(a) + (1 − w) f(b)`, skipping an NDF of weight 0, whose value could be infinite.
    fn sum(&self, a: impl Fn(&A) -> f32, b: impl Fn(&B) -> f32) -> f32 {
        if self.weight >= 1.0 {
            a(&self.a)
        } else if self.weight <= 0.0 {
            b(&self.b)
        } else {
            self.weight * a(&self.a) + (1.0 - self.weight) * b(&self.b)
        }
    }

    /// A sample of `a` with this probability, otherwise of `b`, from the remainder of `u`.
    fn choose(
        &self,
        probability: f32,
        u: Vec2,
        a: impl Fn(&A, Vec2) -> Vec3,
        b: impl Fn(&B, Vec2) -> Vec3,
    ) -> Vec3 {
        let u = unit_square(u);
        if u.x < probability {
            a(&self.a, Vec2::new(u.x / probability, u.y))
        } else {
            b(&self.b, Vec2::new((u.x - probability) / (1.0 - probability), u.y))
        }
    }
}

impl<A: Ndf, B: Ndf> Blend<A, B> {
    /// The density `D(m)` of facet normals, in sr⁻¹, with `∫ D cos θ dω = 1`.
    #[must_use]
    pub fn d(&self, m: Vec3) -> f32 {
        self.sum(|a| a.d(m), |b| b.d(m)).min(f32::MAX)
    }

    /// A normal with the density `D` over the macro surface, for a uniform `u` in `[0, 1)²`.
    #[must_use]
    pub fn sample(&self, u: Vec2) -> Vec3 {
        self.choose(self.weight, u, Ndf::sample, Ndf::sample)
    }
}

impl<A: Microfacet, B: Microfacet> Blend<A, B> {
    /// Smith's `Λ(v)`, see [`Microfacet::lambda`].
    #[must_use]
    pub fn lambda(&self, v: Vec3) -> f32 {
        self.sum(|a| a.lambda(v), |b| b.lambda(v))
    }

    /// The projected area `σ(v)`, see [`Microfacet::projected_area`].
    #[must_use]
    pub fn projected_area(&self, v: Vec3) -> f32 {
        self.sum(|a| a.projected_area(v), |b| b.projected_area(v))
    }

    /// A visible normal, see [`Microfacet::sample_visible`].
    #[must_use]
    pub fn sample_visible(&self, v: Vec3, u: Vec2) -> Vec3 {
        let probability = self.weight * self.a.projected_area(v) / self.projected_area(v);
        self.choose(probability, u, |a, u| a.sample_visible(v, u), |b, u| b.sample_visible(v, u))
    }

    /// The density of visible normals, see [`Microfacet::visible_pdf`].
    #[must_use]
    pub fn visible_pdf(&self, v: Vec3, m: Vec3) -> f32 {
        let v = above(v);
        let density = self.d(m) * v.dot(m).max(0.0) / self.projected_area(v);
        if density >= 0.0 { density.min(f32::MAX) } else { 0.0 }
    }
}
