//! Seams of a carpet: lines or a grid where there are fewer threads.

use core::f32::consts::{FRAC_PI_2, PI};

use asperity_noise::removed_share;
use glam::Vec2;

use super::form::Form;
use super::parameter::{ParameterError, SHARES, SIZES, direction_in_plane, within};
use crate::math::{cos, floor, sin, sqrt};

/// Where the seams are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SeamPattern {
    /// Nowhere: 0 in the thesis.
    None,
    /// Along parallel lines: 1.
    #[default]
    Lines,
    /// Along two sets of lines at right angles: 2.
    Grid,
}

/// The seams of a carpet: how many threads there are, and the height that goes with it.
///
/// ```text
/// amount = 1 − A (1 − |sin p|),   p = f a·uv,   |a| = 1
/// grid:    the smaller of the amounts along a and along a⊥ = (−a_y, a_x)
/// ```
///
/// Seams are π/f apart in texture coordinates. |sin p| has a crease at each seam; [`rounded`](Self::rounded) takes
/// √(sin² p + ε²) for it, and [`filtered`](Self::filtered) its mean over the width of a pixel.
///
/// Nilsson 2008, §4.2.3.
///
/// ```
/// use asperity_shading::{Form, SeamPattern, Seams, glam::Vec2};
///
/// let seams = Seams::new(Vec2::X, SeamPattern::Lines, 0.5, 0.2)?;
/// assert_eq!(seams.sample(Vec2::ZERO, Form::Corrected).amount, 0.8);
/// assert!((seams.sample(Vec2::new(0.25, 3.0), Form::Corrected).amount - 1.0).abs() < 1e-6);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seams {
    direction: Vec2,
    pattern: SeamPattern,
    frequency: f32,
    amplitude: f32,
    /// The mean of the smaller of two independent creases of the least width.
    grid_mean: f32,
}

/// How many threads there are at a point, and how that changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seam {
    /// The amount of threads: 1 between seams, 1 − A on them.
    pub amount: f32,
    /// Its derivatives in texture coordinates.
    pub slope: Vec2,
}

/// |sin p| and its derivatives by the phases along a and along a⊥, as a pixel sees them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crease {
    pub(crate) height: f32,
    pub(crate) slope: Vec2,
}

/// The width, in phase, over which creases are averaged at least: a twentieth of the way between two seams.
const LEAST: f32 = PI / 20.0;

impl Seams {
    /// Seams at right angles to `propagation`, `distance` apart in texture coordinates, of this amplitude.
    ///
    /// # Errors
    /// [`ParameterError`] unless the direction `seams_propagation` is finite and not zero (of `SeamPattern::None` it does not
    /// matter), `seam_distance` is within `[10⁻⁶, 10⁶]`, and `seams_amplitude` within `[0, 1]`.
    pub fn new(
        propagation: Vec2,
        pattern: SeamPattern,
        distance: f32,
        amplitude: f32,
    ) -> Result<Self, ParameterError> {
        let direction = match (direction_in_plane("seams_propagation", propagation), pattern) {
            // The thesis normalises (0, 0) here, which is NaN on every point of a carpet without seams.
            (Err(_), SeamPattern::None) => Vec2::X,
            (direction, _) => direction?,
        };
        let frequency = PI / within("seam_distance", distance, SIZES)?;
        let amplitude = within("seams_amplitude", amplitude, SHARES)?;
        Ok(Self { direction, pattern, frequency, amplitude, grid_mean: grid_mean() })
    }

    /// The unit direction across the seams.
    #[must_use]
    pub const fn direction(&self) -> Vec2 {
        self.direction
    }

    /// f = π/distance.
    #[must_use]
    pub const fn frequency(&self) -> f32 {
        self.frequency
    }

    /// The amount of threads at a point, without any filter.
    ///
    /// - **Printed:** the derivatives lack the factor f; in the grid those of the second set of seams point along the first; and
    ///   without seams they are those of a seam at phase 0, so that a plain carpet has bumps.
    /// - **Corrected:** none of these.
    ///
    /// Where a coordinate is not finite there is no seam.
    #[must_use]
    pub fn sample(&self, uv: Vec2, form: Form) -> Seam {
        let phases = self.phases(uv);
        let waves = phases.to_array().map(sin);
        let along = usize::from(self.pattern == SeamPattern::Grid && waves[0].abs() > waves[1].abs());
        let (wave, phase) = if along == 1 { (waves[1], phases.y) } else { (waves[0], phases.x) };
        let amount = match self.pattern {
            SeamPattern::None => 1.0,
            _ => 1.0 - self.amplitude * (1.0 - wave.abs()),
        };
        let slope = match (form, self.pattern, along) {
            (Form::Printed, SeamPattern::None, _) => self.direction,
            (Form::Corrected, SeamPattern::None, _) => Vec2::ZERO,
            (Form::Printed, ..) => self.direction * folded_cosine(phase),
            (Form::Corrected, _, 0) => self.direction * (self.frequency * folded_cosine(phase)),
            (Form::Corrected, ..) => self.direction.perp() * (self.frequency * folded_cosine(phase)),
        };
        Seam { amount, slope: slope * self.amplitude }
    }

