//! A density over the hemisphere as a picture: the map of normals, seen from above.

use std::sync::atomic::AtomicBool;

use glam::Vec3;
use indicatif::ProgressBar;

use crate::{
    failure::Failure,
    image::{Image, tone::hex},
    integrator::pixels::{Sampling, render},
    light::background,
};

/// The colours of a density, from none to its peak: night, violet, ember, straw.
pub fn ember(t: f32) -> Vec3 {
    const STOPS: [u32; 6] = [0x1a_1b22, 0x3b_2557, 0x83_2f5e, 0xcc_5540, 0xf1_9b50, 0xfd_ebb8];
    let place = t.clamp(0.0, 1.0) * (STOPS.len() - 1) as f32;
    let k = (place as usize).min(STOPS.len() - 2);
    // Between the stops evenly for the eye: in square roots of the linear values.
    let root = |rgb: u32| hex(rgb).map(f32::sqrt);
    let mixed = root(STOPS[k]).lerp(root(STOPS[k + 1]), place - k as f32);
    mixed * mixed
}

/// The disk of `(n_x, n_y)`, `n_y` upwards, with `√(density/peak)` in the colours of [`ember`].
pub fn hemisphere(
    sampling: Sampling,
    peak: f32,
    progress: &ProgressBar,
    interrupted: &AtomicBool,
    density: impl Fn(Vec3) -> f32 + Sync,
) -> Result<Image, Failure> {
    /// Radius of the disk, in halves of the picture.
    const RADIUS: f32 = 0.86;
    let (width, height) = (sampling.width as f32, sampling.height as f32);
    let half = 0.5 * width.min(height) * RADIUS;
    let rim = hex(0x8b_8d96);
    render(sampling, progress, interrupted, |px, py| {
        let (x, y) = ((px - 0.5 * width) / half, (0.5 * height - py) / half);
        let r2 = x * x + y * y;
        if r2 < 1.0 {
            ember((density(Vec3::new(x, y, (1.0 - r2).sqrt())) / peak).max(0.0).sqrt())
        } else if (r2.sqrt() - 1.0) * half < width / 384.0 {
            rim
        } else {
            background(px / width, py / height)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_colours_grow_lighter() {
        let lightness = |i: u8| ember(f32::from(i) / 50.0).dot(Vec3::new(0.2126, 0.7152, 0.0722));
        assert!((0..50).all(|i| lightness(i) < lightness(i + 1)));
        assert_eq!(ember(2.0), ember(1.0));
    }

    #[test]
    fn the_disk_shows_n_y_upwards() {
        let sampling = Sampling { width: 64, height: 64, samples_per_pixel: 1, seed: 1 };
        let (progress, never) = (ProgressBar::hidden(), AtomicBool::new(false));
        let image = hemisphere(sampling, 1.0, &progress, &never, |m| m.y.max(0.0)).unwrap();
        assert!(image.at(32, 8).x > 4.0 * image.at(32, 56).x);
    }
}
