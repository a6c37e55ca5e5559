//! The two rules for the transition from bump map to BRDF with distance.

use asperity_ndf_sampling::{Frame, GaussianSplit, Ndf, residual_ndf};
use glam::{Vec2, Vec3};

use crate::level_of_detail::gaussian_field::ResolvedBumps;
use crate::math::{clamp_to, sqrt};

/// Shading from afar: the NDF at the half vector.
///
/// ```text
/// radiance / light = p(h)
/// ```
///
/// - **Domain:** unit half vector `h` in the frame of the macro surface; 0 for `h.z ≤ 0`, for a
///   zero vector and for NaN.
/// - **Range:** at least 0, in sr⁻¹.
///
/// No Fresnel term and no shadowing: Kautz, Heidrich, Seidel 2001, *Real-Time Bump Map Synthesis*,
/// §3.1.
#[must_use]
pub fn far_field<N: Ndf + ?Sized>(ndf: &N, h: Vec3) -> f32 {
    if h.z > 0.0 && h.is_finite() { ndf.d(h) } else { 0.0 }
}

/// Shading of one facet with the whole NDF in the frame of the facet.
///
/// ```text
/// radiance / light = p(h_m),   h_m = (h·t_m, h·b_m, h·n_m)
/// ```
///
/// - **Domain:** unit `h` and the frame of the facet, both in the frame of the macro surface; 0 for
///   `h.z ≤ 0`, for a zero vector and for NaN, and where `h` is behind the facet.
/// - **Range:** at least 0, in sr⁻¹.
///
/// The frame is [`Frame::from_normal`] of the normal of a facet, or an entry of the normal table L
/// at [`facet_coordinates`]. Kautz, Heidrich, Seidel 2001, §5.1.
#[must_use]
pub fn shade_facet<N: Ndf + ?Sized>(ndf: &N, facet: &Frame, h: Vec3) -> f32 {
    if h.z > 0.0 { far_field(ndf, facet.to_local(h)) } else { 0.0 }
}

/// Gaussian coordinates of the facet of the `Fractal` rule.
///
/// They are the noise, with its first octave faded in from the flat normal.
///
/// ```text
/// z_m = z_flat + fade (z − z_flat),   T(z_flat) = (0, 0, 1)
/// ```
///
/// `z_flat` is 0 for an NDF that is symmetric in x and y. For other NDFs 0 is the median, which is
/// tilted.
#[must_use]
pub fn facet_coordinates<N: Ndf + ?Sized>(ndf: &N, coordinates: ResolvedBumps) -> Vec2 {
    let ResolvedBumps { z, blend: fade, .. } = coordinates;
    if fade >= 1.0 {
        return z;
    }
    let flat = ndf.invert(Vec3::Z);
    flat + clamp_to(fade, 1.0) * (z - flat)
}

/// The facets that a pixel sees while it resolves a part of the bump map.
///
/// Both rules equal the far field `p(h)` where nothing is resolved, and change continuously from
/// there.
///
/// ```
/// use asperity_shading::level_of_detail::ResolvedBumps;
/// use asperity_shading::{Ggx, LevelOfDetail, far_field, glam::{Vec2, Vec3}};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let h = Vec3::new(0.1, 0.2, 1.0).normalize();
/// let near = ResolvedBumps { z: Vec2::new(0.8, -0.3), variance: 0.75, blend: 1.0 };
/// for rule in [LevelOfDetail::Exact, LevelOfDetail::Fractal] {
///     assert_eq!(rule.radiance(&ggx, h, ResolvedBumps::FAR), far_field(&ggx, h));
///     assert_ne!(rule.radiance(&ggx, h, near), far_field(&ggx, h));
/// }
/// # Ok::<(), asperity_shading::ndf_sampling::NdfError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum LevelOfDetail {
    /// The conditional NDF of the unresolved part. Its mean over the surface is `p(h)` at every
    /// zoom.
    ///
    /// ```text
    /// p_s(h | z) = p(h) Π_k N(z_k(h); √s z_k, 1 − s) / N(z_k(h); 0, 1),   z(h) = T⁻¹(h),   k = 1, 2
    /// ```
    ///
    /// It is a martingale in zoom as well: its mean over a newly resolved octave is the previous
    /// value. See [`residual_ndf`].
    #[default]
    Exact,
    /// Every facet is shaded with the whole NDF `p`, as if it consisted of facets itself.
    ///
    /// ```text
    /// p(h_m),   h_m = h in the frame of the facet T(z)
    /// ```
    ///
    /// This is the rule of Kautz, Heidrich, Seidel 2001, §3.2 and §5.1, for a fractal surface. It
    /// convolves `p` with itself, so the zoomed surface is rougher than the far one. The mean over
    /// a patch of GGX (0.2, 0.4) is 0.37 of the far field at the peak and 1.4 of it in the tail.
    Fractal,
}