    /// The amount with rounded creases.
    ///
    /// ```text
    /// |sin p| becomes √((sin² p + ε²)/(1 + ε²)),   ε = edge
    /// ```
    ///
    /// The floor of a seam is raised by ε and its top stays at 1. An edge that is NaN or not positive is 0.
    #[must_use]
    pub fn rounded(&self, uv: Vec2, edge: f32) -> Seam {
        let e2 = if edge > 0.0 { edge.min(1e6) * edge.min(1e6) } else { 0.0 };
        let phases = self.phases(uv).to_array();
        let [x, y] = phases.map(|p| sqrt((sin(p) * sin(p) + e2) / (1.0 + e2)));
        let second = self.pattern == SeamPattern::Grid && x > y;
        let (height, phase, across) =
            if second { (y, phases[1], self.direction.perp()) } else { (x, phases[0], self.direction) };
        let slope = if height > 0.0 { sin(phase) * cos(phase) / (height * (1.0 + e2)) } else { 0.0 };
        match self.pattern {
            SeamPattern::None => Seam { amount: 1.0, slope: Vec2::ZERO },
            _ => Seam {
                amount: 1.0 - self.amplitude * (1.0 - height),
                slope: across * (self.amplitude * self.frequency * slope),
            },
        }
    }

    /// The mean amount over a pixel that is `widths` wide in texture coordinates, across the first and the second set of seams.
    ///
    /// ```text
    /// lines:  (S(p + W/2) − S(p − W/2))/W,   S = ∫|sin|,   W² = (f width)² + (π/20)²
    /// grid:   the smaller of two such for W = π/20, faded to its mean as frequency clamping fades a noise
    /// ```
    ///
    /// A mean over a width keeps the mean amount, at every width: 1 − A (1 − 2/π) of lines. The least width rounds the creases.
    /// The mean of a grid for W → 0 is 1 − A (1 − 8/π² (π/2 − 1)); for W = π/20 it is integrated once.
    ///
    /// ```
    /// use asperity_shading::{SeamPattern, Seams, glam::Vec2};
    ///
    /// let seams = Seams::new(Vec2::X, SeamPattern::Lines, 0.5, 1.0)?;
    /// let far = seams.filtered(Vec2::new(0.1, 0.0), Vec2::splat(5.0)).amount;
    /// assert!((far - 2.0 / core::f32::consts::PI).abs() < 1e-3);
    /// # Ok::<(), asperity_shading::ParameterError>(())
    /// ```
    #[must_use]
    pub fn filtered(&self, uv: Vec2, widths: Vec2) -> Seam {
        let crease = self.crease(uv, widths.abs() * self.frequency);
        let slope = self.direction * crease.slope.x + self.direction.perp() * crease.slope.y;
        Seam { amount: self.amount(crease.height), slope: slope * (self.amplitude * self.frequency) }
    }

    /// 1 − A (1 − height).
    pub(crate) fn amount(&self, height: f32) -> f32 {
        1.0 - self.amplitude * (1.0 - height)
    }

    /// |sin p| over a pixel of these widths in phase; 1 without seams.
    pub(crate) fn crease(&self, uv: Vec2, widths: Vec2) -> Crease {
        let phases = self.phases(uv);
        match self.pattern {
            SeamPattern::None => Crease { height: 1.0, slope: Vec2::ZERO },
            SeamPattern::Lines => {
                let [height, slope] = mean_crease(phases.x, sqrt(widths.x * widths.x + LEAST * LEAST));
                Crease { height, slope: Vec2::new(slope, 0.0) }
            }
            SeamPattern::Grid => {
                let [[x, dx], [y, dy]] = phases.to_array().map(|p| mean_crease(p, LEAST));
                let (height, slope) = if x <= y { (x, Vec2::new(dx, 0.0)) } else { (y, Vec2::new(0.0, dy)) };
                let kept = 1.0 - removed_share(widths.max_element(), 1.0 / PI);
                Crease { height: self.grid_mean + kept * (height - self.grid_mean), slope: slope * kept }
            }
        }
    }

