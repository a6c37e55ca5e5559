//! Light reflected from an environment, by multiple importance sampling.

use asperity_ndf_sampling::Frame;
use glam::{Vec2, Vec3};

use crate::environment::interface::Environment;
use crate::reflectance::Brdf;

/// A direction of light with its contribution to the radiance towards the eye.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightSample {
    /// Unit, in the world frame, towards the light; zero for a sample without contribution.
    pub direction: Vec3,
    /// `w f_r L cos θ/p`, finite and at least 0.
    pub radiance: Vec3,
}

/// Two samples whose sum is an unbiased estimate of the reflected radiance into `wo`.
///
/// ```text
/// L_o ≈ Σₖ wₖ(ωₖ) f_r(ωₖ, ωo) L(ωₖ) cos θₖ/pₖ(ωₖ),   wₖ = pₖ²/(p₁² + p₂²)
/// ```
///
/// The first direction is drawn by the BRDF, the second by the environment. The power heuristic
/// weights both. A renderer multiplies each by the visibility of the light.
///
/// - **Domain:** `frame` of the surface and unit `wo`, in the world frame; two uniform points of
///   the unit square.
/// - **Any input:** values that the BRDF or the environment cannot compute contribute no light.
///
/// Veach 1997, *Robust Monte Carlo Methods for Light Transport Simulation*, §9.2.4, eq. 9.14, with
/// β = 2.
///
/// ```
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::environment::light_samples;
/// use asperity_shading::{EnvironmentRef, Frame, Lambert};
///
/// let texels = [Vec3::ONE; 8];
/// let mut table = [0.0; EnvironmentRef::table_len(4, 2)];
/// let sky = EnvironmentRef::new(4, 2, &texels, &mut table)?;
/// let chalk = Lambert::new(Vec3::splat(0.8))?;
/// let points = [Vec2::new(0.2, 0.6), Vec2::new(0.7, 0.1)];
/// let [by_surface, by_light] = light_samples(&chalk, &sky, &Frame::IDENTITY, Vec3::Z, points);
/// assert!((by_surface.direction.length() - 1.0).abs() < 1e-6);
/// assert!(by_surface.radiance.x + by_light.radiance.x > 0.3);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "mis")]
#[doc(alias = "multiple importance sampling")]
#[must_use]
pub fn light_samples<B: Brdf + ?Sized, E: Environment + ?Sized>(
    brdf: &B,
    environment: &E,
    frame: &Frame,
    wo: Vec3,
    [by_surface, by_light]: [Vec2; 2],
) -> [LightSample; 2] {
    let wo = frame.to_local(wo);
    let local = brdf.sample(wo, by_surface);
    let world = environment.sample(by_light);
    [(frame.to_world(local), local, true), (world, frame.to_local(world), false)].map(
        |(direction, wi, is_surface)| {
            let cosine = wi.z;
            let [surface, light] = [brdf.density(wi, wo), environment.density(direction)];
            let [own, other] = if is_surface { [surface, light] } else { [light, surface] };
            // p/(p² + q²) without squares, which leave the range of f32 for mirrors.
            let ratio = other / own;
            let weight = 1.0 / (own * (1.0 + ratio * ratio));
            let radiance = brdf.value(wi, wo) * environment.radiance(direction) * (cosine * weight);
            if own > 0.0 && cosine > 0.0 && radiance.is_finite() && radiance.min_element() >= 0.0 {
                LightSample { direction, radiance }
            } else {
                LightSample::default()
            }
        },
    )
}

/// The radiance reflected from an unoccluded environment into `wo`, averaged over the points.
///
/// Averages [`light_samples`].
///
/// Without points it is 0. The error decreases as n^{−1/2} with the number n of points, and faster
/// for low-discrepancy points.
///
/// For surfaces defined by an NDF alone, as in [`LevelOfDetail`](crate::LevelOfDetail), use a
/// [`TorranceSparrow`](crate::TorranceSparrow) of the NDF seen by a pixel.
///
/// ```
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::ndf_sampling::ConditionalNdf;
/// use asperity_shading::level_of_detail::Coordinates;
/// use asperity_shading::{Frame, Ggx, TorranceSparrow, reflected_radiance};
///
/// // Partially resolved facets under uniform light.
/// let seen = Coordinates { z: Vec2::new(0.3, -0.2), share: 0.5, fade: 1.0 };
/// let rest = ConditionalNdf::new(Ggx::isotropic(0.2)?, seen.z, seen.share);
/// let mirrors = TorranceSparrow::new(rest, Vec3::splat(0.9));
/// let points = (0..64).map(|k| {
///     let x = (k as f32 + 0.5) / 64.0;
///     [Vec2::new(x, 0.618 * k as f32 % 1.0), Vec2::new(x, 0.755 * k as f32 % 1.0)]
/// });
/// let sent = reflected_radiance(&mirrors, &Vec3::ONE, &Frame::IDENTITY, Vec3::new(0.6, 0.0, 0.8), points);
/// assert!(sent.x > 0.8 && sent.x < 0.95);
/// # Ok::<(), asperity_shading::ndf_sampling::NdfError>(())
/// ```
#[must_use]
pub fn reflected_radiance<B: Brdf + ?Sized, E: Environment + ?Sized>(
    brdf: &B,
    environment: &E,
    frame: &Frame,
    wo: Vec3,
    points: impl IntoIterator<Item = [Vec2; 2]>,
) -> Vec3 {
    let (mut sum, mut count) = (Vec3::ZERO, 0_u32);
    for point in points {
        let [by_surface, by_light] = light_samples(brdf, environment, frame, wo, point);
        sum += by_surface.radiance + by_light.radiance;
        count += 1;
    }
    sum / count.max(1) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reflectance::CookTorrance;
    use crate::reflectance::Lambert;
    use asperity_ndf_sampling::Ggx;

    #[test]
    fn light_samples_of_invalid_directions_contribute_nothing() {
        let mirror = CookTorrance::new(Ggx::isotropic(1e-4).unwrap(), Vec3::ONE);
        let odd = [f32::NAN, f32::INFINITY, -1.0, 0.0, 0.4, 1.0];
        let views = [Vec3::NAN, Vec3::ZERO, Vec3::NEG_Z, Vec3::INFINITY, Vec3::Z, Vec3::new(1.0, 0.0, 1e-20)];
        for wo in views {
            for (x, y) in odd.into_iter().flat_map(|x| odd.map(|y| (x, y))) {
                let points = [Vec2::new(x, y), Vec2::new(y, x)];
                for brdf in [&mirror as &dyn Brdf, &Lambert::new(Vec3::ONE).unwrap()] {
                    for sample in light_samples(brdf, &Vec3::MAX, &Frame::IDENTITY, wo, points) {
                        let LightSample { direction, radiance } = sample;
                        assert!(radiance.is_finite() && radiance.min_element() >= 0.0, "{wo}: {radiance}");
                        assert!(direction == Vec3::ZERO || (direction.length() - 1.0).abs() < 1e-5);
                        assert!(wo.z > 0.0 || radiance == Vec3::ZERO, "{wo}: {radiance}");
                    }
                }
            }
        }
        let none = reflected_radiance(&mirror, &Vec3::ONE, &Frame::IDENTITY, Vec3::Z, []);
        assert_eq!(none, Vec3::ZERO);
    }
}
