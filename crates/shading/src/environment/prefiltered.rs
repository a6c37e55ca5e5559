//! Environments prefiltered by roughness: a stack of images, one for each roughness.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use asperity_ndf_sampling::{Frame, Ggx, Ndf};
use core::ops::Deref;

use glam::{Vec2, Vec3};

use crate::direction::{half_vector, reflect};
use crate::environment::interface::{Environment, is_direction};
use crate::environment::latitude_longitude::LatitudeLongitude;
use crate::environment::multiple_importance::weighted;
use crate::environment::split_sum::SplitSum;
use crate::error::ShadingError;
use crate::image::Entries;
use crate::low_discrepancy::low_discrepancy_points;
use crate::math::clamp_to;
use crate::parameter::within;
use crate::reflectance::brdf::mirrored_pdf;
use crate::reflectance::{Brdf, BsdfSample};

/// The maximum number of rows of a level.
#[cfg(feature = "alloc")]
const MAX_ROWS: f32 = 8192.0;

/// The roughness below which a mirror is smooth; its lobe is a tenth of a degree wide.
const SMOOTH: f32 = 1e-3;

/// The light of an environment around `direction`, filtered by a GGX mirror at normal incidence.
///
/// ```text
/// L_α(r) = ∫ L(ω) D_α(h) max(0, r·ω) dω/∫ D_α(h) max(0, r·ω) dω,   h = (ω + r)/|ω + r|
/// ```
///
/// - **Domain:** roughness within [0, 1], NaN as 0; below 10⁻³ the result is the environment
///   itself. 0 for an invalid direction.
/// - **Accuracy:** both integrals are sums over the same `points` pairs of samples of lobe and
///   light. Measured over all directions, as the deviation divided by the mean. Soft sky: 64 points
///   0.7 %, 256 points 0.4 %. A sun of 6° that brings most of the light, with a peak of a hundred
///   times the mean: 3 % and 1 % from a roughness of 0.3 on, 22 % and 5 % at 0.05.
///
/// The first factor of the split sum of Karis 2013, *Real Shading in Unreal Engine 4*,
/// "Pre-Filtered Environment Map". Karis samples the lobe only, which misses the sun.
#[must_use]
pub fn prefiltered_radiance<E: Environment + ?Sized>(
    environment: &E,
    alpha: f32,
    direction: Vec3,
    points: u32,
) -> Vec3 {
    let alpha = clamp_to(alpha, 1.0);
    if alpha < SMOOTH || !is_direction(direction) {
        return environment.radiance(direction);
    }
    let (lobe, drawn) = (Lobe(Ggx::new_clamped(alpha, alpha)), Drawn(environment));
    let frame = Frame::from_normal(direction / direction.abs().max_element());
    let (mut sum, mut weight) = (Vec3::ZERO, 0.0);
    for (uc, u, by_light) in low_discrepancy_points(points.max(1)) {
        let eval = |direction| {
            let wi = frame.to_local(direction);
            (lobe.eval(Vec3::Z, wi) * wi.z.max(0.0), lobe.pdf(Vec3::Z, wi))
        };
        let mirrored = lobe.sample(Vec3::Z, uc, u);
        let mirrored = mirrored.map(|sample| BsdfSample { wi: frame.to_world(sample.wi), ..sample });
        for sample in weighted(mirrored, eval, &drawn, environment.sample(by_light)) {
            sum += environment.radiance(sample.direction) * sample.radiance.x;
            weight += sample.radiance.x;
        }
    }
    if weight > 0.0 { sum / weight } else { environment.radiance(direction) }
}

/// Mirroring facets, without the factors that depend on the view.
struct Lobe(Ggx);

impl Brdf for Lobe {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        Vec3::splat(0.25 * self.0.d(half_vector(wi, wo)))
    }

    fn sample(&self, wo: Vec3, _: f32, u: Vec2) -> Option<BsdfSample> {
        BsdfSample::from_direction(self, wo, reflect(wo, self.0.sample(u)))
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        mirrored_pdf(wo, wi, |h| self.0.pdf(h))
    }
}

