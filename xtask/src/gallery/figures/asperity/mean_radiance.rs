//! The mean radiance of a patch against zoom, for both rules of level of detail.

use asperity_ndf_sampling::{Beckmann, Ggx};
use asperity_render::{
    integrator::pixels::jitter,
    materials::{
        SharedNdf,
        field::{Field, NoiseKind},
    },
};
use asperity_shading::{BumpField, Footprint, LevelOfDetail};
use glam::Vec3;

use crate::{
    failure::Failure,
    gallery::{
        figure::{Context, Drawn, Panel},
        panels::rule_words,
        plot::{Axis, Names, Plot, Stroke},
    },
    input::density::painted,
};

/// Lattice cells of the first octave along the patch, and pixels drawn from it, one per cell and more.
const CELLS: f32 = 320.0;
const PIXELS: u32 = 400;
const GAIN: f32 = 0.8;
/// Doublings of the zoom, dense where the first octave fades in.
const DOUBLINGS: [f64; 11] = [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0];

/// A half-vector under which the patch is seen.
struct Look {
    name: &'static str,
    h: Vec3,
}

struct Subject<'a> {
    name: &'static str,
    stem: &'static str,
    ndf: &'a SharedNdf,
    looks: [Look; 2],
}

const RULES: [LevelOfDetail; 2] = [LevelOfDetail::Exact, LevelOfDetail::Fractal];

/// By density, half-vector and rule: mean over far field at each zoom.
type Ratios = Vec<[[f64; 2]; 2]>;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let (ggx, beckmann, painted) = (Ggx::new(0.2, 0.4)?, Beckmann::isotropic(0.3)?, painted()?);
    let look = |name, x: f32, y: f32| Look { name, h: Vec3::new(x, y, (1.0 - x * x - y * y).sqrt()) };
    let subject = |name, stem, ndf, looks| Subject { name, stem, ndf, looks };
    let subjects = [
        subject("GGX 0.2, 0.4", "ggx", &ggx, [look("peak", 0.0, 0.0), look("tail", 0.24, 0.42)]),
        subject("Beckmann 0.3", "beckmann", &beckmann, [look("peak", 0.0, 0.0), look("tail", 0.34, 0.26)]),
        subject(
            "painted, two lobes",
            "painted",
            &painted,
            [look("brighter lobe", -0.38, 0.22), look("between the lobes", 0.0, 0.0)],
        ),
    ];
    let bumps = BumpField::new(Field::new(NoiseKind::Gaussian, 16, GAIN, context.seed)?, 1.0)?;
    let mut curves: Vec<Ratios> = subjects.iter().map(|_| Vec::new()).collect();
    for doubling in DOUBLINGS {
        let means = measure(context, &subjects, &bumps, f64::exp2(doubling) as f32)?;
        for (curve, mean) in curves.iter_mut().zip(means) {
            curve.push(mean);
        }
    }
    let panels = subjects.iter().zip(&curves).map(|(s, c)| panel(s, c)).collect::<Result<_, _>>()?;
    let (head, rows) = table(&subjects, &curves);
    Ok(Drawn::new(3, panels)
        .fact("noise", format!("Gaussian, gain {GAIN}, the first octave half a cell per pixel at zoom 1"))
        .fact("patch", format!("{CELLS} × {CELLS} cells of the first octave"))
        .fact("pixels per mean", format!("{PIXELS} × {PIXELS}, spread evenly over the patch"))
        .table(head, rows))
}

/// The mean over the patch at one zoom, for every density, half-vector and rule, over the far field.
fn measure(
    context: &Context<'_>,
    subjects: &[Subject<'_>; 3],
    bumps: &BumpField<Field>,
    zoom: f32,
) -> Result<[[[f64; 2]; 2]; 3], Failure> {
    let footprint = Footprint::from_width(0.5 / zoom);
    // Slanted, so that no plane of the lattice is sampled alone.
    let (across, along) = (Vec3::new(0.8, 0.36, -0.48), Vec3::new(0.0, 0.8, 0.6));
    let rows = context.rows(PIXELS as usize, |y| {
        let (y, mut sums) = (y as u32, [[[0.0; 2]; 2]; 3]);
        for x in 0..PIXELS {
            let place = jitter(x, y, context.seed);
            let step = CELLS / PIXELS as f32;
            let p = (across * (x as f32 + place.x) + along * (y as f32 + place.y)) * step;
            let coordinates = bumps.coordinates(p, footprint);
            for (subject, sums) in subjects.iter().zip(&mut sums) {
                for (look, sums) in subject.looks.iter().zip(sums) {
                    // Seen and lit from the half-vector itself.
                    for (rule, sum) in RULES.into_iter().zip(sums) {
                        *sum += f64::from(rule.radiance(subject.ndf, look.h, coordinates) * look.h.z);
                    }
                }
            }
        }
        [sums]
    })?;
    let mut means = [[[0.0; 2]; 2]; 3];
    for row in rows {
        for s in 0..3 {
            for l in 0..2 {
                for r in 0..2 {
                    let look = &subjects[s].looks[l];
                    let far = f64::from(subjects[s].ndf.density(look.h) * look.h.z);
                    means[s][l][r] += row[s][l][r] / far / f64::from(PIXELS * PIXELS);
                }
            }
        }
    }
    Ok(means)
}

fn panel(subject: &Subject<'_>, curve: &Ratios) -> Result<Panel, Failure> {
    let (x, y) = (Axis::log2("zoom", [1.0, 64.0], 1), Axis::log2("", [1.0 / 32.0, 16.0], 1));
    let mut plot = Plot::new([420.0, 380.0], x, y, Names::Above);
    for (l, look) in subject.looks.iter().enumerate() {
        for (r, rule) in RULES.into_iter().enumerate() {
            let series = r as u8 + 1;
            let stroke = if l == 0 { Stroke::solid(series) } else { Stroke::dashed(series) };
            let points = DOUBLINGS.iter().zip(curve).map(|(k, mean)| [f64::exp2(*k), mean[l][r]]);
            plot = plot.curve(format!("{}, {}", rule_words(rule)[0], look.name), points, stroke);
        }
    }
    let label = format!("{}: mean over the patch / p(h)", subject.name);
    let alt = format!("{label}, against zoom: flat at 1 by the exact rule, off by the fractal rule");
    plot.panel(subject.stem, label, alt)
}

fn table(subjects: &[Subject<'_>; 3], curves: &[Ratios]) -> (Vec<String>, Vec<Vec<String>>) {
    let shown = |k: &f64| [0.0, 0.5, 1.0, 2.0, 4.0, 6.0].contains(k);
    let zooms = DOUBLINGS.iter().filter(|k| shown(k));
    let zooms = zooms.map(|k| format!("×{:.3}", f64::exp2(*k)).replace(".000", ""));
    let head = ["density", "half-vector", "rule"].map(str::to_owned).into_iter().chain(zooms).collect();
    let mut rows = Vec::new();
    for (subject, curve) in subjects.iter().zip(curves) {
        for (l, look) in subject.looks.iter().enumerate() {
            for (r, rule) in RULES.into_iter().enumerate() {
                let mut row = [subject.name, look.name, rule_words(rule)[0]].map(str::to_owned).to_vec();
                let means = DOUBLINGS.iter().zip(curve).filter(|(k, _)| shown(k));
                row.extend(means.map(|(_, mean)| format!("{:.3}", mean[l][r])));
                rows.push(row);
            }
        }
    }
    (head, rows)
}
