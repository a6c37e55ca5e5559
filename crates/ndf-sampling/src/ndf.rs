//! The `Ndf` trait.

use glam::{Vec2, Vec3};

use crate::coordinates::GaussianSplit;
use crate::numeric::normal_distribution::inverse_gaussian_cdf;
use asperity_core::math;

/// A normal distribution function with a bijection from Gaussian coordinates to normals.
///
/// ```text
/// ∫ D(m) cos θ dω = 1,        m = T(z),  z ~ N(0, I)   ⇒   m has the density D over dn_x dn_y = cos θ dω
/// ```
///
/// - **Directions:** unit vectors in a frame whose z axis is the macro normal.
/// - **Coordinates:** `z` is in standard deviations. Every implementation of this crate accepts
///   every input. A NaN coordinate is read as 0. Coordinates beyond ±13 (about ±5.4 for
///   [`NdfMap`](crate::NdfMap)) are clamped to that bound. A direction with `m.z ≤ 0` or NaN has
///   density 0 and finite Gaussian coordinates.
/// - The trait is dyn-compatible. References to implementations implement it.
///
/// ```
/// use asperity_ndf_sampling::{Beckmann, Ggx, Ndf, glam::Vec2};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let beckmann = Beckmann::isotropic(0.3)?;
/// for ndf in [&ggx as &dyn Ndf, &beckmann] {
///     let z = Vec2::new(0.7, -1.2);
///     let m = ndf.warp_gaussian(z);
///     assert!((m.length() - 1.0).abs() < 1e-6 && m.z > 0.0);
///     assert!(ndf.invert(m).abs_diff_eq(z, 1e-5));
/// }
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, "Real-Time Bump Map Synthesis", section 4. The paper draws normals
/// through tables. The density over the map of normals is D itself, not `D/cos θ` or `D cos θ`,
/// because a bump map is sampled uniformly over the macro surface.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not implement `Ndf`",
    label = "not a normal distribution function",
    note = "pass `Ggx`, `Beckmann`, `NdfMap` or a reference to one, or implement `d`, `warp_gaussian` and `invert`",
    note = "directions and coordinates use the vector types of `asperity_ndf_sampling::glam`"
)]
#[doc(alias = "normal distribution function")]
#[doc(alias = "importance sampling")]
pub trait Ndf {
    /// The density `D(m)` of facet normals, in sr⁻¹, with `∫ D cos θ dω = 1`.
    #[must_use]
    fn d(&self, m: Vec3) -> f32;

    /// `T(z)`: a normal with the density `D` over the macro surface, for standard Gaussian `z`.
    #[must_use]
    fn warp_gaussian(&self, z: Vec2) -> Vec3;

    /// `T⁻¹(m)`: the Gaussian coordinates of the normal `m`.
    #[must_use]
    fn invert(&self, m: Vec3) -> Vec2;

    /// The density of slopes `(m_x, m_y)/m_z`: `P(s) = D(m) m_z⁴` with `m = (s, 1)/√(1 + |s|²)`, `∫
    /// P ds = 1`.
    ///
    /// Returns 0 for NaN and for a slope whose normal is at the horizon in `f32`.
    #[inline]
    #[must_use]
    fn slope_density(&self, slope: Vec2) -> f32 {
        let up = 1.0 / math::sqrt(slope.x * slope.x + slope.y * slope.y + 1.0);
        let (m, up2) = (Vec3::new(slope.x * up, slope.y * up, up), up * up);
        let density = self.d(m) * up2 * up2;
        if density >= 0.0 { density } else { 0.0 }
    }

    /// Samples a normal with the density `D` over the macro surface, for a uniform `u` in `[0,
    /// 1)²`.
    ///
    /// The density over solid angle is [`pdf`](Self::pdf).
    ///
    /// The default is `T(Φ⁻¹(u))`. NDFs with a cheaper map document it. Numbers outside the square
    /// are clamped to it. NaN is read as 0.
    #[inline]
    #[must_use]
    #[doc(alias = "importance sampling")]
    fn sample(&self, u: Vec2) -> Vec3 {
        let z = unit_square(u).to_array().map(|u| inverse_gaussian_cdf(f64::from(u)) as f32);
        self.warp_gaussian(Vec2::from(z))
    }

    /// The density `D(m) m_z` of [`sample`](Self::sample) over solid angle, in sr⁻¹.
    #[inline]
    #[must_use]
    fn pdf(&self, m: Vec3) -> f32 {
        // The density is 0 below the horizon and for NaN. `max` drops NaN, and 0 · ∞ is read as 0.
        let density = self.d(m) * m.z.max(0.0);
        if density >= 0.0 { density.min(f32::MAX) } else { 0.0 }
    }

    /// The density `p_s(h | z_b)` of the unresolved facets, in sr⁻¹.
    ///
    /// See [`residual_ndf`](crate::residual_ndf).
    ///
    /// The default is [`GaussianSplit::weigh`] of `D(h)` and `T⁻¹(h)`. NDFs with their own form
    /// document it.
    #[inline]
    #[must_use]
    fn residual_ndf(&self, h: Vec3, split: GaussianSplit) -> f32 {
        let density = self.d(h);
        if density > 0.0 { split.weigh(density, self.invert(h)) } else { 0.0 }
    }