/// Uniform light with the samples of another environment.
struct Drawn<E>(E);

impl<E: Environment> Environment for Drawn<E> {
    fn radiance(&self, _: Vec3) -> Vec3 {
        Vec3::ONE
    }

    fn sample(&self, u: Vec2) -> Vec3 {
        self.0.sample(u)
    }

    fn pdf(&self, direction: Vec3) -> f32 {
        self.0.pdf(direction)
    }
}

/// An image of the environment filtered by a mirror of this roughness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrefilteredLevel<S = Entries<Vec3>> {
    /// The roughness.
    pub alpha: f32,
    /// The filtered image by direction, see [`prefiltered_radiance`].
    pub image: LatitudeLongitude<S>,
}

/// A stack of filtered images, from smooth to rough, for any roughness by one lookup.
///
/// Between two levels it interpolates linearly in the roughness. Beyond the last level it returns
/// that level.
///
/// - **Error:** [`reflected`](Self::reflected) uses the lobe of a mirror at normal incidence, which
///   is round and not clipped at the surface. Measured against
///   [`reflected_radiance`](super::reflected_radiance), as the deviation over all normals divided
///   by the mean:
///
/// | roughness | soft sky, seen from above | at 60° | at 80° |
/// |---|---|---|---|
/// | 0.1 | 0.005 | 0.018 | 0.052 |
/// | 0.3 | 0.018 | 0.075 | 0.15 |
/// | 0.6 | 0.018 | 0.14 | 0.20 |
///
/// Under a sun that brings most of the light the error is 0.04 to 0.3 from above, and 0.6 to 2.6 at
/// an angle, where highlights should be elongated.
///
#[cfg_attr(feature = "alloc", doc = "```")]
#[cfg_attr(not(feature = "alloc"), doc = "```ignore")]
/// use asperity_shading::environment::{PrefilteredMap, SplitSum};
/// use asperity_shading::{EnvironmentMap, glam::Vec3};
///
/// let sky = EnvironmentMap::from_fn(64, 32, |w| Vec3::splat(if w.z > 0.0 { 1.0 } else { 0.0 }))?;
/// // Roughness and rows of each level.
/// let stack = PrefilteredMap::new(&sky, &[(0.0, 32), (0.2, 16), (0.6, 8)], 32)?;
/// assert!(stack.radiance(Vec3::X, 0.0).x < 0.6 && stack.radiance(Vec3::new(0.8, 0.0, -0.6), 0.6).x > 0.01);
/// let gold = stack.reflected(&SplitSum::new(), Vec3::new(1.0, 0.8, 0.3), 0.1, Vec3::Z, Vec3::new(0.6, 0.0, 0.8));
/// assert!(gold.x > gold.z);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "split sum")]
#[doc(alias = "ibl")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrefilteredMap<L = Entries<PrefilteredLevel>> {
    levels: L,
}

impl<'a> PrefilteredMap<&'a [PrefilteredLevel<&'a [Vec3]>]> {
    /// Creates the stack of these borrowed levels.
    ///
    /// # Errors
    /// [`ShadingError`] unless there is at least one level and the roughness `alpha` is within
    /// [0, 1] and increases. An empty slice is reported as NaN.
    ///
    /// ```
    /// use asperity_shading::environment::{LatitudeLongitude, PrefilteredLevel, PrefilteredMap};
    /// use asperity_shading::glam::Vec3;
    ///
    /// let (sharp, blurred) = ([Vec3::splat(2.0), Vec3::ZERO], [Vec3::ONE]);
    /// let levels = [
    ///     PrefilteredLevel { alpha: 0.0, image: LatitudeLongitude::new(1, 2, &sharp[..])? },
    ///     PrefilteredLevel { alpha: 0.8, image: LatitudeLongitude::new(1, 1, &blurred[..])? },
    /// ];
    /// let stack = PrefilteredMap::from_levels(&levels)?;
    /// assert!((stack.radiance(Vec3::Z, 0.4) - Vec3::splat(1.5)).length() < 1e-6);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn from_levels(levels: &'a [PrefilteredLevel<&'a [Vec3]>]) -> Result<Self, ShadingError> {
        check_alphas(levels.iter().map(|level| level.alpha))?;
        Ok(Self { levels })
    }
}