    /// p along a and along a⊥; 1/4 of a turn where it is not finite.
    fn phases(&self, uv: Vec2) -> Vec2 {
        let uv = uv * self.frequency;
        let phase = |a: Vec2| {
            let p = a.dot(uv);
            if p.is_finite() { p } else { FRAC_PI_2 }
        };
        Vec2::new(phase(self.direction), phase(self.direction.perp()))
    }
}

/// The thesis's first seams, with straight sides: good enough where they are close together and there is no bump mapping.
///
/// ```text
/// printed     |frac(2p)|, a saw that leaps from 1 to 0 at every half
/// corrected   1 − |2 frac(2p) − 1|, from 0 at every half to 1 between: four times the distance to the nearest
/// ```
///
/// The text speaks of twice the distance, and of values up to 1; the distance is at most ¼. Coordinates that are not finite have 1.
///
/// Nilsson 2008, §4.2.3.
///
/// ```
/// use asperity_shading::{Form, linear_seam};
///
/// assert_eq!([0.0, 0.125, 0.25, 0.375].map(|p| linear_seam(p, Form::Corrected)), [0.0, 0.5, 1.0, 0.5]);
/// assert_eq!([0.0, 0.125, 0.25, 0.375].map(|p| linear_seam(p, Form::Printed)), [0.0, 0.25, 0.5, 0.75]);
/// ```
#[must_use]
pub fn linear_seam(p: f32, form: Form) -> f32 {
    let fraction = 2.0 * p - floor(2.0 * p);
    match form {
        _ if !fraction.is_finite() => 1.0,
        Form::Printed => fraction,
        Form::Corrected => 1.0 - (2.0 * fraction - 1.0).abs(),
    }
}

/// d|sin p|/dp from the right: the cosine of the phase folded into [0, π).
fn folded_cosine(p: f32) -> f32 {
    cos(p - floor(p / PI) * PI)
}

/// The mean of |sin| over [p − w/2, p + w/2], and its derivative by p.
fn mean_crease(p: f32, w: f32) -> [f32; 2] {
    if w > 1e4 || w.is_nan() {
        return [2.0 / PI, 0.0];
    }
    // |sin| has period π: only the place in it matters, and small phases keep their digits.
    let p = p - floor(p / PI) * PI;
    let [low, high] = [p - 0.5 * w, p + 0.5 * w];
    [(area(high) - area(low)) / w, (sin(high).abs() - sin(low).abs()) / w]
}

/// ∫₀ᵖ |sin| = 2⌊p/π⌋ + 1 − cos(p − π⌊p/π⌋).
fn area(p: f32) -> f32 {
    let whole = floor(p / PI);
    2.0 * whole + 1.0 - cos(p - whole * PI)
}

