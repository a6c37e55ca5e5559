//! Measurements from renders: the mean radiance of every material at all zooms, and pops in slow
//! zooms. Every texture and material on a plane up to the horizon: one sample per pixel, unfiltered
//! and filtered, against 256 samples.

use asperity_render::image::Image;
use asperity_render::shaded::{
    Frame, Horizon, Mean, Patch, Seen, Sky, Subject, errors, fractal_bumps, grain, largest_pop, materials,
    textures,
};
use glam::Vec3;

use crate::figure::{Context, Drawn, Panel};
use crate::panels::side_by_side;
use crate::plot::{Axis, Names, Plot, Stroke};
use asperity::failure::Result;

const ZOOMS: [f32; 5] = [1.0, 10.0, 100.0, 1e3, 1e4];
const SAMPLES: u32 = 64;

/// From straight above, and at 60°.
const VIEWS: [(&str, Vec3); 2] = [("0°", Vec3::Z), ("60°", Vec3::new(0.0, -0.866_025_4, 0.5))];

/// By view and zoom.
type Means = [[Mean; 5]; 2];

pub(crate) fn draw_means(context: &Context<'_>) -> Result<Drawn> {
    let sky = Sky::about(Vec3::new(-0.34, 0.42, 0.84));
    let subjects: Vec<Subject> = materials().into_iter().chain([fractal_bumps()]).collect();
    context.watch.progress.inc_length(10 * subjects.len() as u64);
    let (mut panels, mut rows) = (Vec::new(), Vec::new());
    for subject in &subjects {
        let means = measure(context, subject, &sky)?;
        panels.push(panel(subject, &means)?);
        let pop = largest_pop(&slow(subject, &sky));
        for ((angle, _), means) in VIEWS.into_iter().zip(means) {
            let first = means[0].value;
            let mut row = vec![subject.name.to_owned(), angle.to_owned(), format!("{first:.4}")];
            let change = |Mean { value, error }: &Mean| {
                format!("{:+.2} ± {:.2} %", 100.0 * (value / first - 1.0), 100.0 * error / first)
            };
            row.extend(means[1..].iter().map(change));
            row.push(if angle == "60°" { format!("{:.2} %", 100.0 * pop) } else { String::new() });
            rows.push(row);
        }
    }
    for subject in subjects {
        if ["carpet", "paint", "bumps"].contains(&subject.name) {
            panels.push(followed(subject, &sky)?);
        }
    }
    let head =
        ["material", "view angle", "mean at ×1", "×10", "×100", "×1000", "×10,000", "largest pop / range"];
    Ok(Drawn::new(4, panels)
        .fact("samples per pixel", SAMPLES.to_string())
        .fact("pixels", "576 per image; 10,816 with 8 samples where details are wider than a pixel")
        .fact("slow zoom", "1000 frames of 1 % from ×1 to ×20,000, in five pixels of 64 samples")
        .table(head, rows))
}

fn measure(context: &Context<'_>, subject: &Subject, sky: &Sky) -> Result<Means> {
    let mut means = [[Mean { value: 0.0, error: 0.0 }; 5]; 2];
    for ((_, view), means) in VIEWS.into_iter().zip(&mut means) {
        for (zoom, mean) in ZOOMS.into_iter().zip(means) {
            context.checkpoint()?;
            let from_afar = ["glass", "glass, noise", "orange peel", "bumps"].contains(&subject.name);
            let from_near = ["flakes", "paint", "carpet", "carpet, grid", "fibers"].contains(&subject.name);
            let fine = from_afar || (from_near && zoom > 500.0);
            // If a pixel shows one flake, one fiber or one wave, all of its samples do: use more
            // pixels with fewer samples.
            let (pixels, samples) = match zoom {
                zoom if zoom < 50.0 => (8, 4 * SAMPLES),
                _ if fine => (104, SAMPLES / 8),
                _ => (24, SAMPLES),
            };
            [*mean] = Patch { pixels, samples, view }.means(subject, &[*sky], zoom);
            context.watch.progress.inc(1);
        }
    }
    Ok(means)
}

fn slow(subject: &Subject, sky: &Sky) -> Vec<Vec<Frame>> {
    Patch { pixels: 1, samples: SAMPLES, view: VIEWS[1].1 }.slow_zooms(subject, sky)
}

fn panel(subject: &Subject, means: &Means) -> Result<Panel> {
    let fractal = subject.name == fractal_bumps().name;
    let strict = fractal || ["flakes", "passive flakes", "bumps"].contains(&subject.name);
    let bound = if strict { 0.02 } else { 0.05 };
    let range = if fractal { [0.6, 1.1] } else { [0.9, 1.1] };
    let y = Axis::linear("", range, if fractal { 0.1 } else { 0.05 });
    let (within, zooms) = ([1.0 - bound, 1.0 + bound], [0.7, 14_000.0]);
    let ticks = [(1.0, "1"), (10.0, "10"), (100.0, "100"), (1e3, "10³"), (1e4, "10⁴")];
    let x = Axis::log2("zoom", zooms).with_ticks(&ticks);
    let mut plot = Plot::new([300.0, 220.0], x, y, Names::Above).frame(zooms, within, 3, 0.12, 0.0);
    for ((k, means), (angle, _)) in means.iter().enumerate().zip(VIEWS) {
        let series = k as u8 + 1;
        // Offset horizontally, so that error bars do not overlap.
        let aside = if k == 0 { 0.94 } else { 1.06 };
        let first = means[0].value;
        let point = |(zoom, mean): (f32, &Mean)| [f64::from(zoom) * aside, mean.value / first];
        let points: Vec<_> = ZOOMS.into_iter().zip(means).map(point).collect();
        for (point, mean) in points.iter().zip(means) {
            let reach = 2.0 * mean.error / first;
            let bar = [[point[0], point[1] - reach], [point[0], point[1] + reach]];
            plot = plot.line(bar, Stroke::solid(series));
        }
        plot = plot.curve(angle, points.clone(), Stroke::solid(series)).dots(points, series, 2.5);
    }
    let alt = format!("{}: mean radiance relative to the far view, against zoom", subject.name);
    plot.panel(format!("mean-{}", stem(subject.name)), subject.name, alt)
}

