//! The trait that every normal density function fulfils.

use glam::{Vec2, Vec3};

use crate::coordinates::GaussianSplit;
use crate::numeric::normal_distribution::inverse_phi;
use asperity_core::math;

/// A normal density function together with a bijection from Gaussian coordinates to its normals.
///
/// ```text
/// ∫ D(m) cos θ dω = 1,        m = T(z),  z ~ N(0, I)   ⇒   m has the density D over dn_x dn_y = cos θ dω
/// ```
///
/// - **Directions:** unit vectors in a frame whose z axis is the macro normal.
/// - **Coordinates:** `z` counts standard deviations. Every implementation of this crate is total: a NaN coordinate is read
///   as 0 and coordinates beyond ±13 (about ±5.4 for [`NdfMap`](crate::NdfMap)) as that bound; a direction with
///   `m.z ≤ 0` or a NaN has the density 0, and its Gaussian coordinates are finite.
/// - The trait is dyn-compatible, and a reference to an implementation is one.
///
/// ```
/// use asperity_ndf_sampling::{Beckmann, Ggx, Ndf, glam::Vec2};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let beckmann = Beckmann::isotropic(0.3)?;
/// for ndf in [&ggx as &dyn Ndf, &beckmann] {
///     let z = Vec2::new(0.7, -1.2);
///     let m = ndf.from_gaussian(z);
///     assert!((m.length() - 1.0).abs() < 1e-6 && m.z > 0.0);
///     assert!(ndf.to_gaussian(m).abs_diff_eq(z, 1e-5));
/// }
/// # Ok::<(), asperity_ndf_sampling::RangeError>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, "Real-Time Bump Map Synthesis", section 4. The paper draws normals through tables; that the
/// density over the map of normals is D itself, not `D/cos θ` or `D cos θ`, follows from sampling a bump map uniformly over
/// the macro surface.
#[expect(clippy::wrong_self_convention, reason = "from_gaussian is T of this NDF, not a constructor")]
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no normal density",
    label = "`Ndf` is not implemented for this",
    note = "pass `Ggx`, `Beckmann`, `NdfMap` or a reference to one, or implement `density`, `from_gaussian` and `to_gaussian`",
    note = "directions and coordinates are those of `asperity_ndf_sampling::glam`"
)]
#[doc(alias = "normal distribution function")]
#[doc(alias = "importance sampling")]
#[doc(alias = "pdf")]
pub trait Ndf {
    /// The density `D(m)` of facet normals, in sr⁻¹, with `∫ D cos θ dω = 1`.
    #[must_use]
    fn density(&self, m: Vec3) -> f32;

    /// `T(z)`: if `z` is standard Gaussian in the plane, `T(z)` has the density `D` over the macro surface.
    #[must_use]
    fn from_gaussian(&self, z: Vec2) -> Vec3;

    /// `T⁻¹(m)`: the Gaussian coordinates of the normal `m`.
    #[must_use]
    fn to_gaussian(&self, m: Vec3) -> Vec2;

    /// The density of slopes `(m_x, m_y)/m_z`: `P(s) = D(m) m_z⁴` with `m = (s, 1)/√(1 + |s|²)`, `∫ P ds = 1`.
    ///
    /// 0 for a slope whose normal is at the horizon in `f32`, and for NaN.
    #[inline]
    #[must_use]
    fn slope_density(&self, slope: Vec2) -> f32 {
        let up = 1.0 / math::sqrt(slope.x * slope.x + slope.y * slope.y + 1.0);
        let (m, up2) = (Vec3::new(slope.x * up, slope.y * up, up), up * up);
        let density = self.density(m) * up2 * up2;
        if density >= 0.0 { density } else { 0.0 }
    }

