//! Frequency clamping on a plane to the horizon.

use asperity_noise::{
    Field, Normalisation, Octaves, Shape, Simplex, Spectrum, Turbulence, pixel_footprint, removed_share,
};
use asperity_render::image::{Image, tone::hex};
use glam::{Vec2, Vec3};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};
use crate::gallery::figures::noise::plane::grey;

const OCTAVES: f32 = 8.0;
/// Samples along each side of a pixel of the reference.
const FINE: usize = 8;
/// Height of the eye over the plane, in cells of the first octave.
const EYE: f32 = 2.2;
/// Half the width of the picture over its distance from the eye.
const ZOOM: f32 = 0.8;
/// The horizon's place, as a share of the picture's height from the top.
const HORIZON: f32 = 0.12;

/// A plane seen through a camera that looks to the horizon.
#[derive(Clone, Copy)]
struct View {
    width: usize,
    height: usize,
}

impl View {
    /// Distance and width of a pixel's row: the point of the plane at `(x, y)` pixels is `(step · (x − width/2), z)`.
    fn row(&self, y: f32) -> Option<(f32, f32)> {
        let down = (y - HORIZON * self.height as f32) * ZOOM / (0.5 * self.width as f32);
        let z = EYE / down;
        (down > 0.0 && z < 1e5).then(|| (z * ZOOM / (0.5 * self.width as f32), z))
    }

    /// The footprint of the pixel around a point: how far the plane's point moves from pixel to pixel, at most.
    fn footprint(&self, x: f32, y: f32) -> Option<f32> {
        let (step, z) = self.row(y)?;
        // z = EYE/down, so dz = −z²/EYE · d(down).
        let dz = -z * z / EYE * ZOOM / (0.5 * self.width as f32);
        let dx = (x - 0.5 * self.width as f32) * step / z * dz;
        Some(pixel_footprint(Vec2::new(step, 0.0), Vec2::new(dx, dz)))
    }

    /// Values at one point of each pixel, or none over the horizon.
    fn points(&self, value: &Way<'_>, context: &Context<'_>) -> Result<Pixels, Failure> {
        context.rows(self.height, |y| {
            let y = y as f32 + 0.5;
            let pixel = move |x: usize| {
                let x = x as f32 + 0.5;
                let (step, z) = self.row(y)?;
                value(Vec2::new(step * (x - 0.5 * self.width as f32), z), self.footprint(x, y)?)
            };
            (0..self.width).map(pixel)
        })
    }

    /// Means over fine samples of each pixel.
    fn means(&self, value: impl Fn(Vec2) -> f32 + Sync, context: &Context<'_>) -> Result<Pixels, Failure> {
        context.rows(self.height, |y| {
            let place = |k: usize| (k as f32 + 0.5) / FINE as f32;
            let lines: Option<Vec<_>> = (0..FINE).map(|k| self.row(y as f32 + place(k))).collect();
            let pixel = |x: usize| {
                let mut sum = 0.0;
                for &(step, z) in lines.as_ref()? {
                    for k in 0..FINE {
                        let x = x as f32 + place(k) - 0.5 * self.width as f32;
                        sum += value(Vec2::new(step * x, z));
                    }
                }
                Some(sum / (FINE * FINE) as f32)
            };
            (0..self.width).map(pixel).collect::<Vec<_>>()
        })
    }
}

/// Values by pixel; none over the horizon.
type Pixels = Vec<Option<f32>>;

/// The value at a point for a footprint.
type Way<'a> = dyn Fn(Vec2, f32) -> Option<f32> + Sync + 'a;

/// The share of the sum's amplitudes that clamping removes.
fn removed(footprint: f32) -> f32 {
    let spectrum = Spectrum::CLOUD;
    let octaves = 0..OCTAVES as u32;
    let lost =
        octaves.map(|i| spectrum.amplitude(i) * removed_share(footprint, spectrum.frequency(i))).sum::<f32>();
    lost / spectrum.sum_of_amplitudes(OCTAVES)
}

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let width = context.size as usize * 3 / 2;
    let view = View { width, height: width * 5 / 8 };
    let sum = Octaves::<_, 2>::new(Simplex::new(context.seed), Spectrum::CLOUD)
        .with_normalisation(Normalisation::Range);
    let cloud = Subject { context, view, name: "cloud", range: [-0.6, 0.6] };
    let (_, mut rows) = cloud.panels(&sum.first(OCTAVES), 0.0)?;
    let turbulence = Subject { name: "turbulence", range: [0.0, 0.75], ..cloud };
    let sum = sum.with_shape(Turbulence);
    let (panels, more) = turbulence.panels(&sum.first(OCTAVES), sum.first(OCTAVES).mean())?;
    rows.extend(more);
    Ok(Drawn::new(2, panels)
        .fact("noise", format!("simplex, r² = 0.5, {OCTAVES} octaves, lacunarity 2, gain 0.5"))
        .fact("footprint", "largest change of a coordinate from pixel to pixel")
        .fact("near the horizon", "the sixth of the picture below it")
        .fact("mean of turbulence", format!("{:.4}", sum.first(OCTAVES).mean()))
        .table(["sum", "pixels", "rms error", "near the horizon", "mean near the horizon"], rows))
}

