//! Grain taken from a picture that is known twice: means over neighbours that look alike but for their noise.

use std::{ops::Range, sync::atomic::AtomicBool};

use glam::Vec3;
use indicatif::ProgressBar;

use crate::{failure::Failure, integrator::pixels::rows};

/// Half the side of the square that neighbours are taken from.
const WINDOW: usize = 3;

/// Half the side of the patches that are compared.
const PATCH: usize = 2;

/// Squares of distances of patches, over the variance of their difference, at which a neighbour counts for 1/e.
const STRENGTH: f32 = 0.2;

/// Rows that are made at once.
const BAND: usize = 32;

/// Pixels beyond the border that the picture is continued by.
const MARGIN: usize = WINDOW + PATCH;

/// Two independent estimates of one picture.
pub(super) struct Halves<'a> {
    pub columns: usize,
    pub halves: &'a [[Vec3; 2]],
    /// Variances of a channel of either half, the mean over the channels: differences within them are taken for noise. Pixels without
    /// any stay as they are.
    pub variances: &'a [f32],
}

impl Halves<'_> {
    /// Both estimates without most of their noise.
    ///
    /// Each is averaged by the weights that patches of the other have, so that its own noise is not taken for a likeness:
    ///
    /// ```text
    /// w(p, q) = e^(−max(0, d²)),   d² = mean over both patches of (|u_p − u_q|² − 6 min(v_p, v_q)) / (3 · 0.2 (v_p + v_q))
    /// ```
    ///
    /// Buades, Coll and Morel 2005, "A Non-Local Algorithm for Image Denoising"; Rousselle, Knaus and Zwicker 2012, "Adaptive Rendering
    /// with Non-Local Means Filtering", eq. 2 to 5, here with one variance for all channels.
    pub(super) fn smoothed(
        &self,
        progress: &ProgressBar,
        interrupted: &AtomicBool,
    ) -> Result<Vec<[Vec3; 2]>, Failure> {
        let count = self.halves.len().checked_div(self.columns).unwrap_or(0);
        if count == 0 {
            return Ok(Vec::new());
        }
        let padded = Padded::new(self, count);
        rows(count.div_ceil(BAND), progress, interrupted, |band| {
            padded.band(band * BAND, BAND.min(count - band * BAND))
        })
    }
}

/// The picture by channels, continued beyond its border as it ends.
struct Padded {
    columns: usize,
    stride: usize,
    halves: [[Vec<f32>; 3]; 2],
    variances: Vec<f32>,
}

impl Padded {
    fn new(of: &Halves<'_>, count: usize) -> Self {
        let within = |place: usize, end: usize| place.saturating_sub(MARGIN).min(end - 1);
        let index = |x: usize, y: usize| within(y, count) * of.columns + within(x, of.columns);
        let stride = of.columns + 2 * MARGIN;
        let places: Vec<usize> = (0..count + 2 * MARGIN)
            .flat_map(|y| (0..stride).map(move |x| (x, y)))
            .map(|(x, y)| index(x, y))
            .collect();
        let channel = |half: usize, k: usize| places.iter().map(|&place| of.halves[place][half][k]).collect();
        Self {
            columns: of.columns,
            stride,
            halves: [0, 1].map(|half| [0, 1, 2].map(|k| channel(half, k))),
            variances: places.iter().map(|&place| of.variances[place]).collect(),
        }
    }

    /// So many rows from one on.
    fn band(&self, first: usize, count: usize) -> Vec<[Vec3; 2]> {
        let Self { columns, stride, .. } = *self;
        let wide = columns + 2 * PATCH;
        let mut distances = vec![0.0; (count + 2 * PATCH) * wide];
        let mut sums = [0, 1].map(|_| Sums::new(count * columns));
        let mut weights = Weights { columns: vec![0.0; wide], row: vec![0.0; columns] };
        for (down, right) in
            (0..=2 * WINDOW).flat_map(|down| (0..=2 * WINDOW).map(move |right| (down, right)))
        {
            for (half, sums) in [1, 0].into_iter().zip(&mut sums) {
                for (y, row) in distances.chunks_exact_mut(wide).enumerate() {
                    let at = (first + y + WINDOW) * stride + WINDOW;
                    self.distances(half, [at, (first + y + down) * stride + right], row);
                }
                for y in 0..count {
                    let other = (first + y + PATCH + down) * stride + PATCH + right;
                    let patches = &distances[y * wide..(y + 2 * PATCH + 1) * wide];
                    let channels =
                        self.halves[1 - half].each_ref().map(|channel| &channel[other..other + columns]);
                    sums.add(y * columns, weights.of(patches), channels);
                }
            }
        }
        let [first, second] = sums.map(Sums::means);
        first.into_iter().zip(second).map(|(first, second)| [first, second]).collect()
    }

    /// Distances of one half's colours along two rows, above that of their noise and over it.
    fn distances(&self, half: usize, [at, other]: [usize; 2], row: &mut [f32]) {
        if at == other {
            return row.fill(0.0);
        }
        let both = [at, other].map(|start| start..start + row.len());
        let [r, g, b] = self.halves[half].each_ref().map(|channel| pair(channel, &both));
        let v = pair(&self.variances, &both);
        for (k, distance) in row.iter_mut().enumerate() {
            let [r, g, b] = [r, g, b].map(|channel| channel[0][k] - channel[1][k]);
            let least = if v[0][k] < v[1][k] { v[0][k] } else { v[1][k] };
            let square = r * r + g * g + b * b - 6.0 * least;
            let variance = v[0][k] + v[1][k];
            // Where there is no noise to take out nothing is alike.
            *distance = if variance > 0.0 { square / (3.0 * STRENGTH * variance) } else { f32::INFINITY };
        }
    }
}

