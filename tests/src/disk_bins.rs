//! Bins over the disk of normals: counting samples, and integrating a density over each bin.

use approx::assert_abs_diff_eq;
use glam::Vec3;

/// Nodes and weights of Gauss and Legendre on [0, 1].
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// `size · size` equal bins over the rectangle `|n_x| ≤ extent[0]`, `|n_y| ≤ extent[1]`.
#[derive(Clone, Copy, Debug)]
pub struct DiskBins {
    /// The number of bins along a side.
    pub size: usize,
    /// Half the sides of the rectangle, at most 1.
    pub extent: [f64; 2],
}

impl DiskBins {
    /// The bin of a normal, row by row; nothing outside the rectangle.
    #[must_use]
    pub fn index(&self, nx: f64, ny: f64) -> Option<usize> {
        let bin = |n: f64, extent: f64| {
            let k = ((n / extent * 0.5 + 0.5) * self.size as f64).floor();
            // The normals at the disk's outermost point belong to the last bin.
            let k = if n == extent { k - 1.0 } else { k };
            (k >= 0.0 && k < self.size as f64).then_some(k as usize)
        };
        Some(bin(ny, self.extent[1])? * self.size + bin(nx, self.extent[0])?)
    }

    /// Counts of normals by their bins; those outside the rectangle are in none.
    ///
    /// # Panics
    /// If one is no unit vector above the horizon.
    #[must_use]
    pub fn count(&self, normals: impl Iterator<Item = Vec3>) -> Vec<u64> {
        let mut counts = vec![0; self.size * self.size];
        for m in normals {
            assert!(m.z > 0.0, "{m}");
            assert_abs_diff_eq!(m.length(), 1.0, epsilon = 1e-6);
            if let Some(bin) = self.index(f64::from(m.x), f64::from(m.y)) {
                counts[bin] += 1;
            }
        }
        counts
    }

    /// The integral over each bin's part inside the disk of `density`, per `dn_x dn_y`.
    ///
    /// Four Gauss–Legendre nodes on each of `pieces` pieces, along y and then along x.
    #[must_use]
    pub fn integrate(&self, pieces: usize, density: impl Fn(f64, f64) -> f64 + Sync) -> Vec<f64> {
        use rayon::prelude::*;
        (0..self.size * self.size)
            .into_par_iter()
            .map(|bin| {
                let edge = |k: usize, extent: f64| (k as f64 / self.size as f64 * 2.0 - 1.0) * extent;
                let (i, j) = (bin % self.size, bin / self.size);
                let (x0, x1) = (edge(i, self.extent[0]), edge(i + 1, self.extent[0]));
                let (y0, y1) = (edge(j, self.extent[1]), edge(j + 1, self.extent[1]));
                // With x = sin t the chord is cos t, smooth at the ends; its kinks at y₀ and y₁ remain.
                let mut cuts = vec![x0.asin(), x1.asin()];
                // |y| = cos t has its kinks at t = ±acos|y|.
                cuts.extend([y0, y1].iter().flat_map(|y| {
                    let t = y.abs().min(1.0).acos();
                    [-t, t].map(|t| t.clamp(x0.asin(), x1.asin()))
                }));
                cuts.sort_by(f64::total_cmp);
                let across = |x: f64| {
                    let chord = (1.0 - x * x).max(0.0).sqrt();
                    let (low, high) = (y0.clamp(-chord, chord), y1.clamp(-chord, chord));
                    composite(low, high, pieces, |y| density(x, y))
                };
                cuts.windows(2)
                    .map(|piece| composite(piece[0], piece[1], pieces, |t| across(t.sin()) * t.cos()))
                    .sum()
            })
            .collect()
    }
}

/// The integral of `f` by four Gauss–Legendre nodes on each of `pieces` equal pieces.
fn composite(from: f64, to: f64, pieces: usize, f: impl Fn(f64) -> f64) -> f64 {
    if to <= from {
        return 0.0;
    }
    let step = (to - from) / pieces as f64;
    let nodes =
        (0..pieces).flat_map(|k| GAUSS.map(|(t, weight)| (from + step * (k as f64 + t), weight * step)));
    nodes.map(|(t, weight)| weight * f(t)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_of_a_constant_add_up_to_the_disk() {
        let bins = DiskBins { size: 9, extent: [1.0, 1.0] };
        let area: f64 = bins.integrate(2, |_, _| 1.0).iter().sum();
        assert_abs_diff_eq!(area, core::f64::consts::PI, epsilon = 1e-9);
    }

    #[test]
    fn index_is_row_by_row() {
        let bins = DiskBins { size: 4, extent: [0.5, 1.0] };
        assert_eq!(bins.index(0.4, -0.9), Some(3));
        assert_eq!(bins.index(-0.4, 0.9), Some(12));
        assert_eq!(bins.index(0.6, 0.0), None);
        assert_eq!(bins.index(0.5, 1.0), Some(15));
    }
}