    /// A normal with the density `D` over the macro surface, [`sample_density`](Self::sample_density) over solid angle, for a
    /// uniform `u` in `[0, 1)²`.
    ///
    /// `T(Φ⁻¹(u))` unless the density has a cheaper map, which it then documents. Numbers outside the square are moved to
    /// it, and a NaN is read as 0.
    #[inline]
    #[must_use]
    #[doc(alias = "importance sampling")]
    fn sample(&self, u: Vec2) -> Vec3 {
        let z = unit_square(u).to_array().map(|u| inverse_phi(f64::from(u)) as f32);
        self.from_gaussian(Vec2::from(z))
    }

    /// `D(m) m_z`: the density of [`sample`](Self::sample) over solid angle, in sr⁻¹.
    #[inline]
    #[must_use]
    #[doc(alias = "pdf")]
    fn sample_density(&self, m: Vec3) -> f32 {
        // Below the horizon and for NaN the density is 0, and `max` takes the number; 0 times infinity is read as 0.
        let density = self.density(m) * m.z.max(0.0);
        if density >= 0.0 { density.min(f32::MAX) } else { 0.0 }
    }

    /// `p_s(h | z_b)`: what is left of the density where a part of it is resolved, in sr⁻¹; see
    /// [`conditional_density`](crate::conditional_density).
    ///
    /// [`GaussianSplit::weigh`] of `D(h)` and `T⁻¹(h)`, unless the density has a form of its own, which it then documents.
    #[inline]
    #[must_use]
    fn conditional_density(&self, h: Vec3, split: GaussianSplit) -> f32 {
        let density = self.density(h);
        if density > 0.0 { split.weigh(density, self.to_gaussian(h)) } else { 0.0 }
    }

    /// [`conditional_density`](Self::conditional_density) at one point for many half vectors, as under many lights: of as many as
    /// both slices have, bit for bit.
    ///
    /// [`Ggx`](crate::Ggx) and [`Beckmann`](crate::Beckmann) take them in SIMD lanes.
    #[inline]
    fn conditional_densities(&self, h: &[Vec3], split: GaussianSplit, densities: &mut [f32]) {
        for (density, &h) in densities.iter_mut().zip(h) {
            *density = self.conditional_density(h, split);
        }
    }
}

/// Methods of a trait by those of another value.
macro_rules! forward {
    (|$this:ident| $to:expr; $($name:ident($($argument:ident: $type:ty),+) -> $result:ty;)+) => {$(
        #[inline]
        fn $name(&self, $($argument: $type),+) -> $result {
            let $this = self;
            $to.$name($($argument),+)
        }
    )+};
}
pub(crate) use forward;

/// All methods of [`Ndf`] by those of another density.
macro_rules! forward_ndf {
    (|$this:ident| $to:expr) => {
        $crate::ndf::forward! { |$this| $to;
            density(m: glam::Vec3) -> f32;
            from_gaussian(z: glam::Vec2) -> glam::Vec3;
            to_gaussian(m: glam::Vec3) -> glam::Vec2;
            slope_density(slope: glam::Vec2) -> f32;
            sample(u: glam::Vec2) -> glam::Vec3;
            sample_density(m: glam::Vec3) -> f32;
            conditional_density(h: glam::Vec3, split: $crate::coordinates::GaussianSplit) -> f32;
        }

        #[inline]
        fn conditional_densities(
            &self,
            h: &[glam::Vec3],
            split: $crate::coordinates::GaussianSplit,
            densities: &mut [f32],
        ) {
            let $this = self;
            $to.conditional_densities(h, split, densities);
        }
    };
}
pub(crate) use forward_ndf;

impl<N: Ndf + ?Sized> Ndf for &N {
    forward_ndf!(|ndf| **ndf);
}