impl LevelOfDetail {
    /// The NDF of a pixel at `h`: its radiance per unit of light, without Fresnel term and
    /// shadowing.
    ///
    /// - **Domain:** unit half vector `h` in the frame of the macro surface; `h.z ≤ 0`, a zero
    ///   vector and NaN return 0. The fraction is clamped to
    ///   [`GaussianSplit::MAX_RESOLVED_VARIANCE`](asperity_ndf_sampling::GaussianSplit::MAX_RESOLVED_VARIANCE),
    ///   NaN is read as 0. A NaN in `z` is read as 0. `blend` is clamped to `[0, 1]`, NaN is read
    ///   as
    ///   0.
    /// - **Range:** at least 0, finite, in sr⁻¹. Where nothing is resolved it is [`far_field`], bit
    ///   for bit.
    #[must_use]
    pub fn radiance<N: Ndf + ?Sized>(self, ndf: &N, h: Vec3, coordinates: ResolvedBumps) -> f32 {
        match self {
            Self::Exact if h.z > 0.0 && h.is_finite() => {
                residual_ndf(ndf, h, coordinates.z, coordinates.variance)
            }
            Self::Exact => 0.0,
            Self::Fractal => shade_facet(ndf, &Frame::from_normal(self.normal(ndf, coordinates)), h),
        }
    }

    /// The radiances of a pixel under many lights, bit-identical to [`radiance`](Self::radiance).
    ///
    /// Processes as many half vectors as the shorter slice has.
    ///
    /// The common part of the lights is computed once: the split of the Gaussian coordinates, and
    /// the frame of the facet. `Exact` processes half vectors of [`Ggx`](crate::Ggx) and
    /// [`Beckmann`](crate::Beckmann) with SIMD under the feature `simd`.
    ///
    /// ```
    /// use asperity_shading::level_of_detail::ResolvedBumps;
    /// use asperity_shading::{Ggx, LevelOfDetail, glam::{Vec2, Vec3}};
    ///
    /// let ggx = Ggx::new(0.2, 0.4)?;
    /// let near = ResolvedBumps { z: Vec2::new(0.8, -0.3), variance: 0.75, blend: 1.0 };
    /// let halves = [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::NEG_Z];
    /// let mut radiances = [0.0; 3];
    /// LevelOfDetail::Exact.radiances(&ggx, &halves, near, &mut radiances);
    /// assert_eq!(radiances, halves.map(|h| LevelOfDetail::Exact.radiance(&ggx, h, near)));
    /// # Ok::<(), asperity_shading::ndf_sampling::NdfError>(())
    /// ```
    pub fn radiances<N: Ndf + ?Sized>(
        self,
        ndf: &N,
        halves: &[Vec3],
        coordinates: ResolvedBumps,
        radiances: &mut [f32],
    ) {
        let frame = match self {
            Self::Exact => {
                let split = GaussianSplit::new(coordinates.z, coordinates.variance);
                ndf.residual_ndf_batch(halves, split, radiances);
                None
            }
            Self::Fractal => Some(Frame::from_normal(self.normal(ndf, coordinates))),
        };
        for (radiance, &h) in radiances.iter_mut().zip(halves) {
            match &frame {
                Some(facet) => *radiance = shade_facet(ndf, facet, h),
                None if h.z > 0.0 && h.is_finite() => {}
                None => *radiance = 0.0,
            }
        }
    }

