//! Denoises an image from two independent estimates: means over neighbors that differ only by
//! noise.

use glam::Vec3;

use crate::{
    failure::Failure,
    integrator::pixels::{Watch, rows},
};

/// Half the side of the square of candidate neighbors.
const WINDOW: usize = 3;

/// Half the side of the compared patches.
const PATCH: usize = 2;

/// Squared patch distance, relative to the variance of the difference, at which a neighbor has
/// weight 1/e.
const STRENGTH: f32 = 0.2;

/// Two independent estimates of one image.
pub(super) struct Halves<'a> {
    pub columns: usize,
    pub halves: &'a [[Vec3; 2]],
    /// Variances of a channel in either half, averaged over the channels. Differences within them
    /// count as noise. Pixels without variance are unchanged.
    pub variances: &'a [f32],
}

impl Halves<'_> {
    /// Returns both estimates with most of their noise removed.
    ///
    /// Each is averaged with weights from patches of the other, so that its noise does not count as
    /// similarity:
    ///
    /// ```text
    /// w(p, q) = e^(−max(0, d²)),   d² = mean over both patches of (|u_p − u_q|² − 6 min(v_p, v_q)) / (3 · 0.2 (v_p + v_q))
    /// ```
    ///
    /// Buades, Coll and Morel 2005, "A Non-Local Algorithm for Image Denoising"; Rousselle, Knaus
    /// and Zwicker 2012, "Adaptive Rendering with Non-Local Means Filtering", eq. 2 to 5, with one
    /// variance for all channels.
    pub(super) fn smoothed(&self, watch: Watch<'_>) -> Result<Vec<[Vec3; 2]>, Failure> {
        let count = self.halves.len().checked_div(self.columns).unwrap_or(0);
        rows(count, watch, |y| self.row(y))
    }

    /// Denoises one row.
    fn row(&self, y: usize) -> Vec<[Vec3; 2]> {
        const SIDE: usize = 2 * PATCH + 1;
        // Columns of pixels covered by patches, from the left end of the first patch.
        let columns = 0..self.columns + SIDE - 1;
        let mut sums = vec![[(Vec3::ZERO, 0.0); 2]; self.columns];
        for (down, right) in
            (0..=2 * WINDOW).flat_map(|down| (0..=2 * WINDOW).map(move |right| (down, right)))
        {
            for half in [1, 0] {
                let distance = |x: usize, row: usize| {
                    let pixel = self.place(x + WINDOW, y + row + WINDOW);
                    let distance = self.distance(half, pixel, self.place(x + right, y + row + down));
                    // Beyond any distance with a weight, so that sums stay finite.
                    if (down, right) == (WINDOW, WINDOW) { 0.0 } else { distance.min(1e6) }
                };
                let patches: Vec<f32> =
                    columns.clone().map(|x| (0..SIDE).map(|row| distance(x, row)).sum()).collect();
                for (x, (patch, sums)) in patches.windows(SIDE).zip(&mut sums).enumerate() {
                    let weight = weight(patch.iter().sum::<f32>() / (SIDE * SIDE) as f32);
                    let other = self.place(x + PATCH + right, y + PATCH + down);
                    let (sum, weights) = &mut sums[1 - half];
                    *sum += weight * self.halves[other][1 - half];
                    *weights += weight;
                }
            }
        }
        sums.into_iter().map(|sums| sums.map(|(sum, weights)| sum / weights)).collect()
    }

    /// Returns the pixel at a padded position, with clamped borders.
    fn place(&self, x: usize, y: usize) -> usize {
        let within = |place: usize, end: usize| place.saturating_sub(WINDOW + PATCH).min(end - 1);
        within(y, self.halves.len() / self.columns) * self.columns + within(x, self.columns)
    }

    /// Returns the distance of one half's colors at two pixels, reduced by their noise and relative
    /// to it.
    fn distance(&self, half: usize, pixel: usize, other: usize) -> f32 {
        let (v, other_v) = (self.variances[pixel], self.variances[other]);
        let (square, variance) =
            ((self.halves[pixel][half] - self.halves[other][half]).length_squared(), v + other_v);
        // Without noise to remove, no pixels count as similar.
        if variance > 0.0 {
            (square - 6.0 * v.min(other_v)) / (3.0 * STRENGTH * variance)
        } else {
            f32::INFINITY
        }
    }
}

