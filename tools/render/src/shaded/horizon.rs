//! A plane up to the horizon.

use asperity_shading::glam::{Vec2, Vec3};

use crate::sampling::low_discrepancy::r2;
use crate::shaded::{
    pixel::{Eye, Pixel},
    subject::{Sky, Subject},
};

/// An image of the plane z = 0 from height 1 in direction y. Its horizon is the upper edge.
#[derive(Clone, Copy, Debug)]
pub struct Horizon {
    /// Image width in pixels.
    pub width: u32,
    /// Image height in pixels.
    pub height: u32,
    /// Samples of a pixel's mean.
    pub samples: u32,
}

/// A pixel from one unfiltered sample, one filtered sample, and many unfiltered samples.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    /// One sample at the center.
    pub plain: Vec3,
    /// One filtered sample at the center, given the pixel footprint.
    pub filtered: Vec3,
    /// The mean of [`Horizon::samples`].
    pub mean: Vec3,
}

impl Horizon {
    /// Returns the point of the plane at this image position.
    fn point(&self, x: f32, y: f32) -> Vec2 {
        let height = 0.6 * self.height as f32;
        let distance = height / (y + 0.02).max(0.02);
        Vec2::new((x - 0.5 * self.width as f32) / height * distance, distance)
    }

    /// Returns a pixel of a row, counted from the top. Eight units of the plane are the width of
    /// [`Subject`].
    #[must_use]
    pub fn seen(&self, [x, y]: [u32; 2], subject: &Subject, sky: &Sky) -> Seen {
        let (x, y) = (x as f32, y as f32);
        let (middle_x, middle_y) = (x + 0.5, y + 0.5);
        let middle = self.point(middle_x, middle_y);
        // The derivatives of the point per pixel.
        let height = 0.6 * self.height as f32;
        let derivatives = [Vec2::new(middle.y / height, 0.0), -middle * (middle.y / height)];
        let unit = subject.width / 8.0;
        let radiance = |at: Vec2, derivatives: [Vec2; 2]| {
            let (derivatives, eye) = (derivatives.map(|d| d * unit), Eye::At(Vec3::Z * unit));
            let [radiance] = subject.radiances(&Pixel::new(at * unit, derivatives, 32, eye), &[*sky]);
            radiance
        };
        let sum = (0..self.samples).map(r2).fold(Vec3::ZERO, |sum, [i, j]| {
            sum + radiance(self.point(x + i as f32, y + j as f32), [Vec2::ZERO; 2])
        });
        Seen {
            plain: radiance(middle, [Vec2::ZERO; 2]),
            filtered: radiance(middle, derivatives),
            mean: sum / self.samples as f32,
        }
    }
}

/// Returns the root mean square errors of one sample per pixel, without and with a filter.
#[must_use]
pub fn errors(pixels: &[Seen]) -> [f64; 2] {
    let rms = |error: fn(&Seen) -> Vec3| {
        let sum: f64 = pixels.iter().map(|seen| f64::from(error(seen).length_squared())).sum();
        (sum / pixels.len() as f64).sqrt()
    };
    [rms(|seen| seen.plain - seen.mean), rms(|seen| seen.filtered - seen.mean)]
}

/// Returns the deviation of filtered samples in the near half of an image of this width, relative
/// to the deviation of the means. Below 1 the filter blurs, above 1 it leaves noise.
#[must_use]
pub fn grain(pixels: &[Seen], width: u32) -> f64 {
    let near = &pixels[pixels.len() / width.max(1) as usize / 2 * width as usize..];
    let deviation = |value: fn(&Seen) -> Vec3| {
        // Between horizontal neighbors, so that trends with distance do not count.
        let difference = |pair: &[Seen]| f64::from((value(&pair[1]) - value(&pair[0])).length_squared());
        let rows = near.chunks(width.max(1) as usize);
        rows.flat_map(|row| row.windows(2)).map(difference).sum::<f64>().sqrt()
    };
    deviation(|seen| seen.filtered) / deviation(|seen| seen.mean)
}
