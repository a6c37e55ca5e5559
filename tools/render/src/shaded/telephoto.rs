//! A patch of a plane through a telephoto lens, at increasing zoom.

use asperity_shading::glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::sampling::low_discrepancy::r2;
use crate::shaded::{
    pixel::{Eye, Pixel},
    subject::{Sky, Subject},
};

/// Pixels along a side of the patch at zoom 1.
const SIDE: f32 = 16.0;

/// A square patch of a plane, seen from far away in parallel rays, and its sampling.
///
/// At zoom 1 it covers 16² pixels, and at zoom z it covers z² times as many: an image of the whole
/// patch at ×10⁴ would have 2.6·10¹⁰. A number of them is rendered, at hashed positions in equal
/// squares of the patch, so that their mean is a stratified estimate of the mean over the patch.
#[derive(Clone, Copy, Debug)]
pub struct Patch {
    /// The square root of the maximum number of rendered pixels.
    pub pixels: u32,
    /// Jittered samples per pixel.
    pub samples: u32,
    /// The unit direction to the viewer, without component along x.
    pub view: Vec3,
}

/// A mean over pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// The mean of the three channels.
    pub value: f64,
    /// Its standard error, from the variation between pixels.
    pub error: f64,
}

/// A pixel's mean, and the range of its samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The mean of the three channels.
    pub mean: f64,
    /// The minimum and the maximum sample.
    pub range: [f64; 2],
}

impl Patch {
    /// Returns the derivatives of the plane for a pixel of this width.
    fn derivatives(&self, width: f32) -> [Vec2; 2] {
        [Vec2::new(width, 0.0), Vec2::new(0.0, width / self.view.z)]
    }

    /// Renders a pixel of this width under each sky.
    fn pixel<const K: usize>(
        &self,
        subject: &Subject,
        skies: &[Sky; K],
        center: Vec2,
        width: f32,
    ) -> [Frame; K] {
        let derivatives = self.derivatives(width);
        let mut frames = [Frame { mean: 0.0, range: [f64::INFINITY, f64::NEG_INFINITY] }; K];
        for k in 0..self.samples {
            let [x, y] = r2(k).map(|x| x as f32 - 0.5);
            let at = center + derivatives[0] * x + derivatives[1] * y;
            let pixel = Pixel::new(at, derivatives, 2, Eye::Towards(self.view));
            for (frame, radiance) in frames.iter_mut().zip(subject.radiances(&pixel, skies)) {
                let radiance = f64::from(radiance.dot(Vec3::ONE)) / 3.0;
                frame.mean += radiance;
                frame.range = [frame.range[0].min(radiance), frame.range[1].max(radiance)];
            }
        }
        frames.map(|frame| Frame { mean: frame.mean / f64::from(self.samples), ..frame })
    }

    /// Returns the mean radiances of the patch under several skies at a zoom.
    #[must_use]
    pub fn means<const K: usize>(&self, subject: &Subject, skies: &[Sky; K], zoom: f32) -> [Mean; K] {
        // Pixels do not overlap.
        let side = (self.pixels as f32).min(SIDE * zoom);
        let stratum = self.derivatives(subject.width * SIDE / side);
        let share = side / (SIDE * zoom);
        let side = side as u32;
        let row = |y: u32| -> Vec<[Frame; K]> {
            (0..side)
                .map(|x| {
                    let [i, j] = r2(y * side + x).map(|u| 0.5 + (1.0 - share) * (u as f32 - 0.5));
                    let center = stratum[0] * (x as f32 + i) + stratum[1] * (y as f32 + j);
                    self.pixel(subject, skies, center, subject.width / zoom)
                })
                .collect()
        };
        let pixels: Vec<[Frame; K]> = (0..side).into_par_iter().flat_map_iter(row).collect();
        let count = pixels.len() as f64;
        std::array::from_fn(|k| {
            let value = pixels.iter().map(|frames| frames[k].mean).sum::<f64>() / count;
            let squares = pixels.iter().map(|frames| (frames[k].mean - value).powi(2));
            let variance = squares.sum::<f64>() / (count - 1.0);
            Mean { value, error: (variance / count).sqrt() }
        })
    }

    /// Renders five slow zooms of 1 % per frame, with 200 frames each, into pixels of the patch:
    /// from ×1 to ×20,000 overall.
    #[must_use]
    pub fn slow_zooms(&self, subject: &Subject, sky: &Sky) -> Vec<Vec<Frame>> {
        let zoom = |start: u8| {
            let center = (Vec2::new(3.37, 5.71) + 0.83 * f32::from(start)) * subject.width;
            let first = 1.01_f32.powf(200.0 * f32::from(start));
            let frame = |k: u8| {
                let width = subject.width / (first * 1.01_f32.powf(f32::from(k)));
                let [frame] = self.pixel(subject, &[*sky], center, width);
                frame
            };
            (0..200_u8).into_par_iter().map(frame).collect()
        };
        (0..5).map(zoom).collect()
    }
}

/// Returns the largest frame-to-frame change relative to the trend (the median of the changes
/// around it), divided by the range of all samples of all zooms.
#[must_use]
pub fn largest_pop(zooms: &[Vec<Frame>]) -> f64 {
    let frames = zooms.iter().flatten();
    let [low, high] = frames.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], frame| {
        [low.min(frame.range[0]), high.max(frame.range[1])]
    });
    let pops = zooms.iter().flat_map(|frames| {
        let changes: Vec<f64> = frames.windows(2).map(|pair| pair[1].mean - pair[0].mean).collect();
        let beside = |about: &[f64]| {
            let mut sorted = about.to_vec();
            sorted.sort_by(f64::total_cmp);
            (about[3] - sorted[3]).abs()
        };
        changes.windows(7).map(beside).collect::<Vec<_>>()
    });
    pops.fold(0.0, f64::max) / (high - low)
}