fn pair<'a>(values: &'a [f32], [first, second]: &[Range<usize>; 2]) -> [&'a [f32]; 2] {
    [&values[first.clone()], &values[second.clone()]]
}

/// Weights of one row of neighbours, and what they are made of.
struct Weights {
    /// Sums of distances down a patch.
    columns: Vec<f32>,
    row: Vec<f32>,
}

impl Weights {
    /// By the distances in all rows of the patches.
    fn of(&mut self, patches: &[f32]) -> &[f32] {
        const AREA: f32 = ((2 * PATCH + 1) * (2 * PATCH + 1)) as f32;
        let wide = self.columns.len();
        self.columns.fill(0.0);
        for row in patches.chunks_exact(wide) {
            for (sum, distance) in self.columns.iter_mut().zip(row) {
                // Beyond any that has a weight: a sum of them must stay finite.
                *sum += distance.min(1e6);
            }
        }
        for (weight, patch) in self.row.iter_mut().zip(self.columns.windows(2 * PATCH + 1)) {
            let distance = patch.iter().sum::<f32>() / AREA;
            // Close to e^(−d²), and none beyond eight.
            let root = (1.0 - 0.125 * distance.max(0.0)).max(0.0);
            let square = root * root;
            *weight = square * square * (square * square);
        }
        &self.row
    }
}

/// Weighted sums of the channels and of the weights.
struct Sums {
    channels: [Vec<f32>; 3],
    weights: Vec<f32>,
}

impl Sums {
    fn new(count: usize) -> Self {
        Self { channels: [0, 1, 2].map(|_| vec![0.0; count]), weights: vec![0.0; count] }
    }

    fn add(&mut self, at: usize, weights: &[f32], channels: [&[f32]; 3]) {
        let range = at..at + weights.len();
        for (sums, values) in self.channels.iter_mut().zip(channels) {
            for ((sum, weight), value) in sums[range.clone()].iter_mut().zip(weights).zip(values) {
                *sum += weight * value;
            }
        }
        for (sum, weight) in self.weights[range].iter_mut().zip(weights) {
            *sum += weight;
        }
    }

    fn means(self) -> Vec<Vec3> {
        let [r, g, b] = self.channels;
        let sums = r.into_iter().zip(g).zip(b).map(|((r, g), b)| Vec3::new(r, g, b));
        sums.zip(self.weights).map(|(sum, weight)| sum / weight).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{integrator::pixels::pixel_hash, sampling::sampler::hash};

    const SIDE: u32 = 70;

    /// Noise of deviation 1 in each channel of both halves.
    fn noise(x: u32, y: u32) -> [Vec3; 2] {
        let even = |k: u32| (hash(pixel_hash(x, y, 7) ^ hash(k)) >> 8) as f32 / 16_777_216.0 - 0.5;
        // A sum of four even numbers.
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
        pool.install(|| of.smoothed(&ProgressBar::hidden(), &AtomicBool::new(false)).unwrap())
    }

    #[test]
    fn noise_goes_and_edges_and_points_stay() {
        // Half dark, half light, and a point beyond all noise.
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
            // No edge moves, and no point is lost: with all 49 neighbours alike it would have a 49th of its height.
            assert!(error.iter().all(|error| error.abs().max_element() < 0.4), "{x}, {y}: {error:?}");
            squares[0] += error[0].length_squared() / 3.0;
            squares[1] += (0.5 * (error[0] + error[1])).length_squared() / 3.0;
        }
        // The mean of 49 has a 49th of the variance at best; the halves are as independent as they were.
        let [variance, both] = squares.map(|sum| sum / (SIDE * SIDE) as f32 / 0.01);
        assert!((1.0 / 49.0..0.1).contains(&variance), "{variance}");
        assert!((0.4..0.7).contains(&(both / variance)), "{both} of {variance}");
    }

    #[test]
    fn a_half_is_averaged_by_the_likeness_of_the_other() {
        let middle = (SIDE * SIDE / 2 + SIDE / 2) as usize;
        let mut halves = vec![[Vec3::ONE; 2]; (SIDE * SIDE) as usize];
        halves[middle][0] = Vec3::splat(50.0);
        let variances = vec![1e-4; halves.len()];
        let of = Halves { columns: SIDE as usize, halves: &halves, variances: &variances };
        let smoothed = of.smoothed(&ProgressBar::hidden(), &AtomicBool::new(false)).unwrap();
        // The second sees nothing there: the point is shared by 49. To the first 25 are unlike the rest, whose level is the same.
        assert!(
            (smoothed[middle][0] - Vec3::splat(2.0)).abs().max_element() < 1e-5,
            "{}",
            smoothed[middle][0]
        );
        assert_eq!(smoothed[middle][1], Vec3::ONE);
    }

    #[test]
    fn pictures_without_noise_and_of_one_level_stay_as_they_are() {
        let ramp = |x: u32, y: u32| Vec3::new(x as f32, y as f32, (x * y % 7) as f32);
        for (k, half) in smoothed(1, 0.0, ramp).into_iter().enumerate() {
            assert_eq!(half, [ramp(k as u32 % SIDE, k as u32 / SIDE); 2]);
        }
        let empty = Halves { columns: 0, halves: &[], variances: &[] };
        assert!(empty.smoothed(&ProgressBar::hidden(), &AtomicBool::new(false)).unwrap().is_empty());
    }

    #[test]
    fn the_number_of_threads_changes_no_bit() {
        let picture = |x: u32, _| Vec3::splat((x as f32 * 0.2).sin());
        assert_eq!(smoothed(1, 0.2, picture), smoothed(3, 0.2, picture));
    }
}