    /// Evaluates [`residual_ndf`](Self::residual_ndf) at one point for many half
    /// vectors.
    ///
    /// Processes as many as the shorter slice has. Results are bit-identical to single calls.
    ///
    /// [`Ggx`](crate::Ggx) and [`Beckmann`](crate::Beckmann) use SIMD.
    #[inline]
    fn residual_ndf_batch(&self, h: &[Vec3], split: GaussianSplit, densities: &mut [f32]) {
        for (density, &h) in densities.iter_mut().zip(h) {
            *density = self.residual_ndf(h, split);
        }
    }
}

/// Implements methods of a trait by calling the same methods of another value.
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

/// Implements all methods of [`Ndf`] by calling those of another NDF.
macro_rules! forward_ndf {
    (|$this:ident| $to:expr) => {
        $crate::ndf::forward! { |$this| $to;
            d(m: glam::Vec3) -> f32;
            warp_gaussian(z: glam::Vec2) -> glam::Vec3;
            invert(m: glam::Vec3) -> glam::Vec2;
            slope_density(slope: glam::Vec2) -> f32;
            sample(u: glam::Vec2) -> glam::Vec3;
            pdf(m: glam::Vec3) -> f32;
            residual_ndf(h: glam::Vec3, split: $crate::coordinates::GaussianSplit) -> f32;
        }

        #[inline]
        fn residual_ndf_batch(
            &self,
            h: &[glam::Vec3],
            split: $crate::coordinates::GaussianSplit,
            densities: &mut [f32],
        ) {
            let $this = self;
            $to.residual_ndf_batch(h, split, densities);
        }
    };
}
pub(crate) use forward_ndf;

impl<N: Ndf + ?Sized> Ndf for &N {
    forward_ndf!(|ndf| **ndf);
}

/// `u` with both numbers clamped to `[0, 1 − 2⁻²⁴]`; NaN is read as 0.
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
    fn sample_density_of_infinite_vectors_is_zero() {
        let (ggx, beckmann) = (crate::Ggx::new(0.2, 0.4).unwrap(), crate::Beckmann::new(0.2, 0.4).unwrap());
        for ndf in [&ggx as &dyn Ndf, &beckmann] {
            for m in [Vec3::new(0.0, 0.0, f32::INFINITY), Vec3::INFINITY, Vec3::new(1.0, f32::NAN, 1.0)] {
                assert_eq!(ndf.pdf(m), 0.0, "{m}");
            }
        }
    }

    /// An NDF with only the required methods of the trait.
    struct Plain(crate::Ggx);

    impl Ndf for Plain {
        fn d(&self, m: Vec3) -> f32 {
            self.0.d(m)
        }

        fn warp_gaussian(&self, z: Vec2) -> Vec3 {
            self.0.warp_gaussian(z)
        }

        fn invert(&self, m: Vec3) -> Vec2 {
            self.0.invert(m)
        }
    }

    #[test]
    fn conditional_densities_equal_single_calls_up_to_the_shorter_slice() {
        let ggx = crate::Ggx::new(0.2, 0.4).unwrap();
        let (plain, split) = (Plain(ggx), GaussianSplit::new(Vec2::new(0.4, -0.9), 0.6));
        let halves: [Vec3; 40] = core::array::from_fn(|k| {
            let across = [7 * k % 11, 5 * k % 13].map(|x| 0.1 * x as f32 - 0.5);
            Vec3::new(across[0], across[1], 0.2 + 0.02 * k as f32).normalize()
        });
        for ndf in [&ggx as &dyn Ndf, &plain, &&plain] {
            for (len, room) in [(40, 40), (33, 40), (40, 7), (1, 3), (3, 1), (0, 4), (4, 0)] {
                let mut densities = [f32::NAN; 40];
                ndf.residual_ndf_batch(&halves[..len], split, &mut densities[..room]);
                for k in 0..40 {
                    let expected = ndf.residual_ndf(halves[k], split);
                    let written = k < len.min(room);
                    assert!(if written { densities[k] == expected } else { densities[k].is_nan() }, "{k}");
                }
            }
        }
        // p_s(h | z_b) = D(h) weighted at T⁻¹(h).
        for h in halves {
            let expected = split.weigh(ggx.d(h), ggx.invert(h));
            assert!(expected > 0.0);
            assert_eq!(plain.residual_ndf(h, split), expected);
            assert_abs_diff_eq!(ggx.residual_ndf(h, split), expected, epsilon = 2e-5 * expected);
        }
    }

    #[test]
    fn unit_square_clamps() {
        assert_eq!(unit_square(Vec2::new(f32::NAN, 1.0)), Vec2::new(0.0, 0.999_999_94));
    }
}

/// Tests that NDFs accept every input.
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

    /// Asserts that every method returns a valid number for every input.
    pub(crate) fn check(ndf: &impl Ndf) {
        for (x, y) in BAD.into_iter().flat_map(|x| BAD.map(|y| (x, y))) {
            let z = Vec2::new(x, y);
            facet(ndf.warp_gaussian(z), z);
            facet(ndf.sample(z), z);
            for m in BAD.map(|up| z.extend(up)) {
                let density = ndf.d(m);
                assert!((0.0..=f32::MAX).contains(&density), "{m}: {density}");
                assert!(m.z > 0.0 || density == 0.0, "below the horizon at {m}: {density}");
                assert!(ndf.invert(m).is_finite(), "{m}: {}", ndf.invert(m));
            }
        }
    }
}
