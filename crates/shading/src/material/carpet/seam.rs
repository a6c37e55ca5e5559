//! Seams of a carpet: lines or a grid with fewer threads.

use core::f32::consts::{FRAC_PI_2, PI};

use glam::Vec2;

use crate::error::ShadingError;
use crate::math::{cos, floor, sin, sqrt};
use crate::parameter::{as_share, as_size, direction_in_plane, parameters};
use crate::pixel::PixelEllipse;

/// Pattern of seams.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum SeamPattern {
    /// No seams: 0 in the thesis.
    None,
    /// Along parallel lines: 1.
    #[default]
    Lines,
    /// Along two sets of lines at right angles: 2.
    Grid,
}

parameters! {
    /// The parameters of [`Seams`], as in [`CarpetParameters`](crate::CarpetParameters).
    pub struct SeamsParameters of Seams {
        /// The direction across the seams in texture coordinates; it is normalized, and ignored for
        /// [`SeamPattern::None`]. Default (1, 0).
        seams_propagation: Vec2 = Vec2::X;
        /// Lines, a grid, or none. Default lines.
        seams_pattern: SeamPattern = SeamPattern::Lines;
        /// The distance of seams in texture coordinates, within `[10⁻⁶, 10⁶]`. Default 0.02.
        seam_distance: f32 = 0.02, as_size;
        /// The fraction of threads that is missing in a seam, within `[0, 1]`. Default 0.3.
        seams_amplitude: f32 = 0.3, as_share;
    }
}

/// The seams of a carpet: the amount of threads, and the corresponding height.
///
/// ```text
/// amount = 1 − A (1 − |sin p|),   p = f a·uv,   |a| = 1
/// grid:    the smaller of the amounts along a and along a⊥ = (−a_y, a_x)
/// ```
///
/// Seams are π/f apart in texture coordinates. |sin p| has a crease at each seam.
/// [`rounded`](Self::rounded) replaces it by √(sin² p + ε²), and [`filtered`](Self::filtered) by
/// its mean over the width of a pixel.
///
/// Nilsson 2008, §4.2.3.
///
/// ```
/// use asperity_shading::material::{Seams, SeamsParameters};
/// use asperity_shading::glam::Vec2;
///
/// let seams = Seams::new(SeamsParameters { seam_distance: 0.5, seams_amplitude: 0.2, ..Default::default() })?;
/// assert_eq!(seams.sample(Vec2::ZERO).amount, 0.8);
/// assert!((seams.sample(Vec2::new(0.25, 3.0)).amount - 1.0).abs() < 1e-6);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seams {
    parameters: SeamsParameters,
    direction: Vec2,
    frequency: f32,
}

/// Amount of threads at a point, and its slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seam {
    /// The amount of threads: 1 between seams, 1 − A on them.
    pub amount: f32,
    /// Its derivatives in texture coordinates.
    pub slope: Vec2,
}

/// |sin p| as seen by a pixel, and its derivatives by the phases along a and along a⊥.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crease {
    pub(crate) height: f32,
    pub(crate) slope: Vec2,
}

/// The minimum width, in phase, over which creases are averaged: a twentieth of the distance of two
/// seams.
const LEAST: f32 = PI / 20.0;

