//! Pixels in parallel rows. The samples of a pixel depend only on the pixel.

use std::{
    ops::Range,
    sync::{LazyLock, atomic::AtomicBool},
};

use glam::{Vec2, Vec3};
use indicatif::ProgressBar;
use rayon::prelude::*;

use crate::{
    failure::{Failure, Interrupted},
    image::Image,
    sampling::{low_discrepancy::r2_from, sampler::hash},
};

/// The progress of an image, and the flag that interrupts it.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    pub progress: &'a ProgressBar,
    pub interrupted: &'a AtomicBool,
}

impl Watch<'_> {
    /// Shows no progress and never stops.
    pub fn unseen() -> Self {
        static PROGRESS: LazyLock<ProgressBar> = LazyLock::new(ProgressBar::hidden);
        static GO_ON: AtomicBool = AtomicBool::new(false);
        Self { progress: &PROGRESS, interrupted: &GO_ON }
    }
}

/// Size and samples of an image.
#[derive(Clone, Copy, Debug)]
pub struct Sampling {
    pub width: u32,
    pub height: u32,
    pub samples_per_pixel: u32,
    pub seed: u32,
}

/// Returns the mean of `radiance` over each pixel, at points in pixels from the top left.
///
/// The image does not depend on the number of threads: a pixel's samples come from a hash of its
/// position, and are summed in order.
pub fn render(
    sampling: Sampling,
    watch: Watch<'_>,
    radiance: impl Fn(f32, f32) -> Vec3 + Sync,
) -> Result<Image, Failure> {
    pixels(sampling, watch, |x, y| {
        let (shift, radiance) = (jitter(x, y, sampling.seed), &radiance);
        move |k| {
            let place = sample(k, shift);
            radiance(x as f32 + place.x, y as f32 + place.y)
        }
    })
}

/// Returns the mean of each pixel's samples.
fn pixels<S: Fn(u32) -> Vec3>(
    sampling: Sampling,
    watch: Watch<'_>,
    pixel: impl Fn(u32, u32) -> S + Sync,
) -> Result<Image, Failure> {
    let samples = 0..sampling.samples_per_pixel.max(1);
    Ok(Sums::default().and(sampling, samples, watch, pixel)?.mean())
}

/// Sums of pixel samples that can be extended. The result is the same in one call and in several.
#[derive(Clone, Default)]
pub(super) struct Sums {
    sums: Option<Image>,
    samples: u32,
}

impl Sums {
    /// Adds the samples of a range, which follows the samples already summed.
    pub(super) fn and<S: Fn(u32) -> Vec3>(
        &self,
        Sampling { width, height, .. }: Sampling,
        samples: Range<u32>,
        watch: Watch<'_>,
        pixel: impl Fn(u32, u32) -> S + Sync,
    ) -> Result<Self, Failure> {
        let black = || Image { width, height, pixels: vec![Vec3::ZERO; width as usize * height as usize] };
        let mut sums = self.sums.clone().unwrap_or_else(black);
        each_row(&mut sums.pixels, width as usize, watch, |y, row| {
            for (x, sum) in row.iter_mut().enumerate() {
                let sample = pixel(x as u32, y as u32);
                *sum = samples.clone().fold(*sum, |sum, k| sum + sample(k));
            }
        })?;
        Ok(Self { sums: Some(sums), samples: samples.end })
    }

    pub(super) fn mean(self) -> Image {
        let sums = self.sums.unwrap_or(Image { width: 0, height: 0, pixels: Vec::new() });
        let count = self.samples as f32;
        sums.map(|sum| sum / count)
    }

    /// Returns the standard error of the mean: the root mean square over displayed pixels and
    /// channels, from the difference to a sum of fewer samples.
    pub(super) fn noise(&self, fewer: &Self, shown: impl Fn(f32) -> f32) -> f32 {
        let (Some(all), Some(first)) = (&self.sums, &fewer.sums) else { return f32::INFINITY };
        let [n, m] = [fewer.samples, self.samples - fewer.samples].map(|count| count as f32);
        let squares = all.pixels.iter().zip(&first.pixels).map(|(&all, &first)| {
            let difference = ((all - first) / m).map(&shown) - (first / n).map(&shown);
            difference.as_dvec3().length_squared()
        });
        let mean = squares.sum::<f64>() / (3.0 * all.pixels.len().max(1) as f64);
        (n * m).sqrt() / (n + m) * mean.sqrt() as f32
    }
}

