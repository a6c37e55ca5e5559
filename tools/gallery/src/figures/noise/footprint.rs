//! Frequency clamping on a plane up to the horizon.

use asperity_noise::{
    Fbm, FbmSpectrum, Field, Normalization, Shape, Simplex, Turbulence, filtered_fraction, pixel_footprint,
};
use asperity_render::image::{Image, tone::hex};
use glam::Vec2;

use crate::figure::{Context, Drawn, Panel};
use crate::figures::noise::plane::gray;
use crate::plot::decimal;
use asperity::failure::Result;

const OCTAVES: f32 = 8.0;
/// Samples along each side of a pixel of the reference.
const FINE: usize = 8;
/// Height of the viewer above the plane, in cells of the first octave.
const EYE: f32 = 2.2;
/// Half the width of the image, relative to its distance from the viewer.
const ZOOM: f32 = 0.8;
/// The horizon's position, as a fraction of the image height from the top.
const HORIZON: f32 = 0.12;

/// A plane, viewed by a camera that looks to the horizon.
#[derive(Clone, Copy)]
struct View {
    width: usize,
    height: usize,
}

impl View {
    /// Returns distance and pixel width of a row: the plane point at `(x, y)` pixels is
    /// `(step · (x − width/2), z)`.
    fn row(&self, y: f32) -> Option<(f32, f32)> {
        let down = (y - HORIZON * self.height as f32) * ZOOM / (0.5 * self.width as f32);
        let z = EYE / down;
        (down > 0.0 && z < 1e5).then(|| (z * ZOOM / (0.5 * self.width as f32), z))
    }

    /// Returns the footprint of the pixel around a point: the maximum change of the plane point
    /// between pixels.
    fn footprint(&self, x: f32, y: f32) -> Option<f32> {
        let (step, z) = self.row(y)?;
        // z = EYE/down, so dz = −z²/EYE · d(down).
        let dz = -z * z / EYE * ZOOM / (0.5 * self.width as f32);
        let dx = (x - 0.5 * self.width as f32) * step / z * dz;
        Some(pixel_footprint(Vec2::new(step, 0.0), Vec2::new(dx, dz)))
    }

    /// Returns the mean over `fine`² samples per pixel of a value at a point with the pixel's
    /// footprint; `None` above the horizon.
    fn pixels(
        &self,
        context: &Context<'_>,
        fine: usize,
        value: impl Fn(Vec2, f32) -> f32 + Sync,
    ) -> Result<Pixels> {
        context.rows(self.height, |y| {
            let place = |k: usize| (k as f32 + 0.5) / fine as f32;
            let lines: Option<Vec<_>> = (0..fine).map(|k| self.row(y as f32 + place(k))).collect();
            let pixel = |x: usize| {
                let footprint = self.footprint(x as f32 + 0.5, y as f32 + 0.5)?;
                let mut sum = 0.0;
                for &(step, z) in lines.as_ref()? {
                    for k in 0..fine {
                        let x = x as f32 + place(k) - 0.5 * self.width as f32;
                        sum += value(Vec2::new(step * x, z), footprint);
                    }
                }
                Some(sum / (fine * fine) as f32)
            };
            (0..self.width).map(pixel).collect::<Vec<_>>()
        })
    }
}

/// Values by pixel; `None` above the horizon.
type Pixels = Vec<Option<f32>>;

/// Returns the fraction of the sum's amplitudes that clamping removes.
fn removed(footprint: f32) -> f32 {
    let spectrum = FbmSpectrum::CLOUD;
    let octaves = 0..OCTAVES as u32;
    let lost = octaves
        .map(|i| spectrum.amplitude(i) * filtered_fraction(footprint, spectrum.frequency(i)))
        .sum::<f32>();
    lost / spectrum.sum_of_amplitudes(OCTAVES)
}

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let sum = Fbm::<_, Vec2>::new(Simplex::new(context.seed), FbmSpectrum::CLOUD)
        .with_normalization(Normalization::UnitRange);
    let turbulence = sum.with_shape(Turbulence).with_octaves(OCTAVES);
    let mean = turbulence.mean();
    let (_, mut rows) = panels(context, "cloud", [-0.6, 0.6], &sum.with_octaves(OCTAVES), 0.0)?;
    let (panels, more) = panels(context, "turbulence", [0.0, 0.75], &turbulence, mean)?;
    rows.extend(more);
    Ok(Drawn::new(2, panels)
        .fact("noise", format!("simplex, r² = 0.5, {OCTAVES} octaves, lacunarity 2, gain 0.5"))
        .fact("footprint", "largest change of a coordinate from pixel to pixel")
        .fact("near the horizon", "the sixth of the image below the horizon")
        .fact("mean of turbulence", format!("{mean:.4}"))
        .table(["sum", "pixels", "rms error", "near the horizon", "mean near the horizon"], rows))
}