/// `u` with both numbers in `[0, 1 − 2⁻²⁴]`; a NaN is read as 0.
#[inline]
pub(crate) fn unit_square(u: Vec2) -> Vec2 {
    let bound = |c: f32| if c > 0.0 { c.min(1.0 - 0.5 * f32::EPSILON) } else { 0.0 };
    Vec2::new(bound(u.x), bound(u.y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn infinite_vectors_have_the_density_zero_for_samples() {
        let (ggx, beckmann) = (crate::Ggx::new(0.2, 0.4).unwrap(), crate::Beckmann::new(0.2, 0.4).unwrap());
        for ndf in [&ggx as &dyn Ndf, &beckmann] {
            for m in [Vec3::new(0.0, 0.0, f32::INFINITY), Vec3::INFINITY, Vec3::new(1.0, f32::NAN, 1.0)] {
                assert_eq!(ndf.sample_density(m), 0.0, "{m}");
            }
        }
    }

    /// A density with nothing but what the trait asks for.
    struct Plain(crate::Ggx);

    impl Ndf for Plain {
        fn density(&self, m: Vec3) -> f32 {
            self.0.density(m)
        }

        fn from_gaussian(&self, z: Vec2) -> Vec3 {
            self.0.from_gaussian(z)
        }

        fn to_gaussian(&self, m: Vec3) -> Vec2 {
            self.0.to_gaussian(m)
        }
    }

    #[test]
    fn many_conditional_densities_are_those_of_single_calls_as_many_as_both_slices_have() {
        let ggx = crate::Ggx::new(0.2, 0.4).unwrap();
        let (plain, split) = (Plain(ggx), GaussianSplit::new(Vec2::new(0.4, -0.9), 0.6));
        let halves: [Vec3; 40] = core::array::from_fn(|k| {
            let across = [7 * k % 11, 5 * k % 13].map(|x| 0.1 * x as f32 - 0.5);
            Vec3::new(across[0], across[1], 0.2 + 0.02 * k as f32).normalize()
        });
        for ndf in [&ggx as &dyn Ndf, &plain, &&plain] {
            for (len, room) in [(40, 40), (33, 40), (40, 7), (1, 3), (3, 1), (0, 4), (4, 0)] {
                let mut densities = [f32::NAN; 40];
                ndf.conditional_densities(&halves[..len], split, &mut densities[..room]);
                for k in 0..40 {
                    let expected = ndf.conditional_density(halves[k], split);
                    let written = k < len.min(room);
                    assert!(if written { densities[k] == expected } else { densities[k].is_nan() }, "{k}");
                }
            }
        }
        // p_s(h | z_b) = D(h) weighed at T⁻¹(h).
        for h in halves {
            let expected = split.weigh(ggx.density(h), ggx.to_gaussian(h));
            assert!(expected > 0.0);
            assert_eq!(plain.conditional_density(h, split), expected);
            assert_abs_diff_eq!(ggx.conditional_density(h, split), expected, epsilon = 2e-5 * expected);
        }
    }

    #[test]
    fn numbers_are_moved_to_the_square() {
        assert_eq!(unit_square(Vec2::new(f32::NAN, 1.0)), Vec2::new(0.0, 0.999_999_94));
    }
}

/// Totality of densities, for their tests.
#[cfg(test)]
pub(crate) mod totality {
    use super::*;

    pub(crate) const BAD: [f32; 10] =
        [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1e-40, 1e38, -1e38, -1.0, 0.5];

    /// Asserts that `m` is a unit vector above the horizon.
    pub(crate) fn facet(m: Vec3, from: impl core::fmt::Debug) {
        asperity_core::assert_abs_diff_eq!(m.length(), 1.0, epsilon = 1e-6, "{from:?}: {m}");
        assert!(m.z > 0.0, "{from:?}: {m}");
    }

    /// Asserts that every call gives a number on every input.
    pub(crate) fn check(ndf: &impl Ndf) {
        for (x, y) in BAD.into_iter().flat_map(|x| BAD.map(|y| (x, y))) {
            let z = Vec2::new(x, y);
            facet(ndf.from_gaussian(z), z);
            facet(ndf.sample(z), z);
            for m in BAD.map(|up| z.extend(up)) {
                let density = ndf.density(m);
                assert!((0.0..=f32::MAX).contains(&density), "{m}: {density}");
                assert!(m.z > 0.0 || density == 0.0, "below the horizon at {m}: {density}");
                assert!(ndf.to_gaussian(m).is_finite(), "{m}: {}", ndf.to_gaussian(m));
            }
        }
    }
}