/// Processes rows of `width` pixels in place, on all threads. A large image leaves no memory for a
/// copy.
pub(super) fn each_row<T: Send>(
    pixels: &mut [T],
    columns: usize,
    watch: Watch<'_>,
    work: impl Fn(usize, &mut [T]) + Sync,
) -> Result<(), Interrupted> {
    let rows = pixels.par_chunks_mut(columns.max(1)).enumerate();
    watch.progress.inc_length(rows.len() as u64);
    rows.try_for_each(|(y, row)| {
        Interrupted::check(watch.interrupted)?;
        work(y, row);
        watch.progress.inc(1);
        Ok(())
    })
}

/// Computes rows on all threads and returns them in order.
pub fn rows<T: Send, R: IntoIterator<Item = T>>(
    count: usize,
    watch: Watch<'_>,
    row: impl Fn(usize) -> R + Sync,
) -> Result<Vec<T>, Failure> {
    let mut rows: Vec<Vec<T>> = (0..count).map(|_| Vec::new()).collect();
    each_row(&mut rows, 1, watch, |k, made| {
        made.iter_mut().for_each(|made| made.extend(row(k)));
    })?;
    Ok(rows.into_iter().flatten().collect())
}

/// Returns the `k`-th point of the R₂ sequence, shifted on the torus.
pub(super) fn sample(k: u32, shift: Vec2) -> Vec2 {
    let [x, y] = r2_from([0.0; 2], k).map(|x| x as f32);
    Vec2::new((x + shift.x).fract(), (y + shift.y).fract())
}

/// Returns two numbers in `[0, 1)` from a hash of the pixel, 24 bits each.
pub fn jitter(x: u32, y: u32, seed: u32) -> Vec2 {
    let first = pixel_hash(x, y, seed);
    let unit = |bits: u32| (bits >> 8) as f32 / 16_777_216.0;
    Vec2::new(unit(first), unit(hash(first ^ 0x9e37_79b9)))
}

pub(super) fn pixel_hash(x: u32, y: u32, seed: u32) -> u32 {
    hash(x ^ hash(y ^ hash(seed)))
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    fn draw(threads: usize) -> Vec<Vec3> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let sampling = Sampling { width: 40, height: 30, samples_per_pixel: 5, seed: 7 };
        pool.install(|| {
            let radiance = |x: f32, y: f32| Vec3::new((x * y).sin(), x, y);
            render(sampling, Watch::unseen(), radiance).unwrap().pixels
        })
    }

    #[test]
    fn render_is_independent_of_threads() {
        assert_eq!(draw(1), draw(3));
    }

    #[test]
    fn sums_in_passes_and_their_standard_error() {
        let sampling = Sampling { width: 64, height: 64, samples_per_pixel: 12, seed: 7 };
        // Uniform over [0, 1]: a standard deviation of 1/√12.
        let pixel = |x, y| move |k| Vec3::splat(jitter(hash(x ^ k << 8), y, k).x);
        let add = |sums: &Sums, samples| sums.and(sampling, samples, Watch::unseen(), pixel).unwrap();
        let first = add(&Sums::default(), 0..4);
        let all = add(&first, 4..12);
        assert_eq!(all.clone().mean().pixels, add(&Sums::default(), 0..12).mean().pixels);
        let expected = (1.0_f32 / 12.0 / 12.0).sqrt();
        // The channels are equal: three standard errors of 4096 squares are a thirtieth.
        assert_abs_diff_eq!(all.noise(&first, |x| x), expected, epsilon = expected / 30.0);
        assert_abs_diff_eq!(all.noise(&first, |x| 0.5 * x), 0.5 * expected, epsilon = expected / 60.0);
        assert_eq!(first.noise(&Sums::default(), |x| x), f32::INFINITY);
    }

    #[test]
    fn samples_stay_in_their_pixel_and_differ_between_pixels() {
        for k in 0..1000 {
            let place = sample(k, jitter(k, 3, 1));
            assert!((0.0..1.0).contains(&place.x) && (0.0..1.0).contains(&place.y), "{k}: {place}");
        }
        assert_ne!(jitter(0, 1, 0), jitter(1, 0, 0));
    }

    #[test]
    fn render_can_be_interrupted() {
        let sampling = Sampling { width: 4, height: 4, samples_per_pixel: 1, seed: 0 };
        let stop = Watch { interrupted: &AtomicBool::new(true), ..Watch::unseen() };
        let stopped = render(sampling, stop, |_, _| Vec3::ZERO);
        assert!(stopped.is_err_and(|e| e.is::<Interrupted>()));
    }
}