/// Returns the panels and rows of one sum with mean `mean`, in gray between two values.
fn panels<T: Shape + Sync>(
    context: &Context<'_>,
    name: &str,
    [black, white]: [f32; 2],
    sum: &Fbm<Simplex, Vec2, T>,
    mean: f32,
) -> Result<(Vec<Panel>, Vec<[String; 5]>)> {
    let width = context.size as usize * 3 / 2;
    let view = View { width, height: width * 5 / 8 };
    let clamped = |p, footprint| sum.band_limited(footprint).value(p);
    let reference = view.pixels(context, FINE, |p, _| sum.value(p))?;
    let mut ways = vec![
        ("one", "one sample per pixel", view.pixels(context, 1, |p, _| sum.value(p))?),
        ("clamped", "one sample, clamped", view.pixels(context, 1, clamped)?),
    ];
    if mean != 0.0 {
        let towards_zero = |p, footprint| clamped(p, footprint) - mean * removed(footprint);
        ways.push(("zero", "one sample, clamped toward 0", view.pixels(context, 1, towards_zero)?));
    }
    ways.push(("reference", "64 samples", reference.clone()));
    let (mut panels, mut rows) = (Vec::new(), Vec::new());
    for (stem, label, pixels) in ways {
        let alt = format!("A plane with the pattern {name} up to the horizon, {label}.");
        let image = Image::from_fn(view.width as u32, view.height as u32, |x, y| {
            let sky = (y as f32 / (HORIZON * view.height as f32)).min(1.0);
            pixels[y as usize * view.width + x as usize].map_or_else(
                || hex(0x2c_3340).lerp(hex(0x76_8596), sky),
                |value| gray((value - black) / (white - black)),
            )
        });
        panels.push(Panel::new(stem, label, alt, image));
        let [all, near] = [1.0, 1.0 / 6.0].map(|share| compare(&view, &pixels, &reference, share));
        let [all, near, mean] = [all[0], near[0], near[1]].map(|v| decimal(v, 4));
        rows.push([name.to_owned(), label.to_owned(), all, near, mean]);
    }
    Ok((panels, rows))
}

/// Returns the root mean square difference over a fraction of the image below the horizon, and the
/// mean there.
fn compare(view: &View, pixels: &Pixels, reference: &Pixels, share: f32) -> [f64; 2] {
    let last = ((HORIZON + share) * view.height as f32) as usize * view.width;
    let (mut count, mut square, mut sum) = (0.0, 0.0, 0.0);
    for (a, b) in pixels.iter().zip(reference).take(last) {
        if let (Some(a), Some(b)) = (a, b) {
            (count, square, sum) = (count + 1.0, square + f64::from(a - b).powi(2), sum + f64::from(*a));
        }
    }
    [(square / f64::max(count, 1.0)).sqrt(), sum / f64::max(count, 1.0)]
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn footprint_is_the_difference_of_neighboring_pixels() {
        let view = View { width: 640, height: 400 };
        let point = |x: f32, y: f32| {
            let (step, z) = view.row(y).unwrap();
            Vec2::new(step * (x - 320.0), z)
        };
        for (x, y) in [(10.5, 60.5), (320.5, 60.5), (500.5, 399.5)] {
            let by_x = (point(x + 0.01, y) - point(x - 0.01, y)) / 0.02;
            let by_y = (point(x, y + 0.01) - point(x, y - 0.01)) / 0.02;
            let got = view.footprint(x, y).unwrap();
            assert_relative_eq!(got, pixel_footprint(by_x, by_y), max_relative = 0.01);
        }
        assert_eq!(view.footprint(320.0, 10.0), None);
    }
}