    /// The normal of the bump map in the frame of the macro surface, for a normal map or a mirror.
    ///
    /// ```text
    /// Fractal: T(z_flat + fade (z − z_flat))
    /// Exact:   T(√s z)
    /// ```
    ///
    /// A unit vector with `z > 0`. The normal of the `Fractal` rule is (0, 0, 1) where nothing is
    /// resolved. The normal of the `Exact` rule is the center, in Gaussian coordinates, of the
    /// normals below the pixel. Where nothing is resolved it is `T(0)`, which is (0, 0, 1) for an
    /// NDF that is symmetric in x and y. Where everything is resolved it is `T(z)`.
    #[must_use]
    pub fn normal<N: Ndf + ?Sized>(self, ndf: &N, coordinates: ResolvedBumps) -> Vec3 {
        match self {
            Self::Exact => ndf.warp_gaussian(sqrt(clamp_to(coordinates.variance, 1.0)) * coordinates.z),
            Self::Fractal if coordinates.blend > 0.0 => {
                ndf.warp_gaussian(facet_coordinates(ndf, coordinates))
            }
            // Bit for bit, since an inversion need not return to the flat normal exactly.
            Self::Fractal => Vec3::Z,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;
    use asperity_ndf_sampling::{Beckmann, Ggx};

    fn near(x: f32, y: f32, variance: f32, blend: f32) -> ResolvedBumps {
        ResolvedBumps { z: Vec2::new(x, y), variance, blend }
    }

    #[test]
    fn unresolved_radiance_is_bit_identical_to_the_far_field() {
        let ndfs: [&dyn Ndf; 2] = [&Ggx::new(0.2, 0.4).unwrap(), &Beckmann::isotropic(0.3).unwrap()];
        for ndf in ndfs {
            for h in [Vec3::Z, Vec3::new(0.3, -0.4, 0.9).normalize(), Vec3::new(-0.9, 0.3, 0.1).normalize()] {
                for rule in [LevelOfDetail::Exact, LevelOfDetail::Fractal] {
                    for z in [Vec2::ZERO, Vec2::new(1.5, -2.0), Vec2::NAN] {
                        let got = rule.radiance(ndf, h, ResolvedBumps { z, ..ResolvedBumps::FAR });
                        assert_eq!(got.to_bits(), far_field(ndf, h).to_bits(), "{rule:?}, {h}, {z}");
                    }
                }
            }
        }
    }

    #[test]
    fn fractal_shades_in_the_frame_of_the_facet() {
        let ndf = Ggx::new(0.2, 0.4).unwrap();
        let coordinates = near(0.8, -1.1, 0.75, 1.0);
        let m = LevelOfDetail::Fractal.normal(&ndf, coordinates);
        assert_eq!(m, ndf.warp_gaussian(coordinates.z));
        // Straight at the facet the peak of the whole NDF is visible.
        let peak = LevelOfDetail::Fractal.radiance(&ndf, m, coordinates);
        assert_abs_diff_eq!(peak / ndf.d(Vec3::Z), 1.0, epsilon = 1e-4);
    }

    #[test]
    fn bump_fades_in_from_the_flat_normal() {
        let ndf = Ggx::new(0.2, 0.4).unwrap();
        for rule in [LevelOfDetail::Exact, LevelOfDetail::Fractal] {
            assert_eq!(rule.normal(&ndf, ResolvedBumps::FAR), Vec3::Z);
            let mut tilt = 0.0;
            for i in 1..=100 {
                let w = i as f32 / 100.0;
                let normal = rule.normal(&ndf, near(1.0, -0.5, 0.75 * w * w, w));
                assert_abs_diff_eq!(normal.length(), 1.0, epsilon = 1e-6);
                let next = normal.x.hypot(normal.y);
                assert!(next > tilt && next - tilt < 0.01, "{rule:?}, w = {w}: {next} after {tilt}");
                tilt = next;
            }
        }
    }

    /// An NDF that is not 0 below the horizon, and whose inversion misses the flat normal.
    struct Unruly;

    impl Ndf for Unruly {
        fn d(&self, m: Vec3) -> f32 {
            2.0 + m.x
        }

        fn warp_gaussian(&self, z: Vec2) -> Vec3 {
            Vec3::new(z.x, z.y, 1.0).normalize()
        }

        fn invert(&self, _: Vec3) -> Vec2 {
            Vec2::new(0.01, 0.0)
        }
    }

    #[test]
    fn rules_accept_invalid_ndfs() {
        for rule in [LevelOfDetail::Exact, LevelOfDetail::Fractal] {
            for h in
                [Vec3::NEG_Z, Vec3::X, Vec3::ZERO, Vec3::NAN, Vec3::new(0.0, f32::NAN, 1.0), Vec3::INFINITY]
            {
                for coordinates in [ResolvedBumps::FAR, near(0.1, 0.1, 0.5, 1.0)] {
                    assert_eq!(rule.radiance(&Unruly, h, coordinates), 0.0, "{rule:?}, {h}");
                }
                assert_eq!(far_field(&Unruly, h), 0.0, "{h}");
            }
            let h = Vec3::new(0.6, 0.0, 0.8);
            assert_eq!(rule.radiance(&Unruly, h, ResolvedBumps::FAR), far_field(&Unruly, h));
        }
        for i in 1..100 {
            let z = Vec2::splat(1.0 / i as f32);
            assert_eq!(facet_coordinates(&Unruly, near(z.x, z.y, 0.5, 1.0)), z, "faded in, the noise itself");
        }
    }

    #[test]
    fn radiances_are_bit_identical_to_radiance() {
        let ndfs: [&dyn Ndf; 3] = [&Ggx::new(0.2, 0.4).unwrap(), &Beckmann::isotropic(0.3).unwrap(), &Unruly];
        let bad =
            [Vec3::NEG_Z, Vec3::X, Vec3::ZERO, Vec3::NAN, Vec3::new(0.0, f32::NAN, 1.0), Vec3::INFINITY];
        let halves: [Vec3; 71] = core::array::from_fn(|k| {
            let turn = 0.7 * k as f32;
            let odd = bad.get(k / 10).filter(|_| k % 10 == 3);
            *odd.unwrap_or(&Vec3::new(turn.cos(), turn.sin(), 0.05 * k as f32).normalize())
        });
        for (ndf, rule) in
            ndfs.iter().flat_map(|ndf| [(ndf, LevelOfDetail::Exact), (ndf, LevelOfDetail::Fractal)])
        {
            for coordinates in
                [ResolvedBumps::FAR, near(0.8, -1.1, 0.75, 1.0), near(f32::NAN, -20.0, 1.0, 0.5)]
            {
                for count in [0, 1, 5, 32, 71] {
                    let mut radiances = [-1.0; 71];
                    rule.radiances(*ndf, &halves, coordinates, &mut radiances[..count]);
                    for (k, (&got, &h)) in radiances.iter().zip(&halves).enumerate() {
                        let each = if k < count { rule.radiance(*ndf, h, coordinates) } else { -1.0 };
                        assert_eq!(got.to_bits(), each.to_bits(), "{rule:?}, {coordinates:?}, {count}, {h}");
                    }
                }
            }
        }
    }

    #[test]
    fn fraction_and_fade_are_clamped_to_one() {
        let ndf = Ggx::new(0.2, 0.4).unwrap();
        for rule in [LevelOfDetail::Exact, LevelOfDetail::Fractal] {
            assert_eq!(
                rule.normal(&ndf, near(0.5, 0.7, 4.0, 2.0)),
                rule.normal(&ndf, near(0.5, 0.7, 1.0, 1.0))
            );
        }
    }

    #[test]
    fn radiance_is_finite_for_every_coordinate() {
        let ndf = Ggx::new(0.05, 1.0).unwrap();
        let odd = [f32::NAN, f32::NEG_INFINITY, -1e30, -1.0, 0.0, 0.5, 1.0, 1e30, f32::INFINITY];
        let h = Vec3::new(0.3, 0.2, 0.9).normalize();
        for rule in [LevelOfDetail::Exact, LevelOfDetail::Fractal] {
            for z in odd {
                for share in odd {
                    for fade in odd {
                        let coordinates = near(z, -z, share, fade);
                        let radiance = rule.radiance(&ndf, h, coordinates);
                        assert!(
                            radiance >= 0.0 && radiance.is_finite(),
                            "{rule:?}, {coordinates:?}: {radiance}"
                        );
                        let normal = rule.normal(&ndf, coordinates);
                        assert_abs_diff_eq!(
                            normal.length(),
                            1.0,
                            epsilon = 1e-5,
                            "{rule:?}, {coordinates:?}"
                        );
                    }
                }
            }
        }
    }
}
