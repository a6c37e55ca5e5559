//! Tempered glass with roller waves.

use glam::Vec3;

use crate::bump::{bumped_normal, project_to_tangent_plane};
use crate::error::ShadingError;
use crate::material::fbm::{SLOPE_VARIANCE, SizedFbm};
use crate::material::interface::Material;
use crate::material::surface_point::SurfacePoint;
use crate::math::{cos, sqrt};
use crate::parameter::{as_share, as_size, color, direction, parameters, range};
use crate::reflectance::coat::Slopes;
use crate::reflectance::{Bsdf, Coat, Dielectric};

/// The shape of the waves of [`TemperedGlass`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum GlassWaves {
    /// A sine along one direction, as left by rollers.
    #[default]
    Sine,
    /// One octave of simplex noise, which looks bumpy; the alternative of the thesis.
    Noise,
}

/// The geometry of [`TemperedGlass`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum GlassBody {
    /// A thin pane without refraction offset.
    #[default]
    Pane,
    /// The refracting surface of a solid body, seen from inside if the eye is below the surface.
    Solid,
}

parameters! {
    /// The parameters of [`TemperedGlass`], named as in Nilsson 2008, Appendix B.
    pub struct TemperedGlassParameters of TemperedGlass {
        /// The frequency of the waves, in radians (sine) or cells (noise) per unit of length;
        /// within `[10⁻⁶, 10⁶]`. Default 20: every 0.3.
        wave_frequency: f32 = 20.0, as_size;
        /// Their amplitude in units of length, within `[0, 10⁶]`. Default 10⁻⁴: a slope of 0.002,
        /// visible in distant reflections.
        wave_amplitude: f32 = 1e-4, range([0.0, 1e6]);
        /// The direction in which they travel, in the space of positions; it is normalized. Default
        /// (0, 1, 0).
        wave_propagation_vector: Vec3 = Vec3::Y;
        /// Sine or noise. Default sine.
        waves: GlassWaves = GlassWaves::Sine;
        /// A thin pane, or the surface of a body. This and the following parameters are not in the
        /// thesis. Default pane.
        body: GlassBody = GlassBody::Pane;
        /// The relative index, within `[1, 4]`. Default 1.52.
        index: f32 = 1.52, range([1.0, 4.0]);
        /// The transmittance of a pane at normal incidence in addition to its reflection, by color.
        /// Default white.
        tint: Vec3 = Vec3::ONE, color;
        /// The roughness of its surfaces, Beckmann's α, within `[0, 1]`, for reflection and
        /// transmission, as of frosted glass. 0 is smooth. Default 0.
        roughness: f32 = 0.0, as_share;
        /// Random seed.
        seed: u32 = 1;
    }
}

/// Tempered glass with a wavy surface.
///
/// ```text
/// h = A sin(f p·d),   g = (d − n (n·d)) f A cos(f p·d),   n′ = normalize(n − g)
/// ```
///
/// or h = A N(f p). Waves that a pixel cannot resolve fade out; their slopes become facets of the
/// [`Bsdf`].
///
/// Nilsson 2008, §4.4 and Appendix B.
///
/// ```
/// use asperity_shading::glam::Vec3;
/// use asperity_shading::{Footprint, Material, SurfacePoint, TemperedGlass, TemperedGlassParameters, glam::Vec2};
///
/// let glass = TemperedGlass::new(TemperedGlassParameters::default())?;
/// let point = SurfacePoint::new(Vec3::ZERO, Vec3::Z, Footprint::from_width(1e-3));
/// let bsdf = glass.bsdf(&point, Vec3::Z);
/// let [mirrored, through] = bsdf.specular_samples(Vec3::Z, Vec2::ZERO).map(Option::unwrap);
/// assert!((mirrored.wi.y + 2.0 * 0.002).abs() < 1e-5 && through.wi == Vec3::NEG_Z);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TemperedGlass {
    parameters: TemperedGlassParameters,
    direction: Vec3,
    noise: SizedFbm,
}

/// The surface gradient of the height `A sin(f p·d)`.
///
/// ```text
/// ∇h = (d − n (n·d)) f A cos(f p·d)
/// ```
///
/// Zero where the phase is not finite. Nilsson 2008, §4.4.2, `wave_gradient`, prints `n d f A cos(f
/// p·d)` component by component, which has no waves for n = (0, 0, 1) and d = (1, 0, 0).
fn wave_gradient(position: Vec3, n: Vec3, direction: Vec3, frequency: f32, amplitude: f32) -> Vec3 {
    let phase = position.dot(direction) * frequency;
    if !phase.is_finite() {
        return Vec3::ZERO;
    }
    project_to_tangent_plane(n, direction) * (frequency * amplitude * cos(phase))
}

impl TemperedGlass {
    /// Creates the glass of these parameters.
    ///
    /// # Errors
    /// [`ShadingError`] with the first parameter that is out of its range, or for a
    /// `wave_propagation_vector` that is zero or not finite.
    pub fn new(parameters: TemperedGlassParameters) -> Result<Self, ShadingError> {
        parameters.check()?;
        let p = &parameters;
        let direction = direction("wave_propagation_vector", p.wave_propagation_vector)?;
        Ok(Self { parameters, direction, noise: SizedFbm::single(1.0 / p.wave_frequency, p.seed) })
    }

