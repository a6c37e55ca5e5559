//! Tempered glass: the waves that rollers leave in it.

use glam::Vec3;

use crate::bump::{bumped_normal, tangential};
use crate::material::fbm::{Fbm, SLOPE_VARIANCE};
use crate::material::form::Form;
use crate::material::interface::Material;
use crate::material::surface_point::SurfacePoint;
use crate::math::{cos, sin, sqrt};
use crate::parameter::{ParameterError, SHARES, SIZES, colour, direction, within};
use crate::reflectance::coat::Slopes;
use crate::reflectance::{Bsdf, Coat, Dielectric};

/// The shape of the waves of [`TemperedGlass`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum GlassWaves {
    /// A sine along one direction, as rollers leave it.
    #[default]
    Sine,
    /// One octave of simplex noise, which looks bumpy: the thesis's other try.
    Noise,
}

/// The thickness of [`TemperedGlass`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum GlassBody {
    /// A thin pane, through which one looks straight.
    #[default]
    Pane,
    /// The surface of a body, which refracts; seen from inside where the eye is below the surface.
    Solid,
}

/// The parameters of [`TemperedGlass`], by the names of Nilsson 2008, Appendix B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TemperedGlassParameters {
    /// The frequency of the waves in radians per unit of length, of noise in cells; within `[10⁻⁶, 10⁶]`. Default 20: every 0.3.
    pub wave_frequency: f32,
    /// Their amplitude in units of length, within `[0, 10⁶]`. Default 10⁻⁴: a slope of 0.002, seen in what is far away.
    pub wave_amplitude: f32,
    /// The direction in which they travel, in the space of positions; it is made unit. Default (0, 1, 0).
    pub wave_propagation_vector: Vec3,
    /// Sine or noise. Default sine.
    pub waves: GlassWaves,
    /// A thin pane, or the surface of a body; this and what follows is not in the thesis. Default pane.
    pub body: GlassBody,
    /// The relative index, within `[1, 4]`. Default 1.52.
    pub index: f32,
    /// The share of light that a pane lets through beside what it mirrors, by colour. Default white.
    pub tint: Vec3,
    /// The roughness of what is mirrored, within `[0, 1]`; 0 is a mirror. Default 0.
    pub roughness: f32,
    /// Which noise: any number.
    pub seed: u32,
}

impl Default for TemperedGlassParameters {
    fn default() -> Self {
        Self {
            wave_frequency: 20.0,
            wave_amplitude: 1e-4,
            wave_propagation_vector: Vec3::Y,
            waves: GlassWaves::Sine,
            body: GlassBody::Pane,
            index: 1.52,
            tint: Vec3::ONE,
            roughness: 0.0,
            seed: 1,
        }
    }
}

/// Tempered glass: a wavy surface.
///
/// ```text
/// h = A sin(f p·d),   g = (d − n (n·d)) f A cos(f p·d),   n′ = normalize(n − g)
/// ```
///
/// or h = A N(f p). Waves that a pixel cannot resolve fade to none; their slopes are then facets of the [`Bsdf`].
///
/// Nilsson 2008, §4.4 and Appendix B.
///
/// ```
/// use asperity_shading::glam::Vec3;
/// use asperity_shading::{Footprint, Material, SurfacePoint, TemperedGlass, TemperedGlassParameters, glam::Vec2};
///
/// let glass = TemperedGlass::new(TemperedGlassParameters::default())?;
/// let point = SurfacePoint::new(Vec3::ZERO, Vec3::Z, Footprint::from_width(1e-3));
/// let [mirrored, through] = glass.bsdf(&point, Vec3::Z).deltas(Vec3::Z, Vec2::ZERO);
/// assert!((mirrored.wi.y + 2.0 * 0.002).abs() < 1e-5 && through.wi == Vec3::NEG_Z);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TemperedGlass {
    parameters: TemperedGlassParameters,
    direction: Vec3,
    noise: Fbm,
}

