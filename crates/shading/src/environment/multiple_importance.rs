//! Light reflected from an environment, by multiple importance sampling.

use glam::{Vec2, Vec3};

use crate::environment::interface::Environment;
use crate::reflectance::{Bsdf, BsdfSample};

/// A direction of light with its contribution to the radiance towards the eye.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightSample {
    /// Unit, in the world frame, towards the light; zero for a sample without contribution.
    pub direction: Vec3,
    /// `w f L |cos θ|/p`, finite and at least 0.
    pub radiance: Vec3,
}

/// Two samples whose sum is an unbiased estimate of the radiance scattered into `wo`.
///
/// ```text
/// L_o ≈ Σₖ wₖ(ωₖ) f(ωo, ωₖ) L(ωₖ) |cos θₖ|/pₖ(ωₖ),   wₖ = pₖ²/(p₁² + p₂²)
/// ```
///
/// The first direction is drawn by the BSDF, the second by the environment. The power heuristic
/// weights both; a specular sample has weight 1. A renderer multiplies each by the visibility of
/// the light.
///
/// - **Domain:** unit `wo` in world space; `uc` and `u` of [`Bsdf::sample`], and a uniform point of
///   the unit square for the environment.
/// - **Any input:** values that the BSDF or the environment cannot compute contribute no light.
///
/// Veach 1997, *Robust Monte Carlo Methods for Light Transport Simulation*, §9.2.4, eq. 9.14, with
/// β = 2.
///
/// ```
/// use asperity_shading::environment::light_samples;
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::{EnvironmentMap, Footprint, Lambert, Material, SurfacePoint};
///
/// let texels = [Vec3::ONE; 8];
/// let mut table = [0.0; EnvironmentMap::table_len(4, 2)];
/// let sky = EnvironmentMap::from_borrowed(4, 2, &texels, &mut table)?;
/// let chalk = Lambert::new(Vec3::splat(0.8))?;
/// let bsdf = chalk.bsdf(&SurfacePoint::new(Vec3::ZERO, Vec3::Z, Footprint::from_width(0.0)), Vec3::Z);
/// let point = (0.5, Vec2::new(0.2, 0.6), Vec2::new(0.7, 0.1));
/// let [by_surface, by_light] = light_samples(&bsdf, &sky, Vec3::Z, point);
/// assert!((by_surface.direction.length() - 1.0).abs() < 1e-6);
/// assert!(by_surface.radiance.x + by_light.radiance.x > 0.3);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "mis")]
#[doc(alias = "multiple importance sampling")]
#[must_use]
pub fn light_samples<E: Environment + ?Sized>(
    bsdf: &Bsdf<'_>,
    environment: &E,
    wo: Vec3,
    (uc, u, by_light): (f32, Vec2, Vec2),
) -> [LightSample; 2] {
    let eval = |wi: Vec3| (bsdf.eval_cos(wo, wi), bsdf.pdf(wo, wi));
    weighted(bsdf.sample(wo, uc, u), eval, environment, environment.sample(by_light))
}

/// Weights a sample of a surface and a direction of an environment. `eval` returns `f |cos θ|` and
/// the pdf of the surface.
pub(super) fn weighted<E: Environment + ?Sized>(
    sample: Option<BsdfSample>,
    eval: impl Fn(Vec3) -> (Vec3, f32),
    environment: &E,
    by_light: Vec3,
) -> [LightSample; 2] {
    let contribution = |direction: Vec3, f: Vec3, own: f32, other: f32| {
        // p/(p² + q²) without squares, which leave the range of f32 for mirrors.
        let ratio = other / own;
        let radiance = f * environment.radiance(direction) / (own * (1.0 + ratio * ratio));
        let sound = own > 0.0 && radiance.is_finite() && radiance.min_element() >= 0.0;
        if sound { LightSample { direction, radiance } } else { LightSample::default() }
    };
    let by_surface = sample.map_or_else(LightSample::default, |sample| {
        let other = if sample.is_specular() { 0.0 } else { environment.pdf(sample.wi) };
        contribution(sample.wi, sample.eval_cos, sample.pdf, other)
    });
    let (f, pdf) = eval(by_light);
    [by_surface, contribution(by_light, f, environment.pdf(by_light), pdf)]
}

