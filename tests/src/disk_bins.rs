//! Bins over the disk of normals: counts samples, and integrates a density over each bin.

use approx::assert_abs_diff_eq;
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Nodes and weights of Gauss–Legendre quadrature on [0, 1].
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
    /// Returns the bin of a normal, row by row, or `None` outside the rectangle.
    #[must_use]
    pub fn index(&self, nx: f64, ny: f64) -> Option<usize> {
        let bin = |n: f64, extent: f64| {
            let k = ((n / extent * 0.5 + 0.5) * self.size as f64).floor();
            // Normals at the disk's outermost point belong to the last bin.
            let k = if n == extent { k - 1.0 } else { k };
            (k >= 0.0 && k < self.size as f64).then_some(k as usize)
        };
        Some(bin(ny, self.extent[1])? * self.size + bin(nx, self.extent[0])?)
    }

    /// Counts normals per bin, ignoring normals outside the rectangle.
    ///
    /// # Panics
    ///
    /// If a vector is not a unit vector above the horizon.
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

    /// Returns the integral of `density`, per `dn_x dn_y`, over each bin's part inside the disk.
    ///
    /// Four Gauss–Legendre nodes on each of `pieces` pieces, along y and then along x.
    #[must_use]
    pub fn integrate(&self, pieces: usize, density: impl Fn(f64, f64) -> f64 + Sync) -> Vec<f64> {
        self.projected(DVec3::Z, pieces, density)
    }

    /// Returns the integral of `density(m) max(0, v·m) dω` over each bin's part inside the disk.
    #[must_use]
    pub fn projected(&self, v: DVec3, pieces: usize, density: impl Fn(f64, f64) -> f64 + Sync) -> Vec<f64> {
        (0..self.size * self.size)
            .into_par_iter()
            .map(|bin| {
                let edge = |k: usize, extent: f64| (k as f64 / self.size as f64 * 2.0 - 1.0) * extent;
                let (i, j) = (bin % self.size, bin / self.size);
                let (x0, x1) = (edge(i, self.extent[0]), edge(i + 1, self.extent[0]));
                let (y0, y1) = (edge(j, self.extent[1]), edge(j + 1, self.extent[1]));
                // With m = (sin t, cos t sin s, cos t cos s) the rim is smooth: dω = cos t dt ds.
                let mut cuts = vec![x0.asin(), x1.asin()];
                let mut cut = |x: f64| cuts.push(x.clamp(x0, x1).asin());
                for y in [y0, y1] {
                    // Kinks are where the rim intersects the edges at y₀ and y₁,
                    let chord = (1.0 - y * y).max(0.0).sqrt();
                    [-chord, chord].into_iter().for_each(&mut cut);
                    // and where the terminator v·m = 0 does: (v_x x + v_y y)² = v_z² (1 − x² − y²).
                    let a = v.x * v.x + v.z * v.z;
                    let half = v.x * v.y * y;
                    let root = half * half - a * ((v.y * v.y + v.z * v.z) * y * y - v.z * v.z);
                    if a > 0.0 && root > 0.0 {
                        [-root.sqrt(), root.sqrt()].into_iter().for_each(|root| cut((root - half) / a));
                    }
                }
                // It ends at the rim, with its extremes in x.
                let (steepest, end) = (v.y.hypot(v.z), v.y / v.x.hypot(v.y).max(f64::MIN_POSITIVE));
                [-steepest, steepest, -end, end].into_iter().for_each(cut);
                cuts.sort_by(f64::total_cmp);
                let across = |t: f64| {
                    let (x, chord) = t.sin_cos();
                    let [low, high] =
                        [y0, y1].map(|y| (y / chord.max(f64::MIN_POSITIVE)).clamp(-1.0, 1.0).asin());
                    // v·m = v_x x + chord √(v_y² + v_z²) cos(s − middle).
                    let middle = v.y.atan2(v.z);
                    let half = (-v.x * x / (chord * steepest)).clamp(-1.0, 1.0).acos();
                    let [from, to] = [middle - half, middle + half].map(|s| s.clamp(low, high));
                    let seen = |s: f64| {
                        let (sin, cos) = s.sin_cos();
                        let m = DVec3::new(x, chord * sin, chord * cos);
                        density(m.x, m.y) * v.dot(m).max(0.0) * chord
                    };
                    [low, from, to, high]
                        .windows(2)
                        .map(|piece| composite(piece[0], piece[1], pieces, seen))
                        .sum()
                };
                cuts.windows(2).map(|piece| composite(piece[0], piece[1], pieces, across)).sum()
            })
            .collect()
    }
}

/// Returns the integral of `f` with four Gauss–Legendre nodes on each of `pieces` equal pieces.
fn composite(from: f64, to: f64, pieces: usize, f: impl Fn(f64) -> f64 + Copy) -> f64 {
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
    fn bins_of_a_constant_sum_to_the_disk() {
        let bins = DiskBins { size: 9, extent: [1.0, 1.0] };
        let area: f64 = bins.integrate(2, |_, _| 1.0).iter().sum();
        assert_abs_diff_eq!(area, core::f64::consts::PI, epsilon = 1e-9);
    }

    #[test]
    fn projected_areas_sum_to_the_silhouette() {
        // ∫ max(0, v·m) dω over the hemisphere is π (1 + cos θ)/2: the front half of the disk and
        // the ellipse behind it.
        let bins = DiskBins { size: 12, extent: [1.0, 1.0] };
        for v in
            [DVec3::Z, DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.48, -0.64, 0.6), DVec3::new(0.0, 1.0, 0.0)]
        {
            let seen: f64 = bins.projected(v, 2, |_, _| 1.0).iter().sum();
            // Where the terminator touches a bin's side, the integral along it grows with power
            // 3/2: measured 6e-5.
            assert_abs_diff_eq!(seen, core::f64::consts::PI * 0.5 * (1.0 + v.z), epsilon = 1e-4);
        }
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
