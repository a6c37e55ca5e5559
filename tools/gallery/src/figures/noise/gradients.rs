//! Exact gradients: as arrows over the values, as colors, and for lighting a relief; and warped
//! domains.

use asperity_noise::{Fbm, FbmSpectrum, Field, GaussianNoise, Sample, Simplex, Warp};
use asperity_render::image::tone::hex;
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn, Shown};
use crate::figures::noise::plane::{Window, gray};
use asperity::failure::Result;

const CELLS: f32 = 5.0;
/// Arrows along a side.
const ARROWS: usize = 20;
/// Length of an arrow for the root mean square slope, in arrow spacings.
const LENGTH: f32 = 0.62;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let window = Window::new(context, CELLS);
    let samples = window.map(context, |p: Vec2| GaussianNoise::new(context.seed).sample(p))?;
    let slope = steepness(&samples);

    let spacing = window.side as f32 / ARROWS as f32;
    let arrow = |column: usize, row: usize| {
        let center = Vec2::new(column as f32 + 0.5, row as f32 + 0.5) * spacing;
        let gradient = samples[center.y as usize * window.side + center.x as usize].gradient;
        // Pixels count downward.
        let along = Vec2::new(gradient.x, -gradient.y) * (LENGTH * spacing / slope);
        (center, along.clamp_length_max(1.25 * spacing))
    };
    let alt = "Gray blobs with arrows that point toward the bright blobs.";
    let words = ["arrows", "values in gray, gradients as arrows", alt];
    let arrows = window.panel(words, |i| {
        let pixel = Vec2::new((i % window.side) as f32 + 0.5, (i / window.side) as f32 + 0.5);
        let (column, row) = ((pixel.x / spacing) as usize, (pixel.y / spacing) as usize);
        let mut ink = 0.0_f32;
        for y in row.saturating_sub(1)..(row + 2).min(ARROWS) {
            for x in column.saturating_sub(1)..(column + 2).min(ARROWS) {
                let (center, along) = arrow(x, y);
                ink = ink.max(coverage(pixel - center, along, context.size as f32 / 384.0));
            }
        }
        gray(0.5 + 0.16 * samples[i].value).lerp(hex(0xff_d9a0), ink)
    });

    let alt = "Colored fans that meet in dark points.";
    let words = ["colors", "the gradient: direction as hue, length as strength", alt];
    let colors = window.panel(words, |i| hue(samples[i].gradient / (2.0 * slope)));

    let sum = Fbm::<_, Vec2>::new(GaussianNoise::new(context.seed), FbmSpectrum::new(2.17, RELIEF_GAIN, 6)?);
    let light = Vec3::new(-0.55, 0.55, 0.63).normalize();
    let alt = "A rugged relief of hills lit from the upper left.";
    let lit = window.draw(context, ["relief", "six octaves, lit by their gradient", alt], |p: Vec2| {
        hex(0xe8_dcc8) * (0.06 + 0.94 * lambert(sum.sample_with_octaves(p, 6.0).gradient * RELIEF, light))
    })?;
    Ok(Drawn::new(3, vec![arrows, colors, lit])
        .fact("noise", "Gaussian")
        .fact("image", format!("{CELLS} × {CELLS} cells"))
        .fact("root mean square slope", format!("{slope:.2} per cell")))
}

/// Height of the relief relative to a cell's width.
const RELIEF: f32 = 0.2;
/// Its gain, smaller than usual because slopes of an octave grow with its frequency.
const RELIEF_GAIN: f32 = 0.38;

/// Returns the cosine between the light and the upward normal of a relief of this slope, clamped at
/// 0.
fn lambert(slope: Vec2, light: Vec3) -> f32 {
    (-slope).extend(1.0).normalize().dot(light).max(0.0)
}

/// Returns the root mean square length of the gradients.
pub(super) fn steepness(samples: &[Sample<Vec2>]) -> f32 {
    (samples.iter().map(|s| s.gradient.length_squared()).sum::<f32>() / samples.len() as f32).sqrt()
}

/// Returns the coverage of the pixel at `p`, relative to an arrow's center; `unit` is a pixel of
/// the usual size.
fn coverage(p: Vec2, along: Vec2, unit: f32) -> f32 {
    let length = along.length();
    if length < 0.5 * unit {
        return 0.0;
    }
    let direction = along / length;
    let (x, y) = (p.dot(direction), p.dot(Vec2::new(-direction.y, direction.x)).abs());
    let (half, head) = (0.5 * length, (0.5 * length).min(5.0 * unit));
    let shaft = (0.5 * unit - y).min(x + half).min(half - head - x);
    // The head narrows from its length to the tip.
    let tip = (0.5 * (half - x) - y).min(x - (half - head));
    (shaft.max(tip) + 0.5).clamp(0.0, 1.0)
}

