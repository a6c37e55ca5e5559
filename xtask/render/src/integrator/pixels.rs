//! Pixels in parallel rows, with samples that depend on the pixel alone.

use std::sync::atomic::AtomicBool;

use glam::{Vec2, Vec3};
use indicatif::ProgressBar;
use rayon::prelude::*;

use crate::{
    failure::{Failure, Interrupted},
    image::Image,
    sampling::{
        low_discrepancy::r2_from,
        sampler::{Sampler, hash},
    },
};

/// Size and samples of a picture.
#[derive(Clone, Copy, Debug)]
pub struct Sampling {
    pub width: u32,
    pub height: u32,
    pub samples_per_pixel: u32,
    pub seed: u32,
}

/// The mean of `radiance` over each pixel, at points given in pixels from the top left.
///
/// One image whatever the number of threads: a pixel's samples come from a hash of its place, and are summed in
/// order.
pub fn render(
    sampling: Sampling,
    progress: &ProgressBar,
    interrupted: &AtomicBool,
    radiance: impl Fn(f32, f32) -> Vec3 + Sync,
) -> Result<Image, Failure> {
    pixels(sampling, progress, interrupted, |x, y| {
        let (shift, radiance) = (jitter(x, y, sampling.seed), &radiance);
        move |k| {
            let place = sample(k, shift);
            radiance(x as f32 + place.x, y as f32 + place.y)
        }
    })
}

/// The mean of `radiance` over the samples of each pixel, each with random points of its own; the first is its place in the pixel.
pub fn render_paths(
    sampling: Sampling,
    progress: &ProgressBar,
    interrupted: &AtomicBool,
    radiance: impl Fn(f32, f32, &mut Sampler) -> Vec3 + Sync,
) -> Result<Image, Failure> {
    pixels(sampling, progress, interrupted, |x, y| {
        let (seed, radiance) = (pixel_hash(x, y, sampling.seed), &radiance);
        move |k| {
            let mut sampler = Sampler::new(k, seed);
            let place = sampler.point();
            radiance(x as f32 + place.x, y as f32 + place.y, &mut sampler)
        }
    })
}

/// The mean of the samples that each pixel gives.
fn pixels<S: Fn(u32) -> Vec3>(
    sampling: Sampling,
    progress: &ProgressBar,
    interrupted: &AtomicBool,
    pixel: impl Fn(u32, u32) -> S + Sync,
) -> Result<Image, Failure> {
    let Sampling { width, height, samples_per_pixel, .. } = sampling;
    let count = samples_per_pixel.max(1);
    let mean = |sample: S| (0..count).fold(Vec3::ZERO, |sum, k| sum + sample(k)) / count as f32;
    let row = |y: usize| (0..width).map(|x| mean(pixel(x, y as u32))).collect::<Vec<_>>();
    Ok(Image { width, height, pixels: rows(height as usize, progress, interrupted, row)? })
}

/// Rows one below the other, made on all threads, in their order whatever the number of threads.
pub fn rows<T: Send, R: IntoIterator<Item = T>>(
    count: usize,
    progress: &ProgressBar,
    interrupted: &AtomicBool,
    row: impl Fn(usize) -> R + Sync,
) -> Result<Vec<T>, Failure> {
    progress.inc_length(count as u64);
    let made = |k| {
        Interrupted::check(interrupted)?;
        let row = row(k).into_iter().collect();
        progress.inc(1);
        Ok(row)
    };
    let rows: Result<Vec<Vec<T>>, Interrupted> = (0..count).into_par_iter().map(made).collect();
    Ok(rows?.into_iter().flatten().collect())
}

/// The `k`-th point of the R₂ sequence, shifted on the torus.
fn sample(k: u32, shift: Vec2) -> Vec2 {
    let [x, y] = r2_from([0.0; 2], k).map(|x| x as f32);
    Vec2::new((x + shift.x).fract(), (y + shift.y).fract())
}

/// Two numbers in `[0, 1)` from a hash of the pixel, 24 bits each.
pub fn jitter(x: u32, y: u32, seed: u32) -> Vec2 {
    let first = pixel_hash(x, y, seed);
    let unit = |bits: u32| (bits >> 8) as f32 / 16_777_216.0;
    Vec2::new(unit(first), unit(hash(first ^ 0x9e37_79b9)))
}

fn pixel_hash(x: u32, y: u32, seed: u32) -> u32 {
    hash(x ^ hash(y ^ hash(seed)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn draw(threads: usize) -> Vec<Vec3> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let sampling = Sampling { width: 40, height: 30, samples_per_pixel: 5, seed: 7 };
        pool.install(|| {
            let radiance = |x: f32, y: f32| Vec3::new((x * y).sin(), x, y);
            render(sampling, &ProgressBar::hidden(), &AtomicBool::new(false), radiance).unwrap().pixels
        })
    }

    #[test]
    fn the_number_of_threads_changes_no_bit() {
        assert_eq!(draw(1), draw(3));
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
    fn an_interruption_stops_it() {
        let sampling = Sampling { width: 4, height: 4, samples_per_pixel: 1, seed: 0 };
        let stopped = render(sampling, &ProgressBar::hidden(), &AtomicBool::new(true), |_, _| Vec3::ZERO);
        assert!(stopped.is_err_and(|e| e.is::<Interrupted>()));
    }
}