    /// The unit direction in which waves travel, and the noise of noise waves.
    pub(crate) const fn parts(&self) -> (Vec3, &SizedFbm) {
        (self.direction, &self.noise)
    }

    /// Unit normal of the glass at a pixel, and the unresolved slopes; flat if the position is not
    /// finite.
    fn surface(&self, point: &SurfacePoint) -> (Vec3, Slopes) {
        let p = &self.parameters;
        let (n, steepest) = (point.normal, p.wave_frequency * p.wave_amplitude);
        let (gradient, lost) = match p.waves {
            GlassWaves::Sine => {
                let across = project_to_tangent_plane(n, self.direction);
                // The period is 2π/f. Along the surface it is longer the more the surface leans
                // away.
                let cycles = point.change(across) * p.wave_frequency / core::f32::consts::TAU;
                let kept = if across == Vec3::ZERO {
                    1.0
                } else {
                    1.0 - asperity_noise::filtered_fraction(cycles, 1.0)
                };
                let g = wave_gradient(point.position, n, self.direction, p.wave_frequency, p.wave_amplitude);
                (g * kept, Slopes::Sine(across * (steepest * sqrt(1.0 - kept * kept))))
            }
            GlassWaves::Noise => {
                let sample = self.noise.sample(point.position, point.footprint());
                let removed = self.noise.removed_slope(point.footprint(), SLOPE_VARIANCE);
                (
                    project_to_tangent_plane(n, sample.gradient) * steepest,
                    Slopes::Gaussian(steepest * steepest * removed),
                )
            }
        };
        (bumped_normal(n, gradient), lost)
    }
}

impl Material for TemperedGlass {
    /// A coat that reflects and transmits, each with the waves in it, or rough glass.
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let (p, frame) = (&self.parameters, point.frame());
        let (normal, slopes) = self.surface(point);
        let fresnel = Dielectric::new_clamped(p.index);
        let coat = match p.body {
            GlassBody::Pane => Coat::thin_dielectric(fresnel, p.tint),
            GlassBody::Solid => Coat::dielectric(fresnel),
        };
        let slopes = match slopes {
            Slopes::Sine(swing) => Slopes::Sine(frame.to_local(swing)),
            even @ Slopes::Gaussian(_) => even,
        };
        Bsdf::new(frame, wo).with_coat(coat.rough(p.roughness).with_slopes(frame.to_local(normal), slopes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pixel::Footprint;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn wave_gradient_matches_finite_differences() {
        let n = Vec3::new(0.36, 0.48, 0.8);
        let d = Vec3::new(0.6, 0.0, 0.8);
        let h = 1.0 / 1024.0;
        let wave_height = |p: Vec3| 0.1 * (p.dot(d) * 7.0).sin();
        for i in 0..50_u8 {
            let p = Vec3::new(f32::from(i) * 0.1, 0.2, -0.3);
            let g = wave_gradient(p, n, d, 7.0, 0.1);
            for t in [project_to_tangent_plane(n, Vec3::X), project_to_tangent_plane(n, Vec3::Y)] {
                let difference = (wave_height(p + t * h) - wave_height(p - t * h)) / (2.0 * h);
                // Phases up to 35 are rounded by 2e-6: 0.1 · 2e-6/2h.
                assert_abs_diff_eq!(g.dot(t), difference, epsilon = 5e-4, "{p}");
            }
        }
    }

    #[test]
    fn wave_gradient_has_its_pinned_value() {
        let (p, n) = (Vec3::new(0.37, -1.21, 2.83), Vec3::new(0.36, 0.48, 0.8));
        let pinned = Vec3::new(0.116_110_02, -0.023_051_254, -0.038_418_76);
        let gradient = wave_gradient(p, n, Vec3::X, 3.0, 0.1);
        assert!((gradient - pinned).abs().cmple(1e-6 * pinned.abs()).all(), "{gradient}");
    }

    #[test]
    fn waves_fade_into_roughness() {
        for waves in [GlassWaves::Sine, GlassWaves::Noise] {
            let parameters = TemperedGlassParameters { waves, wave_amplitude: 0.01, ..Default::default() };
            let glass = TemperedGlass::new(parameters).unwrap();
            let at = |width| {
                let point = SurfacePoint::new(Vec3::splat(0.3), Vec3::Z, Footprint::from_width(width));
                let (normal, slopes) = glass.surface(&point);
                // Half for cos² and half again for one of two axes.
                let variance = match slopes {
                    Slopes::Gaussian(variance) => variance,
                    Slopes::Sine(swing) => 0.25 * swing.length_squared(),
                };
                (normal, variance)
            };
            assert!(at(1e-4).0.z < 1.0 && at(1e-4).1 == 0.0, "{waves:?}");
            assert!(at(10.0).0 == Vec3::Z && at(10.0).1 > 0.009, "{waves:?}");
        }
    }
}
