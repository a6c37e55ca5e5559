//! Checks of a kind of noise against its stated statistics.

use alloc::{vec, vec::Vec};

use asperity_core::check::{Limit, Report, Settings};
use asperity_core::math::{ln_f64, sqrt_f64};

use crate::{
    check::{
        field::{axes, field},
        settings::stream,
    },
    contract::field::Field,
    contract::noise::Noise,
    point::Point,
};

/// Half a side of the box that points are drawn from, in cells.
const BOX: f32 = 64.0;

/// The number of octaves of the sum whose distribution is in [`Statistics`](crate::Statistics).
const OCTAVES: usize = 8;

/// Error of measured means and deviations, over σ₁, and of measured distributions.
const TABLE: f64 = 3e-3;

/// Checks of a [`Noise`]: the checks of [`field`](field()), and mean, deviation and distribution
/// over seeds.
///
/// ```text
/// |mean − μ| < z σ₁/√n,      |mean of (n − μ)² − σ₁²| < z s/√n,      sup |F(r) − G(r)| < z/(2√n),      z = √(2 ln(2·3/significance))
/// ```
///
/// - **Samples:** each has its own seed and position, so that samples are independent. s is the
///   sample deviation of squares.
/// - **Distribution:** F is the distribution of sums of eight octaves with gain ½, divided by their
///   deviation, at the knots of [`Statistics::cdf`](crate::Statistics), tested by
///   Kolmogorov–Smirnov.
/// - **Significance:** each bound is exceeded with at most a third of the probability of the
///   settings. The bounds of means use Chernoff's bound of Gaussian tails, the bound of the
///   distribution uses Massart's inequality. The measured tables themselves are allowed an error of
///   0.003, in units of σ₁.
///
/// ```
/// use asperity_noise::{GaussianNoise, check, glam::Vec2};
///
/// let report = check::noise::<Vec2, _>(&GaussianNoise::new(1), check::Settings::default());
/// assert!(report.passed() && report.checks.len() == 7, "{report}");
/// ```
///
/// Massart 1990, "The Tight Constant in the Dvoretzky–Kiefer–Wolfowitz Inequality".
#[must_use]
pub fn noise<V: Point, N: Noise + Field<V> + Clone>(noise: &N, settings: Settings) -> Report {
    let mut report = field(noise, settings);
    let n = settings.samples.max(4096) as usize;
    let (mut word, mut position) = (stream(settings, 4), stream(settings, 5));
    let statistics = noise.statistics(axes::<V>());
    let moments = noise.moments().map(|moments| [moments.mean, moments.standard_deviation]);
    let [mu, sigma] = moments.unwrap_or([0.0, statistics.standard_deviation]).map(f64::from);
    let mut draw = || {
        let seeded = noise.clone().with_seed((word.word() >> 32) as u32);
        let p = V::from_axes(|_| ((position.word() >> 40) as f32 / 8_388_608.0 - 1.0) * BOX);
        (f64::from(seeded.value(p)) - mu) / sigma
    };
    let singles: Vec<f64> = (0..n).map(|_| draw()).collect();
    let gains: Vec<f64> = (0..OCTAVES).map(|i| 1.0 / f64::from(1_u32 << i)).collect();
    let deviation = sqrt_f64(gains.iter().map(|gain| gain * gain).sum());
    let sums = (0..n).map(|_| gains.iter().map(|gain| gain * draw()).sum::<f64>() / deviation);

    let (root, z) = (sqrt_f64(n as f64), sqrt_f64(2.0 * ln_f64(2.0 * 3.0 / settings.significance)));
    let mean = |f: &dyn Fn(f64) -> f64| singles.iter().map(|&x| f(x)).sum::<f64>() / n as f64;
    let (first, second, fourth) = (mean(&|x| x), mean(&|x| x * x), mean(&|x| x * x * x * x));
    let beyond = |error: f64, table: f64, deviation: f64| (error.abs() - table).max(0.0) * root / deviation;
    let (quantity, limit) = ("error over the standard error", Limit::AtMost(z));
    report.add("mean", quantity, beyond(first, TABLE, sqrt_f64(second)), limit, "");
    let spread = sqrt_f64((fourth - second * second).max(0.0));
    report.add("deviation", quantity, beyond(second - 1.0, 2.0 * TABLE, spread), limit, "");
    let distance = distance(sums, statistics.cdf, n);
    report.add(
        "distribution",
        "sup |F − G| √n",
        (distance - TABLE).max(0.0) * root,
        Limit::AtMost(0.5 * z),
        "",
    );
    report
}

/// The largest difference of an empirical distribution function from a table over ±4.
fn distance(samples: impl Iterator<Item = f64>, cdf: &[f32], n: usize) -> f64 {
    let cells = cdf.len().saturating_sub(1) as f64;
    let mut counts = vec![0_u32; cdf.len()];
    for r in samples {
        // The first knot that is not below. The cast clamps values beyond the knots to the ends.
        let knot = (r + 4.0) * cells / 8.0;
        let above = knot as usize + usize::from(knot > 0.0);
        if let Some(count) = counts.get_mut(above) {
            *count += 1;
        }
    }
    let mut below = 0;
    counts.iter().zip(cdf).fold(0.0, |most: f64, (&count, &g)| {
        below += count;
        most.max((f64::from(below) / n as f64 - f64::from(g)).abs())
    })
}