/// Approximates e^(−d²), with 0 beyond eight.
fn weight(distance: f32) -> f32 {
    let root = (1.0 - 0.125 * distance.max(0.0)).max(0.0);
    let square = root * root;
    square * square * (square * square)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{integrator::pixels::pixel_hash, sampling::sampler::hash};

    const SIDE: u32 = 70;

    /// Noise of deviation 1 in each channel of both halves.
    fn noise(x: u32, y: u32) -> [Vec3; 2] {
        let even = |k: u32| (hash(pixel_hash(x, y, 7) ^ hash(k)) >> 8) as f32 / 16_777_216.0 - 0.5;
        // A sum of four uniform numbers.
        [0, 3].map(|half| {
            let channel = |k: u32| (0..4).map(|term| even(half + k + 8 * term)).sum::<f32>() * 3.0_f32.sqrt();
            Vec3::new(channel(0), channel(1), channel(2))
        })
    }

    fn smoothed(threads: usize, deviation: f32, picture: impl Fn(u32, u32) -> Vec3) -> Vec<[Vec3; 2]> {
        let at = |x: u32, y: u32| noise(x, y).map(|noise| picture(x, y) + deviation * noise);
        let halves: Vec<_> =
            (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))).map(|(x, y)| at(x, y)).collect();
        let variances = vec![deviation * deviation; halves.len()];
        let of = Halves { columns: SIDE as usize, halves: &halves, variances: &variances };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| of.smoothed(Watch::unseen()).unwrap())
    }

    #[test]
    fn noise_is_removed_and_edges_and_points_stay() {
        // Half dark, half light, and a point far above the noise.
        let point = (20, 40);
        let picture = |x, y| {
            let level = if (x, y) == point {
                3.0
            } else if x < 35 {
                1.0
            } else {
                2.0
            };
            Vec3::new(level, 0.5, 0.25 * level)
        };
        let halves = smoothed(2, 0.1, picture);
        let mut squares = [0.0; 2];
        for (k, half) in halves.iter().enumerate() {
            let (x, y) = (k as u32 % SIDE, k as u32 / SIDE);
            let error = half.map(|half| half - picture(x, y));
            // No edge moves, and no point is lost. With all 49 neighbors similar, the point would
            // keep a 49th of its height.
            assert!(error.iter().all(|error| error.abs().max_element() < 0.4), "{x}, {y}: {error:?}");
            squares[0] += error[0].length_squared() / 3.0;
            squares[1] += (0.5 * (error[0] + error[1])).length_squared() / 3.0;
        }
        // The mean of 49 has at best a 49th of the variance. The halves remain independent.
        let [variance, both] = squares.map(|sum| sum / (SIDE * SIDE) as f32 / 0.01);
        assert!((1.0 / 49.0..0.1).contains(&variance), "{variance}");
        assert!((0.4..0.7).contains(&(both / variance)), "{both} of {variance}");
    }

    #[test]
    fn half_is_weighted_by_the_other_half() {
        let middle = (SIDE * SIDE / 2 + SIDE / 2) as usize;
        let mut halves = vec![[Vec3::ONE; 2]; (SIDE * SIDE) as usize];
        halves[middle][0] = Vec3::splat(50.0);
        let variances = vec![1e-4; halves.len()];
        let of = Halves { columns: SIDE as usize, halves: &halves, variances: &variances };
        let smoothed = of.smoothed(Watch::unseen()).unwrap();
        // The second half is uniform, so the point spreads over 49 pixels. In the first half 25
        // pixels differ from the rest, whose level is constant.
        assert!(
            (smoothed[middle][0] - Vec3::splat(2.0)).abs().max_element() < 1e-5,
            "{}",
            smoothed[middle][0]
        );
        assert_eq!(smoothed[middle][1], Vec3::ONE);
    }

    #[test]
    fn noise_free_and_constant_images_are_unchanged() {
        let ramp = |x: u32, y: u32| Vec3::new(x as f32, y as f32, (x * y % 7) as f32);
        for (k, half) in smoothed(1, 0.0, ramp).into_iter().enumerate() {
            assert_eq!(half, [ramp(k as u32 % SIDE, k as u32 / SIDE); 2]);
        }
        let empty = Halves { columns: 0, halves: &[], variances: &[] };
        assert!(empty.smoothed(Watch::unseen()).unwrap().is_empty());
    }

    #[test]
    fn denoised_image_is_independent_of_threads() {
        let picture = |x: u32, _| Vec3::splat((x as f32 * 0.2).sin());
        assert_eq!(smoothed(1, 0.2, picture), smoothed(3, 0.2, picture));
    }
}
