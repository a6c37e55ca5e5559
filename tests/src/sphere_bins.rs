//! Bins over the sphere of directions: counts samples, and integrates a density over each bin.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};

/// Maximum change of the integral over a part of a bin when it is split into four, before these are
/// split further.
///
/// With 200 of 40,000 samples in a bin, χ² tolerates an error of 1e-4 of the total, which is 50
/// parts.
const TOLERANCE: f64 = 2e-6;

/// Maximum number of splits of a bin: edges are resolved to 1/1024 of a bin.
const DEEPEST: u32 = 9;

/// Three nodes of Gauss–Legendre quadrature on [0, 1], with weights.
const GAUSS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_31, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// The ranges of θ and φ.
type Part = [[f64; 2]; 2];

/// Bins over the sphere, in rows of equal angle from the zenith down. Lobes are as narrow near the
/// poles as elsewhere.
#[derive(Clone, Copy, Debug)]
pub struct SphereBins {
    /// The number of rows. The hemisphere has half of them.
    pub rows: usize,
    /// The number of columns around.
    pub columns: usize,
}

impl SphereBins {
    fn steps(&self) -> [f64; 2] {
        [PI / self.rows as f64, TAU / self.columns as f64]
    }

    /// Returns the bin of a direction, row by row.
    #[must_use]
    pub fn index(&self, w: Vec3) -> usize {
        let [x, y, z] = w.to_array().map(f64::from);
        let [theta, phi] = [x.hypot(y).atan2(z), y.atan2(x).rem_euclid(TAU)];
        let [row, column] = [theta / self.steps()[0], phi / self.steps()[1]].map(|place| place as usize);
        row.min(self.rows - 1) * self.columns + column.min(self.columns - 1)
    }

    /// Counts directions per bin, ignoring zero vectors.
    #[must_use]
    pub fn count(&self, directions: impl Iterator<Item = Vec3>) -> Vec<u64> {
        let mut counts = vec![0; self.rows * self.columns];
        for w in directions.filter(|w| *w != Vec3::ZERO) {
            counts[self.index(w)] += 1;
        }
        counts
    }

    /// Returns the integral of a density over each bin's solid angle, adaptively subdivided.
    ///
    /// Fixed nodes are insufficient: densities of refracted light fall to 0 within a degree of the
    /// horizon and of the critical angle, and grow within as little.
    #[must_use]
    pub fn integrate(&self, density: impl Fn(Vec3) -> f64) -> Vec<f64> {
        let [step, turn] = self.steps();
        (0..self.rows * self.columns)
            .map(|bin| {
                let [row, column] = [bin / self.columns, bin % self.columns].map(|k| k as f64);
                let part = [[row, row + 1.0].map(|k| k * step), [column, column + 1.0].map(|k| k * turn)];
                // Split at least twice, to cover features between the nodes. With 16 by 12 bins no
                // corner of refracted light is missed; with 12 by 8 some are.
                let parts = quarters(part).into_iter();
                parts.map(|part| adaptive(part, gauss(part, &density), DEEPEST - 1, &density)).sum()
            })
            .collect()
    }
}

fn quarters([theta, phi]: Part) -> [Part; 4] {
    let halves = |[from, to]: [f64; 2]| [[from, 0.5 * (from + to)], [0.5 * (from + to), to]];
    let ([up, down], [left, right]) = (halves(theta), halves(phi));
    [[up, left], [up, right], [down, left], [down, right]]
}

fn adaptive(part: Part, coarse: f64, deepest: u32, f: &impl Fn(Vec3) -> f64) -> f64 {
    let parts = quarters(part).map(|part| (part, gauss(part, f)));
    let fine: f64 = parts.iter().map(|part| part.1).sum();
    if deepest == 0 || (fine - coarse).abs() <= TOLERANCE {
        return fine;
    }
    parts.into_iter().map(|(part, coarse)| adaptive(part, coarse, deepest - 1, f)).sum()
}

fn gauss([theta, phi]: Part, f: &impl Fn(Vec3) -> f64) -> f64 {
    let nodes = |[from, to]: [f64; 2]| GAUSS.map(|(t, weight)| ((from + (to - from) * t).sin_cos(), weight));
    let around = nodes(phi);
    let mut sum = 0.0;
    for ((sin, cos), weight) in nodes(theta) {
        for ((y, x), other) in around {
            sum += weight * other * sin * f(DVec3::new(sin * x, sin * y, cos).as_vec3());
        }
    }
    sum * (theta[1] - theta[0]) * (phi[1] - phi[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn edges_and_narrow_peaks_are_resolved() {
        let bins = SphereBins { rows: 8, columns: 6 };
        let middle = Vec3::new(0.36, -0.48, 0.8);
        // A cap of height 0.01, and a von Mises–Fisher peak 2° wide.
        let cap = bins.integrate(|w| if w.dot(middle) > 0.99 { 1.0 } else { 0.0 });
        assert_abs_diff_eq!(cap.iter().sum::<f64>(), TAU * 0.01, epsilon = 2e-4);
        let peak = bins.integrate(|w| 800.0 / TAU * f64::from(800.0 * (w.dot(middle) - 1.0)).exp());
        assert_abs_diff_eq!(peak.iter().sum::<f64>(), 1.0, epsilon = 1e-4);
        assert_abs_diff_eq!(peak[bins.index(middle)], peak.iter().copied().fold(0.0, f64::max));
    }
}