/// A sum on the plane.
#[derive(Clone, Copy)]
struct Subject<'a> {
    context: &'a Context<'a>,
    view: View,
    name: &'static str,
    /// Values of black and white.
    range: [f32; 2],
}

impl Subject<'_> {
    /// The panels and rows of one sum, which has the mean `mean`.
    fn panels<T: Shape + Sync>(
        &self,
        sum: &Octaves<Simplex, 2, T>,
        mean: f32,
    ) -> Result<(Vec<Panel>, Vec<Vec<String>>), Failure> {
        let reference = self.view.means(|p| sum.value(p), self.context)?;
        let ways: [(&str, &str, &Way<'_>); 4] = [
            ("one", "one sample per pixel", &|p, _| Some(sum.value(p))),
            ("clamped", "one sample, clamped", &|p, footprint| Some(sum.clamped(footprint).value(p))),
            ("zero", "one sample, clamped towards 0", &|p, footprint| {
                let lost = mean * removed(footprint);
                (mean != 0.0).then(|| sum.clamped(footprint).value(p) - lost)
            }),
            ("reference", "64 samples", &|_, _| None),
        ];
        let (mut panels, mut rows) = (Vec::new(), Vec::new());
        for (stem, label, way) in ways {
            let pixels =
                if stem == "reference" { reference.clone() } else { self.view.points(way, self.context)? };
            if pixels.iter().all(Option::is_none) {
                continue;
            }
            let alt = format!("A plane with the pattern {} running to the horizon, {label}.", self.name);
            panels.push(Panel::raster(stem, label, alt, self.image(&pixels)));
            let [all, near] = [1.0, 1.0 / 6.0].map(|share| self.compare(&pixels, &reference, share));
            let numbers = [all[0], near[0], near[1]].map(|v| format!("{v:.4}").replace('-', "\u{2212}"));
            let mut row = vec![self.name.to_owned(), label.to_owned()];
            row.extend(numbers);
            rows.push(row);
        }
        Ok((panels, rows))
    }

    /// The root mean square difference over a share of the picture from the horizon down, and the mean there.
    fn compare(&self, pixels: &Pixels, reference: &Pixels, share: f32) -> [f64; 2] {
        let last = ((HORIZON + share) * self.view.height as f32) as usize * self.view.width;
        let (mut count, mut square, mut sum) = (0.0, 0.0, 0.0);
        for (a, b) in pixels.iter().zip(reference).take(last) {
            if let (Some(a), Some(b)) = (a, b) {
                (count, square, sum) = (count + 1.0, square + f64::from(a - b).powi(2), sum + f64::from(*a));
            }
        }
        [(square / f64::max(count, 1.0)).sqrt(), sum / f64::max(count, 1.0)]
    }

    fn image(&self, pixels: &Pixels) -> Image {
        let [black, white] = self.range;
        let sky = |y: u32| {
            hex(0x2c_3340).lerp(hex(0x76_8596), (y as f32 / (HORIZON * self.view.height as f32)).min(1.0))
        };
        Image::from_fn(self.view.width as u32, self.view.height as u32, |x, y| -> Vec3 {
            match pixels[y as usize * self.view.width + x as usize] {
                Some(value) => grey((value - black) / (white - black)),
                None => sky(y),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn the_footprint_is_the_difference_of_neighbouring_pixels() {
        let view = View { width: 640, height: 400 };
        let point = |x: f32, y: f32| {
            let (step, z) = view.row(y).unwrap();
            Vec2::new(step * (x - 320.0), z)
        };
        for (x, y) in [(10.5, 60.5), (320.5, 60.5), (500.5, 399.5)] {
            let [ddx, ddy] = [[0.01, 0.0], [0.0, 0.01]]
                .map(|[dx, dy]| (point(x + dx, y + dy) - point(x - dx, y - dy)) / 0.02);
            let (expected, got) = (pixel_footprint(ddx, ddy), view.footprint(x, y).unwrap());
            assert_relative_eq!(got, expected, max_relative = 0.01);
        }
        assert_eq!(view.footprint(320.0, 10.0), None);
    }
}
