//! Slopes that one lobe fits badly: few steep texels among many flat ones.

use asperity_shading::normal_map::SlopeMoments;
use glam::{Mat2, Vec2};

/// Smallest α: of a roughness of 0.045, at which renderers stop.
pub(super) const SHARPEST: f32 = 0.002;

/// The slopes in a texel, with moments to the fourth order.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spread {
    pub(super) moments: SlopeMoments,
    tails: Tails,
}

/// Higher moments of slopes, where d is the difference to the mean.
#[derive(Clone, Copy, Debug, Default)]
struct Tails {
    /// The mean of |d|² d.
    third: Vec2,
    /// The mean of |d|⁴.
    fourth: f32,
}

impl Spread {
    pub(super) fn point(slope: Vec2) -> Self {
        Self { moments: SlopeMoments::point(slope), tails: Tails::default() }
    }

    /// Returns the slopes of parts with weights.
    pub(super) fn mixed(parts: &[(f32, Self)]) -> Self {
        let moments = SlopeMoments::mixed(parts.iter().map(|(weight, part)| (*weight, part.moments)));
        let all: f32 = parts.iter().map(|(weight, _)| weight).sum();
        let mut tails = Tails::default();
        for (weight, Self { moments: part, tails: Tails { third, fourth } }) in parts {
            let (weight, d) = (weight / all, part.mean - moments.mean);
            let [xx, xy, yy] = part.covariance;
            let (along, d2) = (Mat2::from_cols_array(&[xx, xy, xy, yy]) * d, d.length_squared());
            tails.third += weight * (*third + 2.0 * along + (xx + yy + d2) * d);
            tails.fourth += weight * (fourth + 4.0 * d.dot(*third + along) + (2.0 * (xx + yy) + d2) * d2);
        }
        Self { moments, tails }
    }

    /// Returns the variance to add to α₀², as a fraction of tr Σ: 1 if the fourth moment is at most
    /// the Gaussian one, (tr Σ)² + 2 tr Σ².
    ///
    /// Otherwise, the lobe of maximum likelihood for two parts. The ratio of the fourth moments is
    /// the fraction p of steep texels. The flat ones are p |E|d|²d|/tr Σ away from the mean, as of
    /// two slopes. The steep ones have the rest of the variance.
    pub(super) fn kept(self, alpha2: f32) -> f32 {
        let [xx, xy, yy] = self.moments.covariance.map(f64::from);
        let (variance, fourth) = (xx + yy, f64::from(self.tails.fourth));
        let gaussian = variance * variance + 2.0 * (xx * xx + 2.0 * xy * xy + yy * yy);
        if fourth <= gaussian || gaussian <= 0.0 {
            return 1.0;
        }
        let (p, alpha2) = (gaussian / fourth, f64::from(alpha2.max(SHARPEST * SHARPEST)));
        let flat = (p * f64::from(self.tails.third.length()) / variance).powi(2).min(variance);
        let steep = (variance - (1.0 - p) * flat) / p;
        let mean = |lobe| (1.0 - p) * within(lobe / (alpha2 + flat)) + p * within(lobe / (alpha2 + steep));
        // `within(1/x)` is convex and ½ at 1: the lobe is at most as wide as with all variance.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..20 {
            let middle = 0.5 * (low + high);
            if mean(alpha2 + middle * variance) < 0.5 { low = middle } else { high = middle }
        }
        high as f32
    }
}