/// Maps a direction to hue and a length within [0, 1] to strength, with constant perceived
/// lightness at each length.
///
/// The circle lies in the plane of OKLab (Ottosson 2020, "A perceptual color space for image
/// processing").
pub(super) fn hue(v: Vec2) -> Vec3 {
    let strength = v.length().min(1.0);
    let (lightness, chroma) = (0.22 + 0.56 * strength.sqrt(), 0.11 * strength.sqrt());
    let circle = v.normalize_or_zero() * chroma;
    let l = lightness + 0.396_337_78 * circle.x + 0.215_803_76 * circle.y;
    let m = lightness - 0.105_561_346 * circle.x - 0.063_854_17 * circle.y;
    let s = lightness - 0.089_484_18 * circle.x - 1.291_485_5 * circle.y;
    let [l, m, s] = [l, m, s].map(|x| x * x * x);
    Vec3::new(
        4.076_741_7 * l - 3.307_711_6 * m + 0.230_969_94 * s,
        -1.268_438 * l + 2.609_757_4 * m - 0.341_319_38 * s,
        -0.004_196_086_3 * l - 0.703_418_6 * m + 1.707_614_7 * s,
    )
}

/// Domain warping: octave noise evaluated at points displaced by other octave noise.
pub(crate) fn draw_warp(context: &Context<'_>) -> Result<Drawn> {
    const CELLS: f32 = 3.0;
    const OCTAVES: f32 = 6.0;
    const STRENGTH: f32 = 0.22;
    /// Octaves of the displacement fields.
    const MOVING: f32 = 3.0;
    /// Height of the relief relative to a cell's width.
    const RELIEF: f32 = 0.05;
    let window = Window::new(context, CELLS);
    let sums: [_; 5] = std::array::from_fn(|k| {
        let seed = context.seed.wrapping_mul(16).wrapping_add(k as u32);
        Fbm::<_, Vec2>::new(Simplex::new(seed), FbmSpectrum::CLOUD)
    });
    let first = sums[0].with_octaves(OCTAVES);
    let moving = |k: usize| sums[k].with_octaves(MOVING);
    let once = Warp::new(first, [moving(1), moving(2)], STRENGTH)?;
    let by = Warp::new(moving(3), [moving(1), moving(2)], STRENGTH)?;
    let other = Warp::new(moving(4), [moving(1), moving(2)], STRENGTH)?;
    let twice = Warp::new(first, [by, other], STRENGTH)?;
    let shown =
        |words, value: Shown<'_, Vec2, f32>| window.draw(context, words, |p| gray(0.5 + 0.22 * value(p)));
    let light = Vec3::new(-0.5, 0.6, 0.62).normalize();
    let words = ["lit", "lit by its gradient", "A carved, tinted relief of the marbled streaks."];
    let lit = window.draw(context, words, |p: Vec2| {
        let Sample { value, gradient } = twice.sample(p);
        let moved = (twice.displacement(p).point - p) / STRENGTH;
        let tint = hex(0x3e_6a86).lerp(hex(0xd9_a066), (0.5 + 0.3 * moved.x).clamp(0.0, 1.0));
        let tint = tint.lerp(hex(0xf2_e8d5), (0.28 + 0.2 * value).clamp(0.0, 1.0));
        tint * (0.08 + 1.1 * lambert(gradient * RELIEF, light))
    })?;
    let panels = vec![
        shown(["plain", "f(p)", "Soft clouds."], &|p| first.value(p))?,
        shown(["once", "f(p + s w(p))", "The clouds stretched into streaks and folds."], &|p| once.value(p))?,
        shown(["twice", "w warped too", "Marbled streaks with eddies and sharp folds."], &|p| {
            twice.value(p)
        })?,
        lit,
    ];
    let noise = format!("simplex, r² = 0.5, f of {OCTAVES} octaves, lacunarity 2, gain 0.5, of variance 1");
    Ok(Drawn::new(4, panels)
        .fact("noise", noise)
        .fact("picture", format!("{CELLS} × {CELLS} cells"))
        .fact("w", format!("{MOVING} octaves, s = {STRENGTH}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hues_are_in_gamut_and_lighten_with_length() {
        let lightness = |c: Vec3| c.dot(Vec3::new(0.2126, 0.7152, 0.0722));
        for k in 0..24_u8 {
            let direction = Vec2::from_angle(f32::from(k) * std::f32::consts::TAU / 24.0);
            let mut last = -1.0;
            for length in [0.0, 0.25, 0.5, 1.0] {
                let color = hue(direction * length);
                assert!(color.min_element() > -0.01 && color.max_element() < 1.01, "{k}: {color}");
                assert!(lightness(color) > last);
                last = lightness(color);
            }
        }
    }

    #[test]
    fn arrow_covers_its_shaft_and_narrows_to_its_tip() {
        let covered = |x, y| coverage(Vec2::new(x, y), Vec2::new(20.0, 0.0), 1.0);
        assert_eq!([covered(0.0, 0.0), covered(0.0, 3.0), covered(12.0, 0.0)], [1.0, 0.0, 0.0]);
        assert!(covered(6.0, 1.0) > covered(9.0, 1.0));
        assert_eq!(coverage(Vec2::ZERO, Vec2::ZERO, 1.0), 0.0);
    }
}
