//! The mean radiance of every material from afar to very near, from renders, and the pops of slow zooms.

use asperity_render::shaded::{
    Frame, Mean, Patch, Pixel, Sky, Subject, fractal_bumps, largest_pop, materials,
};
use glam::Vec3;

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};
use crate::gallery::plot::{Axis, Names, Plot, Stroke};

const ZOOMS: [f32; 5] = [1.0, 10.0, 100.0, 1e3, 1e4];
const SAMPLES: u32 = 256;

/// From straight above, and at 60°.
const VIEWS: [(&str, Vec3); 2] = [("0°", Vec3::Z), ("60°", Vec3::new(0.0, -0.866_025_4, 0.5))];

/// By view and zoom.
type Means = [[Mean; 5]; 2];

fn bound(name: &str) -> f64 {
    if ["flakes", "passive flakes", "bumps"].contains(&name) { 0.02 } else { 0.05 }
}

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let sky = Sky::about(Vec3::new(-0.34, 0.42, 0.84));
    let subjects: Vec<Subject> = materials().into_iter().chain([fractal_bumps()]).collect();
    context.progress.inc_length(10 * subjects.len() as u64);
    let (mut panels, mut rows) = (Vec::new(), Vec::new());
    for subject in &subjects {
        let means = measure(context, subject, &sky)?;
        panels.push(panel(subject, &means)?);
        let pop = largest_pop(&slow(subject, &sky));
        for ((angle, _), means) in VIEWS.into_iter().zip(means) {
            let first = means[0].value;
            let mut row = vec![subject.name.to_owned(), angle.to_owned(), format!("{first:.4}")];
            let changes = means.iter().skip(1);
            row.extend(changes.map(|mean| {
                format!("{:+.2} ± {:.2} %", 100.0 * (mean.value / first - 1.0), 100.0 * mean.error / first)
            }));
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
        ["material", "seen at", "mean at ×1", "×10", "×100", "×1000", "×10,000", "largest pop of the range"];
    Ok(Drawn::new(4, panels)
        .fact("samples per pixel", SAMPLES.to_string())
        .fact("pixels", "576 of each picture; where details are wider than a pixel 10,816 of 16 samples")
        .fact("slow zoom", "1000 frames of 1 % from ×1 to ×20,000, in five pixels of 64 samples")
        .table(head, rows))
}

fn measure(context: &Context<'_>, subject: &Subject, sky: &Sky) -> Result<Means, Failure> {
    let mut means = [[Mean { value: 0.0, error: 0.0 }; 5]; 2];
    for ((_, view), means) in VIEWS.into_iter().zip(&mut means) {
        for (zoom, mean) in ZOOMS.into_iter().zip(means) {
            context.checkpoint()?;
            let from_afar = ["glass", "glass, noise", "orange peel", "bumps"].contains(&subject.name);
            let fine = from_afar || (["flakes", "paint"].contains(&subject.name) && zoom > 500.0);
            // Where a pixel sees one flake or one wave, so do all of its samples: more pixels of fewer.
            let (pixels, samples) = if zoom < 50.0 {
                (8, SAMPLES)
            } else if fine {
                (104, SAMPLES / 16)
            } else {
                (24, SAMPLES)
            };
            *mean = Patch { pixels, samples, view }.mean(subject, sky, zoom);
            context.progress.inc(1);
        }
    }
    Ok(means)
}

fn slow(subject: &Subject, sky: &Sky) -> Vec<Vec<Frame>> {
    Patch { pixels: 1, samples: SAMPLES / 4, view: VIEWS[1].1 }.slow_zooms(subject, sky)
}

fn zoom_axis() -> Axis {
    let ticks = [(1.0, "1"), (10.0, "10"), (100.0, "100"), (1e3, "10³"), (1e4, "10⁴")];
    Axis::log2("zoom", [0.7, 14_000.0], 1).with_ticks(&ticks)
}

fn panel(subject: &Subject, means: &Means) -> Result<Panel, Failure> {
    let fractal = subject.name == fractal_bumps().name;
    let bound = bound(if fractal { "bumps" } else { subject.name });
    let range = if fractal { [0.6, 1.1] } else { [0.9, 1.1] };
    let y = Axis::linear("", range, if fractal { 0.1 } else { 0.05 });
    let mut plot = Plot::new([300.0, 220.0], zoom_axis(), y, Names::Above).frame(
        [0.7, 14_000.0],
        [1.0 - bound, 1.0 + bound],
        3,
        0.12,
        0.0,
    );
    for ((k, means), (angle, _)) in means.iter().enumerate().zip(VIEWS) {
        let series = k as u8 + 1;
        // Beside one another, so that bars do not hide bars.
        let aside = if k == 0 { 0.94 } else { 1.06 };
        let first = means[0].value;
        let points: Vec<[f64; 2]> = ZOOMS
            .into_iter()
            .zip(means)
            .map(|(zoom, mean)| [f64::from(zoom) * aside, mean.value / first])
            .collect();
        for (point, mean) in points.iter().zip(means) {
            let reach = 2.0 * mean.error / first;
            let bar = [[point[0], point[1] - reach], [point[0], point[1] + reach]];
            plot = plot.line(bar, Stroke::solid(series));
        }
        plot = plot.curve(angle, points.clone(), Stroke::solid(series)).dots(points, series, 2.5);
    }
    let alt = format!("{}: mean radiance over that from afar, against zoom", subject.name);
    plot.panel(format!("mean-{}", stem(subject)), subject.name, alt)
}

/// A pixel in a slow zoom, smoothly and in steps.
fn followed(subject: Subject, sky: &Sky) -> Result<Panel, Failure> {
    let (name, stem) = (subject.name, stem(&subject));
    let smooth = curve(&slow(&subject, sky));
    let stepped = Subject::new(name, subject.width, move |pixel, sky| {
        let width = pixel.footprint().width();
        let by = width.log2().ceil().exp2() / width;
        subject.radiance(&Pixel { derivatives: pixel.derivatives.map(|d| d * by), ..*pixel }, sky)
    });
    let steps = curve(&slow(&stepped, sky));
    let most = smooth.iter().chain(&steps).fold(0.0_f64, |most, point| most.max(point[1]));
    let ticks = [(60.0, "60"), (120.0, "120"), (240.0, "240")];
    let x = Axis::log2("zoom", [FROM, FROM * 7.3], 1).with_ticks(&ticks);
    Plot::new([300.0, 220.0], x, Axis::linear("", [0.0, 1.1 * most], tick(most)), Names::Above)
        .curve("octaves at once", steps, Stroke::solid(2))
        .curve("as they are", smooth, Stroke::solid(1))
        .panel(
            format!("slow-{stem}"),
            format!("one pixel of {name}, slowly"),
            format!("The radiance of a pixel of {name} in a slow zoom"),
        )
}

/// First zoom of the slow zoom shown: 1.01⁴⁰⁰.
const FROM: f64 = 53.5;

fn curve(zooms: &[Vec<Frame>]) -> Vec<[f64; 2]> {
    let frames = zooms.get(2).into_iter().flatten();
    frames.enumerate().map(|(k, frame)| [FROM * 1.01_f64.powi(k as i32), frame.mean]).collect()
}

/// A step of about a third of a range: one, two or five times a power of ten.
fn tick(range: f64) -> f64 {
    let power = 10f64.powf((range / 3.0).log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|k| k * power).into_iter().find(|step| step * 4.0 > range).unwrap_or(power)
}

fn stem(subject: &Subject) -> String {
    subject.name.replace(", ", "-").replace(' ', "-")
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
