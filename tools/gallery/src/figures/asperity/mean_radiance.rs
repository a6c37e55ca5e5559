//! The mean radiance of a patch against zoom, for both level-of-detail rules.

use asperity_ndf_sampling::{Beckmann, Ggx};
use asperity_render::materials::field::{Bumps, Field, NoiseKind};
use asperity_render::{integrator::pixels::jitter, materials::SharedNdf};
use asperity_shading::{BumpField, Footprint, Frame, LevelOfDetail};
use glam::{DVec3, Vec3};

use crate::figure::{Context, Drawn, Panel};
use crate::plot::{Axis, Names, Plot, Stroke};
use asperity::failure::Result;
use asperity::input::density::painted;

/// Lattice cells of the first octave along the patch, and pixels sampled from it, at least one per
/// cell.
const CELLS: f32 = 320.0;
const PIXELS: u32 = 400;
const GAIN: f32 = 0.8;
/// Doublings of the zoom, denser where the first octave fades in.
const DOUBLINGS: [f64; 11] = [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0];

/// Zooms of the table, in doublings.
const SHOWN: [f64; 6] = [0.0, 0.5, 1.0, 2.0, 4.0, 6.0];

/// A density and a rule, for a half vector of view and light.
struct Case<'a> {
    density: [&'static str; 2],
    ndf: &'a SharedNdf,
    look: &'static str,
    h: Vec3,
    rule: LevelOfDetail,
    /// Ratio of mean to far field at each zoom.
    ratios: Vec<f64>,
}

/// A half vector: name and first two coordinates.
type Look = (&'static str, f32, f32);

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let (ggx, beckmann, painted) = (Ggx::new(0.2, 0.4)?, Beckmann::isotropic(0.3)?, painted()?);
    let lobes = [("brighter lobe", -0.38, 0.22), ("between the lobes", 0.0, 0.0)];
    let subjects: [([&str; 2], &SharedNdf, [Look; 2]); 3] = [
        (["ggx", "GGX 0.2, 0.4"], &ggx, [("peak", 0.0, 0.0), ("tail", 0.24, 0.42)]),
        (["beckmann", "Beckmann 0.3"], &beckmann, [("peak", 0.0, 0.0), ("tail", 0.34, 0.26)]),
        (["painted", "painted, two lobes"], &painted, lobes),
    ];
    let mut cases = Vec::new();
    for (density, ndf, looks) in subjects {
        for (look, x, y) in looks {
            let h = Vec3::new(x, y, (1.0 - x * x - y * y).sqrt());
            let rules = [LevelOfDetail::Exact, LevelOfDetail::Fractal];
            cases.extend(rules.map(|rule| Case { density, ndf, look, h, rule, ratios: Vec::new() }));
        }
    }
    let bumps = Bumps { kind: NoiseKind::Gaussian, frequency: 1.0, octaves: 16, gain: GAIN };
    let bumps = bumps.field(context.seed, DVec3::ZERO)?;
    for doubling in DOUBLINGS {
        measure(context, &mut cases, &bumps, f64::exp2(doubling) as f32)?;
    }
    let panels = cases.chunks(4).map(panel).collect::<Result<_, _>>()?;
    let zooms = SHOWN.map(|k| format!("×{:.3}", f64::exp2(k)).replace(".000", ""));
    let rows = cases.iter().map(|case| {
        let shown = DOUBLINGS.iter().zip(&case.ratios).filter(|(k, _)| SHOWN.contains(k));
        let words = [case.density[1].to_owned(), case.look.to_owned(), format!("{:?}", case.rule)];
        words.into_iter().chain(shown.map(|(_, ratio)| format!("{ratio:.3}"))).collect::<Vec<_>>()
    });
    Ok(Drawn::new(3, panels)
        .fact("noise", format!("Gaussian, gain {GAIN}, the first octave half a cell per pixel at zoom 1"))
        .fact("patch", format!("{CELLS} × {CELLS} cells of the first octave"))
        .fact("pixels per mean", format!("{PIXELS} × {PIXELS}, spread evenly over the patch"))
        .table(["density", "half-vector", "rule"].map(str::to_owned).into_iter().chain(zooms), rows))
}

/// Appends the mean of every case over the patch at one zoom, divided by the far field.
fn measure(context: &Context<'_>, cases: &mut [Case<'_>], bumps: &BumpField<Field>, zoom: f32) -> Result<()> {
    let footprint = Footprint::from_width(0.5 / zoom);
    // Tilted, so that a single plane of the lattice is not sampled.
    let (tangent, bitangent) = (Vec3::new(0.8, 0.36, -0.48), Vec3::new(0.0, 0.8, 0.6));
    let frame = Frame { tangent, bitangent, normal: tangent.cross(bitangent) };
    let rows = context.rows(PIXELS as usize, |y| {
        let (y, mut sums) = (y as u32, vec![0.0; cases.len()]);
        for x in 0..PIXELS {
            let place = jitter(x, y, context.seed);
            let step = CELLS / PIXELS as f32;
            let p = (tangent * (x as f32 + place.x) + bitangent * (y as f32 + place.y)) * step;
            let coordinates = bumps.coordinates(p, &frame, footprint);
            for (Case { ndf, h, rule, .. }, sum) in cases.iter().zip(&mut sums) {
                *sum += f64::from(rule.radiance(*ndf, *h, coordinates) * h.z);
            }
        }
        [sums]
    })?;
    for (k, case) in cases.iter_mut().enumerate() {
        let far = f64::from(case.ndf.d(case.h) * case.h.z);
        case.ratios.push(rows.iter().map(|row| row[k] / far / f64::from(PIXELS * PIXELS)).sum());
    }
    Ok(())
}

/// Plots the cases of one density.
fn panel(cases: &[Case<'_>]) -> Result<Panel> {
    let (x, y) = (Axis::log2("zoom", [1.0, 64.0]), Axis::log2("", [1.0 / 32.0, 16.0]));
    let mut plot = Plot::new([420.0, 380.0], x, y, Names::Above);
    for (k, case) in cases.iter().enumerate() {
        let series = (k % 2) as u8 + 1;
        let stroke = if k < 2 { Stroke::solid(series) } else { Stroke::dashed(series) };
        let points = DOUBLINGS.iter().zip(&case.ratios).map(|(k, ratio)| [f64::exp2(*k), *ratio]);
        plot = plot.curve(format!("{:?}, {}", case.rule, case.look), points, stroke);
    }
    let [stem, name] = cases[0].density;
    let label = format!("{name}: mean over the patch / p(h)");
    let alt = format!("{label}, against zoom: flat at 1 by the exact rule, deviating by the fractal rule");
    plot.panel(stem, label, alt)
}