/// Plots a pixel during a slow zoom, smooth and stepped.
fn followed(subject: Subject, sky: &Sky) -> Result<Panel> {
    let name = subject.name;
    let smooth = curve(&slow(&subject, sky));
    let steps = curve(&slow(&subject.in_steps(), sky));
    let most = smooth.iter().chain(&steps).fold(0.0_f64, |most, point| most.max(point[1]));
    let ticks = [(60.0, "60"), (120.0, "120"), (240.0, "240")];
    let x = Axis::log2("zoom", [FROM, FROM * 7.3]).with_ticks(&ticks);
    let (label, alt) = (
        format!("one pixel of {name}, slow zoom"),
        format!("The radiance of a pixel of {name} in a slow zoom"),
    );
    Plot::new([300.0, 220.0], x, Axis::linear("", [0.0, 1.1 * most], tick(most)), Names::Above)
        .curve("octaves switched on", steps, Stroke::solid(2))
        .curve("octaves faded in", smooth, Stroke::solid(1))
        .panel(format!("slow-{}", stem(name)), label, alt)
}

/// First zoom of the slow zoom shown: 1.01⁴⁰⁰.
const FROM: f64 = 53.5;

fn curve(zooms: &[Vec<Frame>]) -> Vec<[f64; 2]> {
    let frames = zooms.get(2).into_iter().flatten();
    frames.enumerate().map(|(k, frame)| [FROM * 1.01_f64.powi(k as i32), frame.mean]).collect()
}

/// Returns a tick step of about a third of a range: one, two or five times a power of ten.
fn tick(range: f64) -> f64 {
    let power = 10f64.powf((range / 3.0).log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|k| k * power).into_iter().find(|step| step * 4.0 > range).unwrap_or(power)
}

const PICTURE: Horizon = Horizon { width: 60, height: 40, samples: 256 };

/// Screen pixels per image pixel, and gap between parts.
const SIDE: u32 = 6;
const GAP: u32 = 8;

pub(crate) fn draw_horizon(context: &Context<'_>) -> Result<Drawn> {
    let sky = Sky::about(Vec3::new(-0.48, 0.6, 0.64));
    let (mut panels, mut rows) = (Vec::new(), Vec::new());
    for subject in textures().into_iter().chain(materials()) {
        let seen = context.rows(PICTURE.height as usize, |y| {
            (0..PICTURE.width).map(|x| PICTURE.seen([x, y as u32], &subject, &sky)).collect::<Vec<_>>()
        })?;
        let [plain, filtered] = errors(&seen);
        let ratio = format!("{:.2}", filtered / plain);
        let near = format!("{:.2}", grain(&seen, PICTURE.width));
        let name = subject.name;
        let alt = format!("A plane of {name} up to the horizon: unfiltered, filtered, and with 256 samples");
        panels.push(Panel::new(stem(name), format!("{name}: {ratio}"), alt, triple(&seen)));
        rows.push([name.to_owned(), format!("{plain:.4}"), format!("{filtered:.4}"), ratio, near]);
    }
    let picture =
        format!("{} × {} pixels, {} samples in the mean", PICTURE.width, PICTURE.height, PICTURE.samples);
    Ok(Drawn::new(2, panels)
        .fact("image", picture)
        .fact("filter", "exact box filters, or up to 32 taps along the pixel's ellipse")
        .table(["surface", "error, unfiltered", "error, filtered", "ratio", "near noise"], rows))
}

/// Converts a name to a part of a file name.
fn stem(name: &str) -> String {
    name.replace(", ", "-").replace(' ', "-")
}

/// Places the three images side by side, exposed by their mean, with visible pixels.
fn triple(seen: &[Seen]) -> Image {
    let mut light: Vec<f32> = seen.iter().map(|pixel| pixel.mean.max_element()).collect();
    light.sort_by(f32::total_cmp);
    let bright = light.get(light.len() * 19 / 20).copied().unwrap_or(1.0).max(1e-6);
    let part = |value: fn(&Seen) -> Vec3| {
        Image::from_fn(PICTURE.width * SIDE, PICTURE.height * SIDE, |x, y| {
            value(&seen[((y / SIDE) * PICTURE.width + x / SIDE) as usize]) * (0.75 / bright)
        })
    };
    side_by_side(&[part(|p| p.plain), part(|p| p.filtered), part(|p| p.mean)], GAP, Vec3::ONE)
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn ticks_are_round_and_few() {
        for (range, step) in [(0.14, 0.05), (1.0, 0.5), (3.0, 1.0), (7.0, 2.0), (0.05, 0.02)] {
            assert_abs_diff_eq!(tick(range), step, epsilon = 1e-9);
        }
    }
}