impl Seams {
    /// Creates the seams of these parameters.
    ///
    /// # Errors
    /// [`ShadingError`] with the first parameter that is out of its range, or for a
    /// `seams_propagation` that is zero or not finite.
    pub fn new(parameters: SeamsParameters) -> Result<Self, ShadingError> {
        let p = &parameters;
        let direction = match (direction_in_plane("seams_propagation", p.seams_propagation), p.seams_pattern)
        {
            // The thesis normalizes (0, 0) here, which is NaN at every point of a carpet without
            // seams.
            (Err(_), SeamPattern::None) => Vec2::X,
            (direction, _) => direction?,
        };
        parameters.check()?;
        Ok(Self { parameters, direction, frequency: PI / p.seam_distance })
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
    /// There is no seam where a coordinate is not finite. In the thesis the derivatives lack the
    /// factor f, the derivatives of the second set of seams of the grid point along the first set,
    /// and a carpet without seams has bumps.
    #[must_use]
    pub fn sample(&self, uv: Vec2) -> Seam {
        let phases = self.phases(uv);
        let waves = phases.to_array().map(sin);
        let along = usize::from(
            self.parameters.seams_pattern == SeamPattern::Grid && waves[0].abs() > waves[1].abs(),
        );
        let (wave, phase) = if along == 1 { (waves[1], phases.y) } else { (waves[0], phases.x) };
        let amount = match self.parameters.seams_pattern {
            SeamPattern::None => 1.0,
            _ => 1.0 - self.parameters.seams_amplitude * (1.0 - wave.abs()),
        };
        let slope = match (self.parameters.seams_pattern, along) {
            (SeamPattern::None, _) => Vec2::ZERO,
            (_, 0) => self.direction * (self.frequency * folded_cosine(phase)),
            _ => self.direction.perp() * (self.frequency * folded_cosine(phase)),
        };
        Seam { amount, slope: slope * self.parameters.seams_amplitude }
    }

    /// The amount with rounded creases.
    ///
    /// ```text
    /// |sin p| becomes √((sin² p + ε²)/(1 + ε²)),   ε = edge
    /// ```
    ///
    /// The bottom of a seam is raised by ε and its top stays at 1. An edge that is NaN or not
    /// positive is read as 0.
    #[must_use]
    pub fn rounded(&self, uv: Vec2, edge: f32) -> Seam {
        let e2 = if edge > 0.0 { edge.min(1e6) * edge.min(1e6) } else { 0.0 };
        let phases = self.phases(uv).to_array();
        let [x, y] = phases.map(|p| sqrt((sin(p) * sin(p) + e2) / (1.0 + e2)));
        let second = self.parameters.seams_pattern == SeamPattern::Grid && x > y;
        let (height, phase, across) =
            if second { (y, phases[1], self.direction.perp()) } else { (x, phases[0], self.direction) };
        let slope = if height > 0.0 { sin(phase) * cos(phase) / (height * (1.0 + e2)) } else { 0.0 };
        match self.parameters.seams_pattern {
            SeamPattern::None => Seam { amount: 1.0, slope: Vec2::ZERO },
            _ => Seam {
                amount: 1.0 - self.parameters.seams_amplitude * (1.0 - height),
                slope: across * (self.parameters.seams_amplitude * self.frequency * slope),
            },
        }
    }

    /// Mean amount over a pixel of the plane of texture coordinates.
    ///
    /// The pixel is as wide across either set of seams as its bounding box.
    ///
    /// ```text
    /// lines:  (S(p + W/2) − S(p − W/2))/W,   S = ∫|sin|,   W² = (f width)² + (π/20)²
    /// grid:   ∫₀^{π/2} m₁(θ) m₂(θ) cos θ dθ,   m(θ) the fraction of [p − W/2, p + W/2] that is farther than θ from every seam
    /// ```
    ///
    /// The amount of a grid depends on the smaller of two values. It is above a level where both
    /// are, so its mean over a rectangle is an integral over levels of products. Fractions are
    /// linear in θ between four points, and the four-point Gauss rule there is accurate to 2e-6.
    ///
    /// A mean over a width keeps the mean amount at every width: 1 − A (1 − 2/π) for lines, 1 − A
    /// (1 − 8/π² (π/2 − 1)) for grids. The minimum width rounds the creases.
    ///
    /// ```
    /// use asperity_shading::Footprint;
    /// use asperity_shading::material::{Seams, SeamsParameters};
    /// use asperity_shading::glam::Vec2;
    ///
    /// let seams = Seams::new(SeamsParameters { seam_distance: 0.5, seams_amplitude: 1.0, ..Default::default() })?;
    /// let far = seams.filtered(Vec2::new(0.1, 0.0), Footprint::from_width(5.0).into()).amount;
    /// assert!((far - 2.0 / core::f32::consts::PI).abs() < 1e-3);
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn filtered(&self, uv: Vec2, pixel: PixelEllipse) -> Seam {
        let widths = [self.direction, self.direction.perp()].map(|across| pixel.change(across.extend(0.0)));
        let widths = Vec2::from(widths);
        let crease = self.crease(uv, widths.abs() * self.frequency);
        let slope = self.direction * crease.slope.x + self.direction.perp() * crease.slope.y;
        Seam {
            amount: self.amount(crease.height),
            slope: slope * (self.parameters.seams_amplitude * self.frequency),
        }
    }

    /// 1 − A (1 − height).
    pub(crate) fn amount(&self, height: f32) -> f32 {
        1.0 - self.parameters.seams_amplitude * (1.0 - height)
    }

    /// |sin p| over a pixel of these widths in phase; 1 without seams.
    pub(crate) fn crease(&self, uv: Vec2, widths: Vec2) -> Crease {
        let phases = self.phases(uv);
        match self.parameters.seams_pattern {
            SeamPattern::None => Crease { height: 1.0, slope: Vec2::ZERO },
            SeamPattern::Lines => {
                let [height, slope] = mean_crease(phases.x, sqrt(widths.x * widths.x + LEAST * LEAST));
                Crease { height, slope: Vec2::new(slope, 0.0) }
            }
            SeamPattern::Grid => {
                let [x, y] =
                    [(phases.x, widths.x), (phases.y, widths.y)].map(|(p, w)| PhaseInterval::new(p, w));
                mean_of_smaller(&x, &y)
            }
        }
    }

    /// The variances of the slopes of |sin p| along a and a⊥ that a pixel does not resolve.
    ///
    /// The widths of the pixel are in phase.
    ///
    /// ```text
    /// lines:  ½ (k(π/20) − k(W)),   k = (1 − x)² (1 + 0.7 x − 0.65 x²),   x = min(W/π, 1),   W² = width² + (π/20)²
    /// grid:   (¼ + 1/π²) (k(π/20) l(π/20) − k(W) l(W⊥)),   k = (1 − x)² (1 − 0.6 x + 0.5 x²),   l = 1 − 0.24 (1 − (1 − x)²)
    /// ```
    ///
    /// Slopes of |sin p| have the mean square ½ across lines. In a grid the nearer seam has the
    /// steeper slope, so the mean square along each axis is ¼ + 1/π² instead of ¼. k and l are fits
    /// of the fraction that remains of a mean over W, within 0.02 below π and 0.03 above.
    pub(crate) fn removed_slopes(&self, widths: Vec2) -> [f32; 2] {
        let [x, y] = widths.to_array().map(|w| 1.0 - (sqrt(w * w + LEAST * LEAST) / PI).min(1.0));
        let near = 1.0 - LEAST / PI;
        // By 1 − x, the remaining fraction of the distance between seams.
        let line = |x: f32| x * x * (1.05 + (0.6 - 0.65 * x) * x);
        let along = |x: f32| x * x * (0.9 + (0.5 * x - 0.4) * x);
        let other = |x: f32| 0.76 + 0.24 * x * x;
        match self.parameters.seams_pattern {
            SeamPattern::None => [0.0; 2],
            SeamPattern::Lines => [(0.5 * (line(near) - line(x))).max(0.0), 0.0],
            SeamPattern::Grid => {
                let kept = |x: f32, y: f32| (0.25 + 1.0 / (PI * PI)) * along(x) * other(y);
                [(x, y), (y, x)].map(|(x, y)| (kept(near, near) - kept(x, y)).max(0.0))
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

/// d|sin p|/dp from the right: the cosine of the phase reduced to [0, π).
fn folded_cosine(p: f32) -> f32 {
    cos(p - floor(p / PI) * PI)
}

/// The mean of |sin| over [p − w/2, p + w/2], and its derivative by p.
fn mean_crease(p: f32, w: f32) -> [f32; 2] {
    if w > 1e4 || w.is_nan() {
        return [2.0 / PI, 0.0];
    }
    // |sin| has period π, so only the position in the period matters, and small phases keep their digits.
    let p = p - floor(p / PI) * PI;
    let [low, high] = [p - 0.5 * w, p + 0.5 * w];
    [(area(high) - area(low)) / w, (sin(high).abs() - sin(low).abs()) / w]
}

/// ∫₀ᵖ |sin| = 2⌊p/π⌋ + 1 − cos(p − π⌊p/π⌋).
fn area(p: f32) -> f32 {
    let whole = floor(p / PI);
    2.0 * whole + 1.0 - cos(p - whole * PI)
}

/// The interval of phases that a pixel covers.
struct PhaseInterval {
    /// Its ends, the first in (−π, π); `None` if it is many seams long.
    ends: Option<[f32; 2]>,
}

impl PhaseInterval {
    fn new(p: f32, width: f32) -> Self {
        let w = sqrt(width * width + LEAST * LEAST);
        let p = p - floor(p / PI) * PI;
        // Longer intervals have the fractions of all phases to 3e-4. A comparison with NaN is
        // false.
        Self { ends: (w < 1e4).then_some([p - 0.5 * w, p + 0.5 * w]) }
    }

    /// The distances of the ends to the nearest seam, where the fraction has kinks.
    fn bends(&self) -> [f32; 2] {
        self.ends.map_or([0.0; 2], |ends| {
            ends.map(|p| {
                let place = p - floor(p / PI) * PI;
                place.min(PI - place)
            })
        })
    }

    /// The fraction of the interval that is farther than θ from every seam.
    fn share(&self, theta: f32) -> f32 {
        let between = PI - 2.0 * theta;
        self.ends.map_or(between / PI, |[a, b]| {
            let until = |p: f32| {
                let whole = floor(p / PI);
                whole * between + (p - whole * PI - theta).clamp(0.0, between.max(0.0))
            };
            (until(b) - until(a)) / (b - a)
        })
    }

    /// Its derivative with respect to the position of the interval.
    fn moved(&self, theta: f32) -> f32 {
        self.ends.map_or(0.0, |[a, b]| {
            let [low, high] = self.bends().map(|bend| if theta < bend { 1.0 } else { 0.0 });
            (high - low) / (b - a)
        })
    }
}

/// The mean of the smaller |sin| of both axes over a rectangle of phases, and its derivatives.
///
/// ```text
/// min(s, t) = ∫₀¹ [s > l] [t > l] dl,   l = sin θ
/// ```
fn mean_of_smaller(x: &PhaseInterval, y: &PhaseInterval) -> Crease {
    /// Gauss points and weights on [0, 1].
    const RULE: [[f32; 2]; 4] = [
        [0.069_431_84, 0.173_927_42],
        [0.330_009_5, 0.326_072_58],
        [0.669_990_5, 0.326_072_58],
        [0.930_568_16, 0.173_927_42],
    ];
    let [[a, b], [c, d]] = [x.bends(), y.bends()];
    let mut bends = [a, b, c, d, FRAC_PI_2];
    bends.sort_unstable_by(f32::total_cmp);
    let mut crease = Crease { height: 0.0, slope: Vec2::ZERO };
    let mut start = 0.0;
    for end in bends {
        let length = end - start;
        if length > 0.0 {
            for [place, weight] in RULE {
                let theta = start + place * length;
                let weight = weight * length * cos(theta);
                let shares = [x.share(theta), y.share(theta)];
                crease.height += weight * shares[0] * shares[1];
                crease.slope += weight * Vec2::new(x.moved(theta) * shares[1], shares[0] * y.moved(theta));
            }
            start = end;
        }
    }
    crease
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    const PATTERNS: [SeamPattern; 3] = [SeamPattern::None, SeamPattern::Lines, SeamPattern::Grid];

    fn seams(pattern: SeamPattern) -> Seams {
        of(Vec2::new(0.6, 0.8), pattern, 0.7, 0.8)
    }

    fn of(
        seams_propagation: Vec2,
        seams_pattern: SeamPattern,
        seam_distance: f32,
        seams_amplitude: f32,
    ) -> Seams {
        let parameters = SeamsParameters { seams_propagation, seams_pattern, seam_distance, seams_amplitude };
        Seams::new(parameters).unwrap()
    }

    #[test]
    fn seam_slopes_match_finite_differences() {
        // Steps of 2⁻¹⁰: truncation f³ h²/6 ~ 1.5e-5, rounding 6e-8 f/h ~ 3e-4; creases are
        // excluded.
        let h = 1.0 / 1024.0;
        for pattern in PATTERNS {
            let seams = seams(pattern);
            let forms: [&dyn Fn(Vec2) -> Seam; 3] =
                [&|uv| seams.sample(uv), &|uv| seams.rounded(uv, 0.3), &|uv| {
                    seams.filtered(uv, PixelEllipse::aligned(Vec2::splat(0.05)))
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
                    assert_abs_diff_eq!(got, slope, epsilon = 5e-3, "{pattern:?}, {k}, {uv}");
                }
            }
        }
    }

    #[test]
    fn filtered_keeps_the_mean_at_every_width() {
        for (pattern, mean) in
            [(SeamPattern::Lines, 2.0 / PI), (SeamPattern::Grid, 8.0 / (PI * PI) * (FRAC_PI_2 - 1.0))]
        {
            let seams = of(Vec2::X, pattern, PI, 1.0);
            for width in [0.0, 0.01, 0.3, 1.0, 2.0, 4.0, 20.0, f32::INFINITY] {
                let mut sum = 0.0;
                for i in 0..64_u8 {
                    for j in 0..64_u8 {
                        let uv = Vec2::new(f32::from(i) + 0.5, f32::from(j) + 0.5) * (PI / 64.0);
                        sum += seams.filtered(uv, PixelEllipse::aligned(Vec2::splat(width))).amount;
                    }
                }
                // At the minimum width the error of the rule itself is 1e-4.
                assert_abs_diff_eq!(sum / 4096.0, mean, epsilon = 3e-4, "{pattern:?}, {width}");
            }
        }
    }

    #[test]
    fn filtered_grid_is_the_mean_over_the_pixel() {
        let seams = of(Vec2::X, SeamPattern::Grid, PI, 1.0);
        for k in 0..60_u16 {
            let uv = Vec2::new(0.31 * f32::from(k), 0.17 * f32::from(k % 23));
            let widths = Vec2::new(0.05 + 0.09 * f32::from(k % 40), 0.07 * f32::from(k % 31));
            let wide = (widths * widths + LEAST * LEAST).map(sqrt);
            let mut sum = 0.0_f64;
            for i in 0..10_000_u16 {
                let place = Vec2::new(f32::from(i % 100), f32::from(i / 100)) / 100.0 - 0.495;
                sum += f64::from(seams.sample(uv + place * wide).amount) / 1e4;
            }
            let got = seams.filtered(uv, PixelEllipse::aligned(widths)).amount;
            // The rule of 100² points errs by 1e-4.
            assert_abs_diff_eq!(f64::from(got), sum, epsilon = 3e-4, "{uv}, {widths}");
        }
    }

    #[test]
    fn rounded_raises_the_crease_and_keeps_the_top() {
        let seams = of(Vec2::X, SeamPattern::Lines, PI, 1.0);
        let at = |p: f32| seams.rounded(Vec2::new(p, 0.0), 0.1);
        assert!((at(0.0).amount - 0.1 / 1.01_f32.sqrt()).abs() < 1e-6 && at(0.0).slope == Vec2::ZERO);
        assert_abs_diff_eq!(at(FRAC_PI_2).amount, 1.0, epsilon = 1e-6);
        let sharp = seams.rounded(Vec2::new(1.0, 0.0), f32::NAN);
        assert_abs_diff_eq!(sharp.amount, seams.sample(Vec2::new(1.0, 0.0)).amount, epsilon = 1e-6);
    }

    #[test]
    fn sample_accepts_every_input() {
        let odd = [f32::NAN, f32::NEG_INFINITY, -1e30, 0.0, 1e30, f32::INFINITY];
        for pattern in PATTERNS {
            for x in odd {
                for y in odd {
                    let (uv, seams) = (Vec2::new(x, y), seams(pattern));
                    for seam in [
                        seams.sample(uv),
                        seams.rounded(uv, y),
                        seams.filtered(uv, PixelEllipse::aligned(Vec2::new(y, x))),
                    ] {
                        assert!((-1e-5..=1.00001).contains(&seam.amount), "{pattern:?}, {uv}: {seam:?}");
                        assert!(seam.slope.is_finite(), "{pattern:?}, {uv}: {seam:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn removed_slopes_match_filtered_seams() {
        const SIDE: u16 = 96;
        for pattern in PATTERNS {
            let seams = of(Vec2::X, pattern, PI, 1.0);
            let square = |widths: Vec2| {
                let mut sum = Vec2::ZERO;
                for k in 0..SIDE * SIDE {
                    let uv = Vec2::new((k % SIDE).into(), (k / SIDE).into()) + Vec2::new(0.31, 0.47);
                    let slope = seams.crease(uv * (PI / f32::from(SIDE)), widths).slope;
                    sum += slope * slope / (f32::from(SIDE) * f32::from(SIDE));
                }
                sum
            };
            let near = square(Vec2::ZERO);
            for widths in [
                [0.0, 0.0],
                [0.3, 0.3],
                [0.8, 0.8],
                [0.8, 0.0],
                [0.0, 2.0],
                [2.0, 1.0],
                [3.0, 3.0],
                [7.0, 9.0],
            ] {
                let got = Vec2::from(seams.removed_slopes(widths.into()));
                // The fits err by 0.02 of ½ below π, and by 0.03 above.
                assert_abs_diff_eq!(
                    got,
                    near - square(widths.into()),
                    epsilon = 0.015,
                    "{pattern:?}, {widths:?}"
                );
            }
            assert_eq!(seams.removed_slopes(Vec2::ZERO), [0.0; 2]);
            assert!(seams.removed_slopes(Vec2::NAN).iter().all(|v| v.is_finite()));
        }
    }
}