/// The radiance from an unoccluded environment that a BSDF scatters into `wo`.
///
/// Averages [`light_samples`] over the points, with reflection and transmission by smooth coats.
///
/// Without points it is 0. The error decreases as n^{−1/2} with the number n of points, and faster
/// for [low-discrepancy points](crate::environment::low_discrepancy_points).
///
/// For surfaces defined by an NDF alone, as in [`LevelOfDetail`](crate::LevelOfDetail), use a
/// [`TorranceSparrow`](crate::TorranceSparrow) of the NDF seen by a pixel.
///
/// ```
/// use asperity_shading::environment::low_discrepancy_points;
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::level_of_detail::ResolvedBumps;
/// use asperity_shading::ndf_sampling::ConditionalNdf;
/// use asperity_shading::{Footprint, Ggx, Material, SurfacePoint, TorranceSparrow, reflected_radiance};
///
/// // Partially resolved facets under uniform light.
/// let seen = ResolvedBumps { z: Vec2::new(0.3, -0.2), variance: 0.5, blend: 1.0 };
/// let rest = ConditionalNdf::new(Ggx::isotropic(0.2)?, seen.z, seen.variance);
/// let mirrors = TorranceSparrow::new(rest, Vec3::splat(0.9));
/// let (wo, point) = (Vec3::new(0.6, 0.0, 0.8), SurfacePoint::new(Vec3::ZERO, Vec3::Z, Footprint::from_width(0.0)));
/// let bsdf = mirrors.bsdf(&point, wo);
/// let sent = reflected_radiance(&bsdf, &Vec3::ONE, wo, low_discrepancy_points(64));
/// assert!(sent.x > 0.8 && sent.x < 0.95);
/// # Ok::<(), asperity_shading::ndf_sampling::NdfError>(())
/// ```
#[must_use]
pub fn reflected_radiance<E: Environment + ?Sized>(
    bsdf: &Bsdf<'_>,
    environment: &E,
    wo: Vec3,
    points: impl IntoIterator<Item = (f32, Vec2, Vec2)>,
) -> Vec3 {
    let (mut sum, mut count) = (Vec3::ZERO, 0_u32);
    for point in points {
        sum += light_samples(bsdf, environment, wo, point).iter().map(|sample| sample.radiance).sum::<Vec3>();
        count += 1;
    }
    sum / count.max(1) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bump::Facet;
    use crate::reflectance::{Brdf, CookTorrance, Lambert, Lobe};
    use asperity_ndf_sampling::{Frame, Ggx};

    #[test]
    fn light_samples_of_invalid_directions_contribute_nothing() {
        let (mirror, chalk) =
            (CookTorrance::new(Ggx::isotropic(1e-4).unwrap(), Vec3::ONE), Lambert::new(Vec3::ONE).unwrap());
        let of = |brdf, wo| Bsdf::new(Frame::IDENTITY, wo).with([Facet::FLAT], [Lobe::from(brdf)]);
        let odd = [f32::NAN, f32::INFINITY, -1.0, 0.0, 0.4, 1.0];
        let views = [Vec3::NAN, Vec3::ZERO, Vec3::NEG_Z, Vec3::INFINITY, Vec3::Z, Vec3::new(1.0, 0.0, 1e-20)];
        for wo in views {
            for (x, y) in odd.into_iter().flat_map(|x| odd.map(|y| (x, y))) {
                let points = (x, Vec2::new(x, y), Vec2::new(y, x));
                for brdf in [&mirror as &dyn Brdf, &chalk] {
                    for sample in light_samples(&of(brdf, wo), &Vec3::MAX, wo, points) {
                        let LightSample { direction, radiance } = sample;
                        assert!(radiance.is_finite() && radiance.min_element() >= 0.0, "{wo}: {radiance}");
                        assert!(direction == Vec3::ZERO || (direction.length() - 1.0).abs() < 1e-5);
                        assert!(wo.z > 0.0 || radiance == Vec3::ZERO, "{wo}: {radiance}");
                    }
                }
            }
        }
        let none = reflected_radiance(&of(&mirror, Vec3::Z), &Vec3::ONE, Vec3::Z, []);
        assert_eq!(none, Vec3::ZERO);
    }
}