/// Tempered glass as a pixel sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GlassSurface {
    /// The unit normal.
    pub normal: Vec3,
    /// The variance of the slope that the footprint took, the mean of both axes: α² grows by twice that.
    pub slope_variance: f32,
    /// The steepest slope of a sine that the footprint took, along its direction; zero for noise.
    pub swing: Vec3,
}

/// The height of waves in glass: `A sin(f p·d)`.
///
/// 0 where the phase is not finite. Nilsson 2008, §4.4.2; its parentheses do not match in print.
#[must_use]
pub fn wave_height(position: Vec3, direction: Vec3, frequency: f32, amplitude: f32) -> f32 {
    let phase = position.dot(direction) * frequency;
    if phase.is_finite() { amplitude * sin(phase) } else { 0.0 }
}

/// The gradient of [`wave_height`] along a surface.
///
/// - **Printed:** `n d f A cos(f p·d)`, component by component, which is zero for n = (0, 0, 1) and d = (1, 0, 0): no waves at all.
/// - **Corrected:** `(d − n (n·d)) f A cos(f p·d)`.
///
/// Zero where the phase is not finite. Nilsson 2008, §4.4.2, `wave_gradient`.
///
/// ```
/// use asperity_shading::material::{Form, wave_gradient};
/// use asperity_shading::glam::Vec3;
///
/// let gradient = |form| wave_gradient(Vec3::ZERO, Vec3::Z, Vec3::X, 20.0, 0.01, form);
/// assert_eq!(gradient(Form::Printed), Vec3::ZERO);
/// assert!((gradient(Form::Corrected) - Vec3::new(0.2, 0.0, 0.0)).length() < 1e-6);
/// ```
#[must_use]
pub fn wave_gradient(
    position: Vec3,
    n: Vec3,
    direction: Vec3,
    frequency: f32,
    amplitude: f32,
    form: Form,
) -> Vec3 {
    let phase = position.dot(direction) * frequency;
    if !phase.is_finite() {
        return Vec3::ZERO;
    }
    let slope = frequency * amplitude * cos(phase);
    match form {
        Form::Printed => n * direction * slope,
        Form::Corrected => tangential(n, direction) * slope,
    }
}

impl TemperedGlass {
    /// The glass of these parameters.
    ///
    /// # Errors
    /// [`ParameterError`] with the first parameter that is out of its range, or for a `wave_propagation_vector` that is zero or not
    /// finite.
    pub fn new(parameters: TemperedGlassParameters) -> Result<Self, ParameterError> {
        let p = &parameters;
        let size = 1.0 / within("wave_frequency", p.wave_frequency, SIZES)?;
        within("wave_amplitude", p.wave_amplitude, [0.0, 1e6])?;
        within("index", p.index, [1.0, 4.0])?;
        within("roughness", p.roughness, SHARES)?;
        colour("tint", p.tint)?;
        let direction = direction("wave_propagation_vector", p.wave_propagation_vector)?;
        Ok(Self { parameters, direction, noise: Fbm::single(size, p.seed) })
    }

    /// The parameters.
    #[must_use]
    pub const fn parameters(&self) -> &TemperedGlassParameters {
        &self.parameters
    }

    /// Normal and lost slopes of the glass at a pixel; total: flat where the position is not finite.
    #[must_use]
    pub(crate) fn surface(&self, point: &SurfacePoint) -> GlassSurface {
        let p = &self.parameters;
        let (n, steepest) = (point.normal, p.wave_frequency * p.wave_amplitude);
        let (gradient, slope_variance, swing) = match p.waves {
            GlassWaves::Sine => {
                let across = tangential(n, self.direction);
                // Its period is 2π/f, and along the surface the longer the more it leans away.
                let cycles = point.change(across) * p.wave_frequency / core::f32::consts::TAU;
                let kept =
                    if across == Vec3::ZERO { 1.0 } else { 1.0 - asperity_noise::removed_share(cycles, 1.0) };
                let g = wave_gradient(
                    point.position,
                    n,
                    self.direction,
                    p.wave_frequency,
                    p.wave_amplitude,
                    Form::Corrected,
                );
                // Half of cos² and half again for one of two axes.
                let lost = 1.0 - kept * kept;
                let variance = 0.25 * steepest * steepest * across.length_squared() * lost;
                (g * kept, variance, across * (steepest * sqrt(lost)))
            }
            GlassWaves::Noise => {
                let sample = self.noise.sample(point.position, point.footprint());
                let removed = self.noise.removed_slope(point.footprint(), SLOPE_VARIANCE);
                (tangential(n, sample.gradient) * steepest, steepest * steepest * removed, Vec3::ZERO)
            }
        };
        GlassSurface { normal: bumped_normal(n, gradient), slope_variance, swing }
    }
}

