//! Area means of a fractal surface in closed form: the slopes within a pixel.

use asperity_fif::{AreaMeans, HeightField, Interval, SlopeMeans, cochran_2000};
use asperity_render::image::{Image, tone::hex};
use glam::Vec3;

use crate::figure::{Context, Drawn, Panel};
use asperity::failure::Result;

/// Pixels along a side.
const SIDE: u32 = 48;
/// The width of the domain.
const WIDTH: f64 = 2.0;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let axis = cochran_2000::g_hat()?;
    let surface = HeightField::new(axis, axis);
    let cell = WIDTH / f64::from(SIDE);
    let over = |x: u32, y: u32, share: f64| -> Result<SlopeMeans> {
        let side = |k: u32| {
            let middle = (f64::from(k) + 0.5) * cell;
            Interval::new(middle - 0.5 * share * cell, middle + 0.5 * share * cell)
        };
        let AreaMeans { slopes, .. } = surface.area_means(side(x), side(SIDE - 1 - y))?;
        Ok(slopes.ok_or("the surface has no slopes")?)
    };
    let (mut points, mut means, mut spreads) = (Vec::new(), Vec::new(), Vec::new());
    for y in 0..SIDE {
        context.checkpoint()?;
        for x in 0..SIDE {
            // A rectangle of zero area is a point.
            points.push(over(x, y, 0.0)?.slope[0].value);
            let pixel = over(x, y, 1.0)?;
            let slope = pixel.slope[0].value;
            means.push(slope);
            spreads.push((pixel.squared[0].value - slope * slope).max(0.0).sqrt());
        }
    }
    let top = spreads.iter().fold(0.0_f64, |top, x| top.max(*x));
    let (low, high) = points.iter().fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(*x), h.max(*x)));
    let picture = |values: &[f64], color: &(dyn Fn(f64) -> Vec3 + Sync)| {
        let scale = (context.size / SIDE).max(1);
        Image::from_fn(SIDE * scale, SIDE * scale, |x, y| {
            color(values[((y / scale) * SIDE + x / scale) as usize])
        })
    };
    let slopes = |x: f64| hex(0x17_2a45).lerp(hex(0xf2_e2b8), ((x - low) / (high - low)) as f32);
    let widths = |x: f64| hex(0x1d_1f23).lerp(hex(0xe8_6a4a), (x / top) as f32);
    let (middle, mean) = ("Slope at the pixel center", "Mean slope over the pixel");
    let (bars, fewer) = ("Vertical bars of many shades", "Bars of the same colors, with fewer extremes");
    let (deviation, bands) =
        ("Standard deviation within the pixel", "Bands, brightest where slopes change the most");
    let panels = vec![
        Panel::new("point", middle, bars, picture(&points, &slopes)),
        Panel::new("mean", mean, fewer, picture(&means, &slopes)),
        Panel::new("spread", deviation, bands, picture(&spreads, &widths)),
    ];
    Ok(Drawn::new(3, panels)
        .fact("slopes", format!("{low:.3} to {high:.3}"))
        .fact("largest deviation in a pixel", format!("{top:.4}")))
}