/// The mean of the smaller of two creases of the least width, of independent phases.
///
/// ```text
/// ∫₀^{π/2} crease(t) (π/2 − t) 8/π² dt
/// ```
fn grid_mean() -> f32 {
    const STEPS: u8 = 128;
    let step = FRAC_PI_2 / f32::from(STEPS);
    let mut sum = 0.0;
    for i in 0..STEPS {
        let t = (f32::from(i) + 0.5) * step;
        sum += mean_crease(t, LEAST)[0] * (FRAC_PI_2 - t);
    }
    sum * step * 8.0 / (PI * PI)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATTERNS: [SeamPattern; 3] = [SeamPattern::None, SeamPattern::Lines, SeamPattern::Grid];

    fn seams(pattern: SeamPattern) -> Seams {
        Seams::new(Vec2::new(0.6, 0.8), pattern, 0.7, 0.8).unwrap()
    }

    #[test]
    fn slopes_are_differences() {
        // Steps of 2⁻¹⁰: truncation f³ h²/6 ~ 1.5e-5, rounding 6e-8 f/h ~ 3e-4; creases are left out.
        let h = 1.0 / 1024.0;
        for pattern in PATTERNS {
            let seams = seams(pattern);
            let forms: [&dyn Fn(Vec2) -> Seam; 3] =
                [&|uv| seams.sample(uv, Form::Corrected), &|uv| seams.rounded(uv, 0.3), &|uv| {
                    seams.filtered(uv, Vec2::splat(0.05))
                }];
            for (k, form) in forms.into_iter().enumerate() {
                for i in 0..200_u8 {
                    let uv = Vec2::new(f32::from(i) * 0.037 - 3.0, f32::from(i % 17) * 0.11);
                    let at = |du, dv| form(uv + Vec2::new(du, dv));
                    let slopes = [at(h, 0.0), at(-h, 0.0), at(0.0, h), at(0.0, -h)].map(|s| s.slope);
                    if slopes.iter().any(|s| (*s - form(uv).slope).length() > 0.1) {
                        continue;
                    }
                    let along = |a: Seam, b: Seam| (a.amount - b.amount) / (2.0 * h);
                    let slope = Vec2::new(along(at(h, 0.0), at(-h, 0.0)), along(at(0.0, h), at(0.0, -h)));
                    let got = form(uv).slope;
                    assert!((got - slope).length() < 5e-3, "{pattern:?}, {k}, {uv}: {got} for {slope}");
                }
            }
        }
    }

    #[test]
    fn filters_keep_the_mean_at_every_width() {
        for (pattern, mean) in [(SeamPattern::Lines, 2.0 / PI), (SeamPattern::Grid, grid_mean())] {
            let seams = Seams::new(Vec2::X, pattern, PI, 1.0).unwrap();
            for width in [0.0, 0.01, 0.3, 1.0, 2.0, 4.0, 20.0, f32::INFINITY] {
                let mut sum = 0.0;
                for i in 0..64_u8 {
                    for j in 0..64_u8 {
                        let uv = Vec2::new(f32::from(i) + 0.5, f32::from(j) + 0.5) * (PI / 64.0);
                        sum += seams.filtered(uv, Vec2::splat(width)).amount;
                    }
                }
                // The rule's own error at the creases is 1e-4.
                assert!((sum / 4096.0 - mean).abs() < 3e-4, "{pattern:?}, {width}: {}", sum / 4096.0);
            }
        }
        // Without rounding: 8/π² (π/2 − 1) = 0.4627.
        assert!((grid_mean() - 0.4627).abs() < 0.02);
    }

    #[test]
    fn edges_are_rounded_from_the_crease_to_the_top() {
        let seams = Seams::new(Vec2::X, SeamPattern::Lines, PI, 1.0).unwrap();
        let at = |p: f32| seams.rounded(Vec2::new(p, 0.0), 0.1);
        assert!((at(0.0).amount - 0.1 / 1.01_f32.sqrt()).abs() < 1e-6 && at(0.0).slope == Vec2::ZERO);
        assert!((at(FRAC_PI_2).amount - 1.0).abs() < 1e-6);
        let sharp = seams.rounded(Vec2::new(1.0, 0.0), f32::NAN);
        assert!((sharp.amount - seams.sample(Vec2::new(1.0, 0.0), Form::Corrected).amount).abs() < 1e-6);
    }

    #[test]
    fn every_coordinate_has_an_amount() {
        let odd = [f32::NAN, f32::NEG_INFINITY, -1e30, 0.0, 1e30, f32::INFINITY];
        for pattern in PATTERNS {
            for x in odd {
                for y in odd {
                    let (uv, seams) = (Vec2::new(x, y), seams(pattern));
                    for seam in [
                        seams.sample(uv, Form::Printed),
                        seams.sample(uv, Form::Corrected),
                        seams.rounded(uv, y),
                        seams.filtered(uv, Vec2::new(y, x)),
                    ] {
                        assert!((-1e-5..=1.00001).contains(&seam.amount), "{pattern:?}, {uv}: {seam:?}");
                        assert!(seam.slope.is_finite(), "{pattern:?}, {uv}: {seam:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn linear_seams_are_continuous_as_corrected_only() {
        let leap = |form| (linear_seam(0.499_999, form) - linear_seam(0.500_001, form)).abs();
        assert!(leap(Form::Corrected) < 1e-5 && leap(Form::Printed) > 0.99);
        for p in [f32::NAN, f32::INFINITY, f32::MAX] {
            assert_eq!(linear_seam(p, Form::Corrected), 1.0, "{p}");
        }
    }

    #[test]
    fn refuses_what_are_no_seams() {
        assert!(Seams::new(Vec2::ZERO, SeamPattern::None, 1.0, 0.2).is_ok());
        assert!(Seams::new(Vec2::ZERO, SeamPattern::Grid, 1.0, 0.2).is_err());
        assert!(Seams::new(Vec2::X, SeamPattern::Grid, 0.0, 0.2).is_err());
        assert!(Seams::new(Vec2::X, SeamPattern::Grid, 1.0, f32::NAN).is_err());
    }
}