/// Returns the mean of α²/(α² + tan²θ) over a GGX lobe with `α²/q`.
///
/// The likelihood of α is largest where this is ½: at `q = 1`.
fn within(q: f64) -> f64 {
    let d = q - 1.0;
    if d.abs() < 1e-4 { 0.5 + d / 6.0 } else { q * (d - q.ln()) / (d * d) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Slopes `[x, y]`, all with the same weight.
    fn mixed(slopes: impl IntoIterator<Item = [f64; 2]>) -> Spread {
        let parts: Vec<_> = slopes
            .into_iter()
            .map(|slope| (1.0, Spread::point(Vec2::from(slope.map(|s| s as f32)))))
            .collect();
        Spread::mixed(&parts)
    }

    /// Slopes of a Gaussian or another radial distribution, by its radius at a CDF.
    fn radial(radius: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        let rings = (0..200).flat_map(|k| (0..16).map(move |j| ((f64::from(k) + 0.5) / 200.0, j)));
        let slope = |(cdf, j)| {
            let (sin, cos) = (f64::from(j) * std::f64::consts::TAU / 16.0).sin_cos();
            [radius(cdf) * cos, radius(cdf) * sin]
        };
        rings.map(slope).collect()
    }

    #[test]
    fn mixed_moments_of_parts() {
        let slopes: Vec<[f64; 2]> =
            (0..60).map(|k| [0.3 + 0.4 * f64::from(k * k % 7), 0.1 * f64::from(k % 5).powi(2)]).collect();
        let direct = mixed(slopes.clone());
        let parts = [0..7, 7..30, 30..60].map(|range| (range.len() as f32, mixed(slopes[range].to_vec())));
        let joined = Spread::mixed(&parts);
        let mean = [0, 1].map(|axis| slopes.iter().map(|s| s[axis]).sum::<f64>() / 60.0);
        let (mut third, mut fourth) = ([0.0; 2], 0.0);
        for slope in &slopes {
            let d = [0, 1].map(|axis| slope[axis] - mean[axis]);
            let d2 = d[0] * d[0] + d[1] * d[1];
            third = [0, 1].map(|axis| third[axis] + d2 * d[axis] / 60.0);
            fourth += d2 * d2 / 60.0;
        }
        for got in [direct, joined] {
            assert!((f64::from(got.tails.third.x) - third[0]).abs() < 1e-5, "{got:?} {third:?}");
            assert!((f64::from(got.tails.third.y) - third[1]).abs() < 1e-5, "{got:?} {third:?}");
            assert!((f64::from(got.tails.fourth) - fourth).abs() < 1e-5, "{got:?} {fourth}");
        }
    }

    #[test]
    fn kept_all_of_slopes_without_tails() {
        // A disk, a ring, two slopes and a Gaussian cut at 3.3 standard deviations.
        for slopes in [
            radial(|cdf| 0.3 * cdf.sqrt()),
            radial(|_| 0.2),
            vec![[0.4, 0.0], [-0.4, 0.0]],
            radial(|cdf| 0.1 * (-2.0 * (1.0 - cdf).ln()).sqrt()),
        ] {
            for alpha2 in [0.0, 1e-4, 0.1, 1.0] {
                assert_eq!(mixed(slopes.iter().copied()).kept(alpha2), 1.0);
            }
        }
        assert_eq!(Spread::default().kept(0.0), 1.0);
    }

    #[test]
    fn kept_is_the_likeliest_lobe_of_few_steep_texels() {
        // 2 % of steep texels in four directions.
        let few = |k: u32| match k {
            0 => [0.8, 0.0],
            1 => [-0.8, 0.0],
            2 => [0.0, 0.8],
            3 => [0.0, -0.8],
            _ => [0.0; 2],
        };
        let slopes = mixed((0..200).map(few));
        let variance = 0.02 * 0.64;
        for alpha0 in [0.01, 0.04, 0.2] {
            let alpha2 = alpha0 * alpha0;
            let kept = f64::from(slopes.kept(alpha2 as f32));
            let likelihood = |lobe: f64| {
                // tan² of each GGX lobe at quantiles; p = 8 v²/2 / (0.02 0.64²).
                let p: f64 = 2.0 * variance * variance / (0.02 * 0.64 * 0.64);
                let part = |own: f64| {
                    let log = |k: u32| {
                        let u = (f64::from(k) + 0.5) / 4e3;
                        (lobe / (lobe + own * (1.0 / u - 1.0)).powi(2)).ln()
                    };
                    (0..4000).map(log).sum::<f64>() / 4e3
                };
                (1.0 - p) * part(alpha2) + p * part(alpha2 + variance / p)
            };
            let best = likelihood(alpha2 + kept * variance);
            for other in [0.9, 1.1] {
                assert!(likelihood(other * (alpha2 + kept * variance)) < best, "{alpha0}: {kept}");
            }
            assert!(kept < 0.5, "{alpha0}: {kept}");
        }
    }

    #[test]
    fn kept_is_a_fraction() {
        let bad = [f32::NAN, f32::INFINITY, 0.0, 1e-40, 1e38, -1.0, 0.5];
        for (x, y) in bad.into_iter().flat_map(|x| bad.map(|y| (x, y))) {
            for z in bad {
                let moments = SlopeMoments { mean: Vec2::ZERO, covariance: [x, y, z] };
                let slopes = Spread { moments, tails: Tails { third: Vec2::new(y, x), fourth: z } };
                assert!((0.0..=1.0).contains(&slopes.kept(x)), "{slopes:?}");
            }
        }
    }
}