#[cfg(feature = "alloc")]
impl PrefilteredMap<Vec<PrefilteredLevel<Vec<Vec3>>>> {
    /// Computes the stack of an environment from the roughness and the rows of each level.
    ///
    /// A level has half as many rows as columns.
    ///
    /// Each texel is a sum over `points` pairs of samples. A level should have at least `2/α` rows,
    /// or those of the environment.
    ///
    /// # Errors
    /// [`ShadingError`] unless there are levels of 1 to 8192 `rows` whose roughness `alpha` is
    /// within [0, 1] and increases.
    pub fn new<E: Environment + ?Sized>(
        environment: &E,
        levels: &[(f32, usize)],
        points: u32,
    ) -> Result<Self, ShadingError> {
        check_alphas(levels.iter().map(|level| level.0))?;
        for &(_, rows) in levels {
            within("rows", rows as f32, [1.0, MAX_ROWS])?;
        }
        let level = |&(alpha, rows): &(f32, usize)| {
            let texel = |k: usize| {
                let direction = LatitudeLongitude::direction(2 * rows, rows, k % (2 * rows), k / (2 * rows));
                prefiltered_radiance(environment, alpha, direction, points)
            };
            let texels = (0..2 * rows * rows).map(texel).collect();
            let poles =
                [Vec3::Z, Vec3::NEG_Z].map(|pole| prefiltered_radiance(environment, alpha, pole, points));
            PrefilteredLevel { alpha, image: LatitudeLongitude::with_poles(2 * rows, rows, texels, poles) }
        };
        Ok(Self { levels: levels.iter().map(level).collect() })
    }

    /// The levels, borrowed, from smooth to rough.
    pub fn levels(&self) -> impl Iterator<Item = PrefilteredLevel<&[Vec3]>> {
        self.levels.iter().map(|level| PrefilteredLevel { alpha: level.alpha, image: level.image.view() })
    }
}

impl<S: Deref<Target = [Vec3]>, L: Deref<Target = [PrefilteredLevel<S>]>> PrefilteredMap<L> {
    /// The radiance filtered by a mirror of the roughness `alpha` at normal incidence.
    ///
    /// 0 for an invalid direction; NaN roughness is read as 0.
    #[must_use]
    pub fn radiance(&self, direction: Vec3, alpha: f32) -> Vec3 {
        let alpha = clamp_to(alpha, 1.0);
        let mut smoother: Option<&PrefilteredLevel<S>> = None;
        for level in &*self.levels {
            if level.alpha >= alpha {
                let rough = level.image.radiance(direction);
                return match smoother {
                    Some(smooth) if level.alpha > alpha => {
                        let share = (alpha - smooth.alpha) / (level.alpha - smooth.alpha);
                        smooth.image.radiance(direction).lerp(rough, share)
                    }
                    _ => rough,
                };
            }
            smoother = Some(level);
        }
        smoother.map_or(Vec3::ZERO, |level| level.image.radiance(direction))
    }

    /// Radiance of a GGX mirror with Schlick's reflectance `f0` into the direction `view`.
    ///
    /// ```text
    /// L_o ≈ L_α(reflect(view, normal)) (F₀ scale + bias)
    /// ```
    ///
    /// Karis 2013. `normal` and `view` are unit vectors; views from below are dark.
    #[must_use]
    pub fn reflected(&self, table: &SplitSum, f0: Vec3, alpha: f32, normal: Vec3, view: Vec3) -> Vec3 {
        let cosine = normal.dot(view);
        if cosine > 0.0 {
            let [scale, bias] = table.at(alpha, cosine);
            self.radiance(reflect(view, normal), alpha) * (f0 * scale + bias)
        } else {
            Vec3::ZERO
        }
    }
}