impl Material for TemperedGlass {
    /// A coat that mirrors and transmits, each with the waves in it; nothing else.
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let (p, frame) = (&self.parameters, point.frame());
        let surface = self.surface(point);
        let fresnel = Dielectric::clamped(p.index);
        let coat = match p.body {
            GlassBody::Pane => Coat::pane(fresnel, p.tint),
            GlassBody::Solid => Coat::body(fresnel),
        };
        let slopes = match p.waves {
            GlassWaves::Sine => Slopes::Sine(frame.to_local(surface.swing)),
            GlassWaves::Noise => Slopes::Gaussian(surface.slope_variance),
        };
        Bsdf::new(wo).with_coat(coat.rough(p.roughness).with_slopes(frame.to_local(surface.normal), slopes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pixel::Footprint;

    fn glass(waves: GlassWaves) -> TemperedGlass {
        TemperedGlass::new(TemperedGlassParameters { waves, wave_amplitude: 0.01, ..Default::default() })
            .unwrap()
    }

    #[test]
    fn the_gradient_is_that_of_the_height() {
        let n = Vec3::new(0.36, 0.48, 0.8);
        let d = Vec3::new(0.6, 0.0, 0.8);
        let h = 1.0 / 1024.0;
        for i in 0..50_u8 {
            let p = Vec3::new(f32::from(i) * 0.1, 0.2, -0.3);
            let g = wave_gradient(p, n, d, 7.0, 0.1, Form::Corrected);
            for t in [tangential(n, Vec3::X), tangential(n, Vec3::Y)] {
                let difference =
                    (wave_height(p + t * h, d, 7.0, 0.1) - wave_height(p - t * h, d, 7.0, 0.1)) / (2.0 * h);
                // Phases up to 35 are rounded by 2e-6: 0.1 · 2e-6/2h.
                assert!((g.dot(t) - difference).abs() < 5e-4, "{p}: {g}, {difference}");
            }
        }
    }

    #[test]
    fn waves_fade_into_roughness() {
        for waves in [GlassWaves::Sine, GlassWaves::Noise] {
            let at = |width| {
                glass(waves).surface(&SurfacePoint::new(
                    Vec3::splat(0.3),
                    Vec3::Z,
                    Footprint::from_width(width),
                ))
            };
            assert!(at(1e-4).normal.z < 1.0 && at(1e-4).slope_variance == 0.0);
            assert!(at(10.0).normal == Vec3::Z && at(10.0).slope_variance > 0.009);
        }
    }

    #[test]
    fn every_point_has_a_normal() {
        for waves in [GlassWaves::Sine, GlassWaves::Noise] {
            for x in [f32::NAN, f32::NEG_INFINITY, -1e30, 0.0, 1e30] {
                for n in [Vec3::Y, Vec3::new(x, 0.0, 1.0)] {
                    let point = SurfacePoint::new(Vec3::new(0.1, x, 0.3), n, Footprint::from_width(x));
                    let s = glass(waves).surface(&point);
                    assert!(
                        (s.normal.length() - 1.0).abs() < 1e-5 && s.slope_variance >= 0.0,
                        "{x}, {n}: {s:?}"
                    );
                }
            }
        }
        let bad = TemperedGlassParameters { wave_propagation_vector: Vec3::ZERO, ..Default::default() };
        assert!(matches!(TemperedGlass::new(bad), Err(ParameterError::Direction { .. })));
        assert!(
            TemperedGlass::new(TemperedGlassParameters { wave_amplitude: -1.0, ..Default::default() })
                .is_err()
        );
    }
}