/// Checks that the roughness increases.
fn check_alphas(mut alphas: impl Iterator<Item = f32>) -> Result<(), ShadingError> {
    let first = within("alpha", alphas.next().unwrap_or(f32::NAN), [0.0, 1.0])?;
    alphas.try_fold(first, |last, alpha| within("alpha", alpha, [last.next_up(), 1.0])).map(|_| ())
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn uniform_light_stays_uniform() {
        for alpha in [f32::NAN, 0.0, 0.05, 0.3, 0.6, 1.0, 2.0] {
            for direction in [Vec3::Z, Vec3::new(-0.6, 0.0, -0.8), Vec3::new(1e30, 0.0, 1e20)] {
                let got = prefiltered_radiance(&Vec3::splat(2.0), alpha, direction, 64);
                assert_abs_diff_eq!(got, Vec3::splat(2.0), epsilon = 1e-5, "{alpha}");
            }
        }
        for bad in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
            assert_eq!(prefiltered_radiance(&Vec3::ONE, 0.3, bad, 4), Vec3::ZERO);
        }
        assert!(prefiltered_radiance(&Vec3::ONE, 0.3, Vec3::Z, 0).is_finite());
    }

    #[test]
    fn levels_are_blended_by_their_roughness() {
        let texels = [1.0, 3.0, 7.0].map(|value| [Vec3::splat(value)]);
        let mut levels = [0.1, 0.2, 0.6].map(|alpha| PrefilteredLevel {
            alpha,
            image: LatitudeLongitude::new(1, 1, &texels[0][..]).unwrap(),
        });
        for (level, texels) in levels.iter_mut().zip(&texels) {
            level.image = LatitudeLongitude::new(1, 1, &texels[..]).unwrap();
        }
        let stack = PrefilteredMap::from_levels(&levels).unwrap();
        let cases =
            [(f32::NAN, 1.0), (0.1, 1.0), (0.15, 2.0), (0.2, 3.0), (0.5, 6.0), (0.6, 7.0), (9.0, 7.0)];
        for (alpha, expected) in cases {
            let got = stack.radiance(Vec3::X, alpha).x;
            assert_abs_diff_eq!(got, expected, epsilon = 1e-5, "{alpha}");
        }
        assert_eq!(stack.radiance(Vec3::NAN, 0.5), Vec3::ZERO);
        let table = SplitSum::new();
        assert_eq!(stack.reflected(&table, Vec3::ONE, 0.3, Vec3::Z, Vec3::NEG_Z), Vec3::ZERO);
        assert_eq!(stack.reflected(&table, Vec3::ONE, 0.3, Vec3::Z, Vec3::NAN), Vec3::ZERO);
    }

    #[test]
    fn new_rejects_roughness_that_does_not_increase() {
        for alphas in [&[][..], &[0.0, 1.5], &[0.0, f32::NAN], &[0.2, 0.2], &[0.3, 0.2], &[1.0, 1.0], &[-0.1]]
        {
            assert_eq!(check_alphas(alphas.iter().copied()).unwrap_err().parameter(), "alpha", "{alphas:?}");
        }
        assert_eq!(check_alphas([0.0, 0.2, 1.0].into_iter()), Ok(()));
    }

    #[cfg(feature = "alloc")]
    #[test]
    fn smooth_level_is_the_environment_and_rows_are_bounded() {
        let sky = crate::environment::EnvironmentMap::from_fn(16, 8, |w| (w + 1.0) * 0.5).unwrap();
        let map = PrefilteredMap::new(&sky, &[(0.0, 8), (0.3, 4), (1.0, 2)], 16).unwrap();
        assert!(map.levels().map(|level| level.image.height()).eq([8, 4, 2]));
        assert_abs_diff_eq!(map.radiance(Vec3::Z, 0.0), sky.radiance(Vec3::Z), epsilon = 1e-6);
        for rows in [0, 8193] {
            let refused = PrefilteredMap::new(&sky, &[(0.0, 8), (0.3, rows)], 16).unwrap_err();
            assert_eq!(refused.parameter(), "rows", "{rows}");
        }
    }
}
